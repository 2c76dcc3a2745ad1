// Visibility as a mean and a few components, with weights for each cell: Iwanicki and Sloan, Normal Mapping with
// Low-Frequency Precomputed Visibility, JGT 2012, section 3.2, and two other choices of what components should keep.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lighting/pca.h"
#include "lighting/visibility_bake.h"
#include "lighting/weighted_components.h"

namespace twinshade {

// What components keep most of: the irradiance that surfaces show under any light (lighting/surface_metric.h);
// visibility itself in all directions, the paper's; or the irradiance under one light (lighting/irradiance_metric.h).
enum class PcaMetric { surface, visibility, irradiance };
std::string_view pca_metric_name(PcaMetric metric);
PcaMetric find_pca_metric(const std::string& name);  // UserError with the nearest names where there is none

class VisibilityComponents {
 public:
  // Of visibility of `order`, 2 to 6. light: of PcaMetric::irradiance, real SH, [j * 3 + c]. The bake must outlive
  // this.
  VisibilityComponents(const VisibilityBake& bake, int order, PcaMetric metric, std::span<const double> light);

  // The mean, then `count` components, as SH: [(1 + component) * order^2 + k]. Components beyond the rank of what
  // varies are zero.
  std::vector<double> rows(std::size_t count);
  // Weights of another bake's cells, or the same's: [cell * count + component].
  std::vector<float> weights(const VisibilityBake& bake, std::size_t count);

 private:
  struct Fit {
    PrincipalComponents principal;
    std::optional<WeightedComponents> weighted;  // instead, where chosen by surface and something is left to choose
  };
  const Fit& fit(std::size_t count);

  const VisibilityBake& bake_;
  const std::size_t dimension_;
  std::vector<double> metric_;                // of all cells; none: sum of squares
  std::vector<std::uint16_t> group_of_cell_;  // of PcaMetric::surface, and the groups' metrics
  std::vector<double> group_metrics_;
  std::map<std::size_t, Fit> fits_;  // by count
};

}  // namespace twinshade

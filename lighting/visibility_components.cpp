#include "lighting/visibility_components.h"

#include <utility>

#include "base/error.h"
#include "base/names.h"
#include "lighting/irradiance_metric.h"
#include "lighting/surface_metric.h"

namespace twinshade {
namespace {

// Principal components that leave less than this part of the variance are as good as any.
constexpr double kNothingLeft = 1e-10;

}  // namespace

std::string_view pca_metric_name(PcaMetric metric) {
  return metric == PcaMetric::surface ? "surface" : metric == PcaMetric::visibility ? "visibility" : "irradiance";
}

PcaMetric find_pca_metric(const std::string& name) {
  std::vector<std::string> names;
  for (const PcaMetric metric : {PcaMetric::surface, PcaMetric::visibility, PcaMetric::irradiance}) {
    names.emplace_back(pca_metric_name(metric));
    if (names.back() == name) return metric;
  }
  throw UserError(unknown_name_message("metric", name, names));
}

VisibilityComponents::VisibilityComponents(const VisibilityBake& bake, int order, PcaMetric metric,
                                           std::span<const double> light)
    : bake_(bake), dimension_(std::size_t(order) * std::size_t(order)) {
  if (metric == PcaMetric::irradiance) metric_ = irradiance_metric(light, order);
  if (metric == PcaMetric::surface) {
    group_of_cell_ = surface_groups(bake.normal);
    group_metrics_ = surface_metrics(bake.normal, bake.area, order);
    metric_ = mean_metric({group_of_cell_, group_metrics_}, bake.area, dimension_);
  }
}

const VisibilityComponents::Fit& VisibilityComponents::fit(std::size_t count) {
  if (const auto found = fits_.find(count); found != fits_.end()) return found->second;
  Fit made;
  made.principal = principal_components(bake_.sh, kVisibilityCount, dimension_, bake_.area, count, metric_);
  if (!group_metrics_.empty() && made.principal.tail(count) > kNothingLeft * made.principal.tail(0))
    made.weighted =
        weighted_components(bake_.sh, kVisibilityCount, bake_.area, {group_of_cell_, group_metrics_}, made.principal);
  return fits_.emplace(count, std::move(made)).first->second;
}

std::vector<double> VisibilityComponents::rows(std::size_t count) {
  const Fit& chosen = fit(count);
  std::vector<double> rows = chosen.principal.mean;
  const std::vector<double>& vectors = chosen.weighted ? chosen.weighted->vectors : chosen.principal.vectors;
  rows.insert(rows.end(), vectors.begin(), vectors.end());
  return rows;
}

std::vector<float> VisibilityComponents::weights(const VisibilityBake& bake, std::size_t count) {
  const Fit& chosen = fit(count);
  return chosen.weighted ? chosen.weighted->project(bake.sh, kVisibilityCount, surface_groups(bake.normal))
                         : chosen.principal.project(bake.sh, kVisibilityCount, count);
}

}  // namespace twinshade

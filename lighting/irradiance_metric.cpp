#include "lighting/irradiance_metric.h"

#include "lighting/light_tables.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

constexpr double kLeastWeight = 1e-6;

}  // namespace

std::vector<double> irradiance_metric(std::span<const double> light, int order) {
  const std::size_t n = std::size_t(order) * std::size_t(order);
  const auto cosine = clamped_cosine_factors();
  const std::vector<double> products = light_times_harmonics(light, order);  // [(i * 3 + channel) * n + j]
  std::vector<double> metric(n * n, 0.0);
  double trace = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t j = 0; j < n; ++j)
          metric[i * n + k] +=
              cosine[j] * cosine[j] * products[(i * 3 + channel) * n + j] * products[(k * 3 + channel) * n + j];
    trace += metric[i * n + i];
  }
  const double least = trace > 0 ? kLeastWeight * trace / double(n) : 1.0;
  for (std::size_t i = 0; i < n; ++i) metric[i * n + i] += least;
  return metric;
}

}  // namespace twinshade

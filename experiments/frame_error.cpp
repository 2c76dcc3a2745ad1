#include "experiments/frame_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"

namespace twinshade {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

double ratio(double part, double whole) { return whole > 0 ? part / whole : kMissing; }

// Sum over channels.
double product(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double sum(const glm::dvec3& a) { return a.x + a.y + a.z; }

}  // namespace

FrameError frame_error(const Frame& frame, const Truth& truth) {
  const std::size_t count = truth.pixels.size();
  TWINSHADE_CHECK_EQ(truth.radiance[0].size(), count);
  TWINSHADE_CHECK_EQ(truth.radiance[1].size(), count);
  double squared = 0, truth_squared = 0, difference = 0, truth_sum = 0;
  std::vector<double> distances;
  distances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* shown = &frame.color[truth.pixels[i] * 4];
    const glm::dvec3 color(shown[0], shown[1], shown[2]);
    if (!std::isfinite(sum(color))) return {kMissing, kMissing, kMissing, false};
    const glm::dvec3 a(truth.radiance[0][i]), b(truth.radiance[1][i]), mean = (a + b) / 2.0;
    squared += product(color - a, color - b);
    truth_squared += product(a, b);
    difference += sum(color - mean);
    truth_sum += sum(mean);
    distances.push_back(product(color - mean, color - mean));
  }
  if (count == 0) return {kMissing, kMissing, kMissing, true};
  const auto worst = distances.begin() + std::ptrdiff_t((count - 1) * 99 / 100);
  std::nth_element(distances.begin(), worst, distances.end());
  return {std::sqrt(ratio(std::max(0.0, squared), truth_squared)), ratio(difference, truth_sum),
          std::sqrt(ratio(*worst * double(count), truth_squared)), true};
}

double truth_noise(const Truth& truth) {
  double squared = 0, truth_squared = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const glm::dvec3 a(truth.radiance[0][i]), b(truth.radiance[1][i]);
    squared += product(a - b, a - b) / 4;
    truth_squared += product(a, b);
  }
  return std::sqrt(ratio(squared, truth_squared));
}

std::vector<std::size_t> stratified_places(std::size_t count, std::size_t wanted, std::uint64_t seed) {
  std::vector<std::size_t> places;
  const std::size_t stretches = std::min(count, wanted);
  for (std::size_t k = 0; k < stretches; ++k) {
    const double place = (double(k) + unit_real(random_bits(seed, kReferencePixel, k))) * double(count);
    places.push_back(stretches == count ? k : std::min(count - 1, std::size_t(place / double(stretches))));
  }
  return places;
}

}  // namespace twinshade

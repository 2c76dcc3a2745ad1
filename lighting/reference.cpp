#include "lighting/reference.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/direction_sets.h"
#include "lighting/environment_sampler.h"
#include "lighting/progress.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"
#include "lighting/receivers.h"

namespace twinshade {
namespace {

constexpr std::size_t kPointsAtOnce = 256;  // points handed to a thread at a time

class Tracer {
 public:
  Tracer(const Scene& scene, const Environment& environment, const ReferenceOptions& options)
      : options_(options),
        rays_(scene),
        light_(environment),
        bright_samples_(light_.has_bright() ? std::max(16u, options.rays / 8) : 0) {}

  glm::vec3 radiance(const ShadedPoint& point, std::uint64_t index) const {
    const glm::dvec3 plane = rays_.geometric_normal(point.triangle);
    const glm::vec3 origin(glm::dvec3(point.position) + plane * rays_.lift(point.position));
    const auto sees = [&](const glm::vec3& direction) {
      return glm::dot(glm::dvec3(direction), plane) > 0 && !rays_.occluded(origin, direction, point.triangle);
    };

    // Directions in proportion to the cosine: z = sqrt(1 - a) of a stratified a
    const glm::dvec3 normal(point.normal);
    const glm::dmat3 frame = tangent_frame(normal, glm::dvec3(0), 1, plane);
    const std::uint32_t scramble = std::uint32_t(random_bits(options_.seed, kReferenceScramble, index));
    glm::dvec3 irradiance(0);
    for (std::uint32_t ray = 0; ray < options_.rays; ++ray) {
      const double a = (ray + unit_real(random_bits(options_.seed, kReferenceJitter, index, ray))) / options_.rays;
      const glm::vec3 direction(
          frame * hemisphere_direction(std::sqrt(1 - a), scrambled_radical_inverse(ray, scramble) * 0x1p-32));
      if (sees(direction)) irradiance += glm::dvec3(light_.rest(direction));
    }
    irradiance *= portable::kPi / options_.rays;

    const double offset = unit_real(random_bits(options_.seed, kReferenceBright, index));
    for (std::uint32_t s = 0; s < bright_samples_; ++s) {
      const std::uint64_t bits = random_bits(options_.seed, kReferencePlace, index, s);
      const EnvironmentSampler::Sample sample = light_.bright(
          (s + offset) / bright_samples_, double(bits >> 32) * 0x1p-32, double(bits & 0xffffffffu) * 0x1p-32);
      const double cosine = glm::dot(sample.direction, frame[2]);
      if (cosine > 0 && sees(glm::vec3(sample.direction))) irradiance += sample.radiance * (cosine / bright_samples_);
    }
    return glm::vec3(irradiance * glm::dvec3(point.albedo) / portable::kPi);
  }

  std::uint32_t rays_per_point() const { return options_.rays + bright_samples_; }

 private:
  const ReferenceOptions& options_;
  const RayScene rays_;
  const EnvironmentSampler light_;
  const std::uint32_t bright_samples_;
};

}  // namespace

std::vector<glm::vec3> reference_radiance(const Scene& scene, const Environment& environment,
                                          std::span<const ShadedPoint> points, const ReferenceOptions& options) {
  if (options.rays < 1 || options.rays > 65536)
    throw UserError("reference rays: " + std::to_string(options.rays) + " is not within 1 to 65536");
  const Tracer tracer(scene, environment, options);
  std::vector<glm::vec3> radiance(points.size());
  Progress progress("reference", "rays", points.size() * tracer.rays_per_point(), options.show_progress);
  parallel_for((points.size() + kPointsAtOnce - 1) / kPointsAtOnce, [&](std::size_t chunk, int) {
    const std::size_t first = chunk * kPointsAtOnce, last = std::min(points.size(), first + kPointsAtOnce);
    for (std::size_t i = first; i < last; ++i) radiance[i] = tracer.radiance(points[i], i);
    progress.add((last - first) * tracer.rays_per_point());
  });
  return radiance;
}

Environment environment_of_radiance(std::span<const double> radiance, int order, std::uint32_t width) {
  TWINSHADE_CHECK_LE(1, order);
  TWINSHADE_CHECK_LE(order, 6);
  const std::size_t count = std::size_t(order) * std::size_t(order);
  TWINSHADE_CHECK_LE(count * 3, radiance.size());
  Environment environment;
  environment.name = "SH";
  environment.width = width, environment.height = width / 2;
  environment.radiance.resize(std::size_t(width) * environment.height);
  const PixelDirections direction(width, environment.height);
  parallel_for(environment.height, [&](std::size_t y, int) {
    std::vector<glm::dvec3> directions;
    for (std::uint32_t x = 0; x < width; ++x) directions.push_back(direction(x, std::uint32_t(y)));
    const std::vector<double> values = radiance_basis(directions, kMostRadianceCount);
    for (std::uint32_t x = 0; x < width; ++x) {
      glm::dvec3 sum(0);
      for (std::size_t j = 0; j < count; ++j)
        sum +=
            glm::dvec3(radiance[j * 3], radiance[j * 3 + 1], radiance[j * 3 + 2]) * values[x * kMostRadianceCount + j];
      environment.radiance[y * width + x] = glm::vec3(sum);
    }
  });
  return environment;
}

}  // namespace twinshade

#include "lighting/reference.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/direction_sets.h"
#include "lighting/environment_sampler.h"
#include "lighting/gather.h"
#include "lighting/progress.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"
#include "lighting/receivers.h"

namespace twinshade {
namespace {

constexpr std::size_t kPointsAtOnce = 256;  // points handed to a thread at a time

void check_rays(std::uint32_t rays) {
  if (rays < 1 || rays > 65536)
    throw UserError("reference rays: " + std::to_string(rays) + " is not within 1 to 65536");
}

class Tracer {
 public:
  // surfaces: what rays that meet one bring; null: nothing.
  Tracer(const Scene& scene, const RayScene& rays, const EnvironmentSampler& light, const SurfaceLight* surfaces,
         const ReferenceOptions& options)
      : options_(options),
        scene_(scene),
        rays_(rays),
        light_(light),
        surfaces_(surfaces),
        bright_samples_(light_.has_bright() ? std::max(16u, options.rays / 8) : 0) {}

  ReflectedLight light_of(const ShadedPoint& point, std::uint64_t index) const {
    const glm::dvec3 plane = rays_.geometric_normal(point.triangle);
    const glm::vec3 origin(glm::dvec3(point.position) + plane * rays_.lift(point.position));
    const auto sees = [&](const glm::vec3& direction) {
      return glm::dot(glm::dvec3(direction), plane) > 0 && !rays_.occluded(origin, direction, point.triangle);
    };

    // Directions in proportion to the cosine: z = sqrt(1 - a) of a stratified a
    const glm::dvec3 normal(point.normal);
    const glm::dmat3 frame = tangent_frame(normal, glm::dvec3(0), 1, plane);
    const std::uint32_t scramble = std::uint32_t(random_bits(options_.seed, kReferenceScramble, index));
    glm::dvec3 irradiance(0), bounced(0);
    for (std::uint32_t ray = 0; ray < options_.rays; ++ray) {
      const double a = (ray + unit_real(random_bits(options_.seed, kReferenceJitter, index, ray))) / options_.rays;
      const glm::vec3 direction(
          frame * hemisphere_direction(std::sqrt(1 - a), scrambled_radical_inverse(ray, scramble) * 0x1p-32));
      if (!surfaces_) {
        if (sees(direction)) irradiance += glm::dvec3(light_.rest(direction));
        continue;
      }
      if (!(glm::dot(glm::dvec3(direction), plane) > 0)) continue;
      const RayHit hit = rays_.closest(origin, direction, point.triangle);
      if (hit.triangle == kNoTriangle)
        irradiance += glm::dvec3(light_.rest(direction));
      else if (hit.front)
        bounced += glm::dvec3(surfaces_->reflected(
            scene_, hit.triangle, hit.b1, hit.b2, unit_real(random_bits(options_.seed, kReferenceVertex, index, ray))));
    }
    irradiance *= portable::kPi / options_.rays;
    bounced *= portable::kPi / options_.rays;

    const double offset = unit_real(random_bits(options_.seed, kReferenceBright, index));
    for (std::uint32_t s = 0; s < bright_samples_; ++s) {
      const std::uint64_t bits = random_bits(options_.seed, kReferencePlace, index, s);
      const EnvironmentSampler::Sample sample = light_.bright(
          (s + offset) / bright_samples_, double(bits >> 32) * 0x1p-32, double(bits & 0xffffffffu) * 0x1p-32);
      const double cosine = glm::dot(sample.direction, frame[2]);
      if (cosine > 0 && sees(glm::vec3(sample.direction))) irradiance += sample.radiance * (cosine / bright_samples_);
    }
    const glm::dvec3 reflectance = glm::dvec3(point.albedo) / portable::kPi;
    return {glm::vec3(irradiance * reflectance), glm::vec3(bounced * reflectance)};
  }

  // Each point's, in the list's order.
  std::vector<ReflectedLight> trace(std::span<const ShadedPoint> points, const char* what) const {
    std::vector<ReflectedLight> light(points.size());
    const std::size_t rays_per_point = options_.rays + bright_samples_;
    Progress progress(what, "rays", points.size() * rays_per_point, options_.show_progress);
    parallel_for((points.size() + kPointsAtOnce - 1) / kPointsAtOnce, [&](std::size_t chunk, int) {
      const std::size_t first = chunk * kPointsAtOnce, last = std::min(points.size(), first + kPointsAtOnce);
      for (std::size_t i = first; i < last; ++i) light[i] = light_of(points[i], i);
      progress.add((last - first) * rays_per_point);
    });
    return light;
  }

 private:
  const ReferenceOptions& options_;
  const Scene& scene_;
  const RayScene& rays_;
  const EnvironmentSampler& light_;
  const SurfaceLight* const surfaces_;
  const std::uint32_t bright_samples_;
};

}  // namespace

std::vector<glm::vec3> reference_radiance(const Scene& scene, const Environment& environment,
                                          std::span<const ShadedPoint> points, const ReferenceOptions& options) {
  check_rays(options.rays);
  const RayScene rays(scene);
  const EnvironmentSampler light(environment);
  std::vector<glm::vec3> radiance;
  radiance.reserve(points.size());
  for (const ReflectedLight& traced : Tracer(scene, rays, light, nullptr, options).trace(points, "reference"))
    radiance.push_back(traced.direct);
  return radiance;
}

std::array<std::vector<ReflectedLight>, 2> reference_light(const Scene& scene, const Environment& environment,
                                                           std::span<const ShadedPoint> points,
                                                           const BakeOptions& surfaces,
                                                           const ReferenceOptions& options) {
  check_rays(options.rays);
  const RayScene rays(scene);
  const EnvironmentSampler light(environment);
  BakeOptions first_pass = surfaces;
  first_pass.lightmap_size = std::min(surfaces.lightmap_size, kSurfaceMap);
  first_pass.show_progress = options.show_progress;
  const SurfaceLight reflecting = gather_surface_light(scene, rays, light, first_pass);
  std::array<std::vector<ReflectedLight>, 2> halves;
  for (std::size_t half = 0; half < 2; ++half) {
    ReferenceOptions own = options;
    own.rays = std::max(1u, options.rays / 2);
    own.seed = random_bits(options.seed, kReferenceHalf, half);
    halves[half] = Tracer(scene, rays, light, &reflecting, own)
                       .trace(points, half == 0 ? "reference, first half" : "reference, second half");
  }
  return halves;
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

// The mean of a probe's rays is taken out before they are projected and goes into l = 0 alone, which its integral is
// exact for: light that is the same everywhere comes back as such, and noise in the other bands is that of the
// differences only (a control variate).
#include "lighting/volume_gather.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/fill.h"
#include "lighting/gather.h"
#include "lighting/progress.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"

namespace twinshade {
namespace {

constexpr int kValues = kVolumeRadianceCount * 3;
constexpr std::uint32_t kSets = 32;       // of directions, of which each probe takes one
constexpr std::size_t kProbesAtOnce = 4;  // probes handed to a thread at a time
// A probe that meets more backs than this is inside of something, or behind a sheet, which hides from it what lights
// the front: the front is lit by those before it.
constexpr double kBehindShare = 0.25;

// Sets of one direction in each of `rays` bands of equal solid angle, as DirectionSets, over the whole sphere.
struct SphereSets {
  std::vector<glm::dvec3> directions;
  std::vector<double> basis;  // kVolumeRadianceCount a direction

  SphereSets(std::uint32_t rays, std::uint64_t seed) {
    for (std::uint32_t set = 0; set < kSets; ++set) {
      const std::uint32_t scramble = std::uint32_t(random_bits(seed, kProbeScramble, set));
      for (std::uint32_t ray = 0; ray < rays; ++ray) {
        const double z = 1 - 2 * (ray + unit_real(random_bits(seed, kProbeJitter, set, ray))) / rays;
        const double angle = 2 * portable::kPi * (scrambled_radical_inverse(ray, scramble) * 0x1p-32);
        const double radius = std::sqrt(std::max(0.0, 1 - z * z));
        directions.push_back({radius * portable::cos(angle), radius * portable::sin(angle), z});
      }
    }
    basis = radiance_basis(directions, kVolumeRadianceCount);
  }
};

class VolumeGatherer {
 public:
  VolumeGatherer(const Scene& scene, const Environment& environment, const ProbeGrid& grid, const BakeOptions& options)
      : scene_(scene),
        grid_(grid),
        options_(options),
        rays_(scene),
        light_(environment),
        sets_(options.probe_rays, options.seed),
        bright_samples_(light_.has_bright() ? std::max(16u, options.probe_rays / 8) : 0) {}

  GatheredVolume run() {
    if (options_.bounce) {
      BakeOptions surfaces = options_;
      surfaces.lightmap_size = std::min(options_.lightmap_size, kSurfaceMap);
      surfaces_ = gather_surface_light(scene_, rays_, light_, surfaces);
    }
    const std::size_t count = grid_.count();
    out_.sh.assign(count * kValues, 0.0f);
    std::vector<std::uint8_t> known(count, 0);
    Progress progress("bake: volume", "rays", count * (options_.probe_rays + bright_samples_), options_.show_progress);
    parallel_for((count + kProbesAtOnce - 1) / kProbesAtOnce, [&](std::size_t chunk, int) {
      const std::size_t first = chunk * kProbesAtOnce, last = std::min(count, first + kProbesAtOnce);
      for (std::size_t probe = first; probe < last; ++probe) known[probe] = gather(probe);
      progress.add((last - first) * (options_.probe_rays + bright_samples_));
    });
    FillPlan::grid(known, grid_.size).apply(out_.sh, kValues);
    out_.rays = surfaces_.rays + std::uint64_t(count) * (options_.probe_rays + bright_samples_);
    return std::move(out_);
  }

 private:
  // Whether the probe has light of its own.
  bool gather(std::size_t probe) {
    const glm::vec3 position = grid_.position(probe);
    const std::uint32_t rays = options_.probe_rays;
    const std::size_t set = random_bits(options_.seed, kProbeSet, probe) % kSets * rays;

    // Radiance of each ray, and its mean
    std::vector<glm::dvec3> radiance(rays);
    glm::dvec3 mean(0);
    std::uint32_t met_back = 0;
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
      const glm::vec3 direction(sets_.directions[set + ray]);
      const RayHit hit = rays_.closest(position, direction);
      if (hit.triangle == kNoTriangle)
        radiance[ray] = light_.rest(direction);
      else if (!hit.front)
        ++met_back;
      else if (options_.bounce)
        radiance[ray] = surfaces_.reflected(scene_, hit.triangle, hit.b1, hit.b2,
                                            unit_real(random_bits(options_.seed, kProbeVertex, probe, ray)));
      mean += radiance[ray];
    }
    mean /= double(rays);

    // Projection of the differences from the mean, and the mean
    double values[kValues] = {};
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
      const double* basis = sets_.basis.data() + (set + ray) * kVolumeRadianceCount;
      const glm::dvec3 difference = radiance[ray] - mean;
      for (int j = 0; j < kVolumeRadianceCount; ++j)
        for (int c = 0; c < 3; ++c) values[j * 3 + c] += difference[c] * basis[j];
    }
    const double weight = 4 * portable::kPi / rays;
    for (double& value : values) value *= weight;
    for (int c = 0; c < 3; ++c) values[c] += mean[c] * std::sqrt(4 * portable::kPi);

    add_bright(probe, position, values);
    for (int k = 0; k < kValues; ++k) out_.sh[probe * kValues + k] = float(values[k]);
    return !(met_back > kBehindShare * rays);
  }

  void add_bright(std::size_t probe, const glm::vec3& position, double* values) const {
    std::vector<glm::dvec3> directions, radiance;
    const double offset = unit_real(random_bits(options_.seed, kProbeBright, probe));
    for (std::uint32_t s = 0; s < bright_samples_; ++s) {
      const std::uint64_t bits = random_bits(options_.seed, kProbePlace, probe, s);
      const EnvironmentSampler::Sample sample = light_.bright(
          (s + offset) / bright_samples_, double(bits >> 32) * 0x1p-32, double(bits & 0xffffffffu) * 0x1p-32);
      if (rays_.occluded(position, glm::vec3(sample.direction))) continue;
      directions.push_back(sample.direction);
      radiance.push_back(sample.radiance / double(bright_samples_));
    }
    const std::vector<double> basis = radiance_basis(directions, kVolumeRadianceCount);
    for (std::size_t s = 0; s < directions.size(); ++s)
      for (int j = 0; j < kVolumeRadianceCount; ++j)
        for (int c = 0; c < 3; ++c) values[j * 3 + c] += radiance[s][c] * basis[s * kVolumeRadianceCount + j];
  }

  const Scene& scene_;
  const ProbeGrid& grid_;
  const BakeOptions& options_;
  const RayScene rays_;
  const EnvironmentSampler light_;
  const SphereSets sets_;
  const std::uint32_t bright_samples_;
  SurfaceLight surfaces_;
  GatheredVolume out_;
};

}  // namespace

glm::vec3 ProbeGrid::position(std::size_t cell) const {
  const std::size_t x = cell % size.x, y = cell / size.x % size.y, z = cell / (std::size_t(size.x) * size.y);
  const glm::dvec3 place{double(x), double(y), double(z)};
  glm::vec3 result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = scale[axis] == 0 ? origin[axis] : float(origin[axis] + place[axis] / scale[axis]);
  return result;
}

ProbeGrid probe_grid(const Scene& scene, const glm::ivec3& size, float limit) {
  glm::dvec3 low(0), high(0);
  bool any = false;
  for (const glm::vec3& p : scene.positions) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) inside = inside && std::abs(p[axis]) <= limit;
    if (!inside) continue;
    low = any ? glm::min(low, glm::dvec3(p)) : glm::dvec3(p);
    high = any ? glm::max(high, glm::dvec3(p)) : glm::dvec3(p);
    any = true;
  }
  const double diagonal = std::sqrt(glm::dot(high - low, high - low));
  ProbeGrid grid;
  grid.size = size;
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] - low[axis] < 0.01 * diagonal) {
      low[axis] -= 0.05 * diagonal;
      high[axis] += 0.05 * diagonal;
    }
    const double share = (high[axis] - low[axis]) / size[axis];
    grid.origin[axis] = float(low[axis] + share / 2);
    grid.scale[axis] = size[axis] > 1 && share > 0 ? float(1 / share) : 0;
  }
  return grid;
}

GatheredVolume gather_volume(const Scene& scene, const Environment& environment, const ProbeGrid& grid,
                             const BakeOptions& options) {
  return VolumeGatherer(scene, environment, grid, options).run();
}

}  // namespace twinshade

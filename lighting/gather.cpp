// Radiance is projected on real spherical harmonics in tangent space, as in Habel and Wimmer, Efficient Irradiance
// Normal Mapping, I3D 2010, sections 3 and 4.
//
// Surfaces have one side, the one their vertex normals point to. A ray that meets the other side brings nothing, and
// where most rays do, the texel is inside something: it takes its light from its neighbours. A ray of the tangent
// hemisphere that starts below its own triangle's plane sees the surface itself.
#include "lighting/gather.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/direction_sets.h"
#include "lighting/environment_sampler.h"
#include "lighting/fill.h"
#include "lighting/progress.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"
#include "lighting/ray_scene.h"
#include "lighting/receivers.h"

namespace twinshade {
namespace {

constexpr int kValues = kRadianceCount * 3;
constexpr std::size_t kRememberedHits = std::size_t(1) << 28;  // 1 GiB

// Sum of radiance times DirectionSets' weights: in float for a few rays, then in double.
class RayProjection {
 public:
  void add(const float* weights, const glm::vec3& radiance) {
    for (int k = 0; k < kWidth; ++k) part_[0][k] += weights[k] * radiance.r;
    for (int k = 0; k < kWidth; ++k) part_[1][k] += weights[k] * radiance.g;
    for (int k = 0; k < kWidth; ++k) part_[2][k] += weights[k] * radiance.b;
    if (++pending_ == 64) flush();
  }

  void flush() {
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < kWidth; ++k) sum_[c][k] += part_[c][k], part_[c][k] = 0;
    pending_ = 0;
  }

  double sum(int function, int channel) const { return sum_[channel][function]; }

 private:
  static constexpr int kWidth = DirectionSets::kWeights;
  float part_[3][kWidth] = {};
  double sum_[3][kWidth] = {};
  int pending_ = 0;
};

// One sample of a bright pixel that a receiver sees: its direction waits for the basis to be evaluated for many at a
// time.
struct SeenBright {
  std::uint32_t receiver;
  glm::dvec3 radiance;
};

// As a matt surface does.
glm::vec3 reflected_radiance(const Receiver& surface, const std::vector<float>& irradiance) {
  const float* e = irradiance.data() + std::size_t(surface.cell) * 3;
  return glm::vec3(e[0], e[1], e[2]) * surface.albedo * float(1 / portable::kPi);
}

class Gatherer {
 public:
  Gatherer(const Scene& scene, const RayScene& rays, const EnvironmentSampler& light, const BakeOptions& options)
      : scene_(scene),
        options_(options),
        rays_(rays),
        receivers_(scene.lightmap_uvs.empty() || options.per_vertex
                       ? vertex_receivers(scene, rays_)
                       : lightmap_receivers(scene, rays_, options.lightmap_size)),
        light_(light),
        sets_(options.rays, options.seed),
        bright_samples_(light_.has_bright() ? std::max(16u, options.rays / 8) : 0) {
    out_.storage = receivers_.storage;
    out_.width = receivers_.width, out_.height = receivers_.height;
    const std::size_t cells = std::size_t(out_.width) * out_.height;
    out_.sh.assign(cells * kValues, 0.0f);
    out_.irradiance.assign(cells * 3, 0.0f);
    inside_.assign(cells, 0);
    if (options.bounce && !receivers_.list.empty())
      remembered_ = std::uint32_t(std::min<std::size_t>(options.rays, kRememberedHits / receivers_.list.size()));
    hits_.assign(receivers_.list.size() * remembered_, kNoReceiver);
  }

  GatheredLight run() {
    const FillPlan fill = direct();
    std::vector<float> irradiance = out_.irradiance;  // with what bounces, which is gathered from direct light alone
    if (remembered_ > 0) {
      const std::size_t count = receivers_.list.size();
      Progress progress("bake: bounce", "rays", count * remembered_, options_.show_progress);
      parallel_for((count + kReceiversAtOnce - 1) / kReceiversAtOnce, [&](std::size_t chunk, int) {
        const std::size_t first = chunk * kReceiversAtOnce, last = std::min(count, first + kReceiversAtOnce);
        for (std::size_t i = first; i < last; ++i) gather_bounce(i, irradiance);
        progress.add((last - first) * remembered_);
      });
    }
    fill.apply(out_.sh, kValues);
    fill.apply(irradiance, 3);
    out_.irradiance = std::move(irradiance);
    return std::move(out_);
  }

  SurfaceLight run_direct() {
    direct();
    return {std::move(receivers_), std::move(out_.irradiance), out_.rays};
  }

 private:
  FillPlan direct() {
    const std::size_t count = receivers_.list.size(), chunks = (count + kReceiversAtOnce - 1) / kReceiversAtOnce;
    Progress progress("bake: direct light", "rays", count * (options_.rays + bright_samples_), options_.show_progress);
    parallel_for(chunks, [&](std::size_t chunk, int) {
      const std::size_t first = chunk * kReceiversAtOnce, last = std::min(count, first + kReceiversAtOnce);
      gather_direct(first, last);
      progress.add((last - first) * (options_.rays + bright_samples_));
    });
    out_.rays = std::uint64_t(count) * (options_.rays + bright_samples_);
    FillPlan fill = plan_fill();
    fill.apply(out_.irradiance, 3);
    return fill;
  }

  std::uint32_t set_of(std::size_t i) const {
    return std::uint32_t(random_bits(options_.seed, kGatherSet, receivers_.list[i].cell) % sets_.count());
  }
  // The rays of [first, last) stand for one remembered ray: which?
  std::uint32_t remembered_ray(std::size_t i, std::uint32_t slot, std::uint32_t& first, std::uint32_t& last) const {
    const std::uint64_t rays = options_.rays;
    first = std::uint32_t(slot * rays / remembered_);
    last = std::uint32_t((slot + 1) * rays / remembered_);
    if (last - first == 1) return first;
    return first +
           std::uint32_t(random_bits(options_.seed, kGatherRay, receivers_.list[i].cell, slot) % (last - first));
  }

  void gather_direct(std::size_t first, std::size_t last) {
    std::vector<RayProjection> sums(last - first);
    std::vector<glm::dvec3> directions;
    std::vector<SeenBright> seen;
    for (std::size_t i = first; i < last; ++i) {
      trace_hemisphere(i, sums[i - first]);
      if (bright_samples_ > 0) trace_bright(i, std::uint32_t(i - first), directions, seen);
    }

    // Means of the uniform hemisphere, then the bright samples on top
    std::vector<double> values((last - first) * kValues), flat((last - first) * 3);
    const double weight = 2 * portable::kPi / options_.rays;
    for (std::size_t r = 0; r < last - first; ++r) {
      for (int k = 0; k < kRadianceCount; ++k)
        for (int c = 0; c < 3; ++c) values[r * kValues + k * 3 + c] = sums[r].sum(k, c) * weight;
      for (int c = 0; c < 3; ++c) flat[r * 3 + c] = sums[r].sum(DirectionSets::kCosine, c) * weight;
    }
    const std::vector<double> basis = radiance_basis(directions);
    for (std::size_t s = 0; s < seen.size(); ++s) {
      double* value = values.data() + seen[s].receiver * std::size_t(kValues);
      for (int k = 0; k < kRadianceCount; ++k)
        for (int c = 0; c < 3; ++c) value[k * 3 + c] += seen[s].radiance[c] * basis[s * kRadianceCount + k];
      for (int c = 0; c < 3; ++c) flat[seen[s].receiver * 3 + c] += seen[s].radiance[c] * directions[s].z;
    }
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t cell = receivers_.list[i].cell;
      for (int k = 0; k < kValues; ++k) out_.sh[cell * kValues + k] = float(values[(i - first) * kValues + k]);
      for (int c = 0; c < 3; ++c) out_.irradiance[cell * 3 + c] = float(flat[(i - first) * 3 + c]);
    }
  }

  void trace_hemisphere(std::size_t i, RayProjection& sum) {
    const Receiver& receiver = receivers_.list[i];
    const std::uint32_t set = set_of(i);
    const glm::dvec3* directions = sets_.directions(set);
    const float* weights = sets_.weights(set);
    const glm::dmat3 frame(receiver.tangent, receiver.bitangent, receiver.normal);
    std::uint32_t slot = 0, slot_first = 0, slot_last = 0, slot_ray = kNoReceiver, met_back = 0;
    for (std::uint32_t ray = 0; ray < options_.rays; ++ray) {
      if (remembered_ > 0 && ray == slot_last) slot_ray = remembered_ray(i, slot++, slot_first, slot_last);
      const Site& site = receivers_.site_of(receiver, ray);
      const glm::vec3 direction(frame * directions[ray]);
      std::uint32_t source = kNoReceiver;
      if (!(glm::dot(direction, site.geometric_normal) > 0)) {
        source = std::uint32_t(i);
      } else {
        const RayHit hit = rays_.closest(site.origin, direction, site.triangle);
        if (hit.triangle == kNoTriangle)
          sum.add(weights + std::size_t(ray) * DirectionSets::kWeights, light_.rest(direction));
        else if (!hit.front)
          ++met_back;
        else if (ray == slot_ray)
          source = receivers_.at(scene_, hit.triangle, hit.b1, hit.b2,
                                 unit_real(random_bits(options_.seed, kGatherVertex, receiver.cell, ray)));
      }
      if (ray == slot_ray) hits_[i * remembered_ + (slot - 1)] = source;
    }
    sum.flush();
    inside_[receiver.cell] = met_back > kInsideShare * options_.rays;
  }

  void trace_bright(std::size_t i, std::uint32_t place, std::vector<glm::dvec3>& directions,
                    std::vector<SeenBright>& seen) {
    const Receiver& receiver = receivers_.list[i];
    const double offset = unit_real(random_bits(options_.seed, kGatherBright, receiver.cell));
    for (std::uint32_t s = 0; s < bright_samples_; ++s) {
      const std::uint64_t bits = random_bits(options_.seed, kGatherPlace, receiver.cell, s);
      const EnvironmentSampler::Sample sample = light_.bright(
          (s + offset) / bright_samples_, double(bits >> 32) * 0x1p-32, double(bits & 0xffffffffu) * 0x1p-32);
      const glm::dvec3 local(glm::dot(sample.direction, glm::dvec3(receiver.tangent)),
                             glm::dot(sample.direction, glm::dvec3(receiver.bitangent)),
                             glm::dot(sample.direction, glm::dvec3(receiver.normal)));
      if (!(local.z > 0)) continue;
      const Site& site = receivers_.site_of(receiver, s);
      const glm::vec3 direction(sample.direction);
      if (!(glm::dot(direction, site.geometric_normal) > 0) || rays_.occluded(site.origin, direction, site.triangle))
        continue;
      directions.push_back(local);
      seen.push_back({place, sample.radiance / double(bright_samples_)});
    }
  }

  FillPlan plan_fill() const {
    std::vector<std::uint8_t> known(inside_.size(), 0);
    for (const Receiver& receiver : receivers_.list) known[receiver.cell] = !inside_[receiver.cell];
    return receivers_.storage == CoefficientStorage::lightmap ? FillPlan::lightmap(known, receivers_, kGutter)
                                                              : FillPlan::vertices(known, receivers_, scene_);
  }

  void gather_bounce(std::size_t i, std::vector<float>& irradiance) {
    const std::uint32_t cell = receivers_.list[i].cell;
    const float* weights = sets_.weights(set_of(i));
    RayProjection sum;
    for (std::uint32_t slot = 0; slot < remembered_; ++slot) {
      const std::uint32_t source = hits_[i * remembered_ + slot];
      if (source == kNoReceiver) continue;
      std::uint32_t first, last;
      const std::uint32_t ray = remembered_ray(i, slot, first, last);
      sum.add(weights + std::size_t(ray) * DirectionSets::kWeights,
              reflected_radiance(receivers_.list[source], out_.irradiance));
    }
    sum.flush();
    const double weight = 2 * portable::kPi / remembered_;
    float* values = out_.sh.data() + std::size_t(cell) * kValues;
    for (int k = 0; k < kRadianceCount; ++k)
      for (int c = 0; c < 3; ++c) values[k * 3 + c] = float(values[k * 3 + c] + sum.sum(k, c) * weight);
    float* flat = irradiance.data() + std::size_t(cell) * 3;
    for (int c = 0; c < 3; ++c) flat[c] = float(flat[c] + sum.sum(DirectionSets::kCosine, c) * weight);
  }

  const Scene& scene_;
  const BakeOptions& options_;
  const RayScene& rays_;
  Receivers receivers_;
  const EnvironmentSampler& light_;
  const DirectionSets sets_;
  const std::uint32_t bright_samples_;
  std::uint32_t remembered_ = 0;      // rays a receiver whose hit is kept
  std::vector<std::uint32_t> hits_;   // receiver that was hit
  std::vector<std::uint8_t> inside_;  // by cell
  GatheredLight out_;
};

}  // namespace

GatheredLight gather_light(const Scene& scene, const Environment& environment, const BakeOptions& options) {
  const RayScene rays(scene);
  return Gatherer(scene, rays, EnvironmentSampler(environment), options).run();
}

SurfaceLight gather_surface_light(const Scene& scene, const RayScene& rays, const EnvironmentSampler& light,
                                  const BakeOptions& options) {
  BakeOptions direct = options;
  direct.bounce = false;  // nothing is remembered
  return Gatherer(scene, rays, light, direct).run_direct();
}

glm::vec3 SurfaceLight::reflected(const Scene& scene, std::uint32_t triangle, double b1, double b2,
                                  double choice) const {
  const std::uint32_t receiver = receivers.at(scene, triangle, b1, b2, choice);
  return receiver == kNoReceiver ? glm::vec3(0) : reflected_radiance(receivers.list[receiver], irradiance);
}

}  // namespace twinshade

// How fast light is baked, against Embree alone: the whole bake (watertight test in double behind padded boxes,
// projection on 25 functions, samples of bright pixels, one bounce); its rays by our test with the results thrown away;
// the same rays against the same triangles as Embree's own geometry. Then what follows a bake: every basis projected.
//   light_bake_bench [LIGHTMAP [RAYS]], default 256 and 256, scene courtyard, environment sky, all processors.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>

#include "base/parallel.h"
#include "lighting/bake.h"
#include "lighting/direction_sets.h"
#include "lighting/receivers.h"
#include "tests/bench/plain_embree.h"

namespace {

using namespace twinshade;

template <class Body>
double seconds_of(const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Trace {
  std::uint64_t rays = 0, hits = 0;
  double seconds = 0;
  double rate() const { return double(rays) / seconds; }
};

// The stratified hemisphere of every receiver, as the bake traces it. closest(site, direction) says whether there is a
// hit.
template <class Closest>
Trace trace(const Receivers& receivers, const DirectionSets& sets, const Closest& closest) {
  std::atomic<std::uint64_t> rays{0}, hits{0};
  Trace all;
  all.seconds = seconds_of([&] {
    parallel_for((receivers.list.size() + 63) / 64, [&](std::size_t chunk, int) {
      std::uint64_t own_rays = 0, own_hits = 0;
      for (std::size_t i = chunk * 64; i < std::min(receivers.list.size(), (chunk + 1) * 64); ++i) {
        const Receiver& receiver = receivers.list[i];
        const glm::dmat3 frame(receiver.tangent, receiver.bitangent, receiver.normal);
        const glm::dvec3* directions = sets.directions(receiver.cell % sets.count());
        for (std::uint32_t ray = 0; ray < sets.rays(); ++ray) {
          const Site& site = receivers.site_of(receiver, ray);
          const glm::vec3 direction(frame * directions[ray]);
          if (!(glm::dot(direction, site.geometric_normal) > 0)) continue;
          ++own_rays;
          own_hits += closest(site, direction);
        }
      }
      rays += own_rays;
      hits += own_hits;
    });
  });
  all.rays = rays;
  all.hits = hits;
  return all;
}

}  // namespace

int main(int count, char** arguments) {
  BakeOptions options;
  options.lightmap_size = count > 1 ? std::uint32_t(std::atoi(arguments[1])) : 256;
  options.rays = count > 2 ? std::uint32_t(std::atoi(arguments[2])) : 256;
  options.use_cache = false;
  const Scene scene = load_scene("courtyard");
  const Environment environment = load_environment("sky", false);

  LightBake bake;
  const double bake_seconds = seconds_of([&] { bake = bake_light(scene, environment, options); });

  const RayScene ours(scene);
  const Receivers receivers = lightmap_receivers(scene, ours, options.lightmap_size);
  const DirectionSets sets(options.rays, options.seed);
  const PlainEmbree embree(scene);
  const Trace our_rays = trace(receivers, sets, [&](const Site& site, const glm::vec3& direction) {
    return ours.closest(site.origin, direction, site.triangle).triangle != kNoTriangle;
  });
  const Trace embree_rays = trace(receivers, sets, [&](const Site& site, const glm::vec3& direction) {
    return embree.closest(site.origin, direction);
  });

  std::vector<const TechniqueInfo*> bases;
  for (const TechniqueInfo& technique : techniques())
    if (technique.is_basis && can_read(technique, CoefficientStorage::lightmap)) bases.push_back(&technique);
  Bundle bundle;
  const double project_seconds = seconds_of([&] { bundle = make_bundle(scene, bake, bases, FrameOptions()); });

  fmt::print("courtyard, {0} x {0} texels, {1} rays, {2} threads, {3:.1f} M rays traced, {4:.1f}% hit\n",
             options.lightmap_size, options.rays, thread_count(), double(our_rays.rays) * 1e-6,
             100 * double(our_rays.hits) / double(our_rays.rays));
  fmt::print("bake           {:7.2f} s  {:6.2f} M rays/s\n", bake_seconds, bake.rays_per_second * 1e-6);
  fmt::print("rays alone     {:7.2f} s  {:6.2f} M rays/s\n", our_rays.seconds, our_rays.rate() * 1e-6);
  fmt::print("Embree alone   {:7.2f} s  {:6.2f} M rays/s, {:.2f} x the bake's, {:.2f} x our rays'\n",
             embree_rays.seconds, embree_rays.rate() * 1e-6, embree_rays.rate() / bake.rays_per_second,
             embree_rays.rate() / our_rays.rate());
  fmt::print("projection     {:7.2f} s for {} bases of {} texels, {:.1f} % of the bake\n", project_seconds,
             bases.size(), options.lightmap_size * options.lightmap_size, 100 * project_seconds / bake_seconds);
}

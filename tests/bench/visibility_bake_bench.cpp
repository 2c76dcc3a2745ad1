// How fast visibility is baked, against Embree alone: the bake (watertight test in double behind padded boxes, sums of
// 36 functions), then the same rays against the same triangles as Embree's own geometry, results thrown away but for a
// count.  visibility_bake_bench [LIGHTMAP [RAYS]], default 512 and 1024, scene house, all processors.
#include <fmt/format.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdlib>

#include "base/parallel.h"
#include "lighting/receivers.h"
#include "lighting/sphere_sets.h"
#include "lighting/visibility_bake.h"
#include "tests/bench/plain_embree.h"

namespace {

using namespace twinshade;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int count, char** arguments) {
  VisibilityOptions options;
  options.lightmap_size = count > 1 ? std::uint32_t(std::atoi(arguments[1])) : 512;
  options.rays = count > 2 ? std::uint32_t(std::atoi(arguments[2])) : 1024;
  options.use_cache = false;
  const Scene scene = load_scene("house");

  auto start = std::chrono::steady_clock::now();
  const VisibilityBake bake = bake_visibility(scene, options);
  const double bake_seconds = seconds_since(start);

  const RayScene rays(scene);
  const Receivers receivers = lightmap_receivers(scene, rays, options.lightmap_size);
  const SphereSets sets(options.rays, options.seed);
  const PlainEmbree embree(scene);
  std::atomic<std::uint64_t> traced{0}, hits{0};
  start = std::chrono::steady_clock::now();
  parallel_for((receivers.list.size() + 63) / 64, [&](std::size_t chunk, int) {
    std::uint64_t own_traced = 0, own_hits = 0;
    for (std::size_t i = chunk * 64; i < std::min(receivers.list.size(), (chunk + 1) * 64); ++i) {
      const Receiver& receiver = receivers.list[i];
      const glm::vec3* directions = sets.directions(sets.set_of(receiver.cell));
      for (std::uint32_t ray = 0; ray < options.rays; ++ray) {
        const Site& site = receivers.site_of(receiver, ray);
        if (!(glm::dot(glm::dvec3(directions[ray]), glm::dvec3(site.geometric_normal)) > 0)) continue;
        ++own_traced;
        own_hits += embree.occluded(site.origin, directions[ray]);
      }
    }
    traced += own_traced;
    hits += own_hits;
  });
  const double embree_rate = double(traced) / seconds_since(start);

  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print(
      "house, {0} x {0} texels, {1} rays over the sphere, {2} threads, {3:.1f} M rays above the surfaces, {4:.1f}% "
      "hit\n",
      options.lightmap_size, options.rays, thread_count(), double(traced) * 1e-6, 100 * double(hits) / double(traced));
  fmt::print("bake            {:7.2f} s  {:6.2f} M rays/s\n", bake_seconds, bake.rays_per_second * 1e-6);
  fmt::print("Embree alone    {:7.2f} s  {:6.2f} M rays/s, {:.2f} x the bake's\n", double(traced) / embree_rate,
             embree_rate * 1e-6, embree_rate / bake.rays_per_second);
  fmt::print("memory          {:.1f} MiB for the bake, {:.1f} MiB of the process at most\n",
             double(bake.memory_bytes) * 0x1p-20, double(usage.ru_maxrss) / 1024);
}

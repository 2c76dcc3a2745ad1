// Rays are stratified over the sphere in world space, so that their SH values are computed once for a few sets of
// directions and a cell's coefficients are a sum over the directions in which it sees out.
#include "lighting/visibility_bake.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/cache.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/bake_cache.h"
#include "lighting/fill.h"
#include "lighting/progress.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/random_domains.h"
#include "lighting/ray_scene.h"
#include "lighting/receivers.h"
#include "lighting/sphere_sets.h"

namespace twinshade {
namespace {

// Raise when the same inputs give another bake.
constexpr int kBakeVersion = 4;
// A receiver that sees out in no more than kInsideShare of its rays may be inside something; so many closest hits
// decide.
constexpr std::uint32_t kInsideRays = 64;

class Baker {
 public:
  Baker(const Scene& scene, const VisibilityOptions& options)
      : scene_(scene),
        options_(options),
        rays_(scene),
        receivers_(options.per_vertex || scene.lightmap_uvs.empty()
                       ? vertex_receivers(scene, rays_)
                       : lightmap_receivers(scene, rays_, options.lightmap_size)),
        sets_(options.rays, options.seed) {
    out_.storage = receivers_.storage;
    out_.width = receivers_.width, out_.height = receivers_.height;
    out_.sh.assign(out_.cells() * kVisibilityCount, 0.0f);
    out_.ambient.assign(out_.cells(), 0.0f);
    out_.area.assign(out_.cells(), 0.0f);
    out_.normal.assign(out_.cells() * 3, 0.0f);
    for (const Receiver& receiver : receivers_.list)
      for (int c = 0; c < 3; ++c) out_.normal[std::size_t(receiver.cell) * 3 + std::size_t(c)] = receiver.normal[c];
    known_.assign(out_.cells(), 0);
  }

  VisibilityBake run() {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t count = receivers_.list.size(), chunks = (count + kReceiversAtOnce - 1) / kReceiversAtOnce;
    std::atomic<std::uint64_t> traced{0};
    {
      Progress progress("bake: visibility", "rays", count * options_.rays, options_.show_progress);
      parallel_for(chunks, [&](std::size_t chunk, int) {
        const std::size_t first = chunk * kReceiversAtOnce, last = std::min(count, first + kReceiversAtOnce);
        std::uint64_t rays = 0;
        for (std::size_t i = first; i < last; ++i) rays += look_around(receivers_.list[i]);
        traced += rays;
        progress.add((last - first) * options_.rays);
      });
    }
    for (const Receiver& receiver : receivers_.list) out_.area[receiver.cell] = receiver.area;
    const FillPlan fill = receivers_.storage == CoefficientStorage::lightmap
                              ? FillPlan::lightmap(known_, receivers_, kGutter)
                              : FillPlan::vertices(known_, receivers_, scene_);
    fill.apply(out_.sh, kVisibilityCount);
    fill.apply(out_.ambient, 1);
    fill.apply(out_.normal, 3);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    out_.rays_per_second = double(traced) / seconds;
    out_.memory_bytes = sets_.bytes() + receivers_.list.size() * sizeof(Receiver) +
                        receivers_.sites.size() * sizeof(Site) +
                        receivers_.receiver_of_cell.size() * sizeof(std::uint32_t) + known_.size() +
                        (out_.sh.size() + out_.ambient.size() + out_.normal.size() + out_.area.size()) * sizeof(float);
    return std::move(out_);
  }

 private:
  // Returns the number of rays traced.
  std::uint64_t look_around(const Receiver& receiver) {
    const std::uint32_t set = sets_.set_of(receiver.cell);
    const glm::vec3* directions = sets_.directions(set);
    const float* values = sets_.values(set);
    // In float for a few rays, then in double
    float part[kVisibilityCount] = {};
    double sum[kVisibilityCount] = {}, above = 0, seen = 0;
    std::uint64_t traced = 0, open = 0;
    int pending = 0;
    const auto flush = [&] {
      for (int k = 0; k < kVisibilityCount; ++k) sum[k] += part[k], part[k] = 0;
      pending = 0;
    };
    for (std::uint32_t ray = 0; ray < options_.rays; ++ray) {
      const Site& site = receivers_.site_of(receiver, ray);
      const glm::vec3& direction = directions[ray];
      const double cosine = glm::dot(glm::dvec3(direction), glm::dvec3(site.geometric_normal));
      if (!(cosine > 0)) continue;
      above += cosine;
      ++traced;
      if (rays_.occluded(site.origin, direction, site.triangle)) continue;
      ++open;
      seen += cosine;
      for (int k = 0; k < kVisibilityCount; ++k) part[k] += values[std::size_t(ray) * kVisibilityCount + k];
      if (++pending == 64) flush();
    }
    flush();
    float* sh = out_.sh.data() + std::size_t(receiver.cell) * kVisibilityCount;
    for (int k = 0; k < kVisibilityCount; ++k) sh[k] = float(sum[k] * (4 * portable::kPi / options_.rays));
    out_.ambient[receiver.cell] = above > 0 ? float(seen / above) : 0.0f;
    known_[receiver.cell] = double(open) > (1 - kInsideShare) * double(traced) || !is_inside(receiver, directions);
    return traced;
  }

  bool is_inside(const Receiver& receiver, const glm::vec3* directions) const {
    const std::uint32_t step = std::max(1u, options_.rays / kInsideRays);
    std::uint32_t tried = 0, back = 0;
    for (std::uint32_t ray = 0; ray < options_.rays; ++ray) {
      if (random_bits(options_.seed, kInsideRay, ray) % step != 0) continue;
      const Site& site = receivers_.site_of(receiver, ray);
      if (!(glm::dot(directions[ray], site.geometric_normal) > 0)) continue;
      ++tried;
      const RayHit hit = rays_.closest(site.origin, directions[ray], site.triangle);
      back += hit.triangle != kNoTriangle && !hit.front;
    }
    return back > kInsideShare * tried;
  }

  const Scene& scene_;
  const VisibilityOptions& options_;
  const RayScene rays_;
  const Receivers receivers_;
  const SphereSets sets_;
  std::vector<std::uint8_t> known_;  // by cell
  VisibilityBake out_;
};

// Layout of a cached bake: magic, storage, width, height (u32 each), sh, ambient, normal, area of all cells as f32,
// SHA-256 of all before it as 64 hex digits.
static_assert(std::endian::native == std::endian::little);
constexpr std::uint32_t kMagic = 0x32564254;  // "TBV2"
constexpr std::size_t kCellFloats = kVisibilityCount + 5;

std::string serialize(const VisibilityBake& bake) {
  const std::uint32_t header[] = {kMagic, std::uint32_t(bake.storage), bake.width, bake.height};
  std::string bytes(reinterpret_cast<const char*>(header), sizeof header);
  for (const std::vector<float>* values : {&bake.sh, &bake.ambient, &bake.normal, &bake.area})
    bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float));
  return bytes + sha256_hex(bytes);
}

bool deserialize(std::string_view bytes, VisibilityBake& bake) {
  std::uint32_t header[4];
  if (bytes.size() < sizeof header + kBakeHashLength) return false;
  const std::string_view content = bytes.substr(0, bytes.size() - kBakeHashLength);
  bake.hash = bytes.substr(content.size());
  if (sha256_hex(content) != bake.hash) return false;
  std::memcpy(header, content.data(), sizeof header);
  if (header[0] != kMagic || header[1] > 1) return false;
  bake.storage = CoefficientStorage(header[1]);
  bake.width = header[2], bake.height = header[3];
  if (content.size() != sizeof header + bake.cells() * kCellFloats * sizeof(float)) return false;
  const char* from = content.data() + sizeof header;
  const auto take = [&](std::vector<float>& values, std::size_t count) {
    values.resize(count);
    std::memcpy(values.data(), from, count * sizeof(float));
    from += count * sizeof(float);
  };
  take(bake.sh, bake.cells() * kVisibilityCount);
  take(bake.ambient, bake.cells());
  take(bake.normal, bake.cells() * 3);
  take(bake.area, bake.cells());
  return true;
}

bool find_cached(const std::string& key, VisibilityBake& bake) {
  try {
    const std::string path = bake_cache_path(key);
    // Anything else in its place (a pipe would be waited for) goes when the bake is kept.
    if (std::error_code code; !std::filesystem::is_regular_file(path, code)) return false;
    if (deserialize(read_file(path), bake)) {
      touch_cached(path);
      return true;
    }
    std::fprintf(stderr, "twinshade: cached bake %s is damaged: baking again\n", path.c_str());
  } catch (const UserError& error) {
    std::fprintf(stderr, "twinshade: bake cache not used: %s\n", error.what());
  }
  return false;
}

void check(const char* name, std::uint32_t value, std::uint32_t highest) {
  if (value < 1 || value > highest)
    throw UserError(std::string(name) + ": " + std::to_string(value) + " is not within 1 to " +
                    std::to_string(highest));
}

}  // namespace

VisibilityBake bake_visibility(const Scene& scene, const VisibilityOptions& options) {
  check("lightmap size", options.lightmap_size, 4096);
  check("visibility rays", options.rays, 65536);
  if (scene.procedural_coefficients)
    throw UserError(scene.name + ": has no surfaces in world space to bake visibility for");
  const std::vector<std::pair<std::string, std::string>> notes = {
      {"visibility_scene_hash", scene_hash(scene)},
      {"visibility_lightmap_size",
       options.per_vertex || scene.lightmap_uvs.empty() ? "per vertex" : std::to_string(options.lightmap_size)},
      {"visibility_rays", std::to_string(options.rays)},
      {"visibility_seed", std::to_string(options.seed)},
      {"visibility_basis", radiance_basis_hash(kVisibilityCount)},
      {"visibility_version", std::to_string(kBakeVersion)}};
  std::string all;
  for (const auto& [name, value] : notes) all += name + "=" + value + "\n";
  const std::string key = sha256_hex(all);

  VisibilityBake bake;
  if (!options.use_cache || !find_cached(key, bake)) {
    bake = Baker(scene, options).run();
    const std::string bytes = serialize(bake);
    bake.hash = bytes.substr(bytes.size() - kBakeHashLength);
    if (options.use_cache) keep_bake(key, bytes);
  }
  bake.notes = notes;
  bake.notes.emplace_back("visibility_hash", bake.hash);
  return bake;
}

}  // namespace twinshade

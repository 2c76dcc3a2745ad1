#include "lighting/bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/hash.h"
#include "base/portable_math.h"
#include "lighting/bake_cache.h"
#include "lighting/gather.h"
#include "lighting/radiance_basis.h"
#include "lighting/volume_gather.h"

namespace twinshade {
namespace {

// Raise when the same inputs give another bake. What the GLSL of the radiance basis says is in the key by itself.
constexpr int kBakeVersion = 7;

using Notes = std::vector<std::pair<std::string, std::string>>;

void check(const char* name, std::int64_t value, std::int64_t highest) {
  if (value < 1 || value > highest)
    throw UserError(std::string(name) + ": " + std::to_string(value) + " is not within 1 to " +
                    std::to_string(highest));
}

// Light that varies smoothly from place to place, mostly from above, a little of every function: for scenes that test
// rasterization and have no place where light could be gathered.
void procedural_light(const glm::vec3& p, int count, float* sh) {
  const auto phase = [](float coordinate) {
    return std::isfinite(coordinate) ? std::clamp(double(coordinate), -1e3, 1e3) : 0;
  };
  for (int k = 0; k < count; ++k) {
    for (int c = 0; c < 3; ++c) {
      const double wave = portable::sin(0.7 * phase(p.x) + 1.1 * phase(p.y) + 0.9 * phase(p.z) + 0.8 * k + 2.1 * c);
      sh[k * 3 + c] = float(k == 0 ? 2 + 0.5 * wave : k == 2 ? 1 + 0.3 * wave : 0.2 * wave);
    }
  }
}

LightBake procedural_vertices(const Scene& scene) {
  LightBake bake;
  bake.storage = CoefficientStorage::vertex;
  bake.width = std::uint32_t(scene.positions.size());
  bake.height = 1;
  bake.sh.resize(scene.positions.size() * kRadianceCount * 3);
  for (std::size_t v = 0; v < scene.positions.size(); ++v)
    procedural_light(scene.positions[v], kRadianceCount, bake.sh.data() + v * kRadianceCount * 3);
  return bake;
}

LightBake gathered_light(const Scene& scene, const Environment& environment, const BakeOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  GatheredLight light = gather_light(scene, environment, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  LightBake bake;
  bake.storage = light.storage;
  bake.width = light.width, bake.height = light.height;
  bake.sh = std::move(light.sh);
  bake.irradiance = std::move(light.irradiance);
  bake.rays_per_second = double(light.rays) / seconds;
  return bake;
}

LightBake volume_bake(const Scene& scene, const Environment& environment, const BakeOptions& options) {
  constexpr float kProceduralReach = 1e3f;  // as far as procedural light varies
  const ProbeGrid grid = probe_grid(
      scene, options.volume, scene.procedural_coefficients ? kProceduralReach : std::numeric_limits<float>::max());
  LightBake bake;
  bake.storage = CoefficientStorage::volume;
  bake.width = std::uint32_t(grid.size.x), bake.height = std::uint32_t(grid.size.y * grid.size.z);
  bake.radiance_count = kVolumeRadianceCount;
  bake.volume = grid.size, bake.volume_origin = grid.origin, bake.volume_scale = grid.scale;
  if (scene.procedural_coefficients) {
    bake.sh.resize(grid.count() * kVolumeRadianceCount * 3);
    for (std::size_t probe = 0; probe < grid.count(); ++probe)
      procedural_light(grid.position(probe), kVolumeRadianceCount, bake.sh.data() + probe * kVolumeRadianceCount * 3);
    return bake;
  }
  const auto start = std::chrono::steady_clock::now();
  GatheredVolume volume = gather_volume(scene, environment, grid, options);
  bake.sh = std::move(volume.sh);
  bake.rays_per_second =
      double(volume.rays) / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return bake;
}

// What `make` gives, or, for light that takes long to gather, what it gave before for the same notes.
template <class Make>
LightBake kept(const Scene& scene, Notes notes, bool use_cache, const Make& make) {
  LightBake bake;
  if (scene.procedural_coefficients) {
    bake = make();
    bake.hash = sha256_hex(serialize_bake(bake));
    notes.resize(2);  // scene and scene_hash: nothing else matters
    notes.emplace_back("light", "procedural");
  } else {
    Sha256 key_hash;
    for (const auto& [key, value] : notes) {
      key_hash.add(key);
      key_hash.add("=");
      key_hash.add(value);
      key_hash.add("\n");
    }
    const std::string key = key_hash.hex();
    if (std::optional<LightBake> cached = use_cache ? cached_bake(key) : std::nullopt) {
      bake = std::move(*cached);
    } else {
      bake = make();
      const std::string bytes = serialize_bake(bake);
      bake.hash = bytes.substr(bytes.size() - kBakeHashLength);
      if (use_cache) keep_bake(key, bytes);
    }
  }
  bake.notes = std::move(notes);
  return bake;
}

// What both kinds of bake depend on.
Notes common_notes(const Scene& scene, const Environment& environment, const BakeOptions& options, int radiance_count) {
  return {{"scene", scene.name},
          {"scene_hash", scene_hash(scene)},
          {"environment", environment.name},
          {"environment_hash", environment_hash(environment)},
          {"lightmap_size",
           scene.lightmap_uvs.empty() || options.per_vertex ? "per vertex" : std::to_string(options.lightmap_size)},
          {"rays", std::to_string(options.rays)},
          {"seed", std::to_string(options.seed)},
          {"bounce", options.bounce ? "1" : "0"},
          {"radiance_basis", radiance_basis_hash(radiance_count)},
          {"bake_version", std::to_string(kBakeVersion)}};
}

void check_gathering(const BakeOptions& options) {
  check("lightmap size", options.lightmap_size, 4096);
  check("rays", options.rays, 65536);
}

}  // namespace

LightBake bake_light(const Scene& scene, const Environment& environment, const BakeOptions& options) {
  check_gathering(options);
  LightBake bake = kept(scene, common_notes(scene, environment, options, kRadianceCount), options.use_cache, [&] {
    return scene.procedural_coefficients ? procedural_vertices(scene) : gathered_light(scene, environment, options);
  });
  bake.notes.emplace_back("bake_hash", bake.hash);
  return bake;
}

LightBake bake_volume(const Scene& scene, const Environment& environment, const BakeOptions& options) {
  check_gathering(options);
  for (int axis = 0; axis < 3; ++axis) check("probes along an axis of the volume", options.volume[axis], 256);
  check("probes along y times those along z", std::int64_t(options.volume.y) * options.volume.z, 16384);
  check("rays of a probe", options.probe_rays, 65536);
  Notes notes = common_notes(scene, environment, options, kVolumeRadianceCount);
  const std::string size = std::to_string(options.volume.x) + "x" + std::to_string(options.volume.y) + "x" +
                           std::to_string(options.volume.z);
  notes.emplace_back("volume", size);
  notes.emplace_back("probe_rays", std::to_string(options.probe_rays));
  LightBake bake =
      kept(scene, std::move(notes), options.use_cache, [&] { return volume_bake(scene, environment, options); });
  if (scene.procedural_coefficients) bake.notes.emplace_back("volume", size);
  bake.notes.emplace_back("volume_hash", bake.hash);
  return bake;
}

}  // namespace twinshade

#include "lighting/bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "base/portable_math.h"
#include "lighting/bake_cache.h"
#include "lighting/gather.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

// Raise when the same inputs give another bake.
constexpr int kBakeVersion = 1;

void check(const char* name, std::uint32_t value, std::uint32_t highest) {
  if (value < 1 || value > highest)
    throw UserError(std::string(name) + ": " + std::to_string(value) + " is not within 1 to " +
                    std::to_string(highest));
}

// Light that varies smoothly from vertex to vertex, mostly from above, a little of every function: for scenes that test
// rasterization and have no place where light could be gathered.
LightBake procedural_light(const Scene& scene) {
  LightBake bake;
  bake.storage = CoefficientStorage::vertex;
  bake.width = std::uint32_t(scene.positions.size());
  bake.height = 1;
  bake.sh.resize(scene.positions.size() * kRadianceCount * 3);
  const auto phase = [](float coordinate) {
    return std::isfinite(coordinate) ? std::clamp(double(coordinate), -1e3, 1e3) : 0;
  };
  for (std::size_t v = 0; v < scene.positions.size(); ++v) {
    const glm::vec3& p = scene.positions[v];
    for (int k = 0; k < kRadianceCount; ++k) {
      for (int c = 0; c < 3; ++c) {
        const double wave = portable::sin(0.7 * phase(p.x) + 1.1 * phase(p.y) + 0.9 * phase(p.z) + 0.8 * k + 2.1 * c);
        bake.sh[(v * kRadianceCount + k) * 3 + c] = float(k == 0   ? 2 + 0.5 * wave
                                                          : k == 2 ? 1 + 0.3 * wave
                                                                   : 0.2 * wave);
      }
    }
  }
  bake.hash = sha256_hex(serialize_bake(bake));
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
  bake.rays_per_second = double(light.rays) / seconds;
  return bake;
}

}  // namespace

LightBake bake_light(const Scene& scene, const Environment& environment, const BakeOptions& options) {
  check("lightmap size", options.lightmap_size, 4096);
  check("rays", options.rays, 65536);
  const std::vector<std::pair<std::string, std::string>> notes = {
      {"scene", scene.name},
      {"scene_hash", scene_hash(scene)},
      {"environment", environment.name},
      {"environment_hash", environment_hash(environment)},
      {"lightmap_size", scene.lightmap_uvs.empty() ? "per vertex" : std::to_string(options.lightmap_size)},
      {"rays", std::to_string(options.rays)},
      {"seed", std::to_string(options.seed)},
      {"bounce", options.bounce ? "1" : "0"},
      {"bake_version", std::to_string(kBakeVersion)}};
  if (scene.procedural_coefficients) {
    LightBake bake = procedural_light(scene);
    bake.notes = {notes[0], notes[1], {"light", "procedural"}, {"bake_hash", bake.hash}};
    return bake;
  }

  Sha256 key_hash;
  for (const auto& [key, value] : notes) {
    key_hash.add(key);
    key_hash.add("=");
    key_hash.add(value);
    key_hash.add("\n");
  }
  const std::string key = key_hash.hex();
  LightBake bake;
  if (std::optional<LightBake> cached = options.use_cache ? cached_bake(key) : std::nullopt) {
    bake = std::move(*cached);
  } else {
    bake = gathered_light(scene, environment, options);
    const std::string bytes = serialize_bake(bake);
    bake.hash = bytes.substr(bytes.size() - kBakeHashLength);
    if (options.use_cache) keep_bake(key, bytes);
  }
  bake.notes = notes;
  bake.notes.emplace_back("bake_hash", bake.hash);
  return bake;
}

}  // namespace twinshade

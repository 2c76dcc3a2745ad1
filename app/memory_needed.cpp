#include "app/memory_needed.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/memory.h"

namespace twinshade {
namespace {

// Bytes a pixel: a Frame's colour, depth, primitive id and coverage; OpenGL has them once more in memory that it shares
// with its worker, and the worker's own targets.
constexpr std::uint64_t kFramePixel = 16 + 4 + 4 + 1;
constexpr std::uint64_t kGlPixel = kFramePixel + 24 + 24;

// Bytes a triangle of a scene, its ray tree, its bundle and what the CPU keeps to draw it: 217 to 296 were measured
// with light from lightmaps (docs/performance.md). What vertices keep of light comes on top.
constexpr std::uint64_t kTriangle = 400;

// Bytes a lightmap texel, a probe or a vertex: the larger of what baking takes (coefficients of light, receivers or
// directions, the file for the cache) and of what drawing does, with each layer of the textures (RGBA32F in the bundle,
// interleaved for the CPU, and in the memory shared with OpenGL's worker). Measured, and a few percent added: the most
// that bench of quad held (VmHWM of /proc/PID/status, less 31 MiB) at --lightmap 512 and 1024 with 1 to 25 layers: 932
// baked, 1,504 drawn with 25; at --volume 64x64x64 with 4 and 36: 1,324 baked, 2,184 drawn with 36.
struct LightCell {
  std::uint64_t baked, drawn, layer;
  std::uint64_t bytes(std::uint64_t layers) const { return std::max(baked, drawn + layer * layers); }
};
constexpr LightCell kTexel{960, 360, 48}, kProbe{1370, 500, 48};
// Measured over what the same takes with a lightmap of 16 x 16, of courtyard with 189,175 and 615,263 vertices: 408 and
// 543 with the 4 coefficients of h4, 804 and 922 with the 25 of sh5; 2,016 with 63 (the smaller), 1,567 with 41 weights
// of visibility (the larger).
constexpr LightCell kVertex{560, 280, 32};

// Bytes a texel while its rays are gathered, counted from what is kept: coefficients, receivers and their sites; and of
// each ray whose hit is remembered, as many as lighting/gather.cpp keeps.
constexpr std::uint64_t kGatheredTexel = 600, kRememberedHit = 4, kRememberedHits = std::uint64_t(1) << 28;

std::uint64_t layers_in(const std::vector<LitTechnique>& baked, CoefficientStorage storage) {
  std::uint64_t layers = 0;
  for (const LitTechnique& lit : baked)
    if (lit.storage == storage) layers += std::uint64_t(lit.technique->count);
  return layers;
}

}  // namespace

void require_frame_memory(std::uint32_t width, std::uint32_t height, const std::string& backend) {
  const std::uint64_t pixels = std::uint64_t(width) * height;
  require_memory(pixels * (backend == "cpu" ? kFramePixel : kGlPixel),
                 fmt::format("a frame of {}x{} on {}", width, height, backend), "choose a smaller --size");
}

void require_scene_memory(const SubjectOptions& options) {
  require_memory(options.triangles * kTriangle, fmt::format("{} of {} triangles", options.scene, options.triangles),
                 "choose fewer --triangles");
}

void require_lightmap_memory(const SubjectOptions& options, const std::vector<LitTechnique>& baked) {
  require_volume_memory(options, baked);
  const std::uint64_t layers = layers_in(baked, CoefficientStorage::lightmap);
  if (layers == 0) return;
  const std::uint64_t texels = std::uint64_t(options.lightmap_size) * options.lightmap_size;
  const std::uint64_t hits = std::min(texels * options.rays, kRememberedHits);
  require_memory(std::max(texels * kTexel.bytes(layers), texels * kGatheredTexel + hits * kRememberedHit),
                 fmt::format("a lightmap of {0}x{0} texels and {1} layers", options.lightmap_size, layers),
                 "choose a smaller --lightmap or fewer techniques");
}

void require_volume_memory(const SubjectOptions& options, const std::vector<LitTechnique>& baked) {
  const std::uint64_t layers = layers_in(baked, CoefficientStorage::volume);
  if (layers == 0) return;
  const glm::ivec3& size = options.volume;
  const std::uint64_t probes = std::uint64_t(size.x) * std::uint64_t(size.y) * std::uint64_t(size.z);
  require_memory(probes * kProbe.bytes(layers),
                 fmt::format("a volume of {}x{}x{} probes and {} layers", size.x, size.y, size.z, layers),
                 "choose a smaller --volume or fewer techniques");
}

void require_vertex_memory(std::size_t vertices, const std::vector<LitTechnique>& baked) {
  const std::uint64_t layers = layers_in(baked, CoefficientStorage::vertex);
  if (layers == 0) return;
  require_memory(vertices * kVertex.bytes(layers),
                 fmt::format("light of {} vertices, {} coefficients each,", vertices, layers),
                 "choose fewer --triangles or fewer techniques");
}

}  // namespace twinshade

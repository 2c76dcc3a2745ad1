#include "app/memory_needed.h"

#include <fmt/format.h>

#include "base/memory.h"

namespace twinshade {
namespace {

// Bytes a pixel: a Frame's colour, depth, primitive id and coverage; OpenGL has them once more in memory that it shares
// with its worker, and the worker's own targets.
constexpr std::uint64_t kFramePixel = 16 + 4 + 4 + 1;
constexpr std::uint64_t kGlPixel = kFramePixel + 24 + 24;

// Bytes a triangle of a scene, its ray tree, its bundle and what the CPU keeps to draw it. Measured:
// docs/performance.md.
constexpr std::uint64_t kTriangle = 400;

// Bytes a lightmap texel while it is baked: 25 coefficients of three channels, its receiver and the rays it remembers
// the ends of; of a texture's layer: RGBA32F.
constexpr std::uint64_t kBakedTexel = 25 * 3 * 4 + 100, kLayerTexel = 16;

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
  std::uint64_t layers = 0;
  for (const LitTechnique& lit : baked)
    if (lit.storage == CoefficientStorage::lightmap) layers += std::uint64_t(lit.technique->count);
  if (layers == 0) return;
  const std::uint64_t texels = std::uint64_t(options.lightmap_size) * options.lightmap_size;
  require_memory(texels * (kBakedTexel + kLayerTexel * layers),
                 fmt::format("a lightmap of {0}x{0} texels and {1} layers", options.lightmap_size, layers),
                 "choose a smaller --lightmap or fewer techniques");
}

}  // namespace twinshade

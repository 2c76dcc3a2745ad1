// What a subject and its frames take, so that what cannot fit is refused before anything is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/options.h"
#include "lighting/bake.h"

namespace twinshade {

// UserError where a frame of this size, drawn by a backend, does not fit.
void require_frame_memory(std::uint32_t width, std::uint32_t height, const std::string& backend);
// UserError where a built-in scene refined to so many triangles does not fit. Models are as large as they are.
void require_scene_memory(const SubjectOptions& options);
// UserError where lightmaps of `baked`, and the light that they are made from, do not fit; or volumes, as below.
void require_lightmap_memory(const SubjectOptions& options, const std::vector<LitTechnique>& baked);
// The same of irradiance volumes alone.
void require_volume_memory(const SubjectOptions& options, const std::vector<LitTechnique>& baked);
// UserError where what a scene's vertices, so many, keep of `baked`, and the light that it is made from, do not fit.
void require_vertex_memory(std::size_t vertices, const std::vector<LitTechnique>& baked);

}  // namespace twinshade

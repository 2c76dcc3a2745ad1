// Technique reference: direct light by rays from every pixel, on the host. It has no shader, so only render draws it.
#pragma once

#include "app/machines.h"
#include "app/output.h"
#include "app/subject.h"

namespace twinshade {

bool wants_reference(const ShadingOptions& options);

// Position, normal and albedo of each pixel as the CPU's shaders give them, then rays (lighting/reference.h). UserError
// where the scene is a bundle or has no surfaces in the world.
Frame draw_reference(const SubjectOptions& options, const ShadingOptions& shading, const CpuOptions& cpu,
                     const CommonOptions& common, const Output& output, Subject& subject);

}  // namespace twinshade

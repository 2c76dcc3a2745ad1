// Technique reference: direct light by rays from every pixel, on the host. It has no shader.
#pragma once

#include "experiments/experiment.h"
#include "lighting/bake.h"
#include "lighting/reference.h"

namespace twinshade {

struct ReferenceFrame {
  Frame frame;    // colours traced, all else as drawn
  Bundle bundle;  // what position, normal and albedo were drawn from
};

// Position, normal and albedo of each pixel as the CPU's shaders give them (draw, on "cpu"), then rays
// (lighting/reference.h). UserError where the scene has no surfaces in the world.
ReferenceFrame draw_reference(const Scene& scene, const Environment& environment, const FrameOptions& options,
                              const ReferenceOptions& trace, const DrawFunction& draw);

}  // namespace twinshade

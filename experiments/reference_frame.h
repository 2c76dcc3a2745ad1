// Technique reference: direct light by rays from every pixel, on the host. It has no shader. And what it is traced to.
#pragma once

#include "experiments/experiment.h"
#include "lighting/bake.h"
#include "lighting/reference.h"

namespace twinshade {

// What of a scene is visible, for the host to trace light to.
struct VisiblePoints {
  Bundle bundle;                    // what position, normal and albedo were drawn from
  Frame frame;                      // of positions
  std::vector<ShadedPoint> points;  // one a pixel that is covered, in the frame's order
  std::vector<std::size_t> pixels;  // its place in the frame
};

// UserError where the scene has no surfaces in the world.
void require_world_surfaces(const Scene& scene);

// Position, normal and albedo of each pixel as the CPU's shaders give them (draw, on "cpu"). UserError where the scene
// has no surfaces in the world.
VisiblePoints draw_visible_points(const Scene& scene, const FrameOptions& options, const DrawFunction& draw);

struct ReferenceFrame {
  Frame frame;    // colours traced, all else as drawn
  Bundle bundle;  // what position, normal and albedo were drawn from
};

// Visible points, then rays (lighting/reference.h).
ReferenceFrame draw_reference(const Scene& scene, const Environment& environment, const FrameOptions& options,
                              const ReferenceOptions& trace, const DrawFunction& draw);

}  // namespace twinshade

// The first line of GLSL whose value differs between two machines at a pixel of a frame.
#pragma once

#include <string>

#include "app/options.h"
#include "bundle/bundle.h"
#include "check/first_line.h"
#include "golden/compare_frames.h"
#include "raster/renderer.h"

namespace twinshade {

struct LineSearchOptions {
  CpuOptions cpu;
  bool host_fma = true;
  double time_limit_seconds = DrawOptions().time_limit_seconds;
};

// The pixel's inputs once more, outside of the frame, with probes in the shader. frame: with its attributes captured; a
// and b: names of backends. Never throws because of a shader or a driver: FirstLine::note says why nothing was looked
// for.
FirstLine first_line_at(const ShaderSource& shader, const Bundle& bundle, const Frame& frame, const Difference& at,
                        const std::string& a, const std::string& b, const LineSearchOptions& options);

}  // namespace twinshade

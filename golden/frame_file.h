// A frame as a file, bit for bit: what golden images are kept as.
#pragma once

#include <string>

#include "raster/renderer.h"

namespace twinshade {

// OpenEXR, compressed without loss, which other tools can open: R G B A and Z (depth) as floats, id and coverage as
// unsigned integers; of a shader whose output is integers R G B A are those, signed ones by their bits. Y down, as
// pictures are. Every bit is kept: payloads of NaN, -0, denormals. Attributes, timings and provenance are not.
// The same frame is the same bytes. UserError naming the path where it cannot be written.
void write_frame_file(const std::string& path, const Frame& frame);

// UserError naming the path: missing, damaged, or not written by write_frame_file.
Frame read_frame_file(const std::string& path);

}  // namespace twinshade

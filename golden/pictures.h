// Frames as pictures: EXR with every bit of the colour, HDR and PNG to look at, and pictures of where two frames
// differ.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "raster/renderer.h"

namespace twinshade {

enum class Tonemap {
  none,      // clipped to [0, 1]
  reinhard,  // x / (1 + x): Reinhard et al., Photographic tone reproduction for digital images, 2002, eq. 3
  aces       // Narkowicz's rational fit of the ACES filmic curve, 2015
};

struct PictureOptions {
  double exposure = 0;                                     // stops: radiance is multiplied by 2^exposure. PNG only.
  Tonemap tonemap = Tonemap::reinhard;                     // PNG only
  std::vector<std::pair<std::string, std::string>> notes;  // stored as text attributes, where the format has them
};

// UserError unless `path` ends in .exr, .hdr or .png.
void require_picture_ending(const std::string& path);

// By ending: .exr RGBA 32-bit float, lossless; .hdr RGBE, negative and NaN become 0; .png 8-bit sRGB. Frames are y-up,
// pictures y-down. Integers: .exr RGBA 32-bit unsigned integers, signed ones by their bits; .png themselves, clamped to
// [0, 255]; .hdr refused. UserError naming the path where it cannot be written; nothing half-written stays behind.
void write_picture(const std::string& path, const Frame& frame, const PictureOptions& options = {});

// Where b differs from a, as PNG. Equal pixels: a in dim grey, integers in dim colours. Different colour: blue (1 ULP)
// over green and yellow to red (2^16 ULP or more), white where one side is NaN. Depth or attributes only: cyan.
// Primitive id: orange. Coverage: magenta.
void write_difference_picture(const std::string& path, const Frame& a, const Frame& b);

// The bytes of the same as PNG files.
std::string picture_png(const Frame& frame, const PictureOptions& options = {});
std::string difference_png(const Frame& a, const Frame& b);

// One channel of radiance to 8 bits: exposure, tone curve, sRGB transfer (IEC 61966-2-1), nearest. NaN is 0.
unsigned char display_value(double radiance, double exposure, Tonemap tonemap);

}  // namespace twinshade

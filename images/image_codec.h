// What reads and writes image files: a module that is loaded with the first of them. OpenImageIO brings some 250
// libraries along, whose loading takes longer than a small comparison, and every worker of OpenGL is this program
// again.
#pragma once

#include <string>
#include <string_view>

#include "images/image_file.h"

namespace twinshade {

// Functions throw std::runtime_error with the reason.
struct ImageCodec {
  DecodedImage (*read_file)(const std::string& path);
  DecodedImage (*read_memory)(std::string_view bytes, bool png);  // PNG, else JPEG
  void (*write_file)(const std::string& path, const ImageToWrite& image);
};

// The module's symbol, of type const ImageCodec.
constexpr const char* kImageCodecSymbol = "twinshade_image_codec";

// UserError naming where the module was looked for, or what it lacks.
const ImageCodec& image_codec();

}  // namespace twinshade

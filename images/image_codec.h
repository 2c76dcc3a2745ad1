// What reads and writes image files: a module that is loaded with the first of them. OpenImageIO brings some 250
// libraries along, whose loading takes longer than a small comparison, and every worker of OpenGL is this program
// again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "images/image_file.h"

namespace twinshade {

// Functions throw std::runtime_error with the reason. format: as OpenImageIO calls it; no other is tried. most: bytes
// that the picture may take, std::bad_alloc where it would take more.
struct ImageCodec {
  DecodedImage (*read_file)(const std::string& path, const std::string& format, std::uint64_t most);
  DecodedImage (*read_memory)(std::string_view bytes, const std::string& format, std::uint64_t most);
  void (*write_file)(const std::string& path, const ImageToWrite& image);
  std::string (*encode)(const std::string& name, const ImageToWrite& image);   // the bytes of a file of that name
  ChannelImage (*read_channels)(const std::string& path, std::uint64_t most);  // OpenEXR
  void (*write_channels)(const std::string& path, const ChannelImage& image);
};

// The module's symbol, of type const ImageCodec. Its number goes up where that changes: a module of another build is
// refused, not called.
constexpr const char* kImageCodecSymbol = "twinshade_image_codec_5";

// UserError naming where the module was looked for, or what it lacks.
const ImageCodec& image_codec();

}  // namespace twinshade

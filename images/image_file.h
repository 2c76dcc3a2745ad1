// Image files as they are: no colour conversion, no flipping. Radiance pictures are divided by their EXPOSURE
// and COLORCORR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace twinshade {

struct DecodedImage {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 0;  // 1 to 4: R, G, B, A or grey, A, by name where the file names them; A may be missing
  std::uint32_t bits = 32;     // of an integer sample in the file (8 or 16); 32: floating point
  std::vector<float> texels;   // row 0 is the upper one; integers divided by their largest value
};

// UserError naming the file: missing, truncated, damaged, of no known format, of no size, larger than memory.
DecodedImage decode_image_file(const std::string& path);
// A PNG or JPEG file in memory; `name` for messages.
DecodedImage decode_image_memory(std::string_view bytes, const std::string& name);

struct ImageToWrite {
  std::uint32_t width = 0, height = 0;
  int channels = 3;
  bool is_float = false;                                   // 32-bit floating point, else 8-bit integers
  const void* upper_row = nullptr;                         // pixels of a row one after the other
  std::ptrdiff_t row_stride = 0;                           // bytes to the row below it; may be negative
  std::vector<std::pair<std::string, std::string>> notes;  // stored as text attributes, where the format has them
};

// Format by ending. The same image is the same bytes: no time of writing. UserError naming the path where it cannot be
// written; nothing half-written stays behind.
void write_image_file(const std::string& path, const ImageToWrite& image);

// Pixel `index` of an image, row by row from the upper left, for messages.
std::string pixel_name(std::size_t index, std::uint32_t width);

// ".png" of "a/B.PNG"; empty where there is none.
std::string lower_case_ending(const std::string& path);

}  // namespace twinshade

// Image files as they are: no colour conversion, no flipping.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace twinshade {

struct DecodedImage {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 0;  // 1 to 4; R, G, B, A by name where the file names them
  std::uint32_t bits = 32;     // of an integer sample in the file (8 or 16); 32: floating point
  std::vector<float> texels;   // row 0 is the upper one; integers divided by their largest value
};

// UserError naming the file: missing, truncated, damaged, of no known format, of no size.
DecodedImage decode_image_file(const std::string& path);
// A PNG or JPEG file in memory; `name` for messages.
DecodedImage decode_image_memory(std::string_view bytes, const std::string& name);

// ".png" of "a/B.PNG"; empty where there is none.
std::string lower_case_ending(const std::string& path);

}  // namespace twinshade

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
  std::string note = {};       // what of the file is not read, to be said with the file's name; empty: nothing
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
// The bytes of a PNG file, for documents that pictures are part of.
std::string encode_png(const ImageToWrite& image);

// A picture of named channels, each of 32-bit words that nothing converts: what is written is read bit for bit.
struct ChannelImage {
  struct Channel {
    std::string name;
    bool is_float = true;  // else unsigned integers
  };
  std::uint32_t width = 0, height = 0;
  std::vector<Channel> channels;     // as read: in the order of the file's library
  std::vector<std::uint32_t> words;  // row 0 is the upper one; of a pixel, in the order of the channels
  std::vector<std::pair<std::string, std::string>> notes;  // text attributes

  // Index of that channel; channels.size() where there is none.
  std::size_t find(std::string_view name) const;
};

// As OpenEXR, without loss. The same image is the same bytes, by the same version of the library. UserError as
// write_image_file.
void write_channel_file(const std::string& path, const ChannelImage& image);
// UserError naming the file: missing, truncated, damaged, no OpenEXR file, channels of other than 32 bits, larger than
// memory.
ChannelImage read_channel_file(const std::string& path);

// Pixel `index` of an image, row by row from the upper left, for messages.
std::string pixel_name(std::size_t index, std::uint32_t width);

// ".png" of "a/B.PNG"; empty where there is none.
std::string lower_case_ending(const std::string& path);

}  // namespace twinshade

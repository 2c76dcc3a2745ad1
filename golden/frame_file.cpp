#include "golden/frame_file.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/error.h"
#include "images/image_file.h"

namespace twinshade {
namespace {

// The note that tells what colours are, and that the file is a frame.
constexpr const char* kColourNote = "frame";
constexpr std::array<const char*, 3> kScalarNames{"float", "int", "uint"};  // by Scalar's values

enum FrameChannel : std::size_t { kRed, kGreen, kBlue, kAlpha, kZ, kPrimitive, kCovered, kChannels };
constexpr std::array<const char*, kChannels> kChannelNames{"R", "G", "B", "A", "Z", "id", "coverage"};

bool is_float(std::size_t channel, Scalar scalar) {
  return channel == kZ || (channel <= kAlpha && scalar == Scalar::f32);
}

// What a frame has at a pixel, as words in the order of the channels.
std::array<std::uint32_t, kChannels> words_at(const Frame& frame, std::size_t pixel) {
  std::array<std::uint32_t, kChannels> words{};
  for (std::size_t c = kRed; c <= kAlpha; ++c) words[c] = std::bit_cast<std::uint32_t>(frame.color[pixel * 4 + c]);
  words[kZ] = std::bit_cast<std::uint32_t>(frame.depth[pixel]);
  words[kPrimitive] = frame.primitive_id[pixel];
  words[kCovered] = frame.coverage[pixel];
  return words;
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw UserError(path + ": not a frame that golden images are kept as: " + reason);
}

Scalar scalar_of(const std::string& path, const ChannelImage& image) {
  for (const auto& [key, value] : image.notes)
    if (key == kColourNote)
      for (std::size_t s = 0; s < kScalarNames.size(); ++s)
        if (value == kScalarNames[s]) return Scalar(s);
  refuse(path, "it does not say what its colours are");
}

}  // namespace

void write_frame_file(const std::string& path, const Frame& frame) {
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  TWINSHADE_CHECK_EQ(frame.color.size(), pixels * 4);
  TWINSHADE_CHECK_EQ(frame.depth.size(), pixels);
  TWINSHADE_CHECK_EQ(frame.primitive_id.size(), pixels);
  TWINSHADE_CHECK_EQ(frame.coverage.size(), pixels);
  TWINSHADE_CHECK_LT(std::size_t(frame.color_scalar), kScalarNames.size());
  ChannelImage image;
  image.width = frame.width, image.height = frame.height;
  for (std::size_t c = 0; c < kChannels; ++c)
    image.channels.push_back({kChannelNames[c], is_float(c, frame.color_scalar)});
  image.words.reserve(pixels * kChannels);
  for (std::uint32_t row = 0; row < frame.height; ++row)
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      const auto words = words_at(frame, std::size_t(frame.height - 1 - row) * frame.width + x);
      image.words.insert(image.words.end(), words.begin(), words.end());
    }
  image.notes = {{kColourNote, kScalarNames[std::size_t(frame.color_scalar)]}};
  write_channel_file(path, image);
}

Frame read_frame_file(const std::string& path) {
  const ChannelImage image = read_channel_file(path);
  Frame frame;
  frame.width = image.width, frame.height = image.height;
  frame.color_scalar = scalar_of(path, image);
  std::array<std::size_t, kChannels> place{};
  for (std::size_t c = 0; c < kChannels; ++c) {
    place[c] = image.find(kChannelNames[c]);
    if (place[c] == image.channels.size()) refuse(path, std::string("it has no channel ") + kChannelNames[c]);
    if (image.channels[place[c]].is_float != is_float(c, frame.color_scalar))
      refuse(path, std::string("its channel ") + kChannelNames[c] + " is of another type");
  }
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  frame.color.resize(pixels * 4);
  frame.depth.resize(pixels);
  frame.primitive_id.resize(pixels);
  frame.coverage.resize(pixels);
  for (std::uint32_t row = 0; row < frame.height; ++row)
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      const std::uint32_t* words = &image.words[(std::size_t(row) * frame.width + x) * image.channels.size()];
      const std::size_t pixel = std::size_t(frame.height - 1 - row) * frame.width + x;
      for (std::size_t c = kRed; c <= kAlpha; ++c) frame.color[pixel * 4 + c] = std::bit_cast<float>(words[place[c]]);
      frame.depth[pixel] = std::bit_cast<float>(words[place[kZ]]);
      frame.primitive_id[pixel] = words[place[kPrimitive]];
      if (words[place[kCovered]] > 1) refuse(path, "its coverage is neither 0 nor 1");
      frame.coverage[pixel] = std::uint8_t(words[place[kCovered]]);
    }
  return frame;
}

}  // namespace twinshade

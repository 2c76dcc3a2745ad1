#include "scenes/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/file.h"

namespace twinshade {
namespace {

constexpr int kLargestSide = 65536;

[[noreturn]] void refuse(const std::string& name, std::string reason) {
  reason = reason.substr(0, reason.find('\n'));
  throw UserError(name +
                  ": cannot be read as an image: " + (reason.empty() ? "unknown format or damaged file" : reason));
}

bool starts_with(std::string_view bytes, std::string_view magic) { return bytes.substr(0, magic.size()) == magic; }

// libjpeg fills what is missing with grey and only warns; a whole file has an end-of-image marker after its first scan
// (ITU-T T.81, annex B: in entropy-coded data FF is followed by 00 or a restart marker).
bool jpeg_is_whole(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (byte(at) != 0xff) return false;
    const unsigned marker = byte(at + 1);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    if (marker == 0xda) return bytes.find("\xff\xd9", at) != std::string_view::npos;
    at += 2 + (std::size_t(byte(at + 2)) << 8 | byte(at + 3));
  }
  return false;
}

DecodedImage read_all(OIIO::ImageInput& input, const std::string& name) {
  const OIIO::ImageSpec spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide || spec.depth > 1)
    refuse(name, "its size is " + std::to_string(spec.width) + " x " + std::to_string(spec.height));
  if (spec.deep) refuse(name, "deep images are not supported");
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height)
    refuse(name, "its data window is not its display window; crop or fill it first");
  if (spec.get_int_attribute("Orientation", 1) != 1) refuse(name, "it is stored turned or mirrored; save it upright");

  // R, G, B, A by name, else the first channels in their order.
  std::vector<int> order;
  for (const char* wanted : {"R", "G", "B", "A"})
    for (int c = 0; c < spec.nchannels; ++c)
      if (spec.channel_name(c) == wanted) order.push_back(c);
  const bool named = order.size() >= 3;
  DecodedImage image;
  image.width = std::uint32_t(spec.width);
  image.height = std::uint32_t(spec.height);
  image.channels = named ? std::uint32_t(order.size()) : std::uint32_t(std::min(spec.nchannels, 4));
  image.bits = spec.format == OIIO::TypeDesc::UINT8 ? 8 : spec.format == OIIO::TypeDesc::UINT16 ? 16 : 32;
  const std::size_t pixels = std::size_t(image.width) * image.height;
  image.texels.resize(pixels * image.channels);
  const auto pick = [&](const auto* raw, double largest) {
    for (std::size_t p = 0; p < pixels; ++p)
      for (std::uint32_t c = 0; c < image.channels; ++c) {
        const int from = named ? order[c] : int(c);
        image.texels[p * image.channels + c] =
            float(double(raw[p * std::size_t(spec.nchannels) + std::size_t(from)]) / largest);
      }
  };
  const auto read = [&](auto type, OIIO::TypeDesc format, double largest) {
    std::vector<decltype(type)> raw(pixels * std::size_t(spec.nchannels));
    if (!input.read_image(0, 0, 0, spec.nchannels, format, raw.data())) refuse(name, input.geterror());
    if (input.has_error()) refuse(name, input.geterror());
    pick(raw.data(), largest);
  };
  if (image.bits == 8)
    read(std::uint8_t{}, OIIO::TypeDesc::UINT8, 255);
  else if (image.bits == 16)
    read(std::uint16_t{}, OIIO::TypeDesc::UINT16, 65535);
  else
    read(float{}, OIIO::TypeDesc::FLOAT, 1);
  return image;
}

}  // namespace

std::string lower_case_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return ending;
}

DecodedImage decode_image_file(const std::string& path) {
  const std::string bytes = read_file(path);
  if (bytes.empty()) refuse(path, "the file is empty");
  if (starts_with(bytes, "\xff\xd8") && !jpeg_is_whole(bytes)) refuse(path, "the file is truncated");
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &config);
  if (!input) refuse(path, OIIO::geterror());
  return read_all(*input, path);
}

DecodedImage decode_image_memory(std::string_view bytes, const std::string& name) {
  const bool png = starts_with(bytes, "\x89PNG"), jpeg = starts_with(bytes, "\xff\xd8");
  if (!png && !jpeg) refuse(name, "neither PNG nor JPEG");
  if (jpeg && !jpeg_is_whole(bytes)) refuse(name, "the file is truncated");
  OIIO::Filesystem::IOMemReader reader(const_cast<char*>(bytes.data()), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input =
      OIIO::ImageInput::open(png ? "memory.png" : "memory.jpg", &config, &reader);
  if (!input) refuse(name, OIIO::geterror());
  return read_all(*input, name);
}

}  // namespace twinshade

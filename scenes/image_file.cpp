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
constexpr double kMostSamples = 0x1p30;  // 4 GiB as floats

[[noreturn]] void refuse(const std::string& name, std::string reason) {
  reason = reason.substr(0, reason.find('\n'));
  throw UserError(name +
                  ": cannot be read as an image: " + (reason.empty() ? "unknown format or damaged file" : reason));
}

bool is_png(std::string_view bytes) { return bytes.substr(0, 4) == "\x89PNG"; }
bool is_jpeg(std::string_view bytes) { return bytes.substr(0, 2) == "\xff\xd8"; }

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// The check of ISO 3309 that PNG's chunks carry.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0u;
  for (char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

// libpng writes to stderr about damage; chunks that are all there with their checksums give it no reason to
// (W3C, Portable network graphics, section 5).
bool png_is_whole(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12) return false;
    if (crc32(bytes.substr(at + 4, length + 4)) != big_endian(bytes, at + 8 + length)) return false;
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    at += length + 12;
  }
  return false;
}

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

void check_whole(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) refuse(name, "the file is empty");
  if ((is_png(bytes) && !png_is_whole(bytes)) || (is_jpeg(bytes) && !jpeg_is_whole(bytes)))
    refuse(name, "the file is truncated or damaged");
}

DecodedImage read_all(OIIO::ImageInput& input, const std::string& name) {
  const OIIO::ImageSpec spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide || spec.depth > 1 ||
      double(spec.width) * spec.height * spec.nchannels > kMostSamples)
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
  check_whole(bytes, path);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &config);
  if (!input) refuse(path, OIIO::geterror());
  return read_all(*input, path);
}

DecodedImage decode_image_memory(std::string_view bytes, const std::string& name) {
  const bool png = is_png(bytes);
  if (!png && !is_jpeg(bytes)) refuse(name, "neither PNG nor JPEG");
  check_whole(bytes, name);
  OIIO::Filesystem::IOMemReader reader(const_cast<char*>(bytes.data()), bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &reader;
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(png ? "memory.png" : "memory.jpg", &config);
  if (!input) refuse(name, OIIO::geterror());
  return read_all(*input, name);
}

}  // namespace twinshade

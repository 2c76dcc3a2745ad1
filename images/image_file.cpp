#include "images/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "base/error.h"
#include "base/file.h"
#include "images/image_codec.h"

namespace twinshade {
namespace {

constexpr const char* kNoMemory = "there is not enough memory for it; make it smaller";

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

// The chunks are all there, with their checksums (W3C, Portable network graphics, section 5).
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

// Those behind the = of a line; 0 where there is none.
std::array<double, 3> numbers_of(const std::string& line) {
  std::array<double, 3> numbers{};
  const char* at = line.c_str() + line.find('=') + 1;
  for (double& number : numbers) {
    char* behind = nullptr;
    number = std::strtod(at, &behind);
    at = behind;
  }
  return numbers;
}

// What a Radiance picture's red, green and blue have been multiplied by: the product of its header's EXPOSURE and
// COLORCORR lines (Ward, Radiance file formats), which OpenImageIO does not divide by. 1 for other files. Only the
// header, up to an empty line, is read.
std::array<double, 3> radiance_exposure(std::string_view bytes, const std::string& name) {
  std::array<double, 3> exposure{1, 1, 1};
  if (bytes.substr(0, 2) != "#?") return exposure;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string line(bytes.substr(0, end));
    if (line.empty() || line == "\r") break;
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    if (line.rfind("FORMAT=32-bit_rle_xyze", 0) == 0)
      refuse(name, "its colours are CIE XYZ, which is not read; convert it with ra_xyze -r");
    const bool for_all = line.rfind("EXPOSURE=", 0) == 0;
    if (!for_all && line.rfind("COLORCORR=", 0) != 0) continue;
    const std::array<double, 3> factor = numbers_of(line);
    for (std::size_t c = 0; c < 3; ++c) {
      exposure[c] *= factor[for_all ? 0 : c];
      if (!(exposure[c] > 0 && std::isfinite(exposure[c]))) refuse(name, "its header says " + line);
    }
  }
  return exposure;
}

}  // namespace

std::string lower_case_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return ending;
}

std::string pixel_name(std::size_t index, std::uint32_t width) {
  return "pixel (" + std::to_string(index % width) + ", " + std::to_string(index / width) +
         ") counted from the upper left";
}

DecodedImage decode_image_file(const std::string& path) {
  try {
    std::array<double, 3> exposure;
    {
      const std::string bytes = read_file(path);
      check_whole(bytes, path);
      exposure = radiance_exposure(bytes, path);
    }
    DecodedImage image = image_codec().read_file(path);
    if (exposure != std::array<double, 3>{1, 1, 1})
      for (std::size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i] = float(double(image.texels[i]) / exposure[i % image.channels % 3]);
    return image;
  } catch (const UserError&) {
    throw;
  } catch (const std::runtime_error& error) {
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, kNoMemory);
  }
}

DecodedImage decode_image_memory(std::string_view bytes, const std::string& name) {
  if (!is_png(bytes) && !is_jpeg(bytes)) refuse(name, "neither PNG nor JPEG");
  check_whole(bytes, name);
  try {
    return image_codec().read_memory(bytes, is_png(bytes));
  } catch (const std::runtime_error& error) {
    refuse(name, error.what());
  } catch (const std::bad_alloc&) {
    refuse(name, kNoMemory);
  }
}

void write_image_file(const std::string& path, const ImageToWrite& image) {
  write_file_with(path, [&](const std::string& temporary) {
    try {
      image_codec().write_file(temporary, image);
    } catch (const std::runtime_error& error) {
      const std::string reason = error.what();
      std::string line = reason.substr(0, reason.find('\n'));
      // The library names the temporary file; the user knows only the final one.
      if (const auto at = line.find(temporary); at != std::string::npos) line.replace(at, temporary.size(), path);
      throw UserError(path + ": cannot be written: " + (line.empty() ? "unknown reason" : line));
    }
  });
}

}  // namespace twinshade

#include "images/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "images/image_codec.h"

namespace twinshade {
namespace {

using namespace std::string_view_literals;

constexpr const char* kNoMemory = "there is not enough memory for it; make it smaller";

[[noreturn]] void refuse(const std::string& name, std::string reason) {
  reason = reason.substr(0, reason.find('\n'));
  throw UserError(name +
                  ": cannot be read as an image: " + (reason.empty() ? "unknown format or damaged file" : reason));
}

bool is_png(std::string_view bytes) { return bytes.substr(0, 4) == "\x89PNG"; }
bool is_jpeg(std::string_view bytes) { return bytes.substr(0, 2) == "\xff\xd8"; }

bool is_pnm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && std::string_view("123456fF").find(bytes[1]) != std::string_view::npos &&
         std::string_view(" \t\r\n#").find(bytes[2]) != std::string_view::npos;
}

// As OpenImageIO calls them; empty: none that is read. What else the library reads is hardly met, and less careful with
// damage: some of it ends the program.
std::string format_of(std::string_view bytes, const std::string& path) {
  constexpr std::pair<std::string_view, const char*> kBeginnings[] = {
      {"\x89PNG", "png"},  {"\xff\xd8", "jpeg"}, {"v/1\x01", "openexr"}, {"#?", "hdr"}, {"II*\0"sv, "tiff"},
      {"MM\0*"sv, "tiff"}, {"II+\0"sv, "tiff"},  {"MM\0+"sv, "tiff"},    {"BM", "bmp"}, {"GIF8", "gif"},
      {"DDS ", "dds"},     {"8BPS", "psd"},      {"\x01\xda", "sgi"}};
  for (const auto& [beginning, format] : kBeginnings)
    if (bytes.substr(0, beginning.size()) == beginning) return format;
  if (bytes.substr(0, 4) == "RIFF" && bytes.substr(std::min<std::size_t>(bytes.size(), 8), 4) == "WEBP") return "webp";
  if (is_pnm(bytes)) return "pnm";
  const std::string ending = lower_case_ending(path);  // all that tells these
  return ending == ".tga" || ending == ".tpic" ? "targa" : ending == ".hdr" || ending == ".rgbe" ? "hdr" : "";
}

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

std::uint32_t little_endian(std::string_view bytes, std::size_t at) { return __builtin_bswap32(big_endian(bytes, at)); }

// Which bits are red, green, blue and, where there is one, alpha, is in masks of the header, of which none is empty:
// the library would look for their lowest bit without end (Microsoft, "DDS_PIXELFORMAT structure").
bool dds_masks_are_whole(std::string_view bytes) {
  constexpr std::size_t kFlags = 80, kMasks = 92, kHeader = 128;
  constexpr std::uint32_t kHasAlpha = 0x1, kHasMasks = 0x40;
  if (bytes.size() < kHeader) return false;
  const std::uint32_t flags = little_endian(bytes, kFlags);
  const std::size_t masks = (flags & kHasMasks) == 0 ? 0 : (flags & kHasAlpha) == 0 ? 3 : 4;
  for (std::size_t i = 0; i < masks; ++i)
    if (little_endian(bytes, kMasks + 4 * i) == 0) return false;
  return true;
}

// Returns the format.
std::string check_whole(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) refuse(name, "the file is empty");
  std::string format = format_of(bytes, name);
  if (format.empty())
    refuse(
        name,
        "it begins as no PNG, JPEG, OpenEXR, Radiance, TIFF, BMP, GIF, WebP, PNM, DDS, PSD or SGI file does, nor is it "
        "called .tga; convert it");
  if ((is_png(bytes) && !png_is_whole(bytes)) || (is_jpeg(bytes) && !jpeg_is_whole(bytes)) ||
      (format == "dds" && !dds_masks_are_whole(bytes)))
    refuse(name, "the file is truncated or damaged");
  return format;
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

// Whether the pixels of a Radiance picture, from its line of sizes on, have run lengths of the format's older kind,
// which OpenImageIO does not read: a pixel (1, 1, 1, n) repeats the one before it (Ward, Radiance file formats).
// Pictures without run lengths may have such pixels as well, but no bytes too few.
bool has_old_run_lengths(std::string_view bytes) {
  unsigned height = 0, width = 0;
  const std::size_t end = bytes.find('\n');
  if (end == bytes.npos || std::sscanf(std::string(bytes.substr(0, end)).c_str(), "-Y %u +X %u", &height, &width) != 2)
    return false;
  bytes.remove_prefix(end + 1);
  if (bytes.size() / 4 / std::max(width, 1u) >= height || bytes.substr(0, 2) == "\2\2") return false;
  for (std::size_t at = 4; at + 4 <= bytes.size(); at += 4)
    if (bytes.substr(at, 3) == "\1\1\1") return true;
  return false;
}

// What a Radiance picture's red, green and blue have been multiplied by: the product of its header's EXPOSURE and
// COLORCORR lines (Ward, Radiance file formats), which OpenImageIO does not divide by. 1 for other files. Refuses those
// that are not read.
std::array<double, 3> radiance_exposure(std::string_view bytes, const std::string& name) {
  std::array<double, 3> exposure{1, 1, 1};
  if (bytes.substr(0, 2) != "#?") return exposure;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string line(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    if (line.empty() || line == "\r") {
      if (has_old_run_lengths(bytes))
        refuse(name, "its pixels have run lengths of Radiance's old kind, which are not read; convert it with ra_rgbe");
      break;
    }
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

// write: throws std::runtime_error with the reason.
template <class Write>
void write_with_codec(const std::string& path, const Write& write) {
  write_file_with(path, [&](const std::string& temporary) {
    try {
      write(temporary);
    } catch (const std::runtime_error& error) {
      const std::string reason = error.what();
      std::string line = reason.substr(0, reason.find('\n'));
      // The library names the temporary file; the user knows only the final one.
      if (const auto at = line.find(temporary); at != std::string::npos) line.replace(at, temporary.size(), path);
      throw UserError(path + ": cannot be written: " + (line.empty() ? "unknown reason" : line));
    }
  });
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
    std::string bytes = read_file(path);
    const std::string format = check_whole(bytes, path);
    const std::array<double, 3> exposure = radiance_exposure(bytes, path);
    std::error_code code;
    const bool from_file = std::filesystem::is_regular_file(path, code);  // a pipe gives its bytes once
    if (from_file) bytes = std::string();
    const std::uint64_t most = available_memory();
    DecodedImage image =
        from_file ? image_codec().read_file(path, format, most) : image_codec().read_memory(bytes, format, most);
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
  const std::string format = check_whole(bytes, name);
  try {
    return image_codec().read_memory(bytes, format, available_memory());
  } catch (const std::runtime_error& error) {
    refuse(name, error.what());
  } catch (const std::bad_alloc&) {
    refuse(name, kNoMemory);
  }
}

void write_image_file(const std::string& path, const ImageToWrite& image) {
  write_with_codec(path, [&](const std::string& temporary) { image_codec().write_file(temporary, image); });
}

std::string encode_png(const ImageToWrite& image) {
  try {
    return image_codec().encode("picture.png", image);
  } catch (const UserError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw UserError(std::string("a picture cannot be made: ") + error.what());
  }
}

std::size_t ChannelImage::find(std::string_view name) const {
  return std::size_t(std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; }) -
                     channels.begin());
}

void write_channel_file(const std::string& path, const ChannelImage& image) {
  TWINSHADE_CHECK_EQ(image.words.size(), std::size_t(image.width) * image.height * image.channels.size());
  write_with_codec(path, [&](const std::string& temporary) { image_codec().write_channels(temporary, image); });
}

ChannelImage read_channel_file(const std::string& path) {
  constexpr std::string_view kBeginning = "v/1\x01";
  try {
    const std::string bytes = read_file(path);
    if (bytes.empty()) refuse(path, "the file is empty");
    if (std::string_view(bytes).substr(0, kBeginning.size()) != kBeginning) refuse(path, "it is no OpenEXR file");
    return image_codec().read_channels(path, available_memory());
  } catch (const UserError&) {
    throw;
  } catch (const std::runtime_error& error) {
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, kNoMemory);
  }
}

}  // namespace twinshade

// Layout: Header, a bit for each cell (1: it has light), what those cells have as f32 (coefficients, then irradiance
// where the bake has it), SHA-256 of all before it as 64 hex digits. That hash is also the bake's.
#include "lighting/bake_cache.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/cache.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kMagic = 0x334b4254;  // "TBK3"

struct Header {
  std::uint32_t magic, storage, width, height, radiance_count, irradiance_count;
  std::int32_t volume[3];
  float origin[3], scale[3];
};
constexpr std::size_t kHeaderBytes = sizeof(Header);
static_assert(kHeaderBytes == 15 * 4);
constexpr std::size_t kRgbBytes = 3 * sizeof(float);

bool is_zero(const char* cell, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i)
    if (cell[i] != 0) return false;
  return true;
}

}  // namespace

std::string serialize_bake(const LightBake& bake) {
  const std::size_t cells = std::size_t(bake.width) * bake.height;
  const std::uint32_t irradiance_count = bake.irradiance.empty() ? 0 : 1;
  Header header{kMagic,
                std::uint32_t(bake.storage),
                bake.width,
                bake.height,
                std::uint32_t(bake.radiance_count),
                irradiance_count,
                {},
                {},
                {}};
  for (int axis = 0; axis < 3; ++axis) {
    header.volume[axis] = bake.volume[axis];
    header.origin[axis] = bake.volume_origin[axis];
    header.scale[axis] = bake.volume_scale[axis];
  }
  const std::size_t sh_bytes = header.radiance_count * kRgbBytes, irradiance_bytes = irradiance_count * kRgbBytes;
  std::string bytes(reinterpret_cast<const char*>(&header), kHeaderBytes);
  bytes.resize(kHeaderBytes + (cells + 7) / 8, 0);
  bytes.reserve(bytes.size() + cells * (sh_bytes + irradiance_bytes) + kBakeHashLength);
  const char* sh = reinterpret_cast<const char*>(bake.sh.data());
  const char* irradiance = reinterpret_cast<const char*>(bake.irradiance.data());
  for (std::size_t cell = 0; cell < cells; ++cell, sh += sh_bytes, irradiance += irradiance_bytes) {
    if (is_zero(sh, sh_bytes) && is_zero(irradiance, irradiance_bytes)) continue;
    bytes[kHeaderBytes + cell / 8] = char(bytes[kHeaderBytes + cell / 8] | (1 << cell % 8));
    bytes.append(sh, sh_bytes);
    bytes.append(irradiance, irradiance_bytes);
  }
  return bytes + sha256_hex(bytes);
}

std::optional<LightBake> deserialize_bake(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes + kBakeHashLength) return std::nullopt;
  const std::string_view content = bytes.substr(0, bytes.size() - kBakeHashLength);
  LightBake bake;
  bake.hash = bytes.substr(content.size());
  if (sha256_hex(content) != bake.hash) return std::nullopt;
  Header header;
  std::memcpy(&header, content.data(), kHeaderBytes);
  if (header.magic != kMagic || header.storage > std::uint32_t(CoefficientStorage::volume) ||
      header.radiance_count > std::uint32_t(kMostRadianceCount) || header.irradiance_count > 1)
    return std::nullopt;
  bake.storage = CoefficientStorage(header.storage);
  bake.width = header.width, bake.height = header.height;
  bake.radiance_count = int(header.radiance_count);
  for (int axis = 0; axis < 3; ++axis) {
    bake.volume[axis] = header.volume[axis];
    bake.volume_origin[axis] = header.origin[axis];
    bake.volume_scale[axis] = header.scale[axis];
  }
  const std::size_t sh_bytes = header.radiance_count * kRgbBytes;
  const std::size_t irradiance_bytes = header.irradiance_count * kRgbBytes;

  const std::size_t cells = std::size_t(bake.width) * bake.height, mask_bytes = (cells + 7) / 8;
  if (content.size() - kHeaderBytes < mask_bytes) return std::nullopt;
  const char* mask = content.data() + kHeaderBytes;
  const auto stored = [&](std::size_t cell) { return (mask[cell / 8] >> cell % 8 & 1) != 0; };
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) count += stored(cell);
  if (content.size() != kHeaderBytes + mask_bytes + count * (sh_bytes + irradiance_bytes)) return std::nullopt;
  bake.sh.assign(cells * sh_bytes / sizeof(float), 0.0f);
  bake.irradiance.assign(cells * irradiance_bytes / sizeof(float), 0.0f);
  const char* from = mask + mask_bytes;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (!stored(cell)) continue;
    // Either may be empty, of which memcpy takes no address.
    std::copy_n(from, sh_bytes, reinterpret_cast<char*>(bake.sh.data()) + cell * sh_bytes);
    from += sh_bytes;
    std::copy_n(from, irradiance_bytes, reinterpret_cast<char*>(bake.irradiance.data()) + cell * irradiance_bytes);
    from += irradiance_bytes;
  }
  return bake;
}

std::string bake_cache_path(const std::string& key) { return cache_folder() + "/bake-" + key; }

std::optional<LightBake> cached_bake(const std::string& key) {
  try {
    const std::string path = bake_cache_path(key);
    // Anything else in its place (a pipe would be waited for) goes when the bake is kept.
    if (std::error_code code; !std::filesystem::is_regular_file(path, code)) return std::nullopt;
    if (std::optional<LightBake> bake = deserialize_bake(read_file(path))) {
      touch_cached(path);
      return bake;
    }
    std::fprintf(stderr, "twinshade: cached bake %s is damaged: baking again\n", path.c_str());
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  } catch (const UserError& error) {
    std::fprintf(stderr, "twinshade: bake cache not used: %s\n", error.what());
  }
  return std::nullopt;
}

void keep_bake(const std::string& key, std::string_view bytes) {
  try {
    write_cached(bake_cache_path(key), bytes);
    trim_cache();
  } catch (const UserError& error) {
    std::fprintf(stderr, "twinshade: bake not cached: %s\n", error.what());
  }
}

}  // namespace twinshade

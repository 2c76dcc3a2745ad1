// Layout: magic, storage, width, height (u32 each), a bit for each cell (1: it has coefficients), the coefficients of
// those cells as f32, SHA-256 of all before it as 64 hex digits. That hash is also the bake's.
#include "lighting/bake_cache.h"

#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kMagic = 0x314b4254;  // "TBK1"
constexpr std::size_t kCellBytes = kRadianceCount * 3 * sizeof(float);
constexpr std::size_t kHeaderBytes = 16;

bool is_zero(const char* cell) {
  for (std::size_t i = 0; i < kCellBytes; ++i)
    if (cell[i] != 0) return false;
  return true;
}

}  // namespace

std::string serialize_bake(const LightBake& bake) {
  const std::size_t cells = std::size_t(bake.width) * bake.height;
  const std::uint32_t header[] = {kMagic, std::uint32_t(bake.storage), bake.width, bake.height};
  std::string bytes(reinterpret_cast<const char*>(header), kHeaderBytes);
  bytes.resize(kHeaderBytes + (cells + 7) / 8, 0);
  const char* values = reinterpret_cast<const char*>(bake.sh.data());
  bytes.reserve(bytes.size() + cells * kCellBytes + kBakeHashLength);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (is_zero(values + cell * kCellBytes)) continue;
    bytes[kHeaderBytes + cell / 8] = char(bytes[kHeaderBytes + cell / 8] | (1 << cell % 8));
    bytes.append(values + cell * kCellBytes, kCellBytes);
  }
  return bytes + sha256_hex(bytes);
}

std::optional<LightBake> deserialize_bake(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes + kBakeHashLength) return std::nullopt;
  const std::string_view content = bytes.substr(0, bytes.size() - kBakeHashLength);
  LightBake bake;
  bake.hash = bytes.substr(content.size());
  if (sha256_hex(content) != bake.hash) return std::nullopt;
  std::uint32_t header[4];
  std::memcpy(header, content.data(), kHeaderBytes);
  if (header[0] != kMagic || header[1] > 1) return std::nullopt;
  bake.storage = CoefficientStorage(header[1]);
  bake.width = header[2], bake.height = header[3];

  const std::size_t cells = std::size_t(bake.width) * bake.height, mask_bytes = (cells + 7) / 8;
  if (content.size() - kHeaderBytes < mask_bytes) return std::nullopt;
  const char* mask = content.data() + kHeaderBytes;
  const auto stored = [&](std::size_t cell) { return (mask[cell / 8] >> cell % 8 & 1) != 0; };
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) count += stored(cell);
  if (content.size() != kHeaderBytes + mask_bytes + count * kCellBytes) return std::nullopt;
  bake.sh.assign(cells * kRadianceCount * 3, 0.0f);
  const char* from = mask + mask_bytes;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (!stored(cell)) continue;
    std::memcpy(bake.sh.data() + cell * kRadianceCount * 3, from, kCellBytes);
    from += kCellBytes;
  }
  return bake;
}

std::string bake_cache_path(const std::string& key) { return cache_folder() + "/bake-" + key; }

std::optional<LightBake> cached_bake(const std::string& key) {
  try {
    const std::string path = bake_cache_path(key);
    if (!std::filesystem::exists(path)) return std::nullopt;
    if (std::optional<LightBake> bake = deserialize_bake(read_file(path))) return bake;
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
    write_file(bake_cache_path(key), bytes);
  } catch (const UserError& error) {
    std::fprintf(stderr, "twinshade: bake not cached: %s\n", error.what());
  }
}

}  // namespace twinshade

// Bakes kept between runs, by what they were made from.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lighting/bake.h"

namespace twinshade {

// Size, storage and coefficients, little-endian; cells that are all zero take one bit.
std::string serialize_bake(const LightBake& bake);
// Nothing where the bytes are damaged or not a bake. Fills hash; leaves notes empty.
std::optional<LightBake> deserialize_bake(std::string_view bytes);

// The last so many bytes of what serialize_bake returns are the bake's hash.
inline constexpr std::size_t kBakeHashLength = 64;

// By key, hex digits. A damaged entry is reported on stderr and removed.
std::optional<LightBake> cached_bake(const std::string& key);
// A cache that cannot be written is reported on stderr: the bake goes on without.
void keep_bake(const std::string& key, std::string_view bytes);
std::string bake_cache_path(const std::string& key);

}  // namespace twinshade

// The folder for what can be made again, and its bounded size.
//
// An entry is a file or folder KIND-KEY in it, KIND one of "bake", "runtime" and "shader", KEY at least 16 hex digits;
// other files are nobody's business here. The age of an entry is its modification time: whoever reads one calls
// touch_cached. Entries appear whole, by write_file; processes may share a cache.
#pragma once

#include <cstdint>
#include <string>

namespace twinshade {

// $TWINSHADE_CACHE, else $XDG_CACHE_HOME/twinshade, else ~/.cache/twinshade. Created if missing. UserError where there
// is none of them, or it cannot be created.
std::string cache_folder();

// Bytes that the cache may take: $TWINSHADE_CACHE_SIZE, a number with an optional K, M, G or T (powers of 1024); 2G
// where it is not set. UserError for anything else.
std::uint64_t cache_size_limit();

// Marks an entry as used now.
void touch_cached(const std::string& path);

// Removes the least recently used entries until the limit is met. Entries used within the last minute stay: another
// process may be about to read them. To be called after something was added; what cannot be removed is left.
void trim_cache();

// A sealed file ends in the SHA-256 of what is before it, as hex digits, so that a damaged one is seen. Loaders of
// shared objects and linkers ignore the tail.
void seal(const std::string& path);
// False where the file is missing, truncated or changed.
bool is_sealed(const std::string& path);

}  // namespace twinshade

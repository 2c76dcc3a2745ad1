// The folder for what can be made again, and its bounded size.
//
// An entry is a file or folder KIND-KEY in it, KIND one of "bake", "runtime" and "shader", KEY at least 16 hex digits;
// other files are nobody's business here. The age of an entry is its modification time: whoever reads one calls
// touch_cached. Entries appear whole, by write_cached; processes may share a cache.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace twinshade {

// $TWINSHADE_CACHE, else $XDG_CACHE_HOME/twinshade where that is absolute, else ~/.cache/twinshade. Created if missing.
// UserError where there is none of them, it cannot be created, or TWINSHADE_CACHE_SIZE is no size: whoever asks is
// about to use the cache.
std::string cache_folder();

// UserError where nothing can be added to the cache: to be asked before work whose result goes there.
void require_writable_cache();

// A folder below the cache's, which is made where it is missing; its path. A file in its place, or in that of a folder
// on the way to it, goes. UserError where it cannot be made.
std::string make_cache_folder(const std::string& name);

// As write_file and write_file_with. What stands at `path` and is no regular file (a folder, a link) goes.
void write_cached(const std::string& path, std::string_view content);
void write_cached_with(const std::string& path, const std::function<void(const std::string& temporary)>& write);

// Bytes that the cache may take: $TWINSHADE_CACHE_SIZE, a number with an optional K, M, G or T (powers of 1024); 2G
// where it is not set. UserError for anything else.
std::uint64_t cache_size_limit();

// Marks an entry as used now.
void touch_cached(const std::string& path);

// Removes the least recently used entries until the limit is met. Entries used within the last minute stay, runtimes
// for half an hour: another process may be about to read them, a compiler may be reading all the time. Temporaries that
// are older than an hour go, from folders of the cache, too. To be called after something was added; what cannot be
// removed is left.
void trim_cache();

// A sealed file ends in the SHA-256 of what is before it, as hex digits, so that a damaged one is seen. Loaders of
// shared objects and linkers ignore the tail.
void seal(const std::string& path);
// False where the file is missing, truncated or changed, cannot be read or is none.
bool is_sealed(const std::string& path);

}  // namespace twinshade

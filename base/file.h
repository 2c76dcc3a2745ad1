// Whole files in, whole files out. Nothing half-written is ever seen under the final name.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace twinshade {

constexpr std::uint64_t kMostTextBytes = std::uint64_t{4} << 20;  // of what people write: a shader, ranges of inputs

// Whole content, of `most` bytes at most. That is looked at while reading: a device or a pipe says no size, and may
// have no end. Without it a file may be as large as memory, what says no size 256 MiB. UserError naming the path and
// the system's reason if it cannot be read, or naming the limit.
std::string read_file(const std::string& path, std::optional<std::uint64_t> most = std::nullopt);

// Writes to a temporary beside `path`, then renames. A link stays, the file that it leads to is replaced. What is no
// regular file (a device, a pipe, /dev/stdout) stays as well and gets the content. UserError naming the path if the
// folder is missing or not writable.
void write_file(const std::string& path, std::string_view content);

// For libraries that insist on writing a file themselves: `write` gets a temporary path with the same ending; it is
// renamed to `path` when `write` returns, removed when it throws and when a signal ends the process (RemovedOnSignal).
void write_file_with(const std::string& path, const std::function<void(const std::string& temporary)>& write);

// Whether each write_file there leaves a whole file of what was written last. Where it writes to a device, a pipe or an
// open descriptor instead, what is written twice is there twice.
bool is_replaced_by_writing(const std::string& path);

// UserError if write_file could not write there: found out before minutes of work, not after.
void require_writable_file(const std::string& path);

}  // namespace twinshade

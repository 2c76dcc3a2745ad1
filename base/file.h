// Whole files in, whole files out. Nothing half-written is ever seen under the final name.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace twinshade {

// Whole content. UserError naming the path and the system's reason if it cannot be read.
std::string read_file(const std::string& path);

// Writes to a temporary beside `path`, then renames. UserError naming the path if the folder is missing or not writable.
void write_file(const std::string& path, std::string_view content);

// For libraries that insist on writing a file themselves: `write` gets a temporary path with the same ending; it is
// renamed to `path` when `write` returns, removed when it throws.
void write_file_with(const std::string& path, const std::function<void(const std::string& temporary)>& write);

}  // namespace twinshade

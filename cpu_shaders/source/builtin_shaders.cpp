#include "cpu_shaders/source/builtin_shaders.h"

#include <algorithm>
#include <span>

#include "base/embedded_file.h"

namespace twinshade {

std::span<const EmbeddedFile> embedded_shaders();  // cmake/TwinshadeEmbed.cmake

std::optional<std::string_view> builtin_shader(std::string_view name) {
  for (const EmbeddedFile& file : embedded_shaders())
    if (file.path == name) return file.content;
  return std::nullopt;
}

std::vector<std::string_view> builtin_shader_names() {
  std::vector<std::string_view> names;
  for (const EmbeddedFile& file : embedded_shaders()) names.push_back(file.path);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace twinshade

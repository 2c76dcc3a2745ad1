#include "cpu_shaders/source/builtin_shaders.h"

#include <algorithm>
#include <span>

namespace twinshade {

namespace detail {
extern const BuiltinShader kBuiltinShaders[];
extern const std::size_t kBuiltinShaderCount;
}  // namespace detail

namespace {
std::span<const detail::BuiltinShader> all() { return {detail::kBuiltinShaders, detail::kBuiltinShaderCount}; }
}  // namespace

std::optional<std::string_view> builtin_shader(std::string_view name) {
  for (const auto& shader : all())
    if (shader.name == name) return shader.text;
  return std::nullopt;
}

std::vector<std::string_view> builtin_shader_names() {
  std::vector<std::string_view> names;
  for (const auto& shader : all()) names.push_back(shader.name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace twinshade

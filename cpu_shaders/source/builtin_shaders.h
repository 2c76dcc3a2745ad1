// The files under shaders/, as they were when the program was built. Names are relative to shaders/: "exact/dot.glsl".
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace twinshade {

std::optional<std::string_view> builtin_shader(std::string_view name);
std::vector<std::string_view> builtin_shader_names();  // sorted

}  // namespace twinshade

// Translations list a shader's interface in the order of its use; a header lists it as the author does.
#pragma once

#include <string>
#include <vector>

namespace twinshade {

// Identifiers that stand in declarations of `in`, `out`, `uniform` and `buffer`, types among them, in order, each once.
std::vector<std::string> declared_names(const std::string& glsl);

}  // namespace twinshade

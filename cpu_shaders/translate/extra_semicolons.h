// Semicolons behind the bodies of functions, as GLSL has them from 4.60 on and drivers in every version: glslang
// refuses them before.
#pragma once

#include <string>

namespace twinshade {

// Whether a message of glslang is about one.
bool is_about_extra_semicolon(const std::string& complaint);

// Preprocessed GLSL with those blanked.
std::string without_extra_semicolons(std::string text);

}  // namespace twinshade

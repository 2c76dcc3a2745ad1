// Where a shader declares what a message is about.
#pragma once

#include <string>
#include <string_view>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// "file:line" of the first place outside comments that names `name` behind a word that contains `kind` ("buffer",
// "sampler"); of the first that names it at all where there is no such place; else the file.
std::string declared_at(const ShaderSource& source, std::string_view name, std::string_view kind);

}  // namespace twinshade

// Names of the author's that gave way when a shader was made exact: there and back.
#pragma once

#include <string>

#include "cpu_shaders/rewrite/make_exact.h"

namespace twinshade {

// A GLSL path of the author's ("light.power") in the result.
std::string path_in(const ExactShader& exact, std::string path);

// Text that names what is in the result ("sample_name.x"), as the author names it.
std::string as_the_author_names(const ExactShader& exact, std::string text);

}  // namespace twinshade

// How glslang is asked to read GLSL, by all who parse or preprocess it. It keeps a table of built-in functions for each
// environment and version, whose reading takes most of the time of a process' first translation: so there is one
// environment.
#pragma once

#include <glslang/Public/ShaderLang.h>

#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// Before any other use of glslang; again and again if one likes.
void start_glslang();

// OpenGL's GLSL on its way to SPIR-V 1.0. Returns the messages to parse or preprocess with. Not for ES below 310,
// which glslang makes no SPIR-V of.
EShMessages set_opengl_environment(glslang::TShader& shader, EShLanguage stage);

// The versions to read the shader as, one after another until one accepts it: the author's (ES: 310 at least), and 450
// for what an earlier one lacks.
std::vector<int> glslang_versions(const ShaderSource& source);

// The whole text under a #version line of its own, with #line "file" allowed.
std::string glslang_text(const ShaderSource& source, int version);

// The first error of glslang's log as "file:line: message".
std::string first_glslang_error(const ShaderSource& source, const char* log);

}  // namespace twinshade

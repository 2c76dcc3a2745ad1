// How glslang is asked to read GLSL, by all who parse or preprocess it. It keeps a table of built-in functions for each
// environment and version, whose reading takes most of the time of a process' first translation: so there is one
// environment, and as few versions as the shaders allow.
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

// The versions to read the shader as, one after another until one accepts it; the author's is one of them, and its
// complaint the one to report. ES: 310 at least. Desktop: first smaller ones that mean the same, unless the shader can
// tell the difference (it speaks of __VERSION__ or of a macro or extension GL_...), since glslang reads their tables in
// less time; after the author's 450, for what the author's lacks.
std::vector<int> glslang_versions(const ShaderSource& source);

// The whole text under a #version line of its own, with #line "file" allowed, and what 450 has by extension where the
// version is less than the author's.
std::string glslang_text(const ShaderSource& source, int version);

// The first error of glslang's log as "file:line: message".
std::string first_glslang_error(const ShaderSource& source, const char* log);

}  // namespace twinshade

// How glslang is asked to read GLSL, by all who parse or preprocess it. It keeps a table of built-in functions for each
// environment and version, whose reading takes most of the time of a process' first translation: so there is one
// environment, and as few versions as the shaders allow.
#pragma once

#include <glslang/Public/ShaderLang.h>

#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// Before any other use of glslang; again and again if one likes.
void start_glslang();

// OpenGL's GLSL on its way to SPIR-V 1.0. Returns the messages to parse or preprocess with. Not for ES below 310,
// which glslang makes no SPIR-V of.
EShMessages set_opengl_environment(glslang::TShader& shader, EShLanguage stage);

// The version to try first. ES: 310 at least. Desktop: the author's, but 440 for 450 and 460 unless the shader can tell
// the difference (it speaks of __VERSION__ or of a macro or extension GL_...): what both accept means the same in both,
// and the table of 440 is read in less than half the time. What 440 refuses is to be read again as the author's.
int glslang_version(const ShaderSource& source);

// The whole text under a #version line of its own, with #line "file" allowed.
std::string glslang_text(const ShaderSource& source, int version);

// The first error of glslang's log as "file:line: message".
std::string first_glslang_error(const ShaderSource& source, const char* log);

}  // namespace twinshade

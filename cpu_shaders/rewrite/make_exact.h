// Any shader in the exact dialect (docs/exact-dialect.md): its operators and built-in functions become calls of the
// functions in shaders/exact/, each of which is one precise operation or made of them. What the author wrote is then
// the same bits on every machine, though not the same function values that some driver has for sin, say.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cpu_shaders/lint/lint.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// A uniform float that the result reads in the place of literal zeros, and through exact_unseen to hide what else
// compilers know of values: it must be 0. They drop x + 0.0 and x * 0.0 even where told to be precise, so they may not
// see a zero, nor constants that they could compute one of.
inline constexpr const char* kExactZero = "exact_zero";

struct ExactShader {
  ShaderSource source;                         // GLSL 450; every line keeps its file and number
  bool changed = false;                        // something was in the scope
  bool uses_zero = false;                      // it has the uniform kExactZero
  std::vector<LintFinding> left;               // what is still outside the exact dialect, where the author wrote it
  std::map<std::string, std::string> renamed;  // the author's names that gave way to others, and what they are now
};

enum class ExactScope {
  everything,
  constants,    // only arithmetic between constants: what compilers fold
  written_out,  // only what of the dialect itself is inexact on graphics cards: / sqrt min max clamp, also within the
                // files of shaders/exact/, by shaders/exact/written_out.glsl
};

// UserError where the shader is not valid GLSL.
ExactShader make_exact(const ShaderSource& source, ExactScope scope = ExactScope::everything);

}  // namespace twinshade

// Built-in functions that a shader hides. GLSL nests the global scope in that of the built-in functions: a function
// that the shader declares hides all built-in ones of its name from there on, whatever their parameters (4.2.2 of
// GLSL 4.60; GLSL ES refuses it). glslang 12 does not know that: it calls a built-in function that fits a call as it
// is, and wants the same result type of both.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace twinshade {

// Of any version of GLSL, or of an extension that glslang does not wait to be asked for.
bool is_built_in_function(std::string_view name);

// Where preprocessed GLSL, as words and symbols, names functions of its own that hide built-in ones; variables and
// members of such a name too, so that all are the same word. Calls before a function's first declaration are of the
// built-in one, and none of these.
std::vector<std::size_t> names_of_hiding_functions(const std::vector<std::string_view>& pieces);

}  // namespace twinshade

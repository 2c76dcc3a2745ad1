// A user's fragment shader made ready to be called from a generated main(): its main renamed, its outputs (and, where
// asked, its inputs) turned into plain globals. Works on preprocessed tokens; every line stays where it was.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bundle/bundle.h"
#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::gl {

enum class InputStyle {
  globals,   // inputs become globals that the generated main() fills; gl_FragCoord and gl_FrontFacing become kFragCoord
             // ...
  rows,      // the same; values are given to each fragment, so interpolation qualifiers mean nothing
  varyings,  // inputs stay what they are, less their layout(): the generated vertex shader matches them by name
};

struct Input {
  std::string name;
  std::string type;  // as in GLSL: "vec3"
  Scalar scalar = Scalar::f32;
  std::uint32_t columns = 1, rows = 1;  // vecN: columns 1, rows N
  std::uint32_t array_length = 0;       // 0: not an array
  std::string interpolation;            // "flat", "noperspective" or empty
  bool per_sample = false;              // `sample`, which drivers want on both sides
  bool used = false;                    // named anywhere but in its declaration
  Token where;
};

struct Output {
  std::string name;
  Scalar scalar = Scalar::f32;
  std::uint32_t components = 1;
  std::uint32_t array_length = 0;  // 0: not an array
  int location = -1;
};

struct FragmentShader {
  std::vector<std::string> extensions;  // #extension lines
  std::string text;                     // the rewritten shader, from its first #line to its end
  std::vector<Input> inputs;            // in order of declaration
  std::vector<Output> outputs;
  std::vector<std::string>
      initializers;  // functions that give globals their values: to be called before the user's main, in order
  bool discards = false, writes_depth = false, uses_fragment_position = false, has_storage = false;
  bool extended_products = false;  // it calls functions of extended_products.h
  std::string derivative;          // position and name of the first derivative function that it calls; empty: none
};

// Names that the rewritten text uses and the generated text defines. The prefix is ours: a shader that uses it is
// refused.
inline constexpr const char* kPrefix = "twinshade_";
inline constexpr const char* kUserMain = "twinshade_user_main";
inline constexpr const char* kFragCoord = "twinshade_FragCoord";
inline constexpr const char* kFrontFacing = "twinshade_FrontFacing";
inline constexpr const char* kPrimitiveId = "twinshade_PrimitiveID";  // not InputStyle::varyings

// UserError "file:line: ..." for what cannot be rewritten: struct inputs, inputs of unknown size, interpolateAtOffset
// and noperspective with InputStyle::globals, input blocks with InputStyle::varyings ...
FragmentShader rewrite_fragment_shader(const ShaderSource& source, InputStyle style);

}  // namespace twinshade::gl

// How GLSL spells a uniform, and how its author gives it a value where nothing else does.
#pragma once

#include <string>

#include "bundle/bundle.h"

namespace twinshade {

// "vec3", "ivec2", "mat4x3", "float[5]".
inline std::string glsl_type(Scalar scalar, std::uint32_t columns, std::uint32_t rows, std::uint32_t array_length) {
  static constexpr const char* kScalars[] = {"float", "int", "uint", "bool"};
  static constexpr const char* kPrefixes[] = {"", "i", "u", "b"};
  std::string name = columns > 1 ? "mat" : kPrefixes[int(scalar)];
  if (columns > 1)
    name.append(std::to_string(columns)).append("x").append(std::to_string(rows));
  else if (rows > 1)
    name.append("vec").append(std::to_string(rows));
  else
    name = kScalars[int(scalar)];
  if (array_length > 0) name.append("[").append(std::to_string(array_length)).append("]");
  return name;
}

// "write uniform vec3 tint = vec3(1.0); ...", of a variable, an array or a member of a structure.
inline std::string initial_value_remedy(const std::string& name, Scalar scalar, std::uint32_t columns,
                                        std::uint32_t rows, std::uint32_t array_length) {
  if (array_length > 0 || name.find_first_of(".[") != std::string::npos)
    return "give it one in the shader (in GLSL ES make it a constant)";
  static constexpr const char* kValues[] = {"1.0", "1", "1u", "true"};
  const std::string type = glsl_type(scalar, columns, rows, 0), one = kValues[int(scalar)];
  const std::string declared = type + " " + name + " = " + (columns * rows > 1 ? type + "(" + one + ")" : one) + ";";
  return "write \"uniform " + declared + "\" (in GLSL ES \"const " + declared + "\")";
}

}  // namespace twinshade

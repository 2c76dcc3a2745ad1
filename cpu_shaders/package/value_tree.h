// Struct members from the flat list of a shader's values: "lights[2].colour" is the member colour of element 2 of
// lights.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace twinshade {

struct ValueNode {
  std::string name;
  std::vector<std::uint32_t> extents;  // outermost first; empty: no array
  std::vector<ValueNode> members;      // empty: a leaf
  std::string cpp, glsl;               // types of a leaf
};

// Adds a leaf. array_length: of its last array, 0 for none; indices within `name` make arrays as long as the largest
// asks for.
void add_value(std::vector<ValueNode>& nodes, const std::string& name, std::uint32_t array_length,
               const std::string& cpp, const std::string& glsl);

// The C++ expression of a leaf: `name` with the names that C++ has for itself replaced.
std::string cpp_path(const std::string& name);

// One declaration a node, structs before what they are the type of, GLSL's types as comments. Lines are indented by
// `indent`.
std::string declare_values(const std::vector<ValueNode>& nodes, const std::string& indent);

// element, count times over for each extent, outermost first.
std::string in_arrays(std::string element, const std::vector<std::uint32_t>& extents);

}  // namespace twinshade

// Struct members from the flat list of a shader's values: "lights[2].colour" is the member colour of element 2 of
// lights.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace twinshade {

struct ValueNode {
  std::string name;                            // GLSL's
  std::vector<std::uint32_t> extents;          // outermost first; empty: no array
  std::vector<ValueNode> members;              // empty: a leaf
  std::string cpp, glsl;                       // types of a leaf
  std::map<std::string, std::string> initial;  // of a leaf: C++ initialisers by the names that add_value got
  std::string cpp_name, struct_name;           // set by name_members
};

// Adds a leaf. array_length: of its last array, 0 for none; indices within `name` make arrays as long as the largest
// asks for. initial: C++ initialiser, with its braces if it is an array; empty: zero.
void add_value(std::vector<ValueNode>& nodes, const std::string& name, std::uint32_t array_length,
               const std::string& cpp, const std::string& glsl, const std::string& initial = "");

// Gives every member and struct its C++ name: GLSL's, and with "_struct" behind it, where that is no reserved name and
// free in its scope, else with as many underscores behind it as that takes. Members go before structs. own: names in
// the scope of `nodes` that are not the shader's. enclosing: the struct that they are members of.
void name_members(std::vector<ValueNode>& nodes, const std::vector<std::string>& own,
                  const std::string& enclosing = "");

// Adds the members' names, theirs too, where C++ has GLSL's.
void add_names(const std::vector<ValueNode>& nodes, std::set<std::string>& names);

// The C++ expression of a leaf. name: as add_value got it.
std::string cpp_path(const std::vector<ValueNode>& nodes, const std::string& name);

// One declaration a node, structs before what they are the type of, GLSL's types as comments. Lines are indented by
// `indent`. path: GLSL's to `nodes`, "" or ending in a dot.
std::string declare_values(const std::vector<ValueNode>& nodes, const std::string& indent,
                           const std::string& path = "");

// element, count times over for each extent, outermost first.
std::string in_arrays(std::string element, const std::vector<std::uint32_t>& extents);

}  // namespace twinshade

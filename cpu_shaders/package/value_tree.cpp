#include "cpu_shaders/package/value_tree.h"

#include <algorithm>

#include "cpu_shaders/package/reserved_names.h"

namespace twinshade {
namespace {

struct PathPart {
  std::string name;
  std::vector<std::uint32_t> indices;
};

std::vector<PathPart> parts_of(const std::string& path) {
  std::vector<PathPart> parts;
  for (std::size_t at = 0; at < path.size();) {
    const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
    PathPart part{path.substr(at, end - at), {}};
    at = end;
    while (at < path.size() && path[at] == '[') {
      part.indices.push_back(std::uint32_t(std::stoul(path.substr(at + 1))));
      at = path.find(']', at) + 1;
    }
    parts.push_back(part);
    if (at < path.size() && path[at] == '.') ++at;
  }
  return parts;
}

template <class Nodes>  // constant or not
auto find_node(Nodes& nodes, const std::string& name) {
  return std::find_if(nodes.begin(), nodes.end(), [&](const ValueNode& node) { return node.name == name; });
}

constexpr const char* kZero = "{}";

// values: of the members of a struct or the elements of an array.
std::string in_braces(const std::vector<std::string>& values, const std::string& open, const std::string& close) {
  if (std::all_of(values.begin(), values.end(), [](const std::string& value) { return value == kZero; })) return kZero;
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? open : ", ") + value;
  return text + close;
}

// path: GLSL's, with indices of the first `indexed` extents of the node.
std::string initial_value(const ValueNode& node, const std::string& path, std::size_t indexed = 0) {
  if (const auto found = node.initial.find(path); found != node.initial.end()) return found->second;
  std::vector<std::string> values;
  if (indexed < node.extents.size()) {
    for (std::uint32_t k = 0; k < node.extents[indexed]; ++k)
      values.push_back(initial_value(node, path + "[" + std::to_string(k) + "]", indexed + 1));
    return in_braces(values, "{{", "}}");  // of std::array and of the array within
  }
  for (const ValueNode& member : node.members) values.push_back(initial_value(member, path + "." + member.name));
  return in_braces(values, "{", "}");
}

}  // namespace

std::string in_arrays(std::string element, const std::vector<std::uint32_t>& extents) {
  for (auto extent = extents.rbegin(); extent != extents.rend(); ++extent)
    element = "std::array<" + element + ", " + std::to_string(*extent) + ">";
  return element;
}

void add_value(std::vector<ValueNode>& nodes, const std::string& name, std::uint32_t array_length,
               const std::string& cpp, const std::string& glsl, const std::string& initial) {
  std::vector<PathPart> parts = parts_of(name);
  if (array_length > 0) parts.back().indices.push_back(array_length - 1);
  std::vector<ValueNode>* at = &nodes;
  ValueNode* node = nullptr;
  for (const PathPart& part : parts) {
    auto found = find_node(*at, part.name);
    if (found == at->end()) {
      found = at->emplace(at->end());
      found->name = part.name;
    }
    node = &*found;
    node->extents.resize(std::max(node->extents.size(), part.indices.size()), 0);
    for (std::size_t k = 0; k < part.indices.size(); ++k)
      node->extents[k] = std::max(node->extents[k], part.indices[k] + 1);
    at = &node->members;
  }
  node->cpp = cpp;
  node->glsl = glsl;
  if (!initial.empty()) node->initial[name] = initial;
}

void name_members(std::vector<ValueNode>& nodes, const std::vector<std::string>& own, const std::string& enclosing) {
  std::set<std::string> taken(own.begin(), own.end());
  taken.insert(enclosing);  // C++ has no members of their struct's name
  const auto is_free = [&](const std::string& name) { return !is_reserved_name(name) && taken.count(name) == 0; };

  // Names that can stay do, whatever comes before them.
  std::vector<ValueNode*> renamed;
  for (ValueNode& node : nodes) {
    node.cpp_name = node.name;
    if (!is_free(node.name)) renamed.push_back(&node);
  }
  for (const ValueNode& node : nodes) taken.insert(node.name);
  for (ValueNode* node : renamed) {
    while (!is_free(node->cpp_name)) node->cpp_name += '_';
    taken.insert(node->cpp_name);
  }

  for (ValueNode& node : nodes) {
    if (node.members.empty()) continue;
    node.struct_name = node.name + "_struct";
    while (!is_free(node.struct_name) || find_node(node.members, node.struct_name) != node.members.end())
      node.struct_name += '_';
    taken.insert(node.struct_name);
    name_members(node.members, {}, node.struct_name);
  }
}

void add_names(const std::vector<ValueNode>& nodes, std::set<std::string>& names) {
  for (const ValueNode& node : nodes) {
    if (node.cpp_name == node.name) names.insert(node.name);
    add_names(node.members, names);
  }
}

std::string cpp_path(const std::vector<ValueNode>& nodes, const std::string& name) {
  std::string path;
  const std::vector<ValueNode>* at = &nodes;
  for (const PathPart& part : parts_of(name)) {
    const auto node = find_node(*at, part.name);
    path += (path.empty() ? "" : ".") + node->cpp_name;
    for (const std::uint32_t index : part.indices) path += "[" + std::to_string(index) + "]";
    at = &node->members;
  }
  return path;
}

std::string declare_values(const std::vector<ValueNode>& nodes, const std::string& indent, const std::string& path) {
  std::string text;
  for (const ValueNode& node : nodes) {
    std::string type = node.cpp, glsl = node.glsl, initial = kZero;
    if (!node.members.empty()) {
      type = node.struct_name;
      glsl = "struct";
      text += indent + "struct " + type + " {\n" + declare_values(node.members, indent + "  ", path + node.name + ".") +
              indent + "};\n";
    }
    // A struct's members have their own values; in an array of structs these differ from element to element.
    if (node.members.empty() || !node.extents.empty()) initial = initial_value(node, path + node.name);
    if (initial[0] != '{') initial = "{" + initial + "}";
    std::string brackets;
    for (const std::uint32_t extent : node.extents) brackets += "[" + std::to_string(extent) + "]";
    text += indent + in_arrays(type, node.extents) + " " + node.cpp_name + initial + ";  // " + glsl + " " + node.name +
            brackets + "\n";
  }
  return text;
}

}  // namespace twinshade

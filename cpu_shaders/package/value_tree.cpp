#include "cpu_shaders/package/value_tree.h"

#include <algorithm>

#include "cpu_shaders/translate/cpp_keywords.h"

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

std::string member_name(const std::string& name) {
  static const std::string kOurs[] = {"Uniforms", "BasicInputs", "BasicOutputs", "Real", "std", "twinshade"};
  const bool taken =
      spirv::is_cpp_keyword(name) || std::find(std::begin(kOurs), std::end(kOurs), name) != std::end(kOurs);
  return taken ? name + "_" : name;
}

}  // namespace

std::string in_arrays(std::string element, const std::vector<std::uint32_t>& extents) {
  for (auto extent = extents.rbegin(); extent != extents.rend(); ++extent)
    element = "std::array<" + element + ", " + std::to_string(*extent) + ">";
  return element;
}

void add_value(std::vector<ValueNode>& nodes, const std::string& name, std::uint32_t array_length,
               const std::string& cpp, const std::string& glsl) {
  std::vector<PathPart> parts = parts_of(name);
  if (array_length > 0) parts.back().indices.push_back(array_length - 1);
  std::vector<ValueNode>* at = &nodes;
  ValueNode* node = nullptr;
  for (const PathPart& part : parts) {
    auto found = std::find_if(at->begin(), at->end(), [&](const ValueNode& n) { return n.name == part.name; });
    if (found == at->end()) found = at->insert(at->end(), ValueNode{part.name, {}, {}, "", ""});
    node = &*found;
    node->extents.resize(std::max(node->extents.size(), part.indices.size()), 0);
    for (std::size_t k = 0; k < part.indices.size(); ++k)
      node->extents[k] = std::max(node->extents[k], part.indices[k] + 1);
    at = &node->members;
  }
  node->cpp = cpp;
  node->glsl = glsl;
}

std::string cpp_path(const std::string& name) {
  std::string path;
  for (const PathPart& part : parts_of(name)) {
    path += (path.empty() ? "" : ".") + member_name(part.name);
    for (const std::uint32_t index : part.indices) path += "[" + std::to_string(index) + "]";
  }
  return path;
}

std::string declare_values(const std::vector<ValueNode>& nodes, const std::string& indent) {
  std::string text;
  for (const ValueNode& node : nodes) {
    std::string type = node.cpp, glsl = node.glsl;
    if (!node.members.empty()) {
      type = node.name + "_struct";
      glsl = "struct";
      text += indent + "struct " + type + " {\n" + declare_values(node.members, indent + "  ") + indent + "};\n";
    }
    std::string brackets;
    for (const std::uint32_t extent : node.extents) brackets += "[" + std::to_string(extent) + "]";
    text += indent + in_arrays(type, node.extents) + " " + member_name(node.name) + "{};  // " + glsl + " " +
            node.name + brackets + "\n";
  }
  return text;
}

}  // namespace twinshade

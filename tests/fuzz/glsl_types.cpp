#include "tests/fuzz/glsl_types.h"

#include <algorithm>

namespace twinshade::fuzz {

GlslType GlslType::element() const {
  GlslType t = *this;
  if (is_array())
    t.dimensions.erase(t.dimensions.begin());
  else if (is_matrix())
    t.columns = 1;
  else
    t.rows = 1;
  return t;
}

std::string type_name(const GlslType& type, const Structures& structures) {
  std::string name;
  if (type.structure >= 0) {
    name = structures[static_cast<std::size_t>(type.structure)].name;
  } else if (type.is_matrix()) {
    name = "mat" + std::to_string(type.columns) + "x" + std::to_string(type.rows);
  } else {
    const char* const scalars[] = {"float", "int", "uint", "bool"};
    const char* const vectors[] = {"vec", "ivec", "uvec", "bvec"};
    const auto base = static_cast<std::size_t>(type.base);
    name = type.rows == 1 ? scalars[base] : vectors[base] + std::to_string(type.rows);
  }
  for (const int length : type.dimensions) name += "[" + std::to_string(length) + "]";
  return name;
}

std::size_t component_count(const GlslType& type, const Structures& structures) {
  std::size_t count = 0;
  if (type.structure >= 0) {
    for (const Member& m : structures[static_cast<std::size_t>(type.structure)].members)
      count += component_count(m.type, structures);
  } else {
    count = static_cast<std::size_t>(type.rows * type.columns);
  }
  for (const int length : type.dimensions) count *= static_cast<std::size_t>(length);
  return count;
}

bool holds_float(const GlslType& type, const Structures& structures) {
  if (type.structure < 0) return type.base == Scalar::f32;
  const auto& members = structures[static_cast<std::size_t>(type.structure)].members;
  return std::any_of(members.begin(), members.end(), [&](const Member& m) { return holds_float(m.type, structures); });
}

}  // namespace twinshade::fuzz

// Types of generated programs and their GLSL spelling.
#pragma once

#include <string>
#include <vector>

#include "bundle/bundle.h"

namespace twinshade::fuzz {

struct GlslType {
  Scalar base = Scalar::i32;
  int rows = 1, columns = 1;    // vecN: rows N; matCxR: columns C, rows R (float only)
  int structure = -1;           // index into Structs; then base, rows and columns mean nothing
  std::vector<int> dimensions;  // of an array, outermost first

  bool operator==(const GlslType&) const = default;
  bool is_array() const { return !dimensions.empty(); }
  bool is_matrix() const { return columns > 1 && structure < 0; }
  bool is_plain() const { return dimensions.empty() && structure < 0 && columns == 1; }  // scalar or vector
  GlslType element() const;  // of an array; a matrix's column; a vector's component
};

struct Member {
  std::string name;
  GlslType type;
};
struct Structure {
  std::string name;
  std::vector<Member> members;
};
using Structures = std::vector<Structure>;

inline GlslType plain(Scalar base, int rows = 1) { return {base, rows, 1, -1, {}}; }

// "ivec3", "Pair[2][3]": also the name of the constructor.
std::string type_name(const GlslType& type, const Structures& structures);

// Number of scalars.
std::size_t component_count(const GlslType& type, const Structures& structures);

// Whether some part of it is float.
bool holds_float(const GlslType& type, const Structures& structures);

}  // namespace twinshade::fuzz

// As much of GLSL's types as the rules need: what kind of number, how many columns and rows.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace twinshade::lint_detail {

struct GlslType {
  enum class Base { unknown, nothing, boolean, int32, uint32, float32, float64, structure, opaque };
  Base base = Base::unknown;
  int columns = 1, rows = 1;  // vecN: columns 1, rows N; matCxR
  int array_dimensions = 0;
  std::string name;  // of an opaque type; of a structure or block, its own key: no other has it

  bool is_floating() const { return base == Base::float32 || base == Base::float64; }
  bool is_integer() const { return base == Base::int32 || base == Base::uint32; }
  bool is_matrix() const { return columns > 1 && array_dimensions == 0; }
  bool is_vector() const { return columns == 1 && rows > 1 && array_dimensions == 0; }
  bool operator==(const GlslType&) const = default;
};

inline bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

GlslType scalar_type(GlslType::Base base);
// From a keyword ("vec3", "mat2x4", "isampler2D"); Base::unknown where it is none.
GlslType keyword_type(std::string_view keyword);
// Of a op b, by GLSL's implicit conversions. Comparisons and logic give bool.
GlslType binary_type(std::string_view op, const GlslType& a, const GlslType& b);
// v[i] and m[i], a[i]
GlslType element_type(const GlslType& indexed);
// Of a built-in function; Base::unknown where the name is none we know.
GlslType builtin_type(std::string_view function, const std::vector<GlslType>& arguments);

}  // namespace twinshade::lint_detail

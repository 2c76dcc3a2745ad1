// Which scalars of a value are known to be zero: compilers fold arithmetic with them.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "cpu_shaders/lint/glsl_type.h"

namespace twinshade::lint_detail {

struct Zeros {
  bool any = false;  // some scalar is
  bool all = false;
  // Of components, columns, elements or members; null where they are not known one by one.
  std::shared_ptr<const std::vector<Zeros>> parts;
};

Zeros scalar_zeros(bool is_zero);
Zeros composed_zeros(std::vector<Zeros> parts);
// type(operands), each with its type.
Zeros constructed_zeros(const GlslType& type, const std::vector<std::pair<GlslType, Zeros>>& operands);
// Of one part; without an index, of whichever.
Zeros part_zeros(const Zeros& whole, std::optional<long> index);
// The same with one part stored; without an index, in whichever. count: of its parts, as far as it is known.
Zeros with_part(const Zeros& whole, std::size_t count, std::optional<long> index, const Zeros& part);
// Of a letter of xyzw, rgba or stpq.
long component_index(char letter);

}  // namespace twinshade::lint_detail

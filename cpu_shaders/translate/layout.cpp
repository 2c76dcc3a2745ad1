#include "cpu_shaders/translate/layout.h"

#include <algorithm>

namespace twinshade::spirv {
namespace {
std::uint32_t round_up(std::uint32_t x, std::uint32_t to) { return (x + to - 1) / to * to; }
}  // namespace

std::uint32_t Layout::alignment(Id id) const {
  const Type& t = module_->type(id);
  switch (t.kind) {
    case Kind::vector:
      return t.count == 2 ? 8 : 16;
    case Kind::matrix:
    case Kind::array:
    case Kind::structure:
      return 16;
    default:
      return 4;
  }
}

std::uint32_t Layout::member_offset(Id structure, std::uint32_t index) const {
  if (decorated_) return module_->member(structure, index).get(spv::DecorationOffset);
  std::uint32_t at = 0;
  const auto& members = module_->type(structure).members;
  for (std::uint32_t k = 0;; ++k) {
    at = round_up(at, alignment(members[k]));
    if (k == index) return at;
    at += size(members[k]);
  }
}

MatrixLayout Layout::member_matrix(Id structure, std::uint32_t index) const {
  if (!decorated_) return {};
  const Decorations& d = module_->member(structure, index);
  return {d.get(spv::DecorationMatrixStride, 16), d.has(spv::DecorationRowMajor)};
}

std::uint32_t Layout::array_stride(Id array) const {
  if (decorated_) return module_->decorations_of(array).get(spv::DecorationArrayStride);
  return round_up(size(module_->type(array).element), 16);
}

std::uint32_t Layout::size(Id id, const MatrixLayout& matrix) const {
  const Type& t = module_->type(id);
  switch (t.kind) {
    case Kind::vector:
      return 4 * t.count;
    case Kind::matrix: {
      const std::uint32_t rows = module_->type(t.element).count;
      return matrix.row_major ? matrix.stride * (rows - 1) + 4 * t.count : matrix.stride * (t.count - 1) + 4 * rows;
    }
    case Kind::array:
      return decorated_ ? array_stride(id) * (t.count - 1) + size(t.element, matrix) : array_stride(id) * t.count;
    case Kind::runtime_array:
      return 0;
    case Kind::structure: {
      std::uint32_t end = 0;
      for (std::uint32_t k = 0; k < t.members.size(); ++k)
        end = std::max(end, member_offset(id, k) + size(t.members[k], member_matrix(id, k)));
      return round_up(end, decorated_ ? 4 : 16);
    }
    default:
      return 4;
  }
}

}  // namespace twinshade::spirv

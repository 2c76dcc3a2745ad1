#include "cpu_shaders/translate/count_instruction.h"

#include <algorithm>

#include "cpu_shaders/translate/served.h"

namespace twinshade::spirv {
namespace {

bool is_real(const Module& module, Id type) { return module.scalar_kind(type) == Kind::real; }

// `sums` sums of `terms` products.
void products(OperationCount& count, std::int64_t sums, std::int64_t terms) {
  count.multiplications += sums * terms;
  count.additions += sums * (terms - 1);
}

// GLSL.std.450, by number. n, size: components of the result, and of the first operand.
void extended(std::uint32_t number, bool real, int n, int size, OperationCount& count) {
  if (!real) {
    count.integers += n;
    return;
  }
  switch (number) {
    case 1:
    case 2:
    case 3:
    case 4:
    case 6:
    case 8:
    case 9:  // round, roundEven, trunc, abs, sign, floor, ceil
    case 37:
    case 40:
    case 79:
    case 80:
    case 48:  // min, max, step
      count.selections += n;
      return;
    case 43:
    case 81:  // clamp
      count.selections += 2 * n;
      return;
    case 10:  // fract
      count.additions += n, count.selections += n;
      return;
    case 11:
    case 12:  // radians, degrees
      count.multiplications += n;
      return;
    case 31:  // sqrt
      count.square_roots += n;
      return;
    case 32:  // inversesqrt
      count.square_roots += n, count.divisions += n;
      return;
    case 46:  // mix
      count.multiplications += 2 * n, count.additions += 2 * n;
      return;
    case 49:  // smoothstep
      count.additions += 3 * n, count.multiplications += 3 * n, count.divisions += n, count.selections += 2 * n;
      return;
    case 50:  // fma
      count.multiplications += n, count.additions += n;
      return;
    case 66:
    case 67:  // length, distance
      if (number == 67) count.additions += size;
      if (size == 1) {
        count.selections += 1;
        return;
      }
      products(count, 1, size);
      count.square_roots += 1;
      return;
    case 68:  // cross
      products(count, n, 2);
      return;
    case 69:  // normalize
      if (size == 1) {
        count.selections += 1;
        return;
      }
      products(count, 1, size);
      count.square_roots += 1, count.divisions += 1, count.multiplications += n;
      return;
    case 71:  // reflect
      products(count, 1, size);
      count.multiplications += 2 * n, count.additions += n;
      return;
    default:
      count.others += n;
  }
}

bool is_integer_operation(spv::Op op) {
  return (op >= spv::OpSNegate && op <= spv::OpSMod && op != spv::OpFNegate) ||
         (op >= spv::OpLogicalEqual && op <= spv::OpLogicalNot) ||
         (op >= spv::OpIEqual && op <= spv::OpSLessThanEqual) || (op >= spv::OpShiftRightLogical && op <= spv::OpNot) ||
         (op >= spv::OpConvertFToU && op <= spv::OpConvertUToF);
}

std::int64_t sum_of_products(std::int64_t sum, std::int64_t number, std::int64_t times) {
  std::int64_t product = 0;
  if (__builtin_mul_overflow(number, times, &product) || __builtin_add_overflow(sum, product, &sum)) return INT64_MAX;
  return sum;
}

}  // namespace

void add(OperationCount& to, const OperationCount& from, std::int64_t times) {
  for (const auto member : kOperationCounts) to.*member = sum_of_products(to.*member, from.*member, times);
  to.loops = to.loops || from.loops;
}

void count_instruction(const Module& module, const Instruction& i, OperationCount& count) {
  const auto operand_type = [&](std::size_t k) { return module.value_types.at(i.operands[k]); };
  const int n = i.type == 0 ? 0 : int(module.component_count(i.type));
  switch (i.op) {
    case spv::OpFAdd:
    case spv::OpFSub:
      count.additions += n;
      return;
    case spv::OpFMul:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpOuterProduct:
      count.multiplications += n;
      return;
    case spv::OpDot:
      products(count, 1, int(module.component_count(operand_type(0))));
      return;
    case spv::OpMatrixTimesVector:
      products(count, n, int(module.component_count(operand_type(1))));
      return;
    case spv::OpVectorTimesMatrix:
      products(count, n, int(module.component_count(operand_type(0))));
      return;
    case spv::OpMatrixTimesMatrix:
      products(count, n, int(module.type(operand_type(0)).count));
      return;
    case spv::OpFDiv:
      count.divisions += n;
      return;
    case spv::OpFNegate:
      count.selections += n;
      return;
    case spv::OpSelect:
      (is_real(module, i.type) ? count.selections : count.integers) += n;
      return;
    case spv::OpFOrdEqual:
    case spv::OpFOrdNotEqual:
    case spv::OpFUnordNotEqual:
    case spv::OpFOrdLessThan:
    case spv::OpFOrdLessThanEqual:
    case spv::OpFOrdGreaterThan:
    case spv::OpFOrdGreaterThanEqual:
    case spv::OpIsNan:
    case spv::OpIsInf:
      count.selections += n;
      return;
    case spv::OpFMod:
    case spv::OpFRem:
      count.others += n;
      return;
    case spv::OpImageFetch:
      ++count.texels;
      return;
    case spv::OpImageSampleImplicitLod:
    case spv::OpImageSampleExplicitLod:
      count.texels += 4;
      return;
    case spv::OpExtInst:
      extended(i.operands[1], is_real(module, i.type), n, int(module.component_count(operand_type(2))), count);
      return;
    default:
      if (is_integer_operation(i.op)) count.integers += n;
  }
}

void count_as_served(const Module& module, const FunctionInfo& info, OperationCount& count) {
  const Function& function = *info.function;
  if (!fetches_colors(module, function)) return;
  // Fives of colours are a cache line, four fetches of 16 bytes, and a last one alone is one.
  const std::int64_t colors = module.type(info.parameter_type(module, function.parameters.size() - 1)).count;
  const std::int64_t taps = count.texels / colors;
  count.texels = taps * (colors / 5 * 4 + (colors % 5 == 0 ? 0 : colors % 5 == 1 ? 1 : 4));
  count.multiplications = 3 * colors * taps;
  count.additions = 3 * colors * std::max<std::int64_t>(taps - 1, 0);
}

void remember(const Module& module, const Instruction& i, StoredConstants& stored) {
  if (i.op != spv::OpStore) return;
  if (module.is_constant(i.operands[1]))
    stored[i.operands[0]] = i.operands[1];
  else
    stored.erase(i.operands[0]);
}

void forget(const Statement& s, StoredConstants& stored) {
  const auto stores = [&](const List& list) {
    for_each_instruction(list, [&](const Instruction& i) {
      if (i.op == spv::OpStore) stored.erase(i.operands[0]);
    });
  };
  for (const List* list : {&s.then_list, &s.else_list, &s.body, &s.continuing}) stores(*list);
  for (const Case& c : s.cases) stores(c.body);
}

}  // namespace twinshade::spirv

// What SPIR-V's instructions do to the components of their operands.
#include <glslang/SPIRV/GLSL.std.450.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/fuzz/spirv_interpreter.h"

namespace twinshade::fuzz {
namespace {

using U = std::uint32_t;
using I = std::int32_t;

float f(U bits) { return std::bit_cast<float>(bits); }
U bits(float x) { return std::bit_cast<U>(x); }
I i(U x) { return static_cast<I>(x); }
U u(I x) { return static_cast<U>(x); }

U to_integer(float x, double lowest, double highest) {
  if (std::isnan(x)) return 0;
  const double clamped = std::clamp(static_cast<double>(x), lowest, highest);
  return static_cast<U>(static_cast<std::int64_t>(clamped));
}

// Division by zero and INT_MIN / -1: as docs/generated-code.md says.
U divide(U a, U b) { return b == 0 ? 0 : b == ~0u ? 0u - a : u(i(a) / i(b)); }
U remainder(U a, U b) { return b == 0 ? ~0u : a % b; }

U extract(U base, U offset, U count) {
  return count == 0 ? 0 : count >= 32 ? base : (base >> offset) & ((1u << count) - 1);
}
U extract_signed(U base, U offset, U count) {
  if (count == 0) return 0;
  const U field = extract(base, offset, count);
  return count < 32 && (field >> (count - 1)) != 0 ? field | (~0u << count) : field;
}
U insert(U base, U value, U offset, U count) {
  const U mask = (count >= 32 ? ~0u : (1u << count) - 1) << offset;
  return (base & ~mask) | ((value << offset) & mask);
}
U reverse(U x) {
  U r = 0;
  for (int k = 0; k < 32; ++k) r |= (x >> k & 1) << (31 - k);
  return r;
}

// Of 0 and -0 the second, as every machine of ours and llvmpipe have it (docs/exact-dialect.md). GLSL's text gives the
// first.
// A result passes through arithmetic: a denormal one becomes 0 where they are flushed.
float as_operand(float x) {
  volatile float one = 1.0F;
  return x * one;
}
float smaller(float a, float b) { return std::isnan(b) ? a : as_operand(!std::isnan(a) && a < b ? a : b); }
float larger(float a, float b) { return std::isnan(b) ? a : as_operand(!std::isnan(a) && a > b ? a : b); }

bool ordered(float a, float b) { return !std::isnan(a) && !std::isnan(b); }

}  // namespace

bool scalar_operation(spv::Op op, const U* x, std::size_t count, U& result) {
  const U a = x[0], b = count > 1 ? x[1] : 0;
  switch (op) {
    // clang-format off
    case spv::OpIAdd: result = a + b; break;
    case spv::OpISub: result = a - b; break;
    case spv::OpIMul: result = a * b; break;
    case spv::OpSDiv: result = divide(a, b); break;
    case spv::OpUDiv: result = b == 0 ? ~0u : a / b; break;
    case spv::OpUMod: case spv::OpSMod: case spv::OpSRem: result = remainder(a, b); break;
    case spv::OpSNegate: result = 0u - a; break;
    case spv::OpFAdd: result = bits(f(a) + f(b)); break;
    case spv::OpFSub: result = bits(f(a) - f(b)); break;
    case spv::OpFMul: result = bits(f(a) * f(b)); break;
    case spv::OpFDiv: result = bits(f(a) / f(b)); break;
    case spv::OpFNegate: result = a ^ 0x80000000u; break;
    case spv::OpShiftLeftLogical: result = a << (b & 31); break;
    case spv::OpShiftRightLogical: result = a >> (b & 31); break;
    case spv::OpShiftRightArithmetic: result = u(i(a) >> (b & 31)); break;
    case spv::OpBitwiseAnd: result = a & b; break;
    case spv::OpBitwiseOr: result = a | b; break;
    case spv::OpBitwiseXor: result = a ^ b; break;
    case spv::OpNot: result = ~a; break;
    case spv::OpBitCount: result = static_cast<U>(std::popcount(a)); break;
    case spv::OpBitReverse: result = reverse(a); break;
    case spv::OpBitFieldUExtract: result = extract(a, b, x[2]); break;
    case spv::OpBitFieldSExtract: result = extract_signed(a, b, x[2]); break;
    case spv::OpBitFieldInsert: result = insert(a, b, x[2], x[3]); break;
    case spv::OpLogicalNot: result = a == 0; break;
    case spv::OpLogicalAnd: result = a & b; break;
    case spv::OpLogicalOr: result = a | b; break;
    case spv::OpLogicalEqual: result = a == b; break;
    case spv::OpLogicalNotEqual: result = a != b; break;
    case spv::OpIEqual: result = a == b; break;
    case spv::OpINotEqual: result = a != b; break;
    case spv::OpULessThan: result = a < b; break;
    case spv::OpULessThanEqual: result = a <= b; break;
    case spv::OpUGreaterThan: result = a > b; break;
    case spv::OpUGreaterThanEqual: result = a >= b; break;
    case spv::OpSLessThan: result = i(a) < i(b); break;
    case spv::OpSLessThanEqual: result = i(a) <= i(b); break;
    case spv::OpSGreaterThan: result = i(a) > i(b); break;
    case spv::OpSGreaterThanEqual: result = i(a) >= i(b); break;
    case spv::OpFOrdEqual: result = f(a) == f(b); break;
    case spv::OpFOrdNotEqual: result = ordered(f(a), f(b)) && f(a) != f(b); break;
    case spv::OpFUnordNotEqual: result = f(a) != f(b); break;
    case spv::OpFOrdLessThan: result = f(a) < f(b); break;
    case spv::OpFOrdLessThanEqual: result = f(a) <= f(b); break;
    case spv::OpFOrdGreaterThan: result = f(a) > f(b); break;
    case spv::OpFOrdGreaterThanEqual: result = f(a) >= f(b); break;
    case spv::OpIsNan: result = std::isnan(f(a)); break;
    case spv::OpIsInf: result = std::isinf(f(a)); break;
    case spv::OpConvertFToS: result = to_integer(f(a), -2147483648.0, 2147483647.0); break;
    case spv::OpConvertFToU: result = to_integer(f(a), 0.0, 4294967295.0); break;
    case spv::OpConvertSToF: result = bits(static_cast<float>(i(a))); break;
    case spv::OpConvertUToF: result = bits(static_cast<float>(a)); break;
    case spv::OpBitcast: case spv::OpCopyObject: result = a; break;
    // clang-format on
    default:
      return false;
  }
  return true;
}

bool extended_scalar(U number, const U* x, U& result) {
  const U a = x[0], b = x[1], c = x[2];
  switch (number) {
    // clang-format off
    case GLSLstd450FAbs: result = a & 0x7fffffffu; break;
    case GLSLstd450SAbs: result = i(a) < 0 ? 0u - a : a; break;
    case GLSLstd450SSign: result = u(i(a) > 0 ? 1 : i(a) < 0 ? -1 : 0); break;
    case GLSLstd450Floor: result = bits(std::floor(f(a))); break;
    case GLSLstd450Ceil: result = bits(std::ceil(f(a))); break;
    case GLSLstd450Trunc: result = bits(std::trunc(f(a))); break;
    case GLSLstd450Sqrt: result = bits(std::sqrt(f(a))); break;
    case GLSLstd450FMin: result = bits(smaller(f(a), f(b))); break;
    case GLSLstd450FMax: result = bits(larger(f(a), f(b))); break;
    case GLSLstd450FClamp: result = bits(smaller(larger(f(a), f(b)), f(c))); break;
    case GLSLstd450Step: result = bits(f(b) < f(a) ? 0.0f : 1.0f); break;
    case GLSLstd450SMin: result = u(std::min(i(a), i(b))); break;
    case GLSLstd450SMax: result = u(std::max(i(a), i(b))); break;
    case GLSLstd450SClamp: result = u(std::min(std::max(i(a), i(b)), i(c))); break;
    case GLSLstd450UMin: result = std::min(a, b); break;
    case GLSLstd450UMax: result = std::max(a, b); break;
    case GLSLstd450UClamp: result = std::min(std::max(a, b), c); break;
    case GLSLstd450FindILsb: result = a == 0 ? ~0u : static_cast<U>(std::countr_zero(a)); break;
    case GLSLstd450FindUMsb: result = a == 0 ? ~0u : static_cast<U>(31 - std::countl_zero(a)); break;
    case GLSLstd450FindSMsb: {
      const U magnitude = i(a) < 0 ? ~a : a;
      result = magnitude == 0 ? ~0u : static_cast<U>(31 - std::countl_zero(magnitude));
      break;
    }
    // clang-format on
    default:
      return false;
  }
  return true;
}

}  // namespace twinshade::fuzz

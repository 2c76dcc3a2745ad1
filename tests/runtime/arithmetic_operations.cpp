// Operators, comparisons, selections and conversions.
#include "tests/runtime/operations_by_policy.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace {

template <class N>
struct Group {
  static constexpr Operation list[] = {
      OPERATION("a + b", return a + b;),
      OPERATION("a - b", return a - b;),
      OPERATION("a * b", return a * b;),
      OPERATION("a / b", return a / b;),
      OPERATION("-a", return -a;),
      OPERATION("a * 3 uniform", return a * UF(3.0f);),
      OPERATION("1 uniform / a", return UF(1.0f) / a;),
      OPERATION("a < b", return a < b;),
      OPERATION("a > b", return a > b;),
      OPERATION("a <= b", return a <= b;),
      OPERATION("a >= b", return a >= b;),
      OPERATION("a == b", return a == b;),
      OPERATION("a != b", return a != b;),
      OPERATION("a < b ? a : c", return select(a < b, a, c);),
      OPERATION("a < b ? 1 : 2 uniform", return select(a < b, UF(1.0f), UF(2.0f));),
      OPERATION("(a < b && b < c) || !(a == c)", return ((a < b) && (b < c)) || !(a == c);),
      OPERATION("(a < b) ^ (b == c)", return (a < b) ^ (b == c);),
      OPERATION("(a < b) == (b < c)", return (a < b) == (b < c);),
      OPERATION("(a < b) != (b < c)", return (a < b) != (b < c);),
      OPERATION("min(a, b)", return lanes_min(a, b);),
      OPERATION("max(a, b)", return lanes_max(a, b);),
      OPERATION("min(a, 1 uniform)", return lanes_min(a, UF(1.0f));),
      OPERATION("max(a, 0 uniform)", return lanes_max(a, UF(0.0f));),
      OPERATION("abs(a)", return lanes_abs(a);),
      OPERATION("sqrt(a)", return lanes_sqrt(a);),
      OPERATION("floor(a)", return lanes_floor(a);),
      OPERATION("ceil(a)", return lanes_ceil(a);),
      OPERATION("trunc(a)", return lanes_trunc(a);),
      OPERATION("roundEven(a)", return lanes_round_even(a);),
      OPERATION("i + j", return i + j;),
      OPERATION("i - j", return i - j;),
      OPERATION("i * j", return i * j;),
      OPERATION("i / j", return i / j;),
      OPERATION("i % j", return i % j;),
      OPERATION("-i", return -i;),
      OPERATION("i & j", return i & j;),
      OPERATION("i | j", return i | j;),
      OPERATION("i ^ j", return i ^ j;),
      OPERATION("~i", return ~i;),
      OPERATION("i << j", return i << j;),
      OPERATION("i >> j", return i >> j;),
      OPERATION("i >> q", return i >> q;),
      OPERATION("i << 33 uniform", return i << UI(33);),
      OPERATION("7 uniform << j", return UI(7) << j;),
      OPERATION("i < j", return i < j;),
      OPERATION("i >= j", return i >= j;),
      OPERATION("i == j", return i == j;),
      OPERATION("min(i, j)", return lanes_min(i, j);),
      OPERATION("max(i, j)", return lanes_max(i, j);),
      OPERATION("abs(i)", return lanes_abs(i);),
      OPERATION("p + q", return p + q;),
      OPERATION("p * q", return p * q;),
      OPERATION("p / q", return p / q;),
      OPERATION("p % q", return p % q;),
      OPERATION("-p", return -p;),
      OPERATION("p << q", return p << q;),
      OPERATION("p >> q", return p >> q;),
      OPERATION("p < q", return p < q;),
      OPERATION("p > q", return p > q;),
      OPERATION("max(p, q)", return lanes_max(p, q);),
      OPERATION("int(a)", return to_int(a);),
      OPERATION("uint(a)", return to_uint(a);),
      OPERATION("bool(a)", return to_bool(a);),
      OPERATION("bool(i)", return to_bool(i);),
      OPERATION("float(i)", return to_float<N>(i);),
      OPERATION("float(p)", return to_float<N>(p);),
      OPERATION("float(a < b)", return to_float<N>(a < b);),
      OPERATION("int(a < b)", return to_int(a < b);),
      OPERATION("int(p)", return to_int(p);),
      OPERATION("uint(i)", return to_uint(i);),
  };
};

OPERATION_SETS(arithmetic)

}  // namespace
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade

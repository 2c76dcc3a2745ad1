#include "tests/runtime/oracle.h"

#include <algorithm>
#include <climits>

namespace twinshade::test {
namespace {

using Words = std::vector<std::uint32_t>;
using Word = std::uint32_t;

double flushed(Word w) {  // as an operand
  const float x = float_of(w);
  return std::fpclassify(x) == FP_SUBNORMAL ? std::copysign(0.0, static_cast<double>(x)) : static_cast<double>(x);
}
// As a result: tiny after rounding with unbounded exponent on x86, before rounding on Arm.
Word flushed_result(double exact) {
#if defined(__aarch64__)
  const double tiny = 0x1p-126;
#else
  const double tiny = 0x1p-126 - 0x1p-151;
#endif
  if (std::fabs(exact) < tiny) exact = std::copysign(0.0, exact);
  return word_of(static_cast<float>(exact));
}

std::int64_t s(Word w) { return static_cast<std::int32_t>(w); }
__extension__ typedef __int128 Wide;
Word wrap(Wide x) { return static_cast<Word>(static_cast<std::uint64_t>(x)); }

}  // namespace

std::map<std::string, Oracle> arithmetic_oracles(bool flush) {
  std::map<std::string, Oracle> o;
  const auto in = [flush](Word w) { return flush ? flushed(w) : static_cast<double>(float_of(w)); };
  const auto out = [flush](double x) { return flush ? flushed_result(x) : word_of(static_cast<float>(x)); };
  const auto real = [&](const char* name, auto f) {
    o[name] = {[=](Word a, Word b, Word c) { return Words{out(f(in(a), in(b), in(c)))}; }};
  };
  real("a + b", [](double a, double b, double) { return a + b; });
  real("a - b", [](double a, double b, double) { return a - b; });
  real("a * b", [](double a, double b, double) { return a * b; });
  real("a / b", [](double a, double b, double) { return a / b; });
  real("a * 3 uniform", [](double a, double, double) { return a * 3; });
  real("1 uniform / a", [](double a, double, double) { return 1 / a; });
  real("sqrt(a)", [](double a, double, double) { return std::sqrt(a); });
  real("floor(a)", [](double a, double, double) { return std::floor(a); });
  real("ceil(a)", [](double a, double, double) { return std::ceil(a); });
  real("trunc(a)", [](double a, double, double) { return std::trunc(a); });
  real("roundEven(a)", [](double a, double, double) { return std::nearbyint(a); });

  // Bits move unchanged.
  o["-a"] = {[](Word a, Word, Word) { return Words{a ^ 0x80000000u}; }};
  o["abs(a)"] = {[](Word a, Word, Word) { return Words{a & 0x7fffffffu}; }};
  // MINPS and MAXPS, but for the number where the second is NaN.
  o["min(a, b)"] = {[=](Word a, Word b, Word) {
    if (std::isnan(in(b))) return Words{a};
    return Words{std::isnan(in(a)) ? out(in(b)) : out(in(a) < in(b) ? in(a) : in(b))};
  }};
  o["max(a, b)"] = {[=](Word a, Word b, Word) {
    if (std::isnan(in(b))) return Words{a};
    return Words{std::isnan(in(a)) ? out(in(b)) : out(in(a) > in(b) ? in(a) : in(b))};
  }};

  const auto truth = [&](const char* name, auto f) {
    o[name] = {[=](Word a, Word b, Word c) { return Words{f(in(a), in(b), in(c)) ? 1u : 0u}; }};
  };
  truth("a < b", [](double a, double b, double) { return std::isless(a, b); });
  truth("a > b", [](double a, double b, double) { return std::isgreater(a, b); });
  truth("a <= b", [](double a, double b, double) { return std::islessequal(a, b); });
  truth("a >= b", [](double a, double b, double) { return std::isgreaterequal(a, b); });
  truth("a == b", [](double a, double b, double) { return !std::isunordered(a, b) && !std::islessgreater(a, b); });
  truth("a != b", [](double a, double b, double) { return std::isunordered(a, b) || std::islessgreater(a, b); });
  truth("bool(a)", [](double a, double, double) { return std::isnan(a) || std::islessgreater(a, 0.0); });
  o["a < b ? a : c"] = {[=](Word a, Word b, Word c) { return Words{in(a) < in(b) ? a : c}; }};

  const auto integer = [&](const char* name, auto f) {
    o[name] = {[=](Word a, Word b, Word) { return Words{wrap(f(a, b))}; }};
  };
  integer("i + j", [](Word a, Word b) { return Wide{s(a)} + s(b); });
  integer("i - j", [](Word a, Word b) { return Wide{s(a)} - s(b); });
  integer("i * j", [](Word a, Word b) { return Wide{s(a)} * s(b); });
  integer("i / j", [](Word a, Word b) { return b == 0 ? Wide{0} : Wide{s(a)} / s(b); });
  integer("i % j", [](Word a, Word b) { return b == 0 ? Wide{-1} : Wide{a} % Wide{b}; });
  integer("-i", [](Word a, Word) { return -Wide{s(a)}; });
  integer("i & j", [](Word a, Word b) { return Wide{a & b}; });
  integer("i | j", [](Word a, Word b) { return Wide{a | b}; });
  integer("i ^ j", [](Word a, Word b) { return Wide{a ^ b}; });
  integer("~i", [](Word a, Word) { return Wide{~a}; });
  integer("i << j", [](Word a, Word b) { return Wide{a} << (b % 32); });
  integer("i << 33 uniform", [](Word a, Word) { return Wide{a} * 2; });
  integer("7 uniform << j", [](Word, Word b) { return Wide{7} << (b % 32); });
  integer("i >> j", [](Word a, Word b) { return Wide{s(a)} >> (b % 32); });
  integer("i >> q", [](Word a, Word b) { return Wide{s(a)} >> (b % 32); });
  integer("i < j", [](Word a, Word b) { return Wide{s(a) < s(b)}; });
  integer("i >= j", [](Word a, Word b) { return Wide{s(a) >= s(b)}; });
  integer("i == j", [](Word a, Word b) { return Wide{a == b}; });
  integer("min(i, j)", [](Word a, Word b) { return Wide{std::min(s(a), s(b))}; });
  integer("max(i, j)", [](Word a, Word b) { return Wide{std::max(s(a), s(b))}; });
  integer("abs(i)", [](Word a, Word) { return Wide{std::abs(s(a))}; });
  integer("p + q", [](Word a, Word b) { return Wide{a} + b; });
  integer("p * q", [](Word a, Word b) { return Wide{a} * b; });
  integer("p / q", [](Word a, Word b) { return b == 0 ? Wide{-1} : Wide{a} / b; });
  integer("p % q", [](Word a, Word b) { return b == 0 ? Wide{-1} : Wide{a} % b; });
  integer("-p", [](Word a, Word) { return -Wide{a}; });
  integer("p << q", [](Word a, Word b) { return Wide{a} << (b % 32); });
  integer("p >> q", [](Word a, Word b) { return Wide{a} >> (b % 32); });
  integer("p < q", [](Word a, Word b) { return Wide{a < b}; });
  integer("p > q", [](Word a, Word b) { return Wide{a > b}; });
  integer("max(p, q)", [](Word a, Word b) { return Wide{std::max(a, b)}; });
  integer("bool(i)", [](Word a, Word) { return Wide{a != 0}; });
  integer("int(p)", [](Word a, Word) { return Wide{a}; });
  integer("uint(i)", [](Word a, Word) { return Wide{a}; });

  const auto clamped = [=](Word a, double low, double high) {
    const double x = in(a);
    return std::isnan(x) ? Wide{0} : static_cast<Wide>(std::trunc(std::clamp(x, low, high)));
  };
  o["int(a)"] = {[=](Word a, Word, Word) { return Words{wrap(clamped(a, INT_MIN, INT_MAX))}; }};
  o["uint(a)"] = {[=](Word a, Word, Word) { return Words{wrap(clamped(a, 0, UINT_MAX))}; }};
  o["float(i)"] = {[](Word a, Word, Word) { return Words{word_of(static_cast<float>(static_cast<double>(s(a))))}; }};
  o["float(p)"] = {[](Word a, Word, Word) { return Words{word_of(static_cast<float>(static_cast<double>(a)))}; }};
  return o;
}

}  // namespace twinshade::test

#include "tests/runtime/oracle.h"

#include <algorithm>

namespace twinshade::test {
namespace {

using Words = std::vector<std::uint32_t>;
using Word = std::uint32_t;

// The value of a half, from its fields.
double half_value(Word h) {
  const int exponent = static_cast<int>(h >> 10 & 31), mantissa = static_cast<int>(h & 1023);
  const double sign = (h & 0x8000u) ? -1 : 1;
  if (exponent == 31) return mantissa == 0 ? sign * INFINITY : NAN;
  if (exponent == 0) return sign * std::ldexp(mantissa, -24);
  return sign * std::ldexp(1024 + mantissa, exponent - 25);
}
// The nearest half by search among all, ties to the even one.
Word nearest_half(double x) {
  if (std::isnan(x)) return 0x7e00;
  const Word sign = std::signbit(x) ? 0x8000u : 0;
  const double a = std::fabs(x);
  if (a >= 65520) return sign | 0x7c00u;
  Word low = 0, high = 0x7bff;
  while (low < high) {  // the greatest half <= a
    const Word middle = (low + high + 1) / 2;
    if (half_value(middle) <= a)
      low = middle;
    else
      high = middle - 1;
  }
  const double below = a - half_value(low), above = (low == 0x7bff ? 65536.0 : half_value(low + 1)) - a;
  return sign | (above < below || (above == below && (low & 1u)) ? low + 1 : low);
}
Word field(double x, double low, double scale, Word mask) {
  const double clamped = std::isnan(x) ? low : std::clamp(x, low, 1.0);
  // The product is rounded to float before it is rounded to an integer.
  return static_cast<Word>(static_cast<std::int64_t>(std::nearbyint(static_cast<float>(clamped * scale)))) & mask;
}

}  // namespace

std::map<std::string, Oracle> builtin_oracles() {
  std::map<std::string, Oracle> o;
  const auto real = [&](const char* name, double ulp, auto f) {
    o[name] = {[=](Word a, Word b, Word c) {
                 const long double x = f(float_of(a), float_of(b), float_of(c));
                 return Words{word_of(static_cast<float>(x))};
               },
               ulp};
  };
  const auto integer = [&](const char* name, auto f) {
    o[name] = {[=](Word a, Word b, Word c) { return Words{static_cast<Word>(f(a, b, c))}; }};
  };
  real("sign(a)", 0, [](float a, float, float) { return a > 0 ? 1.0f : a < 0 ? -1.0f : 0.0f; });
  real("fract(a)", 0, [](float a, float, float) { return static_cast<double>(a) - std::floor(a); });
  real("step(a, b)", 0, [](float a, float b, float) { return b >= a ? 1.0f : 0.0f; });
  real("inversesqrt(a)", 1, [](float a, float, float) { return 1 / std::sqrt(static_cast<long double>(a)); });
  o["clamp(a, b, c)"] = {[](Word a, Word b, Word c) {
    // Of two equal operands (zeros of either sign) the second.
    const float x = float_of(a), low = float_of(b), high = float_of(c);
    const float raised = std::isnan(low) || x > low ? x : low;
    return Words{word_of(std::isnan(high) || raised < high ? raised : high)};
  }};
  real("frexp(a)", 0, [](float a, float, float) {
    int e;
    return std::frexp(a, &e);
  });
  real("radians(a)", 2, [](float a, float, float) { return a * (3.14159265358979323846L / 180); });
  real("degrees(a)", 2, [](float a, float, float) { return a * (180 / 3.14159265358979323846L); });
  o["modf(a)"] = {[](Word a, Word, Word) {
    const float x = float_of(a);
    return Words{word_of(x - std::trunc(x)), word_of(std::trunc(x))};
  }};
  o["ldexp(a, (j & 511) - 256)"] = {[](Word a, Word b, Word) {
    const int exponent = static_cast<int>(b & 511u) - 256;
    if (exponent < -126 || exponent > 128) return Words{};  // GLSL leaves it undefined
    return Words{word_of(std::ldexp(float_of(a), exponent))};
  }};
  integer("isnan(a)", [](Word a, Word, Word) { return std::isnan(float_of(a)); });
  integer("isinf(a)", [](Word a, Word, Word) { return std::isinf(float_of(a)); });
  integer("frexp(a) exponent", [](Word a, Word, Word) {
    int e = 0;
    if (std::isfinite(float_of(a))) std::frexp(float_of(a), &e);
    return e;
  });
  integer("sign(i)", [](Word a, Word, Word) { return a == 0 ? 0 : (a >> 31) ? -1 : 1; });

  // Bits one at a time.
  const auto bit = [](Word w, Word i) { return w >> i & 1u; };
  const auto extract = [=](Word a, Word offset, Word bits) {
    Word r = 0;
    for (Word i = 0; i < bits; ++i) r |= bit(a, offset + i) << i;
    return r;
  };
  integer("bitfieldExtract(p, j & 31, k % 17)", [=](Word a, Word b, Word c) { return extract(a, b & 15u, c % 17u); });
  integer("bitfieldExtract(i, j & 31, k % 17)", [=](Word a, Word b, Word c) {
    const Word bits = c % 17u, r = extract(a, b & 15u, bits);
    return bits != 0 && bit(r, bits - 1) ? r - (1u << bits) : r;
  });
  integer("bitfieldInsert(p, q, r & 15, 16)", [=](Word a, Word b, Word c) {
    for (Word i = 0; i < 16; ++i) a = (a & ~(1u << ((c & 15u) + i))) | bit(b, i) << ((c & 15u) + i);
    return a;
  });
  integer("bitfieldInsert(i, j, 0, 32)", [](Word, Word b, Word) { return b; });
  integer("bitfieldReverse(p)", [=](Word a, Word, Word) {
    Word r = 0;
    for (Word i = 0; i < 32; ++i) r |= bit(a, i) << (31 - i);
    return r;
  });
  integer("bitCount(p)", [=](Word a, Word, Word) {
    Word n = 0;
    for (Word i = 0; i < 32; ++i) n += bit(a, i);
    return n;
  });
  const auto highest = [=](Word a) {
    int at = -1;
    for (Word i = 0; i < 32; ++i) at = bit(a, i) ? static_cast<int>(i) : at;
    return at;
  };
  integer("findMSB(p)", [=](Word a, Word, Word) { return highest(a); });
  integer("findMSB(i)", [=](Word a, Word, Word) { return highest(a >> 31 ? ~a : a); });
  integer("findLSB(i)", [=](Word a, Word, Word) {
    for (Word i = 0; i < 32; ++i) {
      if (bit(a, i)) return static_cast<int>(i);
    }
    return -1;
  });
  const auto wide = [&](const char* name, auto f) {
    o[name] = {[=](Word a, Word b, Word) {
      const auto r = f(a, b);
      return Words{r.first, r.second};
    }};
  };
  using Two = std::pair<Word, Word>;
  wide("uaddCarry(p, q)", [](std::uint64_t a, std::uint64_t b) { return Two(a + b, (a + b) >> 32); });
  wide("usubBorrow(p, q)", [](std::uint64_t a, std::uint64_t b) { return Two(a - b, b > a); });
  wide("umulExtended(p, q)", [](std::uint64_t a, std::uint64_t b) { return Two((a * b) >> 32, a * b); });
  wide("imulExtended(i, j)", [](Word a, Word b) {
    const std::int64_t product = std::int64_t{static_cast<std::int32_t>(a)} * static_cast<std::int32_t>(b);
    return Two(static_cast<std::uint64_t>(product) >> 32, product);
  });

  integer("packUnorm2x16(a, b)", [](Word a, Word b, Word) {
    return field(float_of(a), 0, 65535, 0xffff) | field(float_of(b), 0, 65535, 0xffff) << 16;
  });
  integer("packSnorm2x16(a, b)", [](Word a, Word b, Word) {
    return field(float_of(a), -1, 32767, 0xffff) | field(float_of(b), -1, 32767, 0xffff) << 16;
  });
  integer("packUnorm4x8(a, b, c, a)", [](Word a, Word b, Word c) {
    const auto f = [](Word w) { return field(float_of(w), 0, 255, 0xff); };
    return f(a) | f(b) << 8 | f(c) << 16 | f(a) << 24;
  });
  integer("packSnorm4x8(a, b, c, a)", [](Word a, Word b, Word c) {
    const auto f = [](Word w) { return field(float_of(w), -1, 127, 0xff); };
    return f(a) | f(b) << 8 | f(c) << 16 | f(a) << 24;
  });
  o["packHalf2x16(a, b)"] = {[](Word a, Word b, Word) {
    const double x = float_of(a), y = float_of(b);
    if (std::isnan(x) || std::isnan(y)) return Words{};
    return Words{nearest_half(x) | nearest_half(y) << 16};
  }};
  o["unpackHalf2x16(p)"] = {[](Word a, Word, Word) {
    return Words{word_of(static_cast<float>(half_value(a & 0xffffu))),
                 word_of(static_cast<float>(half_value(a >> 16)))};
  }};
  o["unpackUnorm2x16(p)"] = {[](Word a, Word, Word) {
    return Words{word_of(static_cast<float>((a & 0xffffu) / 65535.0)),
                 word_of(static_cast<float>((a >> 16) / 65535.0))};
  }};
  o["unpackSnorm4x8(p)"] = {[](Word a, Word, Word) {
    Words r;
    for (int i = 0; i < 4; ++i) {
      const auto byte = static_cast<std::int8_t>(a >> (8 * i));
      r.push_back(word_of(static_cast<float>(std::clamp(byte / 127.0, -1.0, 1.0))));
    }
    return r;
  }};

  // Transcendentals, against the C library in long double.
  using Real = long double;
  const auto defined = [&](const char* name, double ulp, auto domain, auto f) {
    o[name] = {[=](Word a, Word b, Word) {
                 const float x = float_of(a), y = float_of(b);
                 if (!domain(x, y)) return Words{};
                 return Words{word_of(static_cast<float>(f(Real{x}, Real{y})))};
               },
               ulp};
  };
  const auto always = [](float, float) { return true; };
  const auto small = [](float x, float) { return !(std::fabs(x) >= 0x1p30f); };
  defined("sin(a)", 1, small, [](Real x, Real) { return std::sin(x); });
  defined("cos(a)", 1, small, [](Real x, Real) { return std::cos(x); });
  defined("tan(a)", 1, small, [](Real x, Real) { return std::tan(x); });
  const auto unit = [](float x, float) { return std::fabs(x) <= 1; };
  defined("asin(a)", 1, unit, [](Real x, Real) { return std::asin(x); });
  defined("acos(a)", 1, unit, [](Real x, Real) { return std::acos(x); });
  defined("atan(a)", 1, always, [](Real x, Real) { return std::atan(x); });
  defined(
      "atan(a, b)", 1, [](float x, float y) { return x != 0 || y != 0; },
      [](Real x, Real y) { return std::atan2(x, y); });
  defined("sinh(a)", 1, always, [](Real x, Real) { return std::sinh(x); });
  defined("cosh(a)", 1, always, [](Real x, Real) { return std::cosh(x); });
  defined("tanh(a)", 1, always, [](Real x, Real) { return std::tanh(x); });
  defined("asinh(a)", 1, always, [](Real x, Real) { return std::asinh(x); });
  defined("acosh(a)", 1, always, [](Real x, Real) { return std::acosh(x); });
  defined(
      "atanh(a)", 1, [](float x, float) { return std::fabs(x) < 1; }, [](Real x, Real) { return std::atanh(x); });
  defined("exp(a)", 1, always, [](Real x, Real) { return std::exp(x); });
  defined("exp2(a)", 1, always, [](Real x, Real) { return std::exp2(x); });
  defined("log(a)", 1, always, [](Real x, Real) { return std::log(x); });
  defined("log2(a)", 1, always, [](Real x, Real) { return std::log2(x); });
  defined(
      "pow(a, b)", 1, [](float x, float y) { return x > 0 && x < INFINITY && std::isfinite(y); },
      [](Real x, Real y) { return std::pow(x, y); });
  return o;
}

}  // namespace twinshade::test

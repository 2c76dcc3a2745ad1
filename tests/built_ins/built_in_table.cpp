// Independent of both machines: the C library in long double, GLM in double, integers in 64 bits.
#include "tests/built_ins/built_in_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace twinshade::test {
namespace {

using Real = long double;
using Values = std::vector<Real>;
constexpr Real kPi = 3.14159265358979323846264338327950288L;

constexpr Range kAngle{-1e4, 1e4, true}, kUnit{-1, 1}, kAny{-1e9, 1e9, true}, kPositive{0, 1e30, true},
    kModerate{-8, 8}, kInt{-2147483648.0, 2147483647.0}, kUint{0, 4294967295.0};

class Table {
 public:
  std::vector<BuiltIn> rows;

  void section(const std::string& name) { section_ = name; }

  void add(const std::string& name, const std::vector<std::string>& types, const std::vector<Range>& ranges,
           const std::string& result, double most_ulp, std::function<Truth(const Arguments&)> truth,
           const std::string& glsl = "") {
    rows.push_back({section_, name, types, ranges, glsl.empty() ? result + " result = " + name + ";" : glsl, result,
                    most_ulp, std::move(truth)});
  }
  template <class F>
  void unary(const std::string& name, Range range, double most_ulp, F f) {
    add(name + "(a)", {"float"}, {range}, "float", most_ulp, [f](const Arguments& r) { return Truth{{f(r.x[0])}}; });
  }
  template <class F>
  void binary(const std::string& name, Range a, Range b, double most_ulp, F f) {
    add(name + "(a, b)", {"float", "float"}, {a, b}, "float", most_ulp,
        [f](const Arguments& r) { return Truth{{f(r.x[0], r.x[1])}}; });
  }
  // Integer arguments and results of any number, exact. f: words to values.
  template <class F>
  void integer(const std::string& name, const std::vector<std::string>& types, const std::string& result, F f,
               const std::string& glsl = "") {
    std::vector<Range> ranges;
    for (const std::string& type : types) ranges.push_back(scalar_letter(type) == 'i' ? kInt : kUint);
    add(
        name, types, ranges, result, 0, [f](const Arguments& r) { return Truth{f(r.words)}; }, glsl);
  }

 private:
  std::string section_;
};

Real as_int(std::uint32_t w) { return static_cast<std::int32_t>(w); }

void trigonometry(Table& t) {
  t.section("Angle and trigonometry functions");
  t.unary("radians", kAny, 1.5, [](Real x) { return x * (kPi / 180); });
  t.unary("degrees", kAny, 1.5, [](Real x) { return x * (180 / kPi); });
  t.unary("sin", kAngle, 0.6, [](Real x) { return std::sin(x); });
  t.unary("cos", kAngle, 0.6, [](Real x) { return std::cos(x); });
  t.unary("tan", kAngle, 0.6, [](Real x) { return std::tan(x); });
  t.unary("asin", kUnit, 0.6, [](Real x) { return std::asin(x); });
  t.unary("acos", kUnit, 0.6, [](Real x) { return std::acos(x); });
  t.unary("atan", kAny, 0.6, [](Real x) { return std::atan(x); });
  t.binary("atan", kAny, kAny, 0.6, [](Real y, Real x) { return std::atan2(y, x); });
  const Range hyperbolic{-80, 80, true};
  t.unary("sinh", hyperbolic, 0.6, [](Real x) { return std::sinh(x); });
  t.unary("cosh", hyperbolic, 0.6, [](Real x) { return std::cosh(x); });
  t.unary("tanh", hyperbolic, 0.6, [](Real x) { return std::tanh(x); });
  t.unary("asinh", kAny, 0.6, [](Real x) { return std::asinh(x); });
  t.unary("acosh", {1, 1e6}, 0.6, [](Real x) { return std::acosh(x); });
  t.unary("atanh", {-0.999, 0.999}, 0.6, [](Real x) { return std::atanh(x); });
}

void exponentials(Table& t) {
  t.section("Exponential functions");
  t.binary("pow", {1e-3, 1e3}, {-10, 10}, 0.6, [](Real x, Real y) { return std::pow(x, y); });
  t.unary("exp", {-80, 80}, 0.6, [](Real x) { return std::exp(x); });
  t.unary("log", kPositive, 0.6, [](Real x) { return std::log(x); });
  t.unary("exp2", {-120, 120}, 0.6, [](Real x) { return std::exp2(x); });
  t.unary("log2", kPositive, 0.6, [](Real x) { return std::log2(x); });
  t.unary("sqrt", kPositive, 0.5, [](Real x) { return std::sqrt(x); });
  t.unary("inversesqrt", kPositive, 1.5, [](Real x) { return 1 / std::sqrt(x); });
}

void common(Table& t) {
  t.section("Common functions");
  t.unary("abs", kAny, 0, [](Real x) { return std::fabs(x); });
  t.integer("abs(a)", {"int"}, "int",
            [](const auto& w) { return Values{w[0] == 0x80000000u ? as_int(w[0]) : std::fabs(as_int(w[0]))}; });
  t.unary("sign", kAny, 0, [](Real x) { return x > 0 ? 1.0L : x < 0 ? -1.0L : 0.0L; });
  t.integer("sign(a)", {"int"}, "int", [](const auto& w) {
    return Values{w[0] == 0 ? 0.0L : as_int(w[0]) > 0 ? 1.0L : -1.0L};
  });
  t.unary("floor", kAny, 0, [](Real x) { return std::floor(x); });
  t.unary("trunc", kAny, 0, [](Real x) { return std::trunc(x); });
  t.unary("round", kAny, 0, [](Real x) { return std::nearbyint(x); });
  t.unary("roundEven", kAny, 0, [](Real x) { return std::nearbyint(x); });
  t.unary("ceil", kAny, 0, [](Real x) { return std::ceil(x); });
  t.unary("fract", kAny, 0.5, [](Real x) { return x - std::floor(x); });
  t.add("mod(a, b)", {"float", "float"}, {kModerate, {0.5, 8}}, "float", 2, [](const Arguments& r) {
    // The remainder itself, unless rounding of a / b reaches the next integer: then b apart from it, and as good.
    return Truth{{r.x[0] - r.x[1] * std::floor(r.x[0] / r.x[1])}, std::max(std::fabs(r.x[0]), r.x[1])};
  });
  t.add(
      "modf(a, whole)", {"float"}, {kAny}, "vec2", 0,
      [](const Arguments& r) {
        return Truth{{r.x[0] - std::trunc(r.x[0]), std::trunc(r.x[0])}};
      },
      "float whole; float part = modf(a, whole); vec2 result = vec2(part, whole);");
  t.binary("min", kAny, kAny, 0, [](Real x, Real y) { return std::min(x, y); });
  t.binary("max", kAny, kAny, 0, [](Real x, Real y) { return std::max(x, y); });
  t.integer("min(a, b)", {"int", "int"}, "int",
            [](const auto& w) { return Values{std::min(as_int(w[0]), as_int(w[1]))}; });
  t.integer("max(a, b)", {"uint", "uint"}, "uint", [](const auto& w) { return Values{Real(std::max(w[0], w[1]))}; });
  t.add("clamp(a, b, c)", {"float", "float", "float"}, {kAny, {-4, 0}, {0, 4}}, "float", 0,
        [](const Arguments& r) { return Truth{{std::clamp(r.x[0], r.x[1], r.x[2])}}; });
  t.add("mix(a, b, c)", {"float", "float", "float"}, {kModerate, kModerate, {0, 1}}, "float", 2,
        [](const Arguments& r) {
          return Truth{{r.x[0] * (1 - r.x[2]) + r.x[1] * r.x[2]}, std::max(std::fabs(r.x[0]), std::fabs(r.x[1]))};
        });
  t.add(
      "mix(a, b, bool)", {"float", "float", "uint"}, {kAny, kAny, kUint}, "float", 0,
      [](const Arguments& r) { return Truth{{r.words[2] & 1u ? r.x[1] : r.x[0]}}; },
      "float result = mix(a, b, (c & 1u) == 1u);");
  t.binary("step", kModerate, kModerate, 0, [](Real edge, Real x) { return x < edge ? 0.0L : 1.0L; });
  t.add("smoothstep(a, b, c)", {"float", "float", "float"}, {{-4, -1}, {1, 4}, kModerate}, "float", 4,
        [](const Arguments& r) {
          const Real s = std::clamp((r.x[2] - r.x[0]) / (r.x[1] - r.x[0]), 0.0L, 1.0L);
          return Truth{{s * s * (3 - 2 * s)}, 1};
        });
  const std::string special =
      "float x = c % 3u == 0u ? a : c % 3u == 1u ? intBitsToFloat(0x7fc00000) : "
      "uintBitsToFloat(0x7f800000u | (c & 0x80000000u)); ";
  t.add(
      "isnan(a)", {"float", "float", "uint"}, {kAny, kAny, kUint}, "uint", 0,
      [](const Arguments& r) { return Truth{{r.words[2] % 3 == 1 ? 1.0L : 0.0L}}; },
      special + "uint result = uint(isnan(x));");
  t.add(
      "isinf(a)", {"float", "float", "uint"}, {kAny, kAny, kUint}, "uint", 0,
      [](const Arguments& r) { return Truth{{r.words[2] % 3 == 2 ? 1.0L : 0.0L}}; },
      special + "uint result = uint(isinf(x));");
  t.add("floatBitsToInt(a)", {"float"}, {kAny}, "int", 0,
        [](const Arguments& r) { return Truth{{as_int(r.words[0])}}; });
  t.add("floatBitsToUint(a)", {"float"}, {kAny}, "uint", 0,
        [](const Arguments& r) { return Truth{{Real(r.words[0])}}; });
  const auto float_of = [](std::uint32_t w) {
    float x;
    std::memcpy(&x, &w, 4);
    return Real(x);
  };
  // Exponents of normal numbers.
  t.add("intBitsToFloat(a)", {"int"}, {{0x00800000, 0x7f7fffff}}, "float", 0,
        [=](const Arguments& r) { return Truth{{float_of(r.words[0])}}; });
  t.add("uintBitsToFloat(a)", {"uint"}, {{0x00800000, 0x7f7fffff}}, "float", 0,
        [=](const Arguments& r) { return Truth{{float_of(r.words[0])}}; });
  t.add("fma(a, b, c)", {"float", "float", "float"}, {kModerate, kModerate, kModerate}, "float", 1.5,
        [](const Arguments& r) {
          return Truth{{r.x[0] * r.x[1] + r.x[2]}, std::max(std::fabs(r.x[0] * r.x[1]), std::fabs(r.x[2]))};
        });
  t.add(
      "frexp(a, exponent)", {"float"}, {kAny}, "vec2", 0,
      [](const Arguments& r) {
        int e;
        const Real part = std::frexp(r.x[0], &e);
        return Truth{{part, Real(e)}};
      },
      "int exponent; float part = frexp(a, exponent); vec2 result = vec2(part, float(exponent));");
  t.add("ldexp(a, b)", {"float", "int"}, {kAny, {-60, 60}}, "float", 0,
        [](const Arguments& r) { return Truth{{std::ldexp(r.x[0], int(r.x[1]))}}; });
}

// Fields of a packed word, from the lowest, each of round(clamp(x, low, 1) * scale).
Truth packed(const Arguments& r, int count, double low, float scale) {
  std::uint32_t word = 0;
  const int bits = 32 / count;
  for (int k = 0; k < count; ++k) {
    const float product = static_cast<float>(std::clamp(double(r.x[std::size_t(k)]), low, 1.0)) * scale;
    const auto field = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::nearbyint(product)));
    word |= (bits == 16 ? field & 0xffffu : field & 0xffu) << (bits * k);
  }
  return Truth{{Real(word)}};
}
Truth unpacked(std::uint32_t word, int count, bool is_signed, Real scale) {
  Truth truth;
  const int bits = 32 / count;
  for (int k = 0; k < count; ++k) {
    const std::uint32_t high = word << (32 - bits * (k + 1));
    const Real field = is_signed ? Real(static_cast<std::int32_t>(high) >> (32 - bits)) : Real(high >> (32 - bits));
    truth.values.push_back(std::max(field / scale, -1.0L));
  }
  return truth;
}
Real half_value(std::uint32_t h) {
  const int exponent = int(h >> 10 & 31u), mantissa = int(h & 1023u);
  const Real magnitude =
      exponent == 0 ? std::ldexp(Real(mantissa), -24) : std::ldexp(Real(1024 + mantissa), exponent - 25);
  return h & 0x8000u ? -magnitude : magnitude;
}
// To nearest, ties to even, by search.
std::uint32_t nearest_half(Real x) {
  const std::uint32_t sign = std::signbit(x) ? 0x8000u : 0u;
  std::uint32_t h = 0;
  for (std::uint32_t step = 0x4000; step > 0; step >>= 1)
    if (h + step <= 0x7bffu && half_value(h + step) <= std::fabs(x)) h += step;
  const Real below = std::fabs(x) - half_value(h), above = half_value(h + 1) - std::fabs(x);
  return sign | (above < below || (above == below && (h & 1u)) ? h + 1 : h);
}

void packing(Table& t) {
  t.section("Floating-point pack and unpack functions");
  const Range beyond{-1.25, 1.25};
  t.add("packUnorm2x16(a)", {"vec2"}, {beyond}, "uint", 0, [](const Arguments& r) { return packed(r, 2, 0, 65535); });
  t.add("packSnorm2x16(a)", {"vec2"}, {beyond}, "uint", 0, [](const Arguments& r) { return packed(r, 2, -1, 32767); });
  t.add("packUnorm4x8(a)", {"vec4"}, {beyond}, "uint", 0, [](const Arguments& r) { return packed(r, 4, 0, 255); });
  t.add("packSnorm4x8(a)", {"vec4"}, {beyond}, "uint", 0, [](const Arguments& r) { return packed(r, 4, -1, 127); });
  t.add("packHalf2x16(a)", {"vec2"}, {{-60000, 60000, true}}, "uint", 0,
        [](const Arguments& r) { return Truth{{Real(nearest_half(r.x[0]) | nearest_half(r.x[1]) << 16)}}; });
  t.add("unpackUnorm2x16(a)", {"uint"}, {kUint}, "vec2", 0.5,
        [](const Arguments& r) { return unpacked(r.words[0], 2, false, 65535); });
  t.add("unpackSnorm2x16(a)", {"uint"}, {kUint}, "vec2", 0.5,
        [](const Arguments& r) { return unpacked(r.words[0], 2, true, 32767); });
  t.add("unpackUnorm4x8(a)", {"uint"}, {kUint}, "vec4", 0.5,
        [](const Arguments& r) { return unpacked(r.words[0], 4, false, 255); });
  t.add("unpackSnorm4x8(a)", {"uint"}, {kUint}, "vec4", 0.5,
        [](const Arguments& r) { return unpacked(r.words[0], 4, true, 127); });
  t.add(
      "unpackHalf2x16(a)", {"uint"}, {kUint}, "vec2", 0,
      [](const Arguments& r) {
        const std::uint32_t word = r.words[0] & 0xbbffbbffu;  // finite ones
        return Truth{{half_value(word & 0xffffu), half_value(word >> 16)}};
      },
      "vec2 result = unpackHalf2x16(a & 0xbbffbbffu);");
}

template <int n>
glm::vec<n, double> vector_at(const Arguments& r, int first) {
  glm::vec<n, double> v;
  for (int k = 0; k < n; ++k) v[k] = double(r.x[std::size_t(first + k)]);
  return v;
}
template <int n>
Values values_of(const glm::vec<n, double>& v) {
  Values values;
  for (int k = 0; k < n; ++k) values.push_back(v[k]);
  return values;
}

template <int n>
void geometric_of(Table& t) {
  const std::string type = "vec" + std::to_string(n);
  const std::string suffix = ", " + type;
  t.add(
      "dot(a, b)" + suffix, {type, type}, {kModerate, kModerate}, "float", n,
      [](const Arguments& r) {
        const auto p = vector_at<n>(r, 0) * vector_at<n>(r, n);
        Real greatest = 0;
        for (int k = 0; k < n; ++k) greatest = std::max(greatest, Real(std::fabs(p[k])));
        return Truth{{Real(glm::dot(vector_at<n>(r, 0), vector_at<n>(r, n)))}, greatest};
      },
      "float result = dot(a, b);");
  t.add(
      "length(a)" + suffix, {type}, {kModerate}, "float", 2,
      [](const Arguments& r) { return Truth{{Real(glm::length(vector_at<n>(r, 0)))}}; }, "float result = length(a);");
  t.add(
      "normalize(a)" + suffix, {type}, {kModerate}, type, 4,
      [](const Arguments& r) { return Truth{values_of<n>(glm::normalize(vector_at<n>(r, 0)))}; },
      type + " result = normalize(a);");
}

void geometry(Table& t) {
  t.section("Geometric functions");
  geometric_of<2>(t);
  geometric_of<3>(t);
  geometric_of<4>(t);
  t.add("distance(a, b)", {"vec3", "vec3"}, {kModerate, kModerate}, "float", 3, [](const Arguments& r) {
    return Truth{{Real(glm::distance(vector_at<3>(r, 0), vector_at<3>(r, 3)))}, 8};
  });
  t.add("cross(a, b)", {"vec3", "vec3"}, {kModerate, kModerate}, "vec3", 2, [](const Arguments& r) {
    return Truth{values_of<3>(glm::cross(vector_at<3>(r, 0), vector_at<3>(r, 3))), 64};
  });
  t.add("faceforward(a, b, c)", {"vec3", "vec3", "vec3"}, {kModerate, kModerate, kModerate}, "vec3", 0,
        [](const Arguments& r) {
          return Truth{values_of<3>(glm::faceforward(vector_at<3>(r, 0), vector_at<3>(r, 3), vector_at<3>(r, 6)))};
        });
  t.add("reflect(a, b)", {"vec3", "vec3"}, {kUnit, kUnit}, "vec3", 4, [](const Arguments& r) {
    return Truth{values_of<3>(glm::reflect(vector_at<3>(r, 0), vector_at<3>(r, 3))), 2};
  });
  t.add("refract(a, b, c)", {"vec3", "vec3", "float"}, {{-0.5, 0.5}, {-0.5, 0.5}, {0.2, 0.9}}, "vec3", 4,
        [](const Arguments& r) {
          return Truth{values_of<3>(glm::refract(vector_at<3>(r, 0), vector_at<3>(r, 3), double(r.x[6]))), 1};
        });
}

template <int n>
glm::mat<n, n, double> matrix_at(const Arguments& r, bool dominant) {
  glm::mat<n, n, double> m;
  for (int c = 0; c < n; ++c)
    for (int k = 0; k < n; ++k) m[c][k] = double(r.x[std::size_t(c * n + k)]) + (dominant && c == k ? 8 : 0);
  return m;
}
template <class M>
Values entries_of(const M& m) {
  Values values;
  for (int c = 0; c < m.length(); ++c)
    for (int k = 0; k < m[c].length(); ++k) values.push_back(m[c][k]);
  return values;
}

// 8 on the diagonal keeps them far from singular: more than the rest of a row together.
template <int n>
void square_of(Table& t) {
  const std::string type = "mat" + std::to_string(n), vector = "vec" + std::to_string(n);
  t.add(
      "determinant(a), " + type, {type}, {kUnit}, "float", 8,
      [](const Arguments& r) {
        return Truth{{Real(glm::determinant(matrix_at<n>(r, true)))}, 100};
      },
      "a += " + type + "(8.0); float result = determinant(a);");
  t.add(
      "inverse(a), " + type, {type}, {kUnit}, type, 8,
      [](const Arguments& r) {
        return Truth{entries_of(glm::inverse(matrix_at<n>(r, true))), 0.25L};
      },
      "a += " + type + "(8.0); " + type + " result = inverse(a);");
  t.add(
      type + " * " + vector, {type, vector}, {kUnit, kUnit}, vector, 4,
      [](const Arguments& r) {
        return Truth{values_of<n>(matrix_at<n>(r, false) * vector_at<n>(r, n * n)), 1};
      },
      vector + " result = a * b;");
  t.add(
      vector + " * " + type, {type, vector}, {kUnit, kUnit}, vector, 4,
      [](const Arguments& r) {
        return Truth{values_of<n>(vector_at<n>(r, n * n) * matrix_at<n>(r, false)), 1};
      },
      vector + " result = b * a;");
}

void matrices(Table& t) {
  t.section("Matrix functions and products");
  square_of<2>(t);
  square_of<3>(t);
  square_of<4>(t);
  // Closed form, of shapes that are not square.
  t.add("matrixCompMult(a, b)", {"mat3x2", "mat3x2"}, {kUnit, kUnit}, "mat3x2", 0.5, [](const Arguments& r) {
    Truth truth;
    for (std::size_t k = 0; k < 6; ++k) truth.values.push_back(r.x[k] * r.x[6 + k]);
    return truth;
  });
  t.add("outerProduct(a, b)", {"vec2", "vec4"}, {kUnit, kUnit}, "mat4x2", 0.5, [](const Arguments& r) {
    Truth truth;
    for (std::size_t k = 0; k < 8; ++k) truth.values.push_back(r.x[k % 2] * r.x[2 + k / 2]);
    return truth;
  });
  t.add("transpose(a)", {"mat2x4"}, {kUnit}, "mat4x2", 0, [](const Arguments& r) {
    Truth truth;
    for (std::size_t k = 0; k < 8; ++k) truth.values.push_back(r.x[k % 2 * 4 + k / 2]);
    return truth;
  });
  t.add(
      "mat2x3 * mat4x2", {"mat2x3", "mat4x2"}, {kUnit, kUnit}, "mat4x3", 2,
      [](const Arguments& r) {
        Truth truth;
        truth.scale = 1;
        for (std::size_t c = 0; c < 4; ++c)
          for (std::size_t k = 0; k < 3; ++k)
            truth.values.push_back(r.x[k] * r.x[6 + 2 * c] + r.x[3 + k] * r.x[7 + 2 * c]);
        return truth;
      },
      "mat4x3 result = a * b;");
}

void relations(Table& t) {
  t.section("Vector relational functions");
  // Five values, so that some are equal.
  const auto relation = [&](const std::string& name, auto f) {
    t.integer(
        name + "(a, b)", {"uvec3", "uvec3"}, "uvec3",
        [f](const auto& w) {
          Values values;
          for (std::size_t k = 0; k < 3; ++k) values.push_back(f(int(w[k] % 5u), int(w[3 + k] % 5u)) ? 1 : 0);
          return values;
        },
        "uvec3 result = uvec3(" + name + "(a % 5u, b % 5u));");
  };
  relation("lessThan", [](int a, int b) { return a < b; });
  relation("lessThanEqual", [](int a, int b) { return a <= b; });
  relation("greaterThan", [](int a, int b) { return a > b; });
  relation("greaterThanEqual", [](int a, int b) { return a >= b; });
  relation("equal", [](int a, int b) { return a == b; });
  relation("notEqual", [](int a, int b) { return a != b; });
  t.integer(
      "any(a), all(a), not(a)", {"uvec3"}, "uvec3",
      [](const auto& w) {
        const bool x = w[0] & 1u, y = w[1] & 1u, z = w[2] & 1u;
        return Values{Real(x || y || z), Real(x && y && z), Real(!z)};
      },
      "bvec3 odd = equal(a & 1u, uvec3(1u)); uvec3 result = uvec3(any(odd), all(odd), not(odd).z);");
}

void integers(Table& t) {
  t.section("Integer functions");
  using Wide = std::uint64_t;
  t.integer(
      "uaddCarry(a, b, carry)", {"uint", "uint"}, "uvec2",
      [](const auto& w) {
        const Wide sum = Wide{w[0]} + w[1];
        return Values{Real(std::uint32_t(sum)), Real(sum >> 32)};
      },
      "uint carry; uint sum = uaddCarry(a, b, carry); uvec2 result = uvec2(sum, carry);");
  t.integer(
      "usubBorrow(a, b, borrow)", {"uint", "uint"}, "uvec2",
      [](const auto& w) {
        return Values{Real(w[0] - w[1]), Real(w[0] < w[1])};
      },
      "uint borrow; uint rest = usubBorrow(a, b, borrow); uvec2 result = uvec2(rest, borrow);");
  t.integer(
      "umulExtended(a, b, high, low)", {"uint", "uint"}, "uvec2",
      [](const auto& w) {
        const Wide product = Wide{w[0]} * w[1];
        return Values{Real(product >> 32), Real(std::uint32_t(product))};
      },
      "uint high, low; umulExtended(a, b, high, low); uvec2 result = uvec2(high, low);");
  t.integer(
      "imulExtended(a, b, high, low)", {"int", "int"}, "ivec2",
      [](const auto& w) {
        const std::int64_t product = std::int64_t{std::int32_t(w[0])} * std::int32_t(w[1]);
        return Values{Real(std::int32_t(product >> 32)), as_int(std::uint32_t(product))};
      },
      "int high, low; imulExtended(a, b, high, low); ivec2 result = ivec2(high, low);");
  const auto field = [](std::uint32_t word, std::uint32_t offset, std::uint32_t bits) {
    return std::uint32_t((Wide{word} >> offset) & ((Wide{1} << bits) - 1));
  };
  const std::string place = "int offset = int(b % 33u), bits = int(c % uint(33 - offset)); ";
  const auto offset_of = [](const auto& w, std::size_t k) { return w[k] % 33u; };
  const auto bits_of = [](const auto& w, std::size_t k) { return w[k + 1] % (33u - w[k] % 33u); };
  t.integer(
      "bitfieldExtract(a, offset, bits)", {"uint", "uint", "uint"}, "uint",
      [=](const auto& w) { return Values{Real(field(w[0], offset_of(w, 1), bits_of(w, 1)))}; },
      place + "uint result = bits == 0 ? 0u : bitfieldExtract(a, offset, bits);");
  t.integer(
      "bitfieldExtract(a, offset, bits), int", {"int", "uint", "uint"}, "int",
      [=](const auto& w) {
        const std::uint32_t bits = bits_of(w, 1), value = field(w[0], offset_of(w, 1), bits);
        const bool negative = bits != 0 && (value >> (bits - 1) & 1u) != 0;
        return Values{negative ? Real(value) - std::ldexp(1.0L, int(bits)) : Real(value)};
      },
      place + "int result = bits == 0 ? 0 : bitfieldExtract(a, offset, bits);");
  t.integer(
      "bitfieldInsert(a, b, offset, bits)", {"uint", "uint", "uint", "uint"}, "uint",
      [=](const auto& w) {
        const Wide mask = ((Wide{1} << bits_of(w, 2)) - 1) << offset_of(w, 2);
        return Values{Real(std::uint32_t((w[0] & ~mask) | ((Wide{w[1]} << offset_of(w, 2)) & mask)))};
      },
      "int offset = int(c % 33u), bits = int(d % uint(33 - offset)); "
      "uint result = bits == 0 ? a : bitfieldInsert(a, b, offset, bits);");
  t.integer("bitfieldReverse(a)", {"uint"}, "uint", [](const auto& w) {
    std::uint32_t reversed = 0;
    for (int k = 0; k < 32; ++k) reversed |= (w[0] >> k & 1u) << (31 - k);
    return Values{Real(reversed)};
  });
  const auto highest = [](std::uint32_t w) {
    int at = -1;
    for (int k = 0; k < 32; ++k) at = w >> k & 1u ? k : at;
    return Values{Real(at)};
  };
  t.integer("bitCount(a)", {"uint"}, "int", [](const auto& w) {
    int count = 0;
    for (int k = 0; k < 32; ++k) count += int(w[0] >> k & 1u);
    return Values{Real(count)};
  });
  // Shifted, so that high and low bits are found all over.
  t.integer(
      "findLSB(a)", {"uint", "uint"}, "int",
      [](const auto& w) {
        const std::uint32_t word = w[0] << (w[1] & 31u);
        for (int k = 0; k < 32; ++k)
          if (word >> k & 1u) return Values{Real(k)};
        return Values{-1.0L};
      },
      "int result = findLSB(a << (b & 31u));");
  t.integer(
      "findMSB(a)", {"uint", "uint"}, "int", [=](const auto& w) { return highest(w[0] >> (w[1] & 31u)); },
      "int result = findMSB(a >> (b & 31u));");
  t.integer(
      "findMSB(a), int", {"int", "uint"}, "int",
      [=](const auto& w) {
        const std::int32_t x = std::int32_t(w[0]) >> (w[1] & 31u);
        return highest(std::uint32_t(x < 0 ? ~x : x));
      },
      "int result = findMSB(a >> (b & 31u));");
}

}  // namespace

int component_count(const std::string& type) {
  const std::size_t digit = type.find_first_of("234");
  if (digit == std::string::npos) return 1;
  const int first = type[digit] - '0';
  if (type.find("mat") == std::string::npos) return first;
  return first * (type.size() > digit + 1 ? type.back() - '0' : first);
}

char scalar_letter(const std::string& type) {
  if (type[0] == 'i' || type[0] == 'u' || type[0] == 'b') return type[0];
  return 'f';
}

const std::vector<BuiltIn>& built_in_table() {
  static const std::vector<BuiltIn> rows = [] {
    Table t;
    trigonometry(t);
    exponentials(t);
    common(t);
    packing(t);
    geometry(t);
    matrices(t);
    relations(t);
    integers(t);
    return t.rows;
  }();
  return rows;
}

}  // namespace twinshade::test

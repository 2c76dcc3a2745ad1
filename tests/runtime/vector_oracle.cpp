#include "tests/runtime/oracle.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace twinshade::test {
namespace {

using Words = std::vector<std::uint32_t>;
using Word = std::uint32_t;

struct Made {  // as in vector_operations.cpp
  Made(double a, double b, double c)
      : v2(a, b),
        w2(c, a),
        v(a, b, c),
        w(b, c, a),
        v4(a, b, c, b),
        w4(c, b, c, a),
        m2(v2, w2),
        m(v, w, glm::dvec3(b, a, c)),
        m4(v4, w4, glm::dvec4(b, a, c, a), glm::dvec4(c, c, b, a)),
        m23(v, w) {}
  glm::dvec2 v2, w2;
  glm::dvec3 v, w;
  glm::dvec4 v4, w4;
  glm::dmat2 m2;
  glm::dmat3 m;
  glm::dmat4 m4;
  glm::dmat2x3 m23;
  glm::dvec3 u{1, -2, 0.5};
};

void append(Words& words, double x) { words.push_back(word_of(static_cast<float>(x))); }
template <int n>
void append(Words& words, const glm::vec<n, double>& v) {
  for (int i = 0; i < n; ++i) append(words, v[i]);
}
template <int c, int r>
void append(Words& words, const glm::mat<c, r, double>& m) {
  for (int i = 0; i < c; ++i) append(words, m[i]);
}
void append(Words& words, bool x) { words.push_back(x); }
template <int n>
void append(Words& words, const glm::vec<n, bool>& v) {
  for (int i = 0; i < n; ++i) append(words, v[i]);
}

}  // namespace

std::map<std::string, Oracle> vector_oracles() {
  std::map<std::string, Oracle> o;
  // Sums that cancel lose relative digits: floats are compared at the scale of 1, the operands being a few units.
  const auto add = [&](const char* name, auto f) {
    o[name] = {[=](Word a, Word b, Word c) {
                 const float x = float_of(a), y = float_of(b), z = float_of(c);
                 Words words;
                 for (const float t : {x, y, z}) {
                   if (!(std::fabs(t) < 8 && std::fabs(t) > 0.01f)) return words;
                 }
                 append(words, f(Made(x, y, z), double{x}));
                 return words;
               },
               256, 1};
  };
  using glm::transpose;
  add("v + w", [](const Made& s, double) { return s.v + s.w; });
  add("v - u", [](const Made& s, double) { return s.v - s.u; });
  add("u * v", [](const Made& s, double) { return s.u * s.v; });
  add("v / a", [](const Made& s, double a) { return s.v / a; });
  add("2 / v", [](const Made& s, double) { return 2.0 / s.v; });
  add("-v4", [](const Made& s, double) { return -s.v4; });
  add("v.zxy", [](const Made& s, double) { return glm::dvec3(s.v.z, s.v.x, s.v.y); });
  add("v == w", [](const Made& s, double) { return s.v == s.w; });
  add("v != u", [](const Made& s, double) { return s.v != s.u; });
  add("dot(v2, w2)", [](const Made& s, double) { return glm::dot(s.v2, s.w2); });
  add("dot(v, w)", [](const Made& s, double) { return glm::dot(s.v, s.w); });
  add("dot(v4, w4)", [](const Made& s, double) { return glm::dot(s.v4, s.w4); });
  add("length(v)", [](const Made& s, double) { return glm::length(s.v); });
  add("distance(v, w)", [](const Made& s, double) { return glm::distance(s.v, s.w); });
  add("normalize(v)", [](const Made& s, double) { return glm::normalize(s.v); });
  add("cross(v, w)", [](const Made& s, double) { return glm::cross(s.v, s.w); });
  add("reflect(v, w)", [](const Made& s, double) { return glm::reflect(s.v, s.w); });
  add("m * v", [](const Made& s, double) { return s.m * s.v; });
  add("v * m", [](const Made& s, double) { return s.v * s.m; });
  add("m * m", [](const Made& s, double) { return s.m * s.m; });
  add("m23 * v2", [](const Made& s, double) { return s.m23 * s.v2; });
  add("v * m23", [](const Made& s, double) { return s.v * s.m23; });
  add("m4 * v4", [](const Made& s, double) { return s.m4 * s.v4; });
  add("m + m * 2 - m / a", [](const Made& s, double a) { return s.m + s.m * 2.0 - s.m / a; });
  add("matrixCompMult(m, m)", [](const Made& s, double) { return glm::matrixCompMult(s.m, s.m); });
  add("outerProduct(v, w2)", [](const Made& s, double) { return glm::outerProduct(s.v, s.w2); });
  add("transpose(m23)", [](const Made& s, double) { return transpose(s.m23); });
  add("determinant(m2)", [](const Made& s, double) { return glm::determinant(s.m2); });
  add("determinant(m)", [](const Made& s, double) { return glm::determinant(s.m); });
  add("lessThan(v, w)", [](const Made& s, double) { return glm::lessThan(s.v, s.w); });
  add("any(equal(v, w))", [](const Made& s, double) { return glm::any(glm::equal(s.v, s.w)); });
  add("all(greaterThanEqual(v, w))", [](const Made& s, double) { return glm::all(glm::greaterThanEqual(s.v, s.w)); });
  add("clamp(v, 0, 1)", [](const Made& s, double) { return glm::clamp(s.v, 0.0, 1.0); });
  add("mix(v, w, a)", [](const Made& s, double a) { return glm::mix(s.v, s.w, a); });

  o["faceforward(v, w, u)"] = {[](Word a, Word b, Word c) {
    Words words;
    const Made s(float_of(a), float_of(b), float_of(c));
    if (!(std::fabs(glm::dot(s.u, s.w)) > 0x1p-100) || !(glm::length(s.v + s.w) < 0x1p100)) return words;
    if (std::fabs(glm::dot(s.u, s.w)) < 1e-6 * glm::length(s.w)) return words;  // the sign is rounding's
    append(words, glm::faceforward(s.v, s.w, s.u));
    return words;
  }};

  // Inverses are held to the matrix they invert: only well-conditioned ones.
  const auto inverse = [&](const char* name, auto pick) {
    o[name] = {[=](Word a, Word b, Word c) {
                 Words words;
                 for (const Word w : {a, b, c}) {
                   if (!(std::fabs(float_of(w)) < 8)) return words;
                 }
                 const auto m = pick(Made(float_of(a), float_of(b), float_of(c)));
                 const double determinant = glm::determinant(m);
                 if (std::fabs(determinant) < 1) return words;
                 append(words, glm::inverse(m));
                 return words;
               },
               65536, 1};
  };
  inverse("inverse(m2)", [](const Made& s) { return s.m2; });
  inverse("inverse(m)", [](const Made& s) { return s.m; });
  inverse("inverse(m4)", [](const Made& s) { return s.m4; });
  return o;
}

}  // namespace twinshade::test

// Shaders with probes are valid, number the same statements whether all or one are told of, and keep their lines.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cpu_shaders/rewrite/frag_coord.h"
#include "cpu_shaders/rewrite/make_exact.h"
#include "cpu_shaders/rewrite/probe.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {
namespace {

const ShaderSource& everything() {
  static const ShaderSource source = resolve_shader(
      "everything",
      "in vec3 a; flat in int k; uniform mat3 m; out vec4 color;\n"                                          // 1
      "const float K = 0.1 * 3.0; float g = K;\n"                                                            // 2
      "struct S { vec3 v; float w[2]; };\n"                                                                  // 3
      "S make(vec3 v) {\n"                                                                                   // 4
      "  return S(v * 2.0, float[](v.x, v.y * 3.0));\n"                                                      // 5
      "}\n"                                                                                                  // 6
      "void fill(out float x, inout vec2 y) { x = a.x * 2.0; y += x; }\n"                                    // 7
      "int count(float x) { return int(x * 4.0); }\n"                                                        // 8
      "void main() {\n"                                                                                      // 9
      "  float x, w[3] = float[](a.x, a.y, a.x * a.y); vec2 y = a.xy;\n"                                     // 10
      "  fill(x, y);\n"                                                                                      // 11
      "  S s = make(a); s.v.xy *= y; s.w[k & 1] = x;\n"                                                      // 12
      "  for (float t = 0.0; t < a.z; t += 0.25) x += t;\n"                                                  // 13
      "  for (int i = 0; i < 3; ++i) for (int j = 0; j < i; ++j) if (w[j] > x) x += w[i]; else x -= 1.0;\n"  // 14
      "  while (x * x > 9.0) { x *= 0.5; if (x < 0.1) break; }\n"                                            // 15
      "  do { x += 1.0; } while (x < 2.0 * a.y);\n"                                                          // 16
      "  switch (count(x)) { case 0: x = 1.0; break; default: x = a.z; }\n"                                  // 17
      "  mat3 p = m * 2.0; p[1] = a;\n"                                                                      // 18
      "  if (a.x > 9.0) discard;\n"                                                                          // 19
      "  vec4 sum =\n"                                                                                       // 20
      "      vec4(s.v * p,\n"                                                                                // 21
      "           x);\n"                                                                                     // 22
      "  color = sum + gl_FragCoord * g;\n"                                                                  // 23
      "}\n",
      "everything.frag");
  return source;
}

bool names(const ProbedShader& shader, int line, const std::string& what) {
  for (const ProbedStatement& statement : shader.statements)
    if (statement.line == line && statement.what == what) return true;
  return false;
}

// With probes, which compile all together and of each statement alone.
ProbedShader compiling_probes(const ShaderSource& source) {
  ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  for (std::size_t k = 0; k < shader.statements.size(); ++k)
    CHECK_NOTHROW(compile_glsl(add_probes(source, std::set<std::size_t>{k}).source));
  return shader;
}

}  // namespace

TEST_CASE("every kind of statement is probed, at its line") {
  const ProbedShader shader = add_probes(everything());
  CHECK_NOTHROW(compile_glsl(shader.source));
  const std::vector<std::pair<int, std::string>> expected = {{2, "K"},          {5, "result of make"},
                                                             {7, "x"},          {8, "result of count"},
                                                             {10, "w"},         {10, "y"},
                                                             {11, "x, y"},      {12, "s.v.xy"},
                                                             {13, "t"},         {13, "condition"},
                                                             {14, "condition"}, {15, "condition"},
                                                             {16, "condition"}, {17, "condition"},
                                                             {18, "p"},         {20, "sum"},
                                                             {23, "color"}};
  for (const auto& statement : expected) {
    CAPTURE(statement.first);
    CAPTURE(statement.second);
    CHECK(names(shader, statement.first, statement.second));
  }
  for (const ProbedStatement& statement : shader.statements)
    if (statement.what == "sum") CHECK(statement.last_line == 22);
}

TEST_CASE("one probe at a time: the same numbers, valid GLSL") {
  const ProbedShader all = add_probes(everything());
  for (std::size_t k = 0; k < all.statements.size(); ++k) {
    const ProbedShader one = add_probes(everything(), std::set<std::size_t>{k});
    CAPTURE(all.statements[k].what);
    CHECK(one.statements.size() == all.statements.size());
    CHECK_NOTHROW(compile_glsl(one.source));
  }
}

TEST_CASE("probes go into shaders that were made exact, and into GLSL ES") {
  CHECK_NOTHROW(compile_glsl(add_probes(make_exact(everything()).source).source));
  const ShaderSource es = resolve_shader("es",
                                         "#version 300 es\nprecision highp float;\nin vec2 uv;\nout vec4 color;\nvoid "
                                         "main() { float x = uv.x * uv.y; color = vec4(x); }\n",
                                         "es.frag");
  CHECK_NOTHROW(compile_glsl(add_probes(es).source));
}

TEST_CASE("what a statement declares outlives the probes of what its calls wrote") {
  const ShaderSource source =
      resolve_shader("t",
                     "in vec4 a; out vec4 c;\n"
                     "float split(float x, out float whole) { whole = floor(x); return sin(x); }\n"
                     "void main() { float whole;\n float part = split(a.x, whole);\n"
                     " c = vec4(part, whole, 0.0, 1.0); }\n",
                     "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 4, "whole, part"));
}

TEST_CASE("what built-in functions write is told where they are called") {
  const ProbedShader shader = compiling_probes(
      resolve_shader("t",
                     "in vec4 a; flat in uvec2 u; out vec4 c; float f(float x) { return x; }\n"
                     "void main() { float whole; vec2 w[2]; ivec2 e; uint high, low;\n"
                     " float part = modf(a.x, whole);\n"
                     " modf(a.xy, w[1]);\n"
                     " vec2 m = frexp(a.zw, e);\n"
                     " if (uaddCarry(u.x, u.y, high) > 3u) part = 1.0;\n"
                     " umulExtended(u.x, u.y, high, low);\n"
                     " c = vec4(part, whole, f(modf(a.y, whole)), float(low) + w[1].x + m.x + float(e.x)); }\n",
                     "t.frag"));
  CHECK(names(shader, 3, "whole, part"));
  CHECK(names(shader, 4, "w[1]"));
  CHECK(names(shader, 5, "e, m"));
  CHECK(names(shader, 6, "high"));
  CHECK(names(shader, 7, "high, low"));
  CHECK(names(shader, 8, "whole, c"));
  CHECK(shader.complete);
  for (const ProbedStatement& statement : shader.statements)
    if (statement.line == 4 || statement.line == 7) CHECK(statement.computes == (statement.line == 4));
}

TEST_CASE("globals are told at their own lines, wherever functions stand") {
  const ShaderSource source = resolve_shader("t",
                                             "in vec4 a; out vec4 c; float f(float x) { return x; }\n"
                                             "float g = sin(a.x);\n"
                                             "void h(inout float k) {\n k = a.y * 2.0; }\n"
                                             "void last();\n"
                                             "void main() { last(); c = vec4(g); h(c.x); }\n"
                                             "float below = cos(a.x);\n"
                                             "void last() { g += below; }\n",
                                             "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 2, "g"));
  CHECK(names(shader, 4, "k"));
  CHECK(names(shader, 7, "below"));
}

TEST_CASE("what a call hands over is told at the call's line, structures and arrays too, but for exact functions") {
  const ShaderSource source = resolve_shader("t",
                                             "in vec4 a; out vec4 c; struct S { float x; mat2 m; };\n"
                                             "float f(float x, in S s, float w[2], mat2 m) {\n"
                                             "  return x + s.x + w[1] + m[0].x; }\n"
                                             "void main() {\n"
                                             "  float r = f(sin(a.x),\n"
                                             "              S(a.y * 2.0, mat2(a)),\n"
                                             "              float[](a.x, tan(a.y)), mat2(a) * 2.0);\n"
                                             "  if (f(r, S(r, mat2(1.0)), float[2](r, r), mat2(r)) > 1.0) c = a;\n"
                                             "}\n",
                                             "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 5, "argument 1 of f"));
  CHECK(names(shader, 6, "argument 2 of f"));
  CHECK(names(shader, 7, "argument 3 of f"));
  CHECK(names(shader, 7, "argument 4 of f"));
  CHECK(names(shader, 8, "argument 1 of f"));
  const ProbedShader exact = add_probes(make_exact(source).source);
  CHECK_NOTHROW(compile_glsl(exact.source));
  for (const ProbedStatement& statement : exact.statements)
    CHECK(statement.what.find("of exact_") == std::string::npos);
}

TEST_CASE("constructed arguments within functions that return a value, and of sizes that are local constants") {
  for (const std::string functions :
       {"struct S { float a; }; float f(S s) { return exp(s.a); } float g(float x) { return f(S(x + 1.0)); }",
        "float f(float[2] a) { return exp(a[0]) + a[1]; }\n"
        "float g(float x) { float y = f(float[](x, 1.0)); if (y > 2.0) return y * 3.0; return y * 2.0; }",
        "float f(float[2] a) { return exp(a[0]) + a[1]; }\n"
        "float g(float x) { const int N = 2; return f(float[N](x, x * 2.0)); }"})
    CHECK_NOTHROW(compile_glsl(
        add_probes(
            resolve_shader("t", "in float x; out float r;\n" + functions + "\nvoid main() { r = g(x); }\n", "t.frag"))
            .source));
}

TEST_CASE("a, b without parentheses is told as a condition and as a result") {
  const ShaderSource source = resolve_shader("t",
                                             "in float a; out float c; float g;\n"
                                             "float f() {\n  return g = a, sin(g); }\n"
                                             "void main() { int i = 0;\n"
                                             "  while (g += cos(a), ++i < 4) ;\n  c = f() + g; }\n",
                                             "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 3, "result of f"));
  CHECK(names(shader, 5, "condition"));
}

TEST_CASE("what an argument stores is told, without parentheses around it too") {
  const ShaderSource source = resolve_shader("t",
                                             "in float a; out float c; struct S { float x; };\n"
                                             "float f(float x) { return x * 2.0; } float g(S s) { return s.x; }\n"
                                             "void main() {\n"
                                             "  float x = a, w[2] = float[](a, a); int i = 0;\n"
                                             "  c = f(x += 0.5);\n"
                                             "  c += f(x++) + f(--x);\n"
                                             "  c += f(w[i++ & 1]);\n"
                                             "  c += g(S(w[i] = a));\n"
                                             "  f(f(x = c));\n"
                                             "}\n",
                                             "t.frag");
  const ProbedShader shader = compiling_probes(source);
  CHECK(names(shader, 5, "x, c"));
  CHECK(names(shader, 6, "x, c"));
  CHECK(names(shader, 7, "i, c"));
  CHECK(names(shader, 8, "w[i], c"));
  CHECK(names(shader, 9, "x"));
}

TEST_CASE("what conditions, selectors and results store is told") {
  const ShaderSource source = resolve_shader("t",
                                             "in float a; out float c; float g; struct S { float x; vec2 v; };\n"
                                             "S s; float two(out float x, inout S s) { x = s.x = a; return x; }\n"
                                             "float f() {\n  return (g = sin(a), 1.0); }\n"
                                             "S h() { float w[2];\n  return w[0] = a, S(w[1] = a, vec2(g += 1.0)); }\n"
                                             "double d() {\n  return g = a, 2.0lf; }\n"
                                             "void main() {\n"
                                             "  float t; int i = 0; uint u;\n"
                                             "  if ((t = sin(a)) > 0.5) c = t; else if (two(t, s) > 1.0) c = 2.0;\n"
                                             "  while (i++, (t *= 1.5) < 9.0) ;\n"
                                             "  do c += t; while ((s.v.x = t) < g--);\n"
                                             "  for (; ++i < 9;) ;\n"
                                             "  while (bool b = (t += 1.0) < 20.0) if (b) c = t;\n"
                                             "  switch (int(t = sin(a))) { default: c = 1.0; }\n"
                                             "  switch (u = uint(t)) { default: c = f() + h().x; }\n"
                                             "  if (true || d() > (c = 3.0)) ;\n"
                                             "}\n",
                                             "t.frag");
  const ProbedShader shader = compiling_probes(source);
  const std::vector<std::pair<int, std::string>> expected = {
      {4, "g"},  {4, "result of f"}, {6, "w[0], w[1], g"}, {6, "result of h"}, {8, "g"},
      {11, "t"}, {11, "t, s"},       {11, "condition"},    {12, "i, t"},       {13, "s.v.x, g"},
      {14, "i"}, {15, "t"},          {15, "condition"},    {16, "t"},          {17, "u"},
      {18, "c"}};
  for (const auto& statement : expected) {
    CAPTURE(statement.first);
    CAPTURE(statement.second);
    CHECK(names(shader, statement.first, statement.second));
  }
}

TEST_CASE("arrays that a condition stores are not told, and it is said that not everything is") {
  const auto complete = [](const std::string& condition) {
    const ProbedShader shader =
        add_probes(resolve_shader("t",
                                  "in float a; out float c; struct S { float w[2]; };\n"
                                  "void main() { float w[2] = float[](a, a), v[2]; S s, r; if (" +
                                      condition + ") c = a; }\n",
                                  "t.frag"));
    CHECK_NOTHROW(compile_glsl(shader.source));
    return shader.complete;
  };
  CHECK_FALSE(complete("(v = w)[0] > 1.0"));
  CHECK_FALSE(complete("(s = r).w[0] > 1.0"));
  CHECK(complete("(v[0] = w[1]) > 1.0"));
}

TEST_CASE("a loop that ends by discarding ends with probes too") {
  const ShaderSource source = resolve_shader("t",
                                             "in float a; out float c;\n"
                                             "float f() { if (a > 9.0) discard; return a; }\n"
                                             "void main() { for (float x = f();; x += a) if (x > 2.0) discard; }\n",
                                             "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(shader.source.text.find("discard") == std::string::npos);
  const std::size_t loop = shader.source.text.find("for ( float x");
  REQUIRE(loop != std::string::npos);
  CHECK(shader.source.text.find("return ;", loop) != std::string::npos);
}

TEST_CASE("returned arrays are told") {
  const ShaderSource source = resolve_shader("t",
                                             "in vec4 a; out vec4 c;\n"
                                             "highp float[2] f() {\n  return float[2](a.x, tan(a.y)); }\n"
                                             "void main() { float w[2] = f(); c = vec4(w[0], w[1], 0, 1); }\n",
                                             "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 3, "result of f"));
}

TEST_CASE("a result is told whatever hides its type within the function") {
  const ShaderSource source =
      resolve_shader("hidden",
                     "in vec2 a; out vec4 color;\n"
                     "struct S { vec2 v; };\n"
                     "S twice(S s) { return S(s.v * 2.0); }\n"
                     "S hides(S s) { struct S { float x; }; S t = S(a.x); s.v += t.x; return twice(s); }\n"
                     "S both(S s) { float S = a.y; s.v *= S; return twice(s); }\n"
                     "void main() { color = vec4(hides(S(a)).v, both(S(a)).v); }\n",
                     "hidden.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 3, "result of twice"));
  CHECK(names(shader, 4, "result of hides"));
  CHECK(names(shader, 5, "result of both"));
}

TEST_CASE("a declaration that is all that an if, an else or a loop does is told where it is known") {
  const ShaderSource source = resolve_shader("alone",
                                             "in float a; out vec4 color;\n"
                                             "float f(out float x) { x = a * 2.0; return x; }\n"
                                             "void main() {\n"
                                             "  float x = a, y = a;\n"
                                             "  if (x > 0.0) float b = f(x);\n"
                                             "  else float c = x * 3.0, d = f(y);\n"
                                             "  for (int i = 0; i < 2; ++i) const float e = x * a;\n"
                                             "  int k = 0;\n"
                                             "  while (++k < 3) float g = f(y);\n"
                                             "  color = vec4(x, y, a, 1.0);\n"
                                             "}\n",
                                             "alone.frag");
  const ProbedShader shader = compiling_probes(source);
  CHECK(names(shader, 5, "x, b"));
  CHECK(names(shader, 6, "c, y, d"));
  CHECK(names(shader, 7, "e"));
  CHECK(names(shader, 9, "y, g"));
}

TEST_CASE("of a structure that hides another its own members are told") {
  const ShaderSource source = resolve_shader("t",
                                             "in float a; out float c; struct T { float x; };\n"
                                             "void main() { struct T { float r; }; T t = T(sin(a)); c = t.r; }\n",
                                             "t.frag");
  const ProbedShader shader = add_probes(source);
  CHECK_NOTHROW(compile_glsl(shader.source));
  CHECK(names(shader, 2, "t"));
}

TEST_CASE("integer statements are told, and values by member, column and element") {
  const ProbedShader shader = add_probes(everything());
  const ShaderSource integers = resolve_shader(
      "t", "flat in int k; out int n;\nvoid main() {\n  int a = k >> 3;\n  if (a > 2) n = a / k;\n}\n", "t.frag");
  const ProbedShader of_integers = add_probes(integers);
  CHECK_NOTHROW(compile_glsl(of_integers.source));
  CHECK(names(of_integers, 3, "a"));
  CHECK(names(of_integers, 4, "condition"));
  CHECK(names(of_integers, 4, "n"));
  for (const ProbedStatement& statement : of_integers.statements) CHECK_FALSE(statement.computes);

  std::set<std::vector<std::string>> found;
  for (const ProbedValue& value : shader.values) found.insert(value.name);
  for (const std::vector<std::string>& name : std::vector<std::vector<std::string>>{
           {"sum"}, {"p[2]"}, {"w", ""}, {"s.v"}, {"s.w", ""}, {"(result of make).v"}, {"(result of make).w", ""}}) {
    CAPTURE(name[0]);
    CHECK(found.count(name) == 1);
  }
}

TEST_CASE("a shader's own probe, ES without a precision yet and names that are keywords elsewhere are no obstacle") {
  const ShaderSource own = resolve_shader(
      "t", "in vec4 a; out vec4 c; void probe(int i, float x) {} void main() { probe(1, a.x); c = a * 2.0; }\n",
      "t.frag");
  CHECK_NOTHROW(compile_glsl(add_probes(own).source));
  const ShaderSource names_of_probes =
      resolve_shader("t",
                     "in float probe_value; out float probe_place;\n"
                     "void main() { float probe_twin = 1.0; probe_place = sin(probe_value) * probe_twin; }\n",
                     "t.frag");
  CHECK_NOTHROW(compile_glsl(add_probes(names_of_probes).source));
  const ShaderSource es = resolve_shader("t",
                                         "#version 300 es\nprecision highp float;\nin vec4 a; out vec4 c;\n"
                                         "void main() { c = sin(a) + gl_FragCoord.x; }\n",
                                         "t.frag");
  CHECK_NOTHROW(compile_glsl(frag_coord_as_input(es)));
  for (const std::string name : {"buffer", "precise"}) {
    const ShaderSource keyword = resolve_shader("t",
                                                "#version 300 es\nprecision highp float;\nin float a; out float c;\n"
                                                "void main() { float " +
                                                    name + " = sin(a); c = " + name + "; }\n",
                                                "t.frag");
    CHECK_NOTHROW(compile_glsl(add_probes(keyword).source));
    CHECK(names(add_probes(keyword), 4, name));
  }
  const ShaderSource redeclared = resolve_shader(
      "t", "in vec4 a; in vec4 gl_FragCoord; out vec4 c;\nvoid main() { c = a * gl_FragCoord.x; }\n", "t.frag");
  CHECK_NOTHROW(compile_glsl(frag_coord_as_input(redeclared)));
}

TEST_CASE("gl_FragCoord becomes an input") {
  const ShaderSource moved = frag_coord_as_input(everything());
  CHECK_NOTHROW(compile_glsl(moved));
  CHECK(moved.text.find("gl_FragCoord") == std::string::npos);
}

}  // namespace twinshade

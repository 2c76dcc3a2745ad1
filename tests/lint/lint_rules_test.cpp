// Each row of the lint's table, with shaders that break it and shaders that come close and do not.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "cpu_shaders/lint/lint.h"

namespace twinshade {
namespace {

// The sample stands in the body of main; declarations that it may use stand before.
constexpr const char* kDeclarations = R"(
in vec3 a; in vec3 b; flat in int k; flat in uint u; uniform mat3 m; uniform sampler2D map; uniform sampler2DArray maps;
const float HALF = 0.5; const int FOUR = 4;
struct Light { vec3 colour; float power; };
float twice(float x) { precise float y = x + x; return y; }
void fill(out float x) { x = 1.0; }
layout(location = 0) out vec4 color;
)";

ShaderSource shader_of(const std::string& body, const std::string& before_main = "") {
  return resolve_shader("sample", kDeclarations + before_main + "\nvoid main() {\n" + body + "\n}\n", "sample.frag");
}

std::vector<LintFinding> lint_body(const std::string& body) { return lint(shader_of(body)); }

// Rule ids, each once, with spaces between.
std::string rules_of(const std::vector<LintFinding>& findings) {
  std::set<std::string> rules;
  for (const LintFinding& finding : findings) rules.insert(finding.rule);
  std::string joined;
  for (const std::string& rule : rules) joined += (joined.empty() ? "" : " ") + rule;
  return joined;
}

struct Samples {
  const char* rule;
  std::vector<const char*> breaking;  // each breaks this rule and no other
  std::vector<const char*> clean;
};

const std::vector<Samples>& samples() {
  static const std::vector<Samples> table = {
      {"precise",
       {"float x = a.x * b.x;", "color = vec4(a + b, 1.0);", "float x = twice(a.x * 2.0);",
        "float x; x = a.x; x += b.x;", "precise float x = twice(a.x + b.x);", "int i = int(a.x * 4.0);",
        "float x = a.x; x++;", "color = texelFetch(map, ivec2(a.xy * 8.0), 0);", "float x = sqrt(a.x);",
        "float x = max(a.x, b.x);", "Light l = Light(a * b, 1.0);", "Light l; l.power = a.x - b.x;",
        "switch (int(a.x + b.x)) { case 0: discard; }", "float x[2] = float[2](a.x, a.x + b.x);",
        "float x[2] = {a.x, a.x + b.x};", "for (float t = a.x; t < 4.0; t += b.x) {}", "vec3 v = k > 0 ? a * b : a;"},
       {"precise float x = a.x * b.x;", "precise vec3 v = a; v += b;", "precise float x; x = sqrt(a.x * a.x + 1.0);",
        "precise vec3 v; v.x = a.x * 2.0;", "precise vec3 v = vec3(a.x * b.x, a.y, -a.z);", "float x = -a.x;",
        "float x = k > 0 ? a.x : b.x;", "int i = k * 3 + 1;", "precise float x[2]; x[0] = a.x + b.x;",
        "precise Light l; l.power = a.x - b.x;", "float x; precise x; x = a.x * b.x;", "float x = abs(floor(a.x));",
        "precise float x = floor(a.x * b.x + 0.5);", "precise float x = k > 0 ? a.x * b.x : 0.0;",
        "precise float x = a.x, y = x * x; x++;", "for (int i = 0; i < 4; ++i) {}"}},
      {"compare",
       {"if (a.x * b.x > 1.0) discard;", "bool c = a.x + 1.0 == b.x;", "precise float x = a.x - b.x > 0.0 ? 1.0 : 2.0;",
        "while (sqrt(a.x) < 1.0) discard;", "bvec3 c = lessThan(a * b, b);", "if (max(a.x, b.x) > 1.0) discard;",
        "if (int(a.x / b.x) == k) discard;", "bool c = floatBitsToInt(a.x * b.x) > 3;"},
       {"precise float x = a.x * b.x; if (x > 1.0) discard;", "if (k * 2 > 3) discard;", "if (a.x < b.x) discard;",
        "if (abs(a.x) < 1.0) discard;", "if (twice(a.x) < 1.0) discard;"}},
      {"constant",
       {"precise float x = a.x * (2.0 * 3.0);", "const float t = 1.0 / 3.0;", "precise float x = sqrt(2.0);",
        "precise float x = HALF * HALF + a.x;", "precise vec3 v = vec3(1.0, 2.0, 3.0) / 2.0;", "float x = 2.0 - HALF;"},
       {"const float t = -0.5;", "int i = 2 * 3;", "precise float x = 2.0 * a.x;", "const vec2 v = vec2(1.0, 2.0);",
        "float x = float(FOUR);"}},
      {"literal",
       {"precise float x = a.x * 0.1;", "float x = 3.14159;", "float x = 1e-40;", "float x = 1e39;",
        "float x = 1.0e-3;", "float x = 0.3333333f;", "precise vec3 v = a * vec3(0.5, 0.2, 1.0);"},
       {"float x = 0.5;", "float x = 3.14159274;", "float x = 0.100000000;", "float x = 1.17549435e-38;",
        "float x = 0.0;", "float x = 2.884765625f;", "float x = 1e6;", "int i = 7;", "float x = 1.;",
        "float x = .25;"}},
      {"zero",
       {"precise float x = a.x * 0.0;", "precise float x = a.x + 0.0;", "precise float x = 0.0 - a.x;",
        "precise vec3 v = a * vec3(1.0, 0.0, 1.0);", "precise float sum = 0.0; sum += a.x;",
        "precise float x = a.x - 0.0;", "precise float sum = 0.0; for (int i = 0; i < 4; ++i) sum += a.x;",
        "precise vec3 v = a + vec3(0);", "const float none = 0.0; precise float x = a.x * none;",
        "precise float x = 0.0 / a.x;", "precise vec2 v = vec2(b.x, 0.0) + a.xy;", "precise float x = a.x; x += -0.0;",
        // components, columns, elements and members
        "const vec2 z = vec2(0.0, 1.0); precise float x = a.x + z.x;",
        "const vec3 z = vec3(0.0, 1.0, 0.0); precise vec2 v = a.xy * z.yz;",
        "const float z[2] = float[](1.0, 0.0); precise float x = a.x + z[1];",
        "const float z[2] = { 1.0, 0.0 }; precise float x = a.x + z[FOUR - 3] + z[1];",
        "const Light l = Light(vec3(1.0, 0.0, 1.0), 1.0); precise float x = a.x * l.colour.g;",
        "const Light l[2] = Light[](Light(a, 1.0), Light(a, 0.0)); precise float x = a.x * l[1].power;",
        "precise float x = a.x * mat2(1.0)[0].y;", "precise vec2 v = a.xy * mat3x2(mat2(1.0))[2];",
        "vec2 z = vec2(1.0); z.x = 0.0; precise float x = a.x * z.x;",
        "vec2 z; z.yx = vec2(1.0, 0.0); precise float x = a.x * z.x;",
        "mat2 z = mat2(1.0); z[1] = vec2(0.0); precise float x = a.x * z[1][1];",
        "float z[3]; z[1] = 0.0; z[0] = a.x; precise float x = a.x * z[1];",
        "Light l; l.colour = a; l.power = 0.0; precise float x = a.x * l.power;",
        "vec3 z = vec3(0.0); z.x = a.x; precise float x = a.x * z.y;"},
       {"precise float x = 0.0; fill(x); x += b.x;",
        "uint c = 0u; uint s = uaddCarry(u, 7u, c); precise float x = a.x * float(c);", "precise float x = a.x * 1.0;",
        "float x = 0.0;", "precise float x = 0.0; x = a.x; x += b.x;", "int i = k * 0;",
        "precise float x = a.x > 0.0 ? a.x : 0.0; x += b.x;", "vec4 v = vec4(a, 0.0);",
        "const vec2 z = vec2(0.0, 1.0); precise float x = a.x + z.y; precise vec2 v = a.xy * z.yy;",
        "const vec2 z = vec2(0.0, 1.0); precise float x = a.x + z[k];",
        "const float z[2] = float[](1.0, 0.0); precise float x = a.x + z[0] + z[k];",
        "const Light l = Light(vec3(1.0, 0.0, 1.0), 1.0); precise float x = a.x * l.colour.r * l.power;",
        "precise float x = a.x * mat2(1.0)[0].x;", "precise vec2 v = a.xy * mat2(m)[1];",
        "vec2 z = vec2(0.0); z.x = a.x; precise float x = a.x * z.x; z.y = a.y; precise vec2 v = a.xy * z;",
        "vec2 z = vec2(0.0); fill(z.y); precise float x = a.x * z.y;",
        "float z[3]; z[1] = 0.0; precise float x = a.x * z[k] * z[2];",
        "float z[2] = float[](0.0, 0.0); z[k] = a.x; precise float x = a.x * z[0];"}},
      {"function",
       {"float x = dot(a, b);", "float x = length(a);", "vec3 v = normalize(a);", "vec3 v = cross(a, b);",
        "vec3 v = reflect(a, b);", "precise vec3 v = mix(a, b, 0.5);", "float x = fract(a.x);",
        "float x = mod(a.x, 2.0);"},
       {"float x[3]; int i = x.length();", "vec3 v = mix(a, b, lessThan(a, vec3(0.5)));"}},
      {"transcendental",
       {"float x = sin(a.x);", "float x = exp2(a.x);", "float x = pow(a.x, 2.0);", "float x = atan(a.x, a.y);",
        "float x = inversesqrt(a.x);", "precise float x = 1.0 - cos(a.x);", "vec3 v = log(a);"},
       {"float x = twice(a.x);"}},
      {"matrix",
       {"precise vec3 v = m * a;", "precise vec3 v = a * m;", "precise mat3 n = m * m;", "precise vec3 v = a; v *= m;"},
       {"precise mat3 n = m * 2.0;", "vec3 v = m[0];", "mat3 n = transpose(m);", "precise vec3 v = m[0] * a.x;"}},
      {"fma", {"precise float x = fma(a.x, b.x, 1.0);"}, {"precise float x = a.x * b.x + 1.0;"}},
      {"arm",
       {"precise float x = k > 0 ? a.x * b.x + a.y : 0.0;", "precise float x = k > 0 ? a.x : (a.x + b.x) - a.y;",
        "precise vec3 v = vec3(k > 0 ? floor(a.x * 8.0) * 0.125 : 0.0);",
        "precise float x = k > 0 ? (k > 1 ? a.x * b.x : b.x) + a.y : 0.0;",
        "precise float x; x = k > 0 ? a.x : k > 1 ? b.x : (a.x - b.x) * 0.5;"},
       {"precise float x = k > 0 ? a.x * b.x : a.x + b.x;", "precise float x = (k > 0 ? a.x * b.x : b.x) + a.x;",
        "precise float y = a.x * b.x + a.y; precise float x = k > 0 ? y : 0.0;", "int i = k > 0 ? k * 2 + 1 : 0;",
        "precise float x = k > 0 ? -a.x * b.x : 0.0;", "precise float x = k > 0 ? m[k + 1 - 2].x * b.x : 0.0;"}},
      {"select-minmax",
       {"float x = a.x < b.x ? a.x : b.x;", "precise float x = a.x > b.x ? b.x : a.x;",
        "float x = a.x > 1.0 ? 1.0 : a.x;", "float x = !(a.x < 1.0) ? a.x : 1.00;",
        "float x = ((a).x >= (b.x)) ? (a.x) : b.x;", "float x = mix(a.x, b.x, a.x < b.x);",
        "vec3 v = mix(a, b, not(lessThan(b, a)));",
        "precise float last = float(k); last = a.y; float x = a.x < last ? a.x : last;",
        "float x = twice(a.x) > b.x ? twice(a.x) : b.x;",
        // NaN by an out argument, a compound assignment, a later line of a loop, or infinities
        "float m = 1.0; fill(m); float x = a.x < m ? a.x : m;",
        "precise float m = 2.0; m /= m - 2.0; float x = a.x < m ? a.x : m;",
        "precise float m = 2.0; m *= 4.0; float x = a.x < m ? a.x : m;",
        "vec2 m = vec2(1.0); m.x = a.y; float x = a.x < m.x ? a.x : m.x;",
        "float m = 1.0; for (int i = 0; i < k; ++i) { float x = a.x < m ? a.x : m; m = b.x; }",
        "float m = 1.0; do { float x = a.x < m ? a.x : m; fill(m); } while (m < b.x);",
        "float big = 1.70141183e38; precise float m = k * big, n = m - m; float x = a.x < n ? a.x : n;"},
       {"float x = a.x > b.x ? a.y : b.x;", "float x = a.x < 1.0 ? a.x : 1.0;", "float x = a.x > 0.0 ? a.x : -a.x;",
        "float x = !(a.x > HALF) ? HALF : a.x;",
        "precise float last = float(k) - 1.0; float x = a.x < last ? a.x : last;",
        "float m = 1.0; if (k > 3) m = float(k); for (; m < b.x; m = HALF) { float x = a.x < m ? a.x : m; }",
        "precise float x = mix(a.x, b.x, a.x < b.x);", "precise vec3 v = mix(a, b, lessThan(a, b));",
        "int i = k < 3 ? k : 3;", "float x = a.x == b.x ? a.x : b.x;"}},
      {"minmax-abs",
       {"precise float x = min(a.x, -a.x);", "precise vec3 v = max(-(a), (a));",
        "precise float x = max(abs(a.x), a.x);", "precise float x = min(-abs(a.x), abs(a.x));",
        "precise float x = clamp(a.x, -a.x, b.x);", "precise float x = min(a[k], +a[k]);"},
       {"precise float x = min(a.x, -a.y);", "precise float x = max(a.x, abs(b.x));",
        "precise float x = min(-a.x, -a.x);", "precise float x = clamp(a.x, b.x, -a.x);", "int i = max(k, -k);"}},
      {"filter",
       {"color = texture(map, a.xy);", "color = textureLod(maps, a, 1.0);", "color = textureGather(map, a.xy);",
        "vec3 v = interpolateAtCentroid(a);"},
       {"color = texelFetch(map, ivec2(k, 0), 0);", "ivec2 size = textureSize(map, 0);"}},
      {"builtin",
       {"float x = round(a.x);", "vec3 v = smoothstep(a, b, a);", "float x = distance(a, b);", "float x = sign(a.x);",
        "mat3 n = inverse(m);", "float x = radians(a.x);", "bool c = isnan(a.x);", "vec3 v = fwidth(a);",
        "uint p = packHalf2x16(a.xy);", "float x = roundEven(a.x);", "vec3 v = refract(a, b, 0.5);",
        "color = unpackUnorm4x8(u);", "vec2 v = unpackHalf2x16(u);", "float x = round(k);"},
       {"float x = trunc(a.x);", "float x = ceil(a.x);", "precise float x = step(a.x, b.x);", "int i = abs(k);",
        "int i = sign(k);", "vec3 v = dFdx(a);", "int i = bitCount(k);", "uint h = floatBitsToUint(a.x);",
        "bool c = any(lessThan(a, b));"}},
      {"vector-store",
       {"vec3 v = a; v[k] = 1.0;", "mat3 n = m; n[0][k] = 1.0;", "vec3 v = a; fill(v[k]);",
        "vec3 v[2]; v[k][k] = 1.0;"},
       {"vec3 v = a; v[1] = 1.0;", "float x[3]; x[k] = 1.0;", "float x = a[k];", "vec3 v = a; v[FOUR - 2] = 1.0;",
        "vec3 v[2]; v[k].x = 1.0;", "mat3 n = m; n[k] = a;", "ivec2 i = ivec2(1); i[k]++;",
        "uvec2 i = uvec2(u); i[u & 1u] = 7u;", "bvec2 c = bvec2(true); c[k] = false;",
        "uvec2 i = uvec2(u); uint c; c = usubBorrow(u, 7u, i[k]);"}},
      {"double", {"double x;", "dvec2 v;", "color.x = float(double(k));"}, {"float x;", "int doubled = k;"}},
      {"division",
       {"int i = 4 / k;", "uint i = 3u / u;", "int i = k; i /= k;", "int i = k / -1;", "uint i = 7u % u;",
        "ivec2 i = ivec2(k) / ivec2(3, 0);", "ivec2 i = ivec2(k) / ivec2(3, k);", "int i = k / (FOUR - 4);",
        "int i = k / (2 - FOUR + 1);", "int i = k / (65536 * 65536);", "int i = k / int(4294967295u);",
        "uvec3 i = uvec3(u) / uvec3(uvec2(2, 3), 0);"},
       {"int i = k / 4;", "uint i = u % 3u;", "int i = k / FOUR;", "uint i = u / 2u;", "precise float x = a.x / b.x;",
        "ivec2 i = ivec2(k) / ivec2(3, 5);", "const ivec2 n = ivec2(3); ivec2 i = ivec2(k) / n;",
        "int i = k / (FOUR * FOUR);", "int i = k / (2 * FOUR - 1);", "uint i = u / uint(-1);",
        "uint i = u / 4294967295u;", "uvec3 i = uvec3(u) / uvec3(uvec2(2, 3), 4);"}},
      {"remainder", {"int i = k % 4;", "int i = k; i %= 3;"}, {"uint i = u % 4u;", "int i = k & 3;"}},
  };
  return table;
}

}  // namespace

TEST_CASE("every rule of the table has breaking and clean samples") {
  std::set<std::string> sampled;
  for (const Samples& row : samples()) {
    sampled.insert(row.rule);
    CHECK(!row.breaking.empty());
    CHECK(!row.clean.empty());
  }
  std::set<std::string> rules;
  for (const LintRule& rule : lint_rules()) rules.insert(std::string(rule.id));
  CHECK(sampled == rules);
}

TEST_CASE("a breaking sample is found by its rule, and by no other") {
  for (const Samples& row : samples()) {
    for (const std::string body : row.breaking) {
      CAPTURE(body);
      CHECK(rules_of(lint_body(body)) == std::string(row.rule));
    }
  }
}

TEST_CASE("a clean sample has no finding") {
  for (const Samples& row : samples()) {
    for (const std::string body : row.clean) {
      CAPTURE(body);
      const std::vector<LintFinding> findings = lint_body(body);
      for (const LintFinding& finding : findings) FAIL_CHECK(describe(finding));
    }
  }
}

TEST_CASE("a finding names file, line and operation through macros, conditionals and #line") {
  const ShaderSource source = resolve_shader("lines",
                                             "#define SCALE(x) ((x) * 0.1)\n"
                                             "in float a;\n"
                                             "invariant out vec4 color;\n"
                                             "#ifdef ABSENT\n"
                                             "float unseen() { return sin(1.0); }\n"
                                             "#endif\n"
                                             "void main() {\n"
                                             "  precise float x =\n"
                                             "      SCALE(a);\n"
                                             "#line 70 \"other.glsl\"\n"
                                             "  float y = dot(vec2(x), vec2(a));\n"
                                             "  color = vec4(y);\n"
                                             "}\n",
                                             "lines.frag");
  const std::vector<LintFinding> findings = lint(source);
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].file == "lines.frag");
  CHECK(findings[0].line == 9);
  CHECK(findings[0].rule == "literal");
  CHECK(findings[0].operation == "0.1");
  CHECK(findings[1].file == "other.glsl");
  CHECK(findings[1].line == 70);
  CHECK(findings[1].operation == "dot");
  CHECK(describe(findings[1]).rfind("other.glsl:70: dot: ", 0) == 0);
}

TEST_CASE("two operations of one expression on different lines of a function body are both found") {
  const std::vector<LintFinding> findings = lint_body("float x = sin(a.x)\n + cos(a.y);");
  CHECK(findings.size() == 3);
}

TEST_CASE("arithmetic is found in every place a statement can have it") {
  const std::string expression = "twice(a.x * b.x)";
  for (const std::string& body :
       {"if (k > 0) { } else color.x = " + expression + ";", "do { color.x = " + expression + "; } while (k > 9);",
        "for (int i = 0; i < k; ++i) { if (i == 2) continue; color.x = " + expression + "; }",
        "switch (k) { case 1: color.x = " + expression + "; break; default: break; }",
        "for (int i = 0; bool more = " + expression + " > a.x; ++i) {}", "{ { color.x = " + expression + "; } }",
        "for (float t = " + expression + "; k > 9;) {}", "color = vec4(1.0), color.x = " + expression + ";",
        "while (" + expression + " > a.x) {}"}) {
    CAPTURE(body);
    CHECK(rules_of(lint_body(body)) == "precise");
  }
  CHECK(rules_of(lint(shader_of("", "float f(float x) { return x * x; }"))) == "precise");
  CHECK(rules_of(lint(shader_of("", "float g = HALF * HALF;"))) == "constant");
}

TEST_CASE("the exact functions' min and max are found like the built-in ones") {
  const std::string include = "#include \"exact/rounding.glsl\"\n";
  CHECK(rules_of(lint(shader_of("float x = exact_min(a.x, -a.x) + 0.5;", include))) == "minmax-abs precise");
  CHECK(rules_of(lint(shader_of("float x = exact_max(a.x, -a.y);", include))) == "");
}

TEST_CASE("blocks, structures, arrays and overloads are followed") {
  const std::string before =
      "layout(std140) uniform Scene { mat4 view; vec4 light[2]; } scene;\n"
      "layout(std430) readonly buffer Values { float values[]; };\n"
      "struct Inner { vec3 v[2]; }; struct Outer { Inner inner; precise float exact; };\n"
      "int pick(int i) { return i; }\nfloat pick(float x) { return x; }\n";
  CHECK(rules_of(lint(shader_of("color = scene.view * scene.light[0];", before))) == "matrix precise");
  CHECK(rules_of(lint(shader_of("float x = values[k] + 1.0;", before))) == "precise");
  CHECK(rules_of(lint(shader_of("Outer o; float x = o.inner.v[1].y * 2.0;", before))) == "precise");
  CHECK(rules_of(lint(shader_of("int i = pick(k) * 2;", before))) == "");
  CHECK(rules_of(lint(shader_of("float x = pick(a.x) * 2.0;", before))) == "precise");
  // A variable hides the structure of its name, within its block.
  CHECK(rules_of(lint(shader_of("{ Inner i; float Inner = a.x; Inner = -Inner; } Inner j; float x = j.v[0].x * 2.0;",
                                before))) == "precise");
}

TEST_CASE("a structure hides another of its name within its own block alone, and has its own members") {
  const std::string outer = "struct T { float a, b; };\n";
  const std::string body = "T t = T(a.x, a.y); color.x = (t.a - t.b) + t.b;";
  const auto operators = [](const std::vector<LintFinding>& findings) {
    std::string list;
    for (const LintFinding& finding : findings) list += finding.operation;
    return list;
  };
  const std::string hidden = outer + "void f() { struct T { int a, b; } t; t.a = k; }\n";
  CHECK(operators(lint(shader_of(body, outer))) == "+");
  CHECK(operators(lint(shader_of(body, hidden))) == "+");
  const std::string whole = "struct T { int a; };\nvoid f() { struct T { float a; } t; t.a = 1.0; }\n";
  CHECK(rules_of(lint(shader_of("T t = T(k); int i = t.a * t.a;", whole))) == "");
  // Within a structure its name is still that of the one around.
  const std::string nested = "struct T { T inner; int a; }; T t; t.a *= 2; t.inner.a *= a.y;";
  CHECK(operators(lint(shader_of(nested, outer))) == "*=");
  // Two in blocks side by side; the zeros of members by their own positions.
  CHECK(rules_of(lint(shader_of("{ struct S { float a; } s = S(a.x); color.x = s.a; }\n"
                                "{ struct S { int b; float a; } s = S(k, 0.0); precise float x = a.x + s.a; }"))) ==
        "zero");
}

TEST_CASE("what a statement without braces declares is not seen behind it") {
  for (const std::string statement :
       {"if (k > 2) float v = a.x;", "if (k > 2) ; else float v = a.x;", "do float v = a.x; while (k > 3);",
        "while (k > 3) float v = a.x;", "for (int i = 0; i < 2; ++i) float v = a.x;"}) {
    CAPTURE(statement);
    CHECK(rules_of(lint(shader_of("int v = k; " + statement + " int i = v * v;"))) == "");
  }
}

TEST_CASE("names that begin like those of samplers and images are names") {
  const std::string before =
      "uniform vec2 image_size; uniform sampler2D image, isampler0; writeonly uniform uimage2D uimages;\n"
      "float image_at(float x) { return x; } float sampler_weight(float x) { return x; }\n";
  CHECK(rules_of(lint(shader_of("precise float x = a.x / image_size.x, iSample = a.y;\n"
                                "vec2 images[2]; images[0] = a.xy; images[0].x = iSample; color = vec4(x);\n"
                                "color = texelFetch(image, ivec2(k), 0) + texelFetch(isampler0, ivec2(k), 0);",
                                before))) == "precise");
  for (const char* call : {"image_at", "sampler_weight"})
    CHECK(rules_of(lint(shader_of("float x = " + std::string(call) + "(a.x) * b.x;", before))) == "precise");
}

TEST_CASE("qualifiers of newer versions are names in older ones") {
  for (const std::string name : {"sample", "patch", "buffer", "precise", "restrict", "readonly"}) {
    CAPTURE(name);
    const std::string text = "#version 330\nin float a; out float " + name + ";\nvoid main() {\n  " + name +
                             " = a;\n  " + name + " *= 2.0;\n}\n";
    const std::vector<LintFinding> findings = lint(resolve_shader("old", text, "old.frag"));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].line == 5);
  }
}

TEST_CASE("qualifiers of newer versions are names of blocks in older ones") {
  const std::string text =
      "#version 330\nin vec4 a; out vec4 c;\nuniform sample { float k; };\n"
      "layout(std140) uniform buffer { vec4 v; } patch;\nvoid main() {\n  c = a + patch.v;\n  c = a * k;\n}\n";
  const std::vector<LintFinding> findings = lint(resolve_shader("t", text, "t.frag"));
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].line == 6);
  CHECK(findings[1].line == 7);
}

TEST_CASE("an overload is found as GLSL's implicit conversions find it") {
  // Only a call that writes its last argument breaks a rule: it stores through a variable index.
  const auto rules = [](const std::string& overloads, const std::string& call) {
    CAPTURE(overloads);
    CAPTURE(call);
    return rules_of(lint(shader_of("vec3 v = a; ivec3 w = ivec3(k); " + call, overloads)));
  };
  for (const std::string writes_first : {"void g(float x, out float n) { n = x; } void g(vec2 x, float n) {}",
                                         "void g(vec2 x, float n) {} void g(float x, out float n) { n = x; }",
                                         "void g(float x, out float n); void g(vec2 x, float n) {}"
                                         " void g(float x, out float n) { n = x; }"}) {
    CHECK(rules(writes_first, "g(k, v[k]);") == "vector-store");
    CHECK(rules(writes_first, "g(u, v[k]);") == "vector-store");
    CHECK(rules(writes_first, "g(a.xy, v[k]);") == "");
  }
  // exact before converted, each in its own order of the text
  CHECK(rules("void g(uint x, out float n) { n = 1.0; } void g(float x, float n) {}", "g(u, v[k]);") == "vector-store");
  CHECK(rules("void g(uint x, out float n) { n = 1.0; } void g(float x, float n) {}", "g(a.x, v[k]);") == "");
  // an out argument is converted the other way round: an int does not take a float
  CHECK(rules("void g(out int n) { n = 1; } void g(float n) {}", "g(v[k]);") == "");
  CHECK(rules("void g(out int n) { n = 1; } void g(vec2 n) {}", "g(v[k]);") == "vector-store");
  CHECK(rules("void g(vec2 x, out float n) { n = 1.0; } void g(float x, inout float n) {}", "g(k, v[k]);") ==
        "vector-store");
  CHECK(rules("void g(float x, inout int n) {}", "g(k, w[k]);") == "");
  // arrays that differ in size are one type to the lint: where either overload writes, the call may
  CHECK(rules("void g(float x[2], out float n) { n = 1.0; } void g(float x[3], float n) {}",
              "g(float[3](1.0, 1.0, 1.0), v[k]);") == "vector-store");
  // the shader's own hides all built-in ones of its name
  CHECK(rules("float abs(out float n) { n = 1.0; return 2.0; }", "float x = abs(v[k]);") == "vector-store");
  CHECK(rules("float early(float n) { return abs(n); } float abs(out float n) { n = 1.0; return 2.0; }",
              "float x = early(v[k]);") == "");
}

TEST_CASE("what a function stores in a global variable may be NaN where another compares it") {
  const std::string stores = "float kept = 1.0; void keep(float x) { kept = x; }\n";
  const std::string keeps = "float kept = 1.0; void keep() { kept = 2.0; }\n";
  const std::string least = "float least(float x) { return x < kept ? x : kept; }\n";
  CHECK(rules_of(lint(shader_of("keep(a.x); color.x = least(a.y);", stores + least))) == "select-minmax");
  CHECK(rules_of(lint(shader_of("keep(a.x); color.x = least(a.y);",
                                "float kept = 1.0;" + least + "void keep(float x) { kept = x; }"))) == "select-minmax");
  CHECK(rules_of(lint(shader_of("keep(); color.x = least(a.y);", keeps + least))) == "");
}

TEST_CASE("a function header that the parser does not know is refused") {
  CHECK_THROWS_AS(lint(resolve_shader("spirv",
                                      "#version 450\n#extension GL_EXT_spirv_intrinsics : enable\n"
                                      "spirv_instruction(id = 81) float first(vec4 v);\n"
                                      "in vec4 a; out vec4 c;\nvoid main() { c = a; }\n",
                                      "spirv.frag")),
                  UserError);
}

TEST_CASE("attributes of statements are passed over") {
  CHECK(rules_of(lint(resolve_shader(
            "attributes",
            "#version 450\n#extension GL_EXT_control_flow_attributes : enable\nin vec4 a; out vec4 c;\nvoid main() {\n"
            "  c = a; [[unroll, dependency_length(4)]] for (int i = 0; i < 3; ++i) [[branch]] if (a.x > 0.0) c += a;\n"
            "}\n",
            "attributes.frag"))) == "precise");
}

TEST_CASE("declarations that declare nothing are passed over within functions too") {
  const std::string text =
      "int; const float; struct S { float x; }; in float a; out float c;\nvoid main() {\n"
      "  int; highp float; const vec2; S; struct T { int i; }; T;\n"
      "  for (int;;) { mat2; break; }\n  if (a > 1.0) float;\n  c = a * a;\n}\n";
  const std::vector<LintFinding> findings = lint(resolve_shader("empty", text, "empty.frag"));
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].line == 6);
}

TEST_CASE("the parser keeps its place through everything that GLSL allows") {
  // The last statements break rules: they are found where the parser came this far.
  const std::string text =
      "layout(origin_upper_left) in vec4 gl_FragCoord;\n"
      "struct Ray { vec3 origin, direction; float lengths[2][3]; } shared_ray;\n"
      "const struct { int a; } anonymous = { 3 };\n"
      "layout(std430, binding = 1) buffer Out { uint count; vec4 items[]; } sink[2];\n"
      "layout(rgba32f) uniform readonly highp image2D picture;\n"
      "uniform isampler2D indices; uniform samplerCubeArrayShadow shadows; uniform usampler2DArray ids[3];\n"
      "const float table[3] = float[](1.0, 2.0, 4.0);\n"
      "const vec2 nested[2] = { { 1.0, 2.0 }, { 3.0, 4.0 } };\n"
      "precise float global; in float wild; flat in ivec4 many; invariant out vec4 color;\n"
      "void nothing(void); vec2 lights_of() { return vec2(1.0); }\n"
      "Ray make(const in Ray r, inout vec3 v, out float t[2]) { t = float[2](1.0, 2.0); v.zyx = r.origin; return r; }\n"
      "void nothing(void) { return; }\n"
      "vec3 pick(vec3 v[2], int i) { return v[i]; }\n"
      "void main() {\n"
      "  int i = 0, j[2] = int[2](1, 2), k; k = i++ + --j[0];\n"
      "  Ray ray = Ray(vec3(1.0), vec3(2.0), float[2][3](float[3](1.0, 1.0, 1.0), float[3](1.0, 1.0, 1.0)));\n"
      "  float t[2]; vec3 v; ray = make(ray, v, t);\n"
      "  for (;;) { if (i > 3) break; else if (i == 2) { ++i; continue; } i += 2; }\n"
      "  for (int a = 0, b = 3; a < b; ++a, --b) ;\n"
      "  while (bool again = i < 9) { i++; if (!again) break; }\n"
      "  for (int c = 0; bool more = c < i; ++c) { if (!more) break; }\n"
      "  do i--; while (i > 0);\n"
      "  switch (i) { case 0: case 1: k = 2; break; default: { k = ~i ^ 5 | 3 & 1; } }\n"
      "  uvec2 q = uvec2(many.xy) << 3u >> uint(1); bool flag = !(i < 3 && i != 2 || k >= 1 ^^ true);\n"
      "  vec3 both[2] = vec3[](v, v.xxz); mat3 m = mat3(1.0); m[1].yz = vec2(t[0], ray.lengths[1][2]);\n"
      "  color = texelFetch(indices, ivec2(0), 0).x > 0 ? vec4(pick(both, 1), 1.0) : vec4(nested[1], lights_of());\n"
      "  atomicAdd(sink[1].count, 1u); sink[0].items[i] = imageLoad(picture, ivec2(many.x, sink[0].items.length()));\n"
      "  nothing(); ; { } i = (k = 3, k); k <<= 2; k %= 3; color.rg = color.gr; gl_FragDepth = table[i];\n"
      "  if (gl_FrontFacing) discard;\n"
      "  global = wild * wild;\n"
      "  color.x = wild * wild;\n"
      "}\n";
  const std::vector<LintFinding> findings = lint(resolve_shader("everything", text, "everything.frag"));
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].rule == "remainder");
  CHECK(findings[1].rule == "precise");
  CHECK(findings[1].line == 31);
}

TEST_CASE("a shader that is not GLSL is refused with its position") {
  CHECK_THROWS_WITH_AS(lint_body("float x = nothing;"), doctest::Contains("sample.frag:"), UserError);
}

}  // namespace twinshade

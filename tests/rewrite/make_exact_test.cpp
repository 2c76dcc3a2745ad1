// Shaders as make_exact rewrites them: nothing is left outside the dialect, or it is named; lines stay where they were.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "cpu_shaders/rewrite/exact_names.h"
#include "cpu_shaders/rewrite/make_exact.h"
#include "cpu_shaders/rewrite/probe.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {
namespace {

constexpr const char* kDeclarations = R"(
in vec3 a; in vec3 b; flat in int k; uniform mat3 m; uniform mat4 m4; uniform mat2x3 n; uniform sampler2D map;
const float HALF = 0.5; const float THIRD = 1.0 / 3.0;
struct Light { vec3 colour; float power; };
float twice(float x) { return x + x; }
void fill(out float x) { x = 1.0 + 0.0; }
layout(location = 0) out vec4 color;
)";

ShaderSource shader_of(const std::string& body, const std::string& before_main = "") {
  return resolve_shader("sample", kDeclarations + before_main + "\nvoid main() {\n" + body + "\n}\n", "sample.frag");
}

std::string left_of(const std::string& body, const std::string& before_main = "") {
  std::string list;
  for (const LintFinding& finding : make_exact(shader_of(body, before_main)).left) list += describe(finding) + "\n";
  return list;
}

// What stands between main's braces.
std::string plain_body(const ExactShader& shader) {
  const std::string& text = shader.source.text;
  const std::size_t open = text.find('{', text.find("void main")) + 1;
  std::string inside = text.substr(open, text.rfind('}') - open), plain;
  for (const char c : inside)
    if (c != ' ' && c != '\n') plain += c;
  return plain;
}

// The rewritten statement.
std::string body_of(const std::string& body, ExactScope scope = ExactScope::everything) {
  return plain_body(make_exact(shader_of(body), scope));
}

}  // namespace

TEST_CASE("operators become calls that keep grouping, operand order and implicit conversions") {
  CHECK(body_of("float x = a.x * b.x + a.y;") == "floatx=exact_add(exact_multiply(a.x,b.x),a.y);");
  CHECK(body_of("float x = (a.x + b.x) * 2.0;") == "floatx=exact_multiply((exact_add(a.x,b.x)),2.0);");
  CHECK(body_of("float x = a.x - (b.x - a.y) - 1;") ==
        "floatx=exact_subtract(exact_subtract(a.x,(exact_subtract(b.x,a.y))),float(1));");
  CHECK(body_of("float x = k / a.x;") == "floatx=exact_divide(exact_unseen(float(k),exact_zero),a.x);");
  CHECK(body_of("int i = k * 3 + 1;") == "inti=k*3+1;");
  CHECK(body_of("vec3 v = m * a;") == "vec3v=exact_multiply(m,a);");
  CHECK(body_of("bool c = a.x * b.x > 0.0;") == "boolc=exact_unseen(exact_multiply(a.x,b.x),exact_zero)>0.0;");
}

TEST_CASE("assignments that compute write their target once") {
  CHECK(body_of("float x = a.x; x += b.x;") == "floatx=a.x;x=exact_add(x,b.x);");
  CHECK(body_of("vec3 v = a; v.xy *= 2.0;") == "vec3v=a;v.xy=exact_multiply(v.xy,2.0);");
  CHECK(body_of("float x = a.x; x++;") == "floatx=a.x;x=exact_add(x,1.0);");
  CHECK(body_of("float x = a.x; float y = ++x;") == "floatx=a.x;floaty=(x=exact_add(x,1.0));");
  CHECK(body_of("float x = a.x; float y = x--;") == "floatx=a.x;floaty=exact_subtract_behind(x,1.0);");
  CHECK(body_of("float x[3]; int i = 0; x[i++] /= a.x;") == "floatx[3];inti=0;exact_divide_to(x[i++],a.x);");
  CHECK(body_of("vec3 v = a; v[k] = a.x * b.x;") == "vec3v=a;v=exact_with(v,int(k),exact_multiply(a.x,b.x));");
  CHECK(body_of("vec3 v = a; v[k] -= b.x;") == "vec3v=a;v=exact_with(v,int(k),exact_subtract(v[k],b.x));");
  CHECK(body_of("vec3 v = a; float y = (v[k] = b.x); y = v[k]++; v[k] *= 2;") ==
        "vec3v=a;floaty=(exact_with_to(v,int(k),b.x));y=exact_with_add_behind(v,int(k),1.0);"
        "v=exact_with(v,int(k),exact_multiply(v[k],float(2)));");
  CHECK(body_of("vec3 v = a; v *= m;") == "vec3v=a;v=exact_multiply(v,m);");
}

TEST_CASE("what a stored value changes of its target's index or old value is read once") {
  CHECK(body_of("vec3 v = a; int i = k; float y = (v[i] = b[i++]); v[i] = b[i++];") ==
        "vec3v=a;inti=k;floaty=(exact_with_to(v,int(i),b[i++]));exact_with_to(v,int(i),b[i++]);");
  CHECK(body_of("vec3 v = a; int i = k; v[i++] = b.x; v[i++] += b.x; v[k] -= twice(b.x);") ==
        "vec3v=a;inti=k;exact_with_to(v,int(i++),b.x);exact_with_add_to(v,int(i++),b.x);"
        "exact_with_subtract_to(v,int(k),twice(b.x));");
  CHECK(body_of("float x = a.x; x += twice(b.x); x *= (x = b.x);") ==
        "floatx=a.x;exact_add_to(x,twice(b.x));exact_multiply_to(x,(x=b.x));");
  CHECK(left_of("vec3 v = a; int i = k; color.x = (v[i++] += twice(v[i]++)); color.yzw = v;") == "");
}

TEST_CASE("a, b without parentheses gets them where it becomes an argument") {
  CHECK(body_of("float g; float x = k > 0 ? g = a.x, 2 : 3.0;").find("?exact_unseen(float((g=a.x,2)),exact_zero):") !=
        std::string::npos);
  CHECK(left_of("color.x = f(); while (g += a.x, g < 4.0) ; vec3 v = a; v[g = 0.0, k] = b.x; color.yzw = v;",
                "float g; float f() { return g = a.x, 1; }\n") == "");
}

TEST_CASE("constants are computed where both machines compute alike, and literals mean one float") {
  CHECK(body_of("const float x = 0.1 * 3.0; float y = x;") ==
        "floatx=exact_multiply(exact_unseen(0.100000001,exact_zero),exact_unseen(3.0,exact_zero));floaty=x;");
  // Constants stay where GLSL asks for one.
  CHECK(
      left_of("float t[int(W)]; t[N - 1] = a.x * W; color.x = t[0]; switch (k) { case N: color.y = float(N); }",
              "const float V = 2.0 * 2.0; const float W = V * 2.0; const int N = int(W / 2.0); uniform float u = W;\n")
          .find("sample.frag:8: *: arithmetic between constants") == 0);
  CHECK(left_of("color.x = E[k & 1] + F[0] + G[1];",
                "const float E[] = float[](0.1 * 3.0, 2.0), G[] = { 0.1 * 2.0, 1.0 };"
                "const float[] F = float[](0.1 * 3.0);") == "");
  CHECK(body_of("const ivec2 p = ivec2(a.xy * 2.0);") == "ivec2p=ivec2(exact_multiply(a.xy,2.0));");
  CHECK(body_of("const float x = 0.1; const float y = x;") == "constfloatx=0.100000001;constfloaty=x;");
  CHECK(body_of("const float x = 1.0, y = 1.0 / 3.0; const float z = x;") ==
        "floatx=1.0,y=exact_divide(exact_unseen(1.0,exact_zero),exact_unseen(3.0,exact_zero));floatz=x;");
  CHECK(body_of("float x = a.x * 2.4 + 0.5;") == "floatx=exact_add(exact_multiply(a.x,2.40000010),0.5);");
  CHECK(left_of("float x = a.x * 2.4 + 3.1;") == "");
  CHECK(body_of("float x = a.x + 0.0;") == "floatx=exact_add(a.x,exact_zero);");
  CHECK(body_of("vec3 v = vec3(0);") == "vec3v=vec3(exact_zero);");
}

TEST_CASE("what shares a `const` with a constant that sizes an array stays one, and is hidden where it is used") {
  for (const char* constants : {"const float s = 2.0, z = 0.0;", "const float z = 0.0, s = 2.0;"}) {
    const std::string text = body_of(std::string(constants) + " float x[int(s)]; float y = a.x + z;");
    CAPTURE(text);
    CHECK(text.find("constfloat") != text.npos);
    CHECK(text.find("floaty=exact_add(a.x,exact_unseen(z,exact_zero));") != text.npos);
  }
  CHECK(left_of("const float s = 2.0, x[int(s)] = float[](0.0, 1.0), z = 0.0; float y = a.x * x[1] + z;").empty());
}

TEST_CASE("no value is known to compilers, so that none can be computed to be zero, and no bit of it changes") {
  // what is computed, by what it is computed of
  CHECK(body_of("mat2 x = inverse(mat2(4.0));") ==
        "mat2x=exact_inverse(exact_diagonal_2(exact_unseen(4.0,exact_zero),exact_zero));");
  CHECK(body_of("vec2 v = vec2(sin(HALF), 1.0);") ==
        "vec2v=vec2(exact_sin(exact_unseen(HALF,exact_zero)),exact_unseen(1.0,exact_zero));");
  CHECK(body_of("float x = pow(2, HALF);") ==
        "floatx=exact_pow(exact_unseen(float(2),exact_zero),exact_unseen(HALF,exact_zero));");
  CHECK(body_of("vec2 v = unpackHalf2x16(0u);") == "vec2v=exact_unseen(unpackHalf2x16(0u),exact_zero);");
  CHECK(body_of("float x = a.x * (1.0 - 1.0);") ==
        "floatx=exact_multiply(a.x,(exact_subtract(exact_unseen(1.0,exact_zero),exact_unseen(1.0,exact_zero))));");
  CHECK(body_of("float x = 2.0; x -= 2.0;") == "floatx=exact_unseen(2.0,exact_zero);x=exact_subtract(x,2.0);");
  CHECK(body_of("float x = floor(0.5);") == "floatx=floor(exact_unseen(0.5,exact_zero));");
  // else as a whole, where something in it may be zero
  CHECK(body_of("float x = k > 0 ? 1.0 : 0.0;") == "floatx=k>0?exact_unseen(1.0,exact_zero):exact_zero;");
  CHECK(body_of("vec4 v = vec4(a, 1);") == "vec4v=exact_unseen(vec4(a,1),exact_zero);");
  CHECK(body_of("vec3 v = vec3(1.0, 0.0, 2.0);") == "vec3v=exact_unseen(vec3(1.0,0.0,2.0),exact_zero);");
  // integers are known too
  CHECK(body_of("float x = float(k - k);") == "floatx=exact_unseen(float(k-k),exact_zero);");
  CHECK(body_of("float x = float(false);") == "floatx=exact_unseen(float(false),exact_zero);");
  CHECK(body_of("const int Z = 0; vec3 v = a * Z;") ==
        "constintZ=0;vec3v=exact_multiply(a,exact_unseen(float(Z),exact_zero));");
  CHECK(body_of("float x = uintBitsToFloat(0u) + twice(0);") ==
        "floatx=exact_add(exact_unseen(uintBitsToFloat(0u),exact_zero),twice(exact_unseen(0,exact_zero)));");
  CHECK(body_of("Light l = Light(a, k);") == "Lightl=Light(a,exact_unseen(k,exact_zero));");
  // the rest of a matrix
  CHECK(body_of("mat3 x = mat3(2.0);") == "mat3x=exact_diagonal_3(exact_unseen(2.0,exact_zero),exact_zero);");
  CHECK(body_of("mat2 x = mat2(k > 0);") == "mat2x=exact_diagonal_2(exact_unseen(float(k>0),exact_zero),exact_zero);");
  CHECK(body_of("mat4 x = mat4(m);") == "mat4x=exact_unseen(mat4(m),exact_zero);");
  CHECK(body_of("mat2x3 x = mat2x3(a.x);") == "mat2x3x=exact_unseen(mat2x3(a.x),exact_zero);");
  CHECK(body_of("mat2 x = mat2(a.xy, b.xy);") == "mat2x=mat2(a.xy,b.xy);");
  // known to be other than zero, beside something unknown
  CHECK(body_of("vec3 v = vec3(1.0, -2.0, 4.0) * a;") == "vec3v=exact_multiply(vec3(1.0,-2.0,4.0),a);");
  CHECK(body_of("const float T[2] = float[](1.0, 2.0); float x = a.x * T[k];") ==
        "constfloatT[2]=float[](1.0,2.0);floatx=exact_multiply(a.x,T[k]);");
  CHECK(body_of("const float T[2] = float[](1.0, 2.0); float x = T[k] - 1.0;") ==
        "constfloatT[2]=float[](1.0,2.0);floatx=exact_subtract(exact_unseen(T[k],exact_zero),exact_unseen(1.0,exact_"
        "zero));");
  // what must stay a constant is hidden where it is used
  const std::string kept = "const float Z = 0.0; uniform float u = Z; float none() { return 0; }\n";
  CHECK(plain_body(make_exact(shader_of("float x = a.x + Z;", kept))) ==
        "floatx=exact_add(a.x,exact_unseen(Z,exact_zero));");
  CHECK(make_exact(shader_of("", kept)).source.text.find("return exact_zero ;") != std::string::npos);
  CHECK(left_of("float x = a.x + Z * none();", kept) == "");
}

TEST_CASE("compilers do not see that two values which are compared or limited have something in common") {
  CHECK(body_of("float x = a.x < b.x ? a.x : b.x;") == "floatx=exact_unseen(a.x,exact_zero)<b.x?a.x:b.x;");
  CHECK(body_of("if (1.0 > a.x) discard;") == "if(1.0>exact_unseen(a.x,exact_zero))discard;");
  CHECK(body_of("bvec3 c = lessThan(a, b); bool d = a.x == b.x;") ==
        "bvec3c=lessThan(exact_unseen(a,exact_zero),b);boold=a.x==b.x;");
  CHECK(body_of("float x = min(a.x, -a.x);") == "floatx=exact_min(exact_unseen(a.x,exact_zero),-a.x);");
  CHECK(body_of("float x = clamp(a.x, 0.5, 1.0);") == "floatx=exact_clamp(a.x,0.5,1.0);");
  CHECK(body_of("int i = min(k, -k); bool c = k < 3;") == "inti=min(k,-k);boolc=k<3;");
  CHECK(left_of("color.x = a.x < b.x ? a.x : b.x; color.y = max(abs(a.y), a.y);") == "");
}

TEST_CASE("written out are division, roots and limits alone, by component, within the files of shaders/exact/ too") {
  const ExactScope scope = ExactScope::written_out;
  CHECK(body_of("float x = a.x / b.x + a.y * 2.0;", scope) == "floatx=written_divide(a.x,b.x)+a.y*2.0;");
  CHECK(body_of("vec3 v = a / b.x; v /= 3.0;", scope) == "vec3v=written_divide(a,b.x);v=written_divide(v,3.0);");
  CHECK(body_of("float x[3]; int i = 0; x[i++] /= a.x;", scope) == "floatx[3];inti=0;written_divide_to(x[i++],a.x);");
  CHECK(body_of("vec3 v = a; v[k] /= b.x;", scope) == "vec3v=a;v[k]=written_divide(v[k],b.x);");
  CHECK(body_of("int i = k / 3; float x = 1.0 / 3.0 + sqrt(2.0);", scope) == "inti=k/3;floatx=1.0/3.0+sqrt(2.0);");
  CHECK(body_of("vec3 v = max(a, 0.0); float x = clamp(a.x, 0.0, 1.0) + min(k, 3);", scope) ==
        "vec3v=written_max(a,0.0);floatx=written_clamp(a.x,0.0,1.0)+min(k,3);");
  CHECK(body_of("mat3 x = m / a.x;", scope) == "mat3x=written_divide(m,a.x);");
  // Out of the reach of `precise` otherwise
  CHECK(body_of("precise float x = (a.x * b.x + a.y) / b.y;", scope) ==
        "precisefloatx=written_divide((written_add(written_multiply(a.x,b.x),a.y)),b.y);");
  CHECK(body_of("precise float x = a.x; x /= a.y * b.y - 1.0;", scope) ==
        "precisefloatx=a.x;x=written_divide(x,written_subtract(written_multiply(a.y,b.y),1.0));");
  CHECK(body_of("precise float x = sqrt(a.x * a.x) + a.y * b.y;", scope) ==
        "precisefloatx=written_sqrt(written_multiply(a.x,a.x))+a.y*b.y;");
  const auto unprotected = [&](const char* body) {
    const std::vector<LintFinding> left = make_exact(shader_of(body), scope).left;
    return std::count_if(left.begin(), left.end(), [](const LintFinding& f) { return f.rule == "precise"; });
  };
  for (const char* body : {"precise float x = (a.x * b.x + a.y) / b.y; color = vec4(x);",
                           "mat3 many[2]; int i = 0; many[i++] = m; many[i++] /= 2.0;"})
    CHECK(unprotected(body) == unprotected(""));
  const ShaderSource nested = resolve_shader(
      "sample", "#include \"exact/normalize.glsl\"\nin vec3 a; out vec3 r;\nvoid main() { r = exact_normalize(a); }\n",
      "sample.frag");
  const std::string text = make_exact(nested, scope).source.text;
  CHECK(text.find("written_sqrt (") != std::string::npos);
  CHECK(text.find("= written_divide(") != std::string::npos);
  CHECK(text.find("exact_normalize (") != std::string::npos);  // a name that this scope brings no function of
  CHECK(text.find("exact_normalize_name") == std::string::npos);
}

TEST_CASE("names that give way take no other name of the shader") {
  const ShaderSource source = resolve_shader("t",
                                             "#version 330\nuniform float sample; out float r;\nvoid main() {\n"
                                             "  float sample_name = 2.0;\n  r = sample / sample_name;\n}\n",
                                             "t.frag");
  const ExactShader exact = make_exact(source);
  CHECK_NOTHROW(compile_glsl(exact.source));
  CHECK(plain_body(exact).find("(sample_name_name,sample_name)") != std::string::npos);
  CHECK(path_in(exact, "sample") == "sample_name_name");
  CHECK(as_the_author_names(exact, "sample_name_name.x, sample_name") == "sample.x, sample_name");
}

TEST_CASE("a shader's own names that are those of exact functions are given way to, included ones are called") {
  const ShaderSource own = resolve_shader(
      "own",
      "in float a; out float r; uniform float exact_zero;\nfloat exact_add(float x, float y) { return x + 0.0 * y; }\n"
      "uniform float exact_scale;\nvoid main() { float exact_multiply = exact_add(a, exact_zero); r = a * "
      "exact_multiply * exact_scale; }\n",
      "own.frag");
  const ExactShader exact = make_exact(own);
  CHECK_NOTHROW(compile_glsl(exact.source));
  CHECK(plain_body(exact).find("exact_multiply_name=exact_add_name(a,exact_zero_name);") != std::string::npos);
  CHECK(exact.source.text.find("exact_scale_name") == std::string::npos);  // there is no such function
  CHECK(path_in(exact, "exact_zero") == "exact_zero_name");
  CHECK(path_in(exact, "exact_scale[2].exact_add.exact_added") == "exact_scale[2].exact_add_name.exact_added");
  const ShaderSource included = resolve_shader(
      "included", "#include \"exact/dot.glsl\"\nin vec3 a; out float r;\nvoid main() { r = exact_dot(a, a) + 1.0; }\n",
      "included.frag");
  CHECK(plain_body(make_exact(included)) == "r=exact_add(exact_dot(a,a),1.0);");
}

TEST_CASE("a file that has an exact function's name alone is made exact as any other") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "twinshade_make_exact_test";
  std::filesystem::create_directories(folder / "exact");
  std::ofstream(folder / "exact" / "dot.glsl") << "float exact_dot(vec3 a, vec3 b) { return a.x * b.x; }\n";
  const ExactShader exact = make_exact(resolve_shader("t",
                                                      "#include \"exact/dot.glsl\"\nin vec3 a; out float r;\n"
                                                      "void main() { r = exact_dot(a, a) + dot(a, a); }\n",
                                                      (folder / "t.frag").string()));
  std::filesystem::remove_all(folder);
  CHECK(plain_body(exact) == "r=exact_add(exact_dot_name(a,a),exact_dot(a,a));");
  CHECK(exact.left.empty());
}

TEST_CASE("constant structures whose members are zeros become variables") {
  for (const std::string constant :
       {"const Pair t = Pair(0, 0);", "const Pair t[2] = Pair[](Pair(1, 0), Pair(0, 0));"}) {
    const ShaderSource source =
        resolve_shader("t",
                       "struct Pair { int a; float b; };\n" + constant + "\nin float a; out float r;\n" +
                           "void main() { r = a * (t" + (constant.find('[') < 20 ? "[0]" : "") + ".b + 1.0); }\n",
                       "t.frag");
    CHECK_NOTHROW(compile_glsl(make_exact(source).source));
  }
}

TEST_CASE("members are those of the structure that is visible, not of another of its name") {
  const std::string of_floats = "struct T { float a; };\nvoid f() { struct T { int a; } t; t.a = k; }\n";
  const std::string of_ints = "struct T { int a; };\nvoid f() { struct T { float a; } t; t.a = a.x; }\n";
  const auto square = [](const std::string& before) {
    const std::string text = make_exact(shader_of("T t; color.x = float(t.a * t.a);", before)).source.text;
    return text.find("exact_multiply(", text.find("void main")) != text.npos;
  };
  CHECK(square(of_floats));
  CHECK(!square(of_ints));
}

TEST_CASE("the scope of constants leaves the rest alone") {
  CHECK(body_of("float x = a.x * (0.1 * 3.0) + 0.0;", ExactScope::constants) ==
        "floatx=a.x*(exact_multiply(0.1,3.0))+0.0;");
  CHECK(body_of("float x = sin(0.5) * sin(a.x);", ExactScope::constants) == "floatx=exact_sin(0.5)*sin(a.x);");
}

TEST_CASE("whatever arithmetic GLSL allows is brought into the exact dialect") {
  for (const std::string body : {
           "color = vec4(mix(a, b, 0.5), dot(a, b));",
           "color = vec4(normalize(a), length(b));",
           "color.xyz = cross(a, b) + reflect(a, b) + refract(a, b, 0.7) + faceforward(a, b, a);",
           "color = vec4(fract(a), mod(a.x, 0.3));",
           "color = vec4(sin(a), cos(a.x)); color.x = tan(a.y) + asin(b.x) + acos(b.y) + atan(a.z) + atan(a.x, b.x);",
           "color = vec4(pow(a, b), exp(a.x)) + exp2(a.x) + log(b.x) + log2(b.y) + inversesqrt(a.x);",
           "color = vec4(sinh(a), cosh(a.x)) * tanh(b.x);",
           "color = vec4(round(a), sign(b.x)); color.xy += roundEven(a.xy); color.x = smoothstep(0.0, 1.0, a.x);",
           "color.xyz = smoothstep(vec3(0.0), vec3(1.0), a) + smoothstep(0.1, 0.9, b) + clamp(a, 0.0, 1.0);",
           "color.xyz = max(a, 0.0) + min(a, b) + step(0.5, a) + step(a, b) + clamp(a, b, vec3(1)) + sqrt(a);",
           "color.xyz = radians(a) + degrees(b) + fma(a, b, a) + fwidth(a);",
           "color.xyz = m * a; color = m4 * vec4(a, 1.0); color.xyz += n * a.xy; color.xy += a * n;",
           "mat3 p = m * m; p *= 2.0; p += m; p = p / 2.0 - m; p = matrixCompMult(p, m); color.xyz = p[0];",
           "mat3 p = inverse(m) * determinant(m); color.xyz = p[k]; color.x += determinant(m4) + inverse(m4)[1].y;",
           "mat2 p = mat2(k > 0); mat3 q = mat3((b.x < a.x)); color.xy = p * a.xy; color.xyz += q * a + "
           "mat4(true)[1].x;",
           "mat3 p = outerProduct(a, b); mat3x2 q = transpose(n); color.xy = q * a; color.xyz += (n * q)[k];",
           "if (a.x * b.x > 0.5 && a.y + 1.0 != b.y) color.x = twice(a.x * 2.0);",
           "for (float t = 0.0; t < 1.0; t += 0.25) color.x += t * a.x;",
           "float x = a.x; while (x * x < 9.0) { x = x * 1.5 + 0.5; } color.x = x > 2 ? x * 2 : 1;",
           "float x[3] = float[](a.x * 2.0, 0.0, 1); x[k] += a.y; color.x = x[1] + x[2];",
           "Light l = Light(a * b, 1.0 - b.x); l.power *= 2.0; color = vec4(l.colour * l.power, 1);",
           "vec3 v = a; v[k] = b.x; v[k] *= 3.0; color.xyz = v; color[k] = HALF + THIRD;",
           "bvec3 n3 = isnan(a); color.x = isinf(b.x) || n3.x ? 1.0 : 0.0;",
           "int i = int(a.x * 4.0); switch (int(b.x * 2.0)) { case 0: i += 2; break; default: i = 1; } color.x = i;",
           "color = vec4(a.x * 2, 3 * a.y, a.z / 2, 1 - b.x); color -= 0.5; --color.x; color.y++;",
       }) {
    CAPTURE(body);
    std::string left;
    CHECK_NOTHROW(left = left_of(body));
    CHECK(left == "");
  }
}

TEST_CASE("what cannot be made exact is named where the author wrote it") {
  CHECK(left_of("color = texture(map, a.xy);").find("sample.frag:10: texture:") == 0);
  CHECK(left_of("uint p = packHalf2x16(a.xy); color.x = float(p);").find("sample.frag:10: packHalf2x16:") == 0);
  CHECK(left_of("vec3 v = a; fill(v[k]); color.xyz = v;").find("sample.frag:10: []:") == 0);
  CHECK(left_of("uvec2 v = uvec2(k); v[k & 1] = 7u; color.x = float(v.x);") == "");  // integers are exact
  CHECK(left_of("color.x = acosh(a.x);").find("sample.frag:10: acosh:") == 0);
  CHECK(left_of("color.x = float(k % 3);").find("sample.frag:10: %:") == 0);
  CHECK(left_of("color.x = a.x + 1e-42;").find("sample.frag:10: 1e-42:") == 0);
}

TEST_CASE("GLSL ES and older versions are rewritten as GLSL 4.50") {
  const ShaderSource es = resolve_shader("es",
                                         "#version 300 es\nprecision highp float;\nin vec2 uv;\nout vec4 color;\nvoid "
                                         "main() { color = vec4(sin(uv) * 2.0, 0.0, 1.0); }\n",
                                         "es.frag");
  const ExactShader exact = make_exact(es);
  CHECK(exact.left.empty());
  CHECK(!exact.source.es);
  CHECK(exact.source.text.find("#line 2 \"es.frag\"") != std::string::npos);
  const ShaderSource old =
      resolve_shader("old",
                     "#version 330\nin vec4 a; out vec4 c; uniform B { float s; };\n"
                     "float buffer = 2.0; void main() { float sample = s; c = a * sample * buffer; }\n",
                     "old.frag");
  CHECK(make_exact(old).left.empty());
  for (const std::string name : {"sample", "patch", "precise", "coherent", "restrict", "readonly", "writeonly"}) {
    CAPTURE(name);
    const ShaderSource named = resolve_shader("named",
                                              "#version 330\nin vec4 a; out vec4 c;\nvoid main() { vec4 " + name +
                                                  " = a; " + name + " *= 3; c = " + name + "; }\n",
                                              "named.frag");
    CHECK_NOTHROW(CHECK(make_exact(named).left.empty()));
  }
  const ShaderSource extended =
      resolve_shader("extended",
                     "#version 330\n#extension GL_ARB_gpu_shader5 : enable\n"
                     "in vec4 a; out vec4 c;\nvoid main() { precise vec4 b = a * a; c = b; }\n",
                     "extended.frag");
  CHECK_NOTHROW(CHECK(make_exact(extended).left.empty()));
  const ShaderSource buffers =
      resolve_shader("buffers",
                     "#version 330\n#extension GL_ARB_shader_storage_buffer_object : enable\nlayout(std430) buffer;\n"
                     "buffer B { vec4 b; }; in vec4 a; out vec4 c;\nvoid main() { c = a * b; }\n",
                     "buffers.frag");
  CHECK_NOTHROW(CHECK(make_exact(buffers).left.empty()));
}

TEST_CASE("functions that became built-in ones in later versions hide those") {
  const std::string body =
      "in float v; out vec4 c;\n"
      "uint bitCount(uint x) { uint n = 0u; for (; x != 0u; x &= x - 1u) ++n; return n; }\n"
      "highp vec2[2] fma(float a);\n"
      "float noise(float x) { float max3 = x; return max3; }\n"
      "void main() { c = vec4(sin(v), float(bitCount(uint(v))), fma(v)[1] * noise(v)); }\n"
      "highp vec2[2] fma(float a) { return vec2[2](vec2(a), vec2(a)); }\n";
  for (const std::string version : {"330", "300 es"}) {
    CAPTURE(version);
    const ShaderSource source =
        resolve_shader("t", "#version " + version + "\nprecision highp float;\n" + body, "t.frag");
    const ExactShader exact = make_exact(source);
    CHECK_NOTHROW(compile_glsl(exact.source));
    CHECK(exact.left.empty());
    CHECK(exact.renamed.empty());
    CHECK_NOTHROW(compile_glsl(add_probes(source).source));
    for (const ProbedStatement& statement : add_probes(source).statements)
      CHECK(statement.what.find("twinshadeprobe") == std::string::npos);
    CHECK_NOTHROW(make_exact(source, ExactScope::constants));
  }
  const ShaderSource noise = resolve_shader("t",
                                            "#version 300 es\nprecision highp float;\nin vec2 v; out vec4 c;\n"
                                            "float noise2(vec2 p) { return sin(p.x) * p.y; }\n"
                                            "void main() { c = vec4(noise2(v)); }\n",
                                            "t.frag");
  CHECK_NOTHROW(make_exact(noise));
  CHECK_NOTHROW(compile_glsl(add_probes(noise).source));
  // built in by an extension, not declared by the shader
  const ShaderSource extended = resolve_shader("t",
                                               "#version 330\n#extension GL_ARB_gpu_shader5 : enable\n"
                                               "flat in uint v; out vec4 c;\nvoid main() { c = vec4(bitCount(v)); }\n",
                                               "t.frag");
  CHECK(make_exact(extended).renamed.empty());
}

TEST_CASE("what a later version than 4.50 allows is still allowed") {
  const ShaderSource later = resolve_shader(
      "later", "#version 460 core\nout vec4 c; in float a; void main() { c = vec4(a * 2.0 + 1.0); };\n", "later.frag");
  CHECK_NOTHROW(CHECK(make_exact(later).left.empty()));
  CHECK_NOTHROW(compile_glsl(add_probes(later).source));
}

TEST_CASE("an included file that its includer's macros make what it is stays behind them") {
  const ShaderSource source = resolve_shader("t",
                                             "uniform sampler2DArray maps; in vec2 uv; out vec4 c;\n"
                                             "#define FETCHED_COLORS 3\n#include \"exact/fetch_colors.glsl\"\n"
                                             "void main() {\n  vec3 colors[FETCHED_COLORS];\n"
                                             "  exact_fetch_colors(maps, exact_taps_clamp(uv, ivec2(8)), colors);\n"
                                             "  c = vec4(colors[0] * colors[1] + colors[2], 1.0);\n}\n",
                                             "t.frag");
  const ExactShader exact = make_exact(source);
  CHECK_NOTHROW(compile_glsl(exact.source));
  CHECK(exact.left.empty());
  CHECK_NOTHROW(compile_glsl(add_probes(exact.source).source));
}

TEST_CASE("a shader that includes exact functions itself gets each once") {
  CHECK(left_of("color.x = exact_dot(a, b) + exact_length(a);", "#include \"exact/length.glsl\"\n") == "");
}

}  // namespace twinshade

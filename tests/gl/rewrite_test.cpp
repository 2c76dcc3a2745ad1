// The rewriting of a user's fragment shader, without any driver.
#include <doctest/doctest.h>

#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/rewrite/make_exact.h"
#include "cpu_shaders/source/preprocess.h"
#include "raster/gl/author_names.h"
#include "raster/gl/constant_integer.h"
#include "raster/gl/declaration.h"
#include "raster/gl/fragment_rewrite.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;
using namespace twinshade::gl;
using test::error_of;
using test::shader;

namespace {

FragmentShader globals(const std::string& text) { return rewrite_fragment_shader(shader(text), InputStyle::globals); }
FragmentShader varyings(const std::string& text) { return rewrite_fragment_shader(shader(text), InputStyle::varyings); }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Words and punctuation with single spaces, directives dropped: what a compiler sees.
std::string tokens_of(const std::string& text) {
  std::string result;
  for (const Token& token : tokenize(shader(""), text).tokens)
    if (!token.text.empty()) result += (result.empty() ? "" : " ") + token.text;
  return result;
}

std::string rejection(const std::string& text, InputStyle style = InputStyle::globals) {
  return error_of([&] { rewrite_fragment_shader(shader(text), style); });
}

const std::string kMain = "void main() {}\n";

}  // namespace

TEST_CASE("inputs with any qualifiers become globals in exact mode and keep precise") {
  const FragmentShader result = globals(
      "layout(location = 3) flat in precise highp vec3 c[9], d;\n"
      "centroid in vec2 v_uv; smooth in mat3 tbn; flat in uint tag; in uvec2 tags;\n" +
      kMain);
  CHECK(contains(tokens_of(result.text), "precise highp vec3 c [ 9 ] , d ;"));
  CHECK(contains(tokens_of(result.text), "vec2 v_uv ; mat3 tbn ; uint tag ; uvec2 tags ;"));
  REQUIRE(result.inputs.size() == 6);
  CHECK(result.inputs[0].name == "c");
  CHECK(result.inputs[0].array_length == 9);
  CHECK(result.inputs[0].interpolation == "flat");
  CHECK(result.inputs[0].rows == 3);
  CHECK(result.inputs[1].array_length == 0);
  CHECK(result.inputs[3].columns == 3);
  CHECK(result.inputs[4].scalar == Scalar::u32);
  CHECK(result.inputs[5].interpolation == "flat");
}

TEST_CASE("inputs hidden behind macros and conditionals are found") {
  const FragmentShader result = globals(
      "#define INPUT(type, name) IN type name\n#define IN in\n#define HAS_B 0\n"
      "INPUT(vec3, a); // in vec4 not_this;\n/* in vec4 nor_this; */\n"
      "#if HAS_B\nin vec3 b;\n#else\nin vec3 c;\n#endif\n" +
      kMain);
  REQUIRE(result.inputs.size() == 2);
  CHECK(result.inputs[0].name == "a");
  CHECK(result.inputs[1].name == "c");
  CHECK(!contains(tokens_of(result.text), "in vec"));
}

TEST_CASE("in and out of function parameters stay") {
  const FragmentShader result =
      globals("void f(in vec3 a, out float b, inout int c) { b = a.x; }\nout vec4 color;\nvoid main() {}\n");
  CHECK(contains(tokens_of(result.text), "void f ( in vec3 a , out float b , inout int c )"));
  CHECK(contains(tokens_of(result.text), "vec4 color ; void twinshade_user_main ( )"));
  CHECK(result.inputs.empty());
}

TEST_CASE("every line stays where it was") {
  const std::string text =
      "in vec3 a;\n\n/* two\nlines */ layout(location = 0)\n out\n vec4 color;\nfloat g = a.x,\n  h = g;\nvoid main() "
      "{ discard; }\n";
  const FragmentShader result = globals(text);
  const ShaderSource source = shader(text);
  const TokenList before = tokenize(source);
  const TokenList after = tokenize(source, result.text);
  const auto line_of = [](const TokenList& tokens, const std::string& word) {
    for (const Token& token : tokens.tokens)
      if (token.text == word) return token.line;
    return -1;
  };
  for (const char* word : {"a", "color", "g", "h", "discard"}) {
    CAPTURE(word);
    CHECK(line_of(before, word) == line_of(after, word));
  }
}

TEST_CASE("operators of more than one character stay whole where a declaration is written anew") {
  const FragmentShader result = globals("float a[1 << 2] = float[4](1.0, 2.0, 3.0, 4.0);\n" + kMain);
  CHECK(contains(tokens_of(result.text), "float a [ 1 << 2 ] ; void twinshade_initialize_0"));
  CHECK(contains(tokens_of(result.text), "twinshade_value [ 1 << 2 ] ="));
}

TEST_CASE("global initializers run after the inputs have been filled") {
  const FragmentShader result =
      globals("in float a;\nprecise float b = a * 2.0, c, d[2] = float[2](b, a);\nconst int k = 3;\n" + kMain);
  CHECK(result.initializers == std::vector<std::string>{"twinshade_initialize_0", "twinshade_initialize_1"});
  const std::string text = tokens_of(result.text);
  CHECK(contains(text,
                 "precise float b ; void twinshade_initialize_0 ( ) { precise float twinshade_value = a * 2.0 ; b = "
                 "twinshade_value ; }"));
  CHECK(contains(text, "precise float c ; precise float d [ 2 ] ; void twinshade_initialize_1"));
  CHECK(contains(text, "const int k = 3 ;"));
  CHECK(varyings("in float a;\nfloat b = a;\n" + kMain).initializers.empty());
  CHECK(contains(tokens_of(globals("precise struct S {\n  float m;\n} s = S(1.0), t;\n" + kMain).text),
                 "precise struct S { float m ; } ; precise S s ; void twinshade_initialize_0 ( ) { precise S "
                 "twinshade_value = S ( 1.0 ) ; s = twinshade_value ; } precise S t ;"));
}

TEST_CASE("built-ins of the fragment are redirected in exact mode only") {
  const std::string text =
      "out vec4 c;\nvoid main() { c = gl_FragCoord * float(gl_PrimitiveID) * float(gl_FrontFacing); }\n";
  const std::string exact = tokens_of(globals(text).text);
  CHECK(contains(exact, "twinshade_FragCoord * float ( twinshade_PrimitiveID ) * float ( twinshade_FrontFacing )"));
  CHECK(contains(tokens_of(varyings(text).text), "gl_FragCoord * float ( gl_PrimitiveID )"));
}

TEST_CASE("native mode keeps inputs, less their locations") {
  const FragmentShader result = varyings("layout(location = 2) noperspective in vec2 a;\nflat in int b;\n" + kMain);
  CHECK(contains(tokens_of(result.text), "noperspective in vec2 a ; flat in int b ;"));
  CHECK(result.inputs[0].interpolation == "noperspective");
}

TEST_CASE("outputs are known with their location, and become globals") {
  const FragmentShader result =
      globals("const int ONE = 1;\nlayout(location = ONE + 1) out uvec3 b;\nout float a;\n" + kMain);
  REQUIRE(result.outputs.size() == 2);
  CHECK(result.outputs[0].location == 2);
  CHECK(result.outputs[0].scalar == Scalar::u32);
  CHECK(result.outputs[0].components == 3);
  CHECK(result.outputs[1].location == -1);
  CHECK(!contains(tokens_of(result.text), "out "));
}

TEST_CASE("array sizes may be constant expressions") {
  const FragmentShader result = globals("#define N 3\nconst int M = N * (N - 1);\nin vec3 c[M / 2 + 1];\n" + kMain);
  CHECK(result.inputs[0].array_length == 4);
  const std::vector<Token> tokens = tokenize(shader(""), "2 * (3 + K) % 4 - 1").tokens;
  CHECK(constant_integer(tokens, 0, tokens.size(), {{"K", 6}}) == 2 * (3 + 6) % 4 - 1);
  CHECK(!constant_integer(tokens, 0, tokens.size(), {}));
  CHECK(!constant_integer(tokens, 0, 2, {}));
}

TEST_CASE("#extension lines are lifted out") {
  const FragmentShader result = globals("#extension GL_ARB_gpu_shader5 : enable\nin float a;\n" + kMain);
  CHECK(std::find(result.extensions.begin(), result.extensions.end(), "#extension GL_ARB_gpu_shader5 : enable") !=
        result.extensions.end());
  CHECK(!contains(result.text, "#extension"));
}

TEST_CASE("names that later versions made keywords are renamed in older shaders") {
  const std::string text = "#version 330\nout vec4 color;\nvoid main() { vec4 sample = vec4(1.0); color = sample; }\n";
  CHECK(contains(tokens_of(globals(text).text), "color = twinshade_name_sample ;"));
  for (const std::string word : {"coherent", "restrict", "readonly", "writeonly"})
    CHECK(contains(tokens_of(globals("#version 410\nout vec4 color;\nvoid main() { vec4 " + word +
                                     " = vec4(1.0); color = " + word + "; }\n")
                                 .text),
                   "color = twinshade_name_" + word + " ;"));
  CHECK(contains(tokens_of(globals("#version 300 es\nprecision highp float;\nout vec4 color;\n"
                                   "void main() { vec4 precise = vec4(1.0); color = precise; }\n")
                               .text),
                 "color = twinshade_name_precise ;"));
  CHECK(author_name("twinshade_name_buffer[2].twinshade_name_sample") == "buffer[2].sample");
  CHECK(author_name("a_twinshade_name_b") == "a_twinshade_name_b");
  CHECK(contains(rejection("float twinshade_name_sample;\n" + kMain), "are reserved: rename twinshade_name_sample"));
  // As names of types, and where an extension, which may make them keywords, has not done so.
  const std::string type =
      "#version 330\nuniform float sample = 2.0; out float c; struct buffer { float a; };\n"
      "buffer make(float a) { buffer b; b.a = a; return b; }\nvoid main() { buffer b = make(sample); c = b.a; }\n";
  CHECK(contains(tokens_of(globals(type).text), "twinshade_name_buffer b = make ( twinshade_name_sample ) ;"));
  CHECK(initialized_uniforms(shader(type)) == std::vector<std::string>{"sample"});
  const std::string extended =
      "#version 330\n#extension GL_ARB_gpu_shader5 : enable\n"
      "#extension GL_ARB_shader_storage_buffer_object : enable\nlayout(std430) buffer;\nout float c;\n"
      "buffer B { float b; };\nvoid main() { precise float patch = b; c = patch; }\n";
  CHECK(contains(tokens_of(globals(extended).text), "layout ( std430 ) buffer ; float c ; buffer B { float b ; } ;"));
  CHECK(contains(tokens_of(globals(extended).text), "precise float twinshade_name_patch = b ;"));
  for (const std::string version : {"330", "310 es", "320 es"})
    CHECK(contains(tokens_of(globals("#version " + version + "\nvoid main() { precise float a = 1.0; }").text),
                   "{ precise float a"));
  CHECK(contains(tokens_of(globals("#version 330\nlayout(shared) uniform B { float b; }; out float c;\n"
                                   "void main() { c = b; }\n")
                               .text),
                 "layout ( shared ) uniform B"));
  CHECK(contains(tokens_of(globals("precise out vec4 c;\nvoid main() { precise float a = 1.0; c = vec4(a); }").text),
                 "precise float a"));
}

TEST_CASE("exact attributes at the centroid and at a sample are those of the pixel") {
  const std::string text =
      "in float a; in vec2 b[2]; out vec4 c;\nvoid main() { int i = 1;\n"
      "c = vec4(interpolateAtCentroid(a), interpolateAtSample(b[i], i + 0), interpolateAtSample(a, 0)); }\n";
  CHECK(contains(tokens_of(globals("#version 450\n" + text).text), "c = vec4 ( ( a ) , ( b [ i ] ) , ( a ) ) ;"));
  const FragmentShader native = rewrite_fragment_shader(shader("#version 450\n" + text), InputStyle::varyings);
  CHECK(contains(tokens_of(native.text), "interpolateAtSample ( b [ i ] , i + 0 )"));
}

TEST_CASE("functions that hide built-in ones are renamed, in every version, and nothing else of their calls is") {
  const std::string text =
      "int bitCount(float x) { return 7; }\nfloat interpolateAtCentroid(float x) { return x; }\n"
      "float dFdxFine(float x);\nuniform float findMSB = 1.0;\nout float c;\n"
      "void main() { c = interpolateAtCentroid(float(bitCount(3))) + dFdxFine(findMSB); }\n"
      "float dFdxFine(float x) { return x; }\n";
  for (const std::string version : {"#version 330\n", "", "#version 300 es\nprecision highp float;\n"}) {
    const FragmentShader rewritten = globals(version + text);
    CHECK(contains(tokens_of(rewritten.text), "int twinshade_name_bitCount ( float x )"));
    CHECK(contains(tokens_of(rewritten.text),
                   "c = twinshade_name_interpolateAtCentroid ( float ( twinshade_name_bitCount"));
    CHECK(rewritten.derivative.empty());
  }
  // Before it is declared, the built-in one is called.
  const FragmentShader before = globals(
      "in float a;\nout float c;\nfloat f() { return dFdx(a); }\nfloat dFdx(float x) { return x; }\n"
      "void main() { c = f() + dFdx(a); }\n");
  CHECK(contains(tokens_of(before.text), "return dFdx ( a ) ;"));
  CHECK(contains(tokens_of(before.text), "c = f ( ) + twinshade_name_dFdx ( a ) ;"));
  CHECK(contains(before.derivative, ":3: dFdx"));
  CHECK(contains(rejection("in float a;\nfloat f() { return interpolateAtOffset(a, vec2(0)); }\n"
                           "float interpolateAtOffset(float x, vec2 y) { return x; }\n" +
                           kMain),
                 ":2: interpolateAtOffset needs native attributes"));
  CHECK(globals("uniform float dFdx;\nout float c;\nvoid main() { float interpolateAtSample = 1.0; "
                "c = dFdx + interpolateAtSample; }\n")
            .derivative.empty());
  CHECK(initialized_uniforms(shader("#version 330\nuniform float bitCount = 1.0;\n")) ==
        std::vector<std::string>{"bitCount"});
}

TEST_CASE("a derivative of an exact function is the author's, at the line of the call") {
  const std::string text =
      "in vec2 a;\nout vec2 c;\nvoid main() {\n  c = a * 0.5;\n  c += fwidthFine(a);\n  c += dFdx(a) + fwidth(a);\n}\n";
  const auto derivative = [](const std::string& version, const std::string& glsl) {
    return rewrite_fragment_shader(make_exact(shader(version + glsl)).source, InputStyle::rows).derivative;
  };
  CHECK(derivative("", text) == "test.frag:5: fwidthFine");
  CHECK(derivative("#version 300 es\nprecision highp float;\n",
                   "in vec2 a;\nout vec2 c;\nvoid main() {\n  c = fwidth(a) * dFdx(a);\n}\n") == "test.frag:6: fwidth");
  CHECK(derivative("", "in vec2 a;\nout vec2 c;\nvoid main() {\n  c = dFdy(a); c.x += fwidth(a.x);\n}\n") ==
        "test.frag:4: dFdy");
}

TEST_CASE("products of 64 bits go through functions that hide their factors from Mesa") {
  const std::string call =
      "void main() { uint h, l; if (true) umulExtended(3u, 1u, h, l); else umulExtended(1u, h, h, l); }\n";
  const FragmentShader result = globals(call);
  CHECK(result.extended_products);
  CHECK(contains(tokens_of(result.text), "if ( true ) twinshade_umulExtended ( 3u , 1u , h , l ) ;"));
  CHECK(contains(tokens_of(result.text), "else twinshade_umulExtended ( 1u , h , h , l ) ;"));
  CHECK(varyings(call).extended_products);
  CHECK(!globals(kMain).extended_products);
  // the author's own function, and variable
  const FragmentShader own =
      globals("void umulExtended(float a, float b) {}\nvoid main() { umulExtended(1.0, 2.0); }\n");
  CHECK(!own.extended_products);
  CHECK(contains(tokens_of(own.text), "{ twinshade_name_umulExtended ( 1.0 , 2.0 ) ; }"));
  CHECK(!globals("void main() { float umulExtended = 1.0; }\n").extended_products);
}

TEST_CASE("what the rewritten shader does is known") {
  const FragmentShader result = globals(
      "in vec2 a;\nin vec2 unused;\nout vec4 c;\nvoid main() {\n if (a.x > 0.0) discard;\n"
      " gl_FragDepth = 0.5; c = vec4(dFdx(a), a); }\n");
  CHECK(result.discards);
  CHECK(result.writes_depth);
  CHECK(result.derivative == "test.frag:6: dFdx");
  CHECK(result.inputs[0].used);
  CHECK(!result.inputs[1].used);
}

TEST_CASE("input blocks become structs, or globals where they have no name") {
  const FragmentShader shader = rewrite_fragment_shader(
      test::shader(
          "in Surface { flat ivec2 id; layout(location = 3) vec3 n[2]; } surface[2];\n"
          "in Loose { float scale; };\nout vec4 color;\nvoid main() { color = vec4(surface[1].n[0], scale); }\n"),
      InputStyle::globals);
  std::vector<std::string> names;
  for (const Input& input : shader.inputs) names.push_back(input.name);
  CHECK(names == std::vector<std::string>{"surface[0].id", "surface[0].n", "surface[1].id", "surface[1].n", "scale"});
  CHECK(shader.inputs[0].interpolation == "flat");
  CHECK(shader.inputs[1].interpolation == "");
  CHECK(shader.inputs[1].array_length == 2);
  CHECK(shader.text.find("struct Surface {") != std::string::npos);
  CHECK(shader.text.find("location") == std::string::npos);
  CHECK(shader.text.find("Loose") == std::string::npos);
}

TEST_CASE("noperspective is refused where attributes are interpolated exactly, and means nothing to values in rows") {
  const std::string text = "in B { noperspective float u; };\nout float o;\nvoid main() { o = u; }\n";
  CHECK(rejection(text) == "test.frag:1: noperspective needs native attributes: exact ones are perspective-correct");
  const FragmentShader rows = rewrite_fragment_shader(shader(text), InputStyle::rows);
  CHECK(contains(tokens_of(rows.text), "float u ; float o ;"));
  REQUIRE(rows.inputs.size() == 1);
  CHECK(rows.inputs[0].name == "u");
}

TEST_CASE("what cannot be rewritten is refused by name, file and line") {
  CHECK(rejection("\nin Block { bool a; } b;\n" + kMain) ==
        "test.frag:2: a member of type bool in an input block is not supported: use float, int, uint, vectors or "
        "matrices");
  CHECK(rejection("struct S { float a; };\nin S s;\n" + kMain) ==
        "test.frag:2: an input of type S is not supported: use float, int, uint, vectors or matrices");
  CHECK(rejection("in float a[];\n" + kMain) ==
        "test.frag:1: input a needs an array size of 1 to 1024 written as a number");
  CHECK(rejection("in float a[2][2];\n" + kMain) ==
        "test.frag:1: input a is an array of arrays, which is not supported");
  CHECK(
      contains(rejection("noperspective in float a;\n" + kMain), "test.frag:1: noperspective needs native attributes"));
  CHECK(rejection("noperspective in float a;\n" + kMain, InputStyle::varyings).empty());
  CHECK(contains(rejection("in float a;\nout vec4 c;\nvoid main() { c = vec4(interpolateAtOffset(a, vec2(0))); }\n"),
                 "test.frag:3: interpolateAtOffset needs native attributes"));
  for (const char* sample : {"i++", "i = 1", "f(i)"})
    CHECK(contains(rejection("in float a;\nout vec4 c;\nint f(int i) { return i; }\nvoid main() { int i = 0; c = "
                             "vec4(interpolateAtSample(a, " +
                             std::string(sample) + ")); }\n"),
                   "test.frag:4: interpolateAtSample needs native attributes: without them the sample may have"));
  CHECK(contains(rejection("layout(early_fragment_tests) in;\n" + kMain), "test.frag:1: layout(early_fragment_tests)"));
  CHECK(contains(rejection("layout(origin_upper_left) in vec4 gl_FragCoord;\n" + kMain),
                 "test.frag:1: gl_FragCoord with origin"));
  CHECK(contains(rejection("float twinshade_x;\n" + kMain),
                 "test.frag:1: names that begin with twinshade_ are reserved"));
  CHECK(contains(rejection("float x;\n"), "test.frag: the shader has no main()"));
  CHECK(contains(rejection("void main() { if (true) {\n"), "test.frag:1: \"{\" is never closed"));
  for (const char* nonsense :
       {"in vec3 = 4;\n", "in vec3 5;\n", "out [2];\n", ") in;\n", "in layout;\n", "struct;\n", "in;\n", ";;\n"})
    for (const InputStyle style : {InputStyle::globals, InputStyle::varyings})
      rejection(nonsense + kMain, style);  // the driver's to refuse
  CHECK(contains(rejection("#error no such mode\n" + kMain), "test.frag:1:"));
}

TEST_CASE("a shader cut off anywhere is rewritten or refused, never more") {
  const std::string text =
      "layout(location = 1 + (2)) flat in precise vec3 a[2], b;\nstruct S { float x; } s[2];\nlayout(std140) uniform U "
      "{ vec4 v; } u;\n"
      "float g = a[0].x, h[2] = float[2](g, 1.0);\nvoid f(in vec2 p[2], out int q) { q = int(p[1]); }\nout vec4 "
      "c;\nprecise c;\n"
      "void main() { for (int i = 0; i < 3; ++i) { c = vec4(h[i], gl_FragCoord.xyz); } }\n";
  int refused = 0;
  for (std::size_t length = 0; length <= text.size(); ++length)
    for (const InputStyle style : {InputStyle::globals, InputStyle::varyings}) {
      try {
        rewrite_fragment_shader(shader(text.substr(0, length)), style);
      } catch (const UserError&) {
        ++refused;
      }
    }
  CHECK(refused > 100);
  CHECK(refused < 2 * int(text.size()));
}

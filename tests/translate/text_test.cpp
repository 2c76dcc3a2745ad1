// What the generated file says: comments or #line, constants, reflection.
#include <doctest/doctest.h>

#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Translation of(const std::string& text, bool readable = true) {
  TranslateOptions options;
  options.readable = readable;
  return translate(resolve_shader("sample", text, "sample.frag"), options);
}

}  // namespace

TEST_CASE("readable text has the GLSL as comments, compiled text #line") {
  const std::string glsl = "#version 450\nin vec3 n;\nout vec4 c;\nvoid main() {\n  c = vec4(n, 1.0);\n}\n";
  const std::string readable = of(glsl).cpp, compiled = of(glsl, false).cpp;
  CHECK(has(readable, "// 5: c = vec4(n, 1.0);"));
  CHECK_FALSE(has(readable, "#line"));
  CHECK(has(readable, "c = vec4(n(), UF(1.0f));"));
  CHECK(has(compiled, "#line 5 \"sample.frag\""));
  CHECK(of(glsl).cpp == readable);
}

TEST_CASE("lines that #line of C++ does not take become ones that it does") {
  TranslateOptions compiled;
  compiled.readable = false;
  const auto text = [&](const std::string& line) {
    return translate(resolve_shader("t", "#version 450\nout float c;\n#line " + line + "\nvoid main() { c = 1.0; }\n",
                                    "t.frag"),
                     compiled)
        .cpp;
  };
  CHECK(has(text("-5"), "#line 1 \"t.frag\""));
  CHECK(has(text("2147483647"), "#line 2146483647 \"t.frag\""));
  CHECK(has(text("7"), "#line 7 \"t.frag\""));
}

TEST_CASE("a file's name may have what means something in a string of C++") {
  TranslateOptions options;
  const std::string glsl =
      "#version 450\nin vec3 n;\nout vec4 c;\nvoid main() {\n"
      "  for (float x = n.x; x < n.y; x *= n.z) c += vec4(x);\n}\n";
  options.readable = false;
  const std::string cpp = translate(resolve_shader("sample", glsl, "back\\xs.frag"), options).cpp;
  CHECK(has(cpp, "#line 5 \"back\\\\xs.frag\""));
  CHECK(has(cpp, ", \"back\\\\xs.frag:5\");"));
}

// glslang is told another version than the author's where the author's has no SPIR-V or lacks what the shader uses.
TEST_CASE("whatever version a shader is read as, __VERSION__ is the author's and newer built-ins are there") {
  const std::string body = "out vec4 c;\nvoid main() { c = vec4(float(__VERSION__)); }\n";
  for (const char* version : {"330", "440", "450", "460"})
    CHECK(has(of("#version " + std::string(version) + "\n" + body).cpp, "UF(" + std::string(version) + ".0f)"));
  for (const char* version : {"300", "310", "320"})
    CHECK(has(of("#version " + std::string(version) + " es\nprecision highp float;\n" + body).cpp,
              "UF(" + std::string(version) + ".0f)"));
  CHECK(has(of("#version 330\nout vec4 c;\nvoid main() { precise float x = float(__VERSION__); c = vec4(x); }\n").cpp,
            "UF(330.0f)"));
  const std::string newer =
      "in float x;\nout vec4 c;\nvoid main() { c = vec4(dFdxFine(x), gl_HelperInvocation, 0, 1); }\n";
  CHECK(has(of("#version 450\n" + newer).cpp, "dFdxFine"));
  CHECK(has(of(newer).cpp, "dFdxFine"));
  CHECK(has(of("#version 450\n#ifdef GL_SPIRV\n" + body + "#endif\n").cpp, "UF(450.0f)"));
}

TEST_CASE("#extension takes no behaviour that glslang cannot bear") {
  const std::string body = "in vec4 f;\nout vec4 c;\nvoid main() { precise vec4 x = f * f; c = x; }\n";
  for (const char* version : {"#version 330\n", "#version 450\n"})
    for (const char* line : {"GL_ARB_gpu_shader5 : warn", "all : warn", "all : disable", "all: disable // none",
                             "GL_ARB_gpu_shader5 : enable"}) {
      CAPTURE(line);
      CHECK(has(of(std::string(version) + "#extension " + line + "\n" + body).cpp, "x"));
    }
  CHECK(has(of("#version 330\n#define X\n#ifdef X\n#extension all : warn /* a\n b */\n#endif\n" + body).cpp, "x"));
  CHECK(has(of("#version 330\n/* as\n   #extension all : warn  does */\n" + body).cpp, "x"));
  CHECK_THROWS_WITH_AS(of("#version 330\n#extension all : require\n" + body), doctest::Contains("'all'"), UserError);
  CHECK_THROWS_WITH_AS(of("#version 330\n#extension all : disable\nout vec4 c;\nvoid main() { c = none; }\n"),
                       doctest::Contains("sample.frag:4"), UserError);
}

TEST_CASE("what a version refuses is refused, whatever earlier version accepts it") {
  const std::string uniform_location =
      "layout(location = 1) uniform float k;\nout vec4 c;\nvoid main() { c = vec4(k); }\n";
  const std::string name_buffer = "out vec4 c;\nvoid main() { float buffer = 1.0; c = vec4(buffer); }\n";
  for (const char* version : {"430", "440", "450", "460"}) {
    CHECK(has(of("#version " + std::string(version) + "\n" + uniform_location).cpp, "vec4(k)"));
    CHECK_THROWS_WITH_AS(of("#version " + std::string(version) + "\n" + name_buffer),
                         doctest::Contains("sample.frag:3"), UserError);
  }
  CHECK(has(of("#version 400\n" + name_buffer).cpp, "buffer"));
  // What core profiles lost with 420.
  const std::string varying = "varying vec2 uv;\nout vec4 c;\nvoid main() { c = uv.xyxy; }\n";
  const std::string old_function =
      "uniform sampler2D map;\nout vec4 c;\nvoid main() { c = texture2D(map, vec2(0.0)); }\n";
  for (const char* version : {"430", "450"}) {
    CHECK_THROWS_WITH_AS(of("#version " + std::string(version) + "\n" + varying), doctest::Contains("sample.frag:2"),
                         UserError);
    CHECK_THROWS_WITH_AS(of("#version " + std::string(version) + "\n" + old_function),
                         doctest::Contains("sample.frag:4"), UserError);
  }
}

TEST_CASE("expressions that are long or deep are written in parts, which compilers can take") {
  std::string sum = "a.x", nested = "a.x";
  for (int i = 0; i < 3000; ++i) sum += " + a.y";
  for (int i = 0; i < 90; ++i) nested = "(a.y * (1.0 - " + nested + "))";
  for (const std::string& value : {sum, nested}) {
    const std::string cpp = of("in vec2 a;\nout float c;\nvoid main() { c = " + value + "; }\n", false).cpp;
    int depth = 0, deepest = 0;
    std::size_t line = 0, longest = 0;
    for (const char c : cpp) {
      if (c == '(') deepest = std::max(deepest, ++depth);
      if (c == ')') --depth;
      line = c == '\n' ? 0 : line + 1;
      longest = std::max(longest, line);
    }
    CHECK(deepest < 200);
    CHECK(longest < 5000);
  }
}

TEST_CASE("functions on integers that only the latest version has are not those on floats") {
  const std::string body = "flat in ivec2 a;\nout float c;\nvoid main() { c = mix(a.x, a.y, a.x < a.y) / 2; }\n";
  CHECK(has(of("#version 450\n" + body).cpp, "/ UI(2)"));
  CHECK(has(of(body).cpp, "/ UI(2)"));
}

TEST_CASE("float constants are the bits of the binary") {
  const std::string cpp =
      of("#version 450\nin float x;\nout vec4 c;\nvoid main() { c = vec4(x * 0.1, x * 0.5, x * -3.0, x * 1e-40); }\n")
          .cpp;
  CHECK(has(cpp, "UF(0x1.99999ap-4f)"));
  CHECK(has(cpp, "UF(0.5f)"));
  CHECK(has(cpp, "UF(-3.0f)"));
  CHECK(has(cpp, "UF(0x1.16c2p-133f)"));
}

TEST_CASE("what is the same for all lanes stays uniform, and needs no masks") {
  const std::string cpp =
      of("#version 450\nin float x;\nout vec4 c;\nuniform int count;\nuniform float w[8];\nvoid main() {\n"
         "  float sum = 0.0, scale = 1.0;\n  for (int i = 0; i < count; ++i) {\n    scale *= 0.5;\n    sum += w[i] * "
         "scale * x;\n  }\n"
         "  c = vec4(sum);\n}\n")
          .cpp;
  CHECK(has(cpp, "for (UI i = UI(0); i < count; i = i + UI(1)) {"));
  CHECK(has(cpp, "UF scale = UF(1.0f);"));
  CHECK(has(cpp, "F sum = UF(0.0f);"));
  CHECK_FALSE(has(cpp, "mask"));
}

TEST_CASE("const arrays are tables under their own name, stored once") {
  const std::string cpp =
      of("#version 450\nflat in int k;\nout vec4 c;\nconst float steps[3] = float[](1.0, 2.0, 4.0);\n"
         "float at(int i) { return steps[i]; }\nvoid main() { c = vec4(at(k), at(k + 1), steps[1], 0.0); }\n")
          .cpp;
  CHECK(has(cpp, "static constexpr table<UF, 3> steps"));
  CHECK(has(cpp, "lookup(steps, "));
  CHECK(cpp.find("static constexpr table") == cpp.rfind("static constexpr table"));
}

TEST_CASE("reflection lists inputs, uniforms by path, resources and what the shader does") {
  const Reflection r = of("#version 450\nflat in ivec2 id;\nin vec3 n[2];\nlayout(location = 1) out vec2 "
                          "second;\nlayout(location = 0) out vec4 first;\n"
                          "struct Light { vec3 colour; float power; };\nuniform Light lights[2];\nuniform mat3 "
                          "frame;\nuniform sampler2D maps[2];\n"
                          "buffer Log { uint lines[]; };\n"
                          "void main() {\n  if (n[0].x < 0.0) discard;\n  first = texture(maps[0], n[1].xy) * "
                          "texture(maps[1], n[0].xy);\n"
                          "  second = vec2(lights[1].power, frame[2].y);\n  lines[id.x] = 1u;\n}\n")
                           .reflection;
  const auto named = [](const auto& all, const std::string& name) {
    for (const auto& one : all)
      if (one.name == name) return one;
    FAIL("no ", name);
    return all[0];
  };
  REQUIRE(r.inputs.size() == 2);
  CHECK(named(r.inputs, "id").flat);
  CHECK(named(r.inputs, "id").scalar == Scalar::i32);
  CHECK(named(r.inputs, "id").rows == 2);
  CHECK(named(r.inputs, "n").array_length == 2);
  CHECK(r.input_components == 8);
  CHECK(r.inputs[0].first_component == 0);
  REQUIRE(r.outputs.size() == 2);
  CHECK(named(r.outputs, "second").location == 1);
  CHECK(named(r.outputs, "first").location == 0);
  REQUIRE(r.uniforms.size() == 5);
  CHECK(r.uniforms[3].name == "lights[1].power");
  CHECK(r.uniforms[3].offset == 28);
  CHECK(r.uniforms[4].columns == 3);
  CHECK(r.uniforms[4].matrix_stride == 16);
  REQUIRE(r.resources.size() == 3);
  CHECK(r.resources[1].name == "maps[1]");
  CHECK(r.resources[1].slot == 1);
  CHECK(r.resources[2].kind == ResourceKind::storage_buffer);
  CHECK_FALSE(r.resources[2].read_only);
  CHECK(r.discards);
  CHECK(r.has_side_effects);
  CHECK_FALSE(r.uses_derivatives);
  CHECK(r.no_float64_reason.empty());
}

TEST_CASE("outputs without a location get the lowest ones that are free, in the order of declaration") {
  const auto locations = [](const std::string& outputs) {
    std::string text;
    const Reflection r = of("#version 450\n" + outputs + "\nvoid main() { b = vec4(1); a = b; }\n").reflection;
    for (const char* name : {"a", "b", "c", "d"})
      for (const auto& output : r.outputs)
        if (output.name == name) text += name + std::to_string(output.location) + " ";
    return text;
  };
  CHECK(locations("out vec4 a; out vec4 b;") == "a0 b1 ");
  CHECK(locations("layout(location = 0) out vec4 a; out vec4 b;") == "a0 b1 ");
  CHECK(locations("out vec4 b; layout(location = 0) out vec4 a;") == "a0 b1 ");
  CHECK(locations("layout(location = 1) out vec4 a; out vec4 c, b; out float d;") == "a1 b2 c0 d3 ");
  CHECK(locations("out vec4 a; layout(location = 1) out vec4 b; out vec4 c[2]; out ivec2 d;") == "a0 b1 c2 d4 ");
}

TEST_CASE("textures that are read at an input's coordinates say which") {
  struct Read {
    const char* main;
    std::string map, maps, more;  // the inputs, coordinates and layer, that each is read at
  };
  const Read reads[] = {
      {"void main() { ExactTaps t = exact_taps_repeat(uv2, textureSize(maps, 0).xy); mat2x4 m = exact_fetch_pair(maps, "
       "more, t, layer); c = m[0] + m[1]; }",
       "", "uv2 layer", "uv2 layer"},
      {"void f() { c = exact_fetch(maps, exact_taps_repeat(uv, textureSize(maps, 0).xy), layer); }\n"
       "void main() { f(); }",
       "", "uv layer", ""},
      {"void main() { c = exact_bilinear_2d_repeat(map, uv) + exact_bilinear_2d_array_repeat(maps, uv2, layer); }",
       "uv", "uv2 layer", ""},
      {"void main() { vec2 at = uv2; c = texture(map, at); }", "uv2", "", ""},
      // Clamped, all layers at once.
      {"void main() { c = exact_bilinear_2d(map, uv) + exact_bilinear_2d_array(more, uv2, layer); }", "uv", "",
       "uv2 layer"},
      {"#define FETCHED_COLORS 6\n#include \"exact/fetch_colors.glsl\"\n"
       "#define FETCHED_LAYERS 3\n#include \"exact/fetch_layers.glsl\"\n"
       "void main() { ExactTaps t = exact_taps_clamp(uv2, textureSize(maps, 0).xy); vec3 rgb[6]; vec4 rgba[3];\n"
       "  exact_fetch_colors(maps, t, rgb); exact_fetch_layers(more, t, rgba); c = vec4(rgb[5], 1) + rgba[2]; }",
       "", "uv2", "uv2"},
      {"void main() { c = exact_fetch(maps, exact_taps_clamp(uv, textureSize(maps, 0).xy), 0); }", "", "uv", ""},
      {"void main() { c = exact_fetch(maps, exact_taps_clamp(uv, textureSize(maps, 0).xy), 1); }", "", "", ""},
      // Computed, parts of an input, a layer that is no input, the sum of two taps.
      {"#define FETCHED_COLORS 6\n#include \"exact/fetch_colors.glsl\"\n"
       "void main() { ExactTaps t = exact_taps_clamp(uv2, textureSize(maps, 0).xy); vec3 rgb[6];\n"
       "  exact_fetch_colors(maps, t, t, rgb); c = vec4(rgb[5], 1); }",
       "", "", ""},
      {"void main() { c = texture(map, uv * 2.0); }", "", "", ""},
      {"void main() { c = texture(map, other.xy); }", "", "", ""},
      {"void main() { c = exact_bilinear_2d_array_repeat(maps, uv, layer + 1); }", "", "", ""},
  };
  for (const Read& read : reads) {
    CAPTURE(read.main);
    const Reflection r = of("#version 450\n#include \"exact/bilinear.glsl\"\nin vec4 other;\nin vec2 uv, uv2;\n"
                            "flat in int layer;\nuniform sampler2D map;\nuniform sampler2DArray maps, more;\n"
                            "out vec4 c;\n" +
                            std::string(read.main) + "\n")
                             .reflection;
    const auto input = [&](std::int32_t component) {
      for (const ReflectedVariable& v : r.inputs)
        if (std::int32_t(v.first_component) == component) return v.name;
      return std::string();
    };
    for (const ReflectedResource& texture : r.resources) {
      CAPTURE(texture.name);
      std::string at = input(texture.coordinates);
      if (texture.layer >= 0) at += " " + input(texture.layer);
      CHECK(at == (texture.name == "map" ? read.map : texture.name == "maps" ? read.maps : read.more));
    }
  }
}

TEST_CASE("choices between parts put together are selections, between long computations branches") {
  const auto cpp = [](const std::string& body) {
    return of("#version 450\nflat in int face;\nin vec3 p;\nout vec4 c;\n" + body + "\n").cpp;
  };
  const std::string turned = cpp(
      "vec3 turned(int f, vec3 q) {\n  return f == 0 ? vec3(-q.z, -q.y, q.x) : f == 1 ? vec3(q.z, -q.y, -q.x)\n"
      "    : f == 2 ? vec3(q.x, q.z, q.y) : f == 3 ? vec3(q.x, -q.z, -q.y) : f == 4 ? vec3(q.x, -q.y, q.z) : -q;\n}\n"
      "void main() { c = vec4(turned(face, p), 1.0); }");
  CHECK_FALSE(has(turned, "if (B mask"));
  std::string product = "p.x";
  for (int k = 0; k < 30; ++k) product += " * p.y";
  CHECK(has(cpp("void main() { c = vec4(face == 0 ? " + product + " : p.z); }"), "if (B mask"));
}

TEST_CASE("short loops whose turns are known are written out in compiled text, once for each value of the counter") {
  const auto loop = [](const std::string& head, const std::string& body, bool readable = false) {
    return of("#version 450\nin vec4 v;\nin float x;\nuniform int n;\nuniform float k[40];\nout vec4 c;\nvoid main() "
              "{\n"
              "  float sum = 0.0;\n  for (" +
                  head + ") {\n" + body + "\n  }\n  c = vec4(sum);\n}\n",
              readable)
        .cpp;
  };
  const std::string sum = "    sum += k[i] * v[i & 3];";
  const std::string up = loop("int i = 1; i < 6; i += 2", sum);
  for (const char* value : {"UI(1)", "UI(3)", "UI(5)"}) CHECK(has(up, "const UI i = " + std::string(value) + ";"));
  CHECK_FALSE(has(up, "const UI i = UI(7);"));
  CHECK_FALSE(has(up, "for (UI"));
  const std::string down = loop("uint i = 3u; i >= 1u; --i", sum);
  for (const char* value : {"UU(3u)", "UU(2u)", "UU(1u)"}) CHECK(has(down, "const UU i = " + std::string(value) + ";"));
  CHECK(has(loop("int i = 1; i < 6; i += 2", sum, true), "for (UI i = UI(1); i < UI(6); i = i + UI(2)) {"));
  // Many turns, turns that are not known, lanes that part, turns that are left out, counters that the body writes.
  for (const std::string& kept :
       {loop("int i = 0; i < 100; ++i", "    sum += k[i & 31];"), loop("int i = 0; i < n; ++i", sum),
        loop("int i = 0; i < 4; ++i", "    if (x < 0.5) break;\n" + sum),
        loop("int i = 0; i < 4; ++i", "    if (n == i) continue;\n" + sum),
        loop("int i = 0; i < 4; ++i", sum + "\n    if (n == i) ++i;"), loop("int i = 0; i < 4; ++i", "    sum += x;"),
        loop("int i = 0; i < 4; ++i, sum *= 0.5", sum),
        loop("int i = 0; i < 4; ++i", "    for (int j = 0; j < n; ++j) sum += k[i] * v[j & 3];")})
    CHECK_FALSE(has(kept, "const UI i = UI(0);"));
}

TEST_CASE("globals that are written before they are read have no value to begin with") {
  const auto global = [](const std::string& functions) {
    return of("#version 450\nin vec3 n;\nin float x;\nuniform int count;\nout vec4 c;\nvec3 g;\nvec3 a[2];\n" +
              functions)
        .cpp;
  };
  const std::string tail = "  c = vec4(g, a[1].x);\n}\n";
  CHECK_FALSE(has(global("void main() {\n  g = n;\n" + tail), "g = vec3{};"));
  CHECK(has(global("void main() {\n  g = n;\n" + tail), "a = arr<uniform_vec3, 2>{};"));
  CHECK_FALSE(has(global("void fill() { g = n; }\nvoid main() {\n  fill();\n" + tail), "g = vec3{};"));
  // Both branches write it, of uniform and of varying conditions, in functions and further in.
  for (const char* begin : {"  if (count > 1) g = n; else g = n.yzx;\n", "  if (x > 0.5) g = n; else fill();\n",
                            "  if (count > 1) { c.x = x; g = n; } else if (x > 0.5) fill(); else g = -n;\n"}) {
    CAPTURE(begin);
    CHECK_FALSE(has(global("void fill() { g = n; }\nvoid main() {\n" + std::string(begin) + tail), "g = vec3{};"));
  }
  CHECK_FALSE(has(global("void main() {\n  g = n;\n" + tail), "c = vec4{};"));  // outputs, too
  for (const char* begin :
       {"  g.x = x;\n", "  c.x = g.x;\n  g = n;\n", "  if (x > 0.5) g = n;\n", "  if (x > 0.5) discard;\n  g = n;\n",
        "  if (x > 0.5) return;\n  g = n;\n", "  g = n;\n  if (x > 0.5) return;\n",
        "  for (int i = 0; i < count; ++i) g = n;\n", "  if (count > 1) c = vec4(g, 1.0);\n  g = n;\n",
        "  if (x > 0.5) g = n; else g.x = x;\n", "  if (x > 0.5) g = n; else c.x = x;\n",
        "  if (x > 0.5) g = n; else c.x = g.y;\n", "  if (x > 0.5) { g = n; if (x > 0.7) return; } else g = -n;\n"}) {
    CAPTURE(begin);
    CHECK(has(global("void main() {\n" + std::string(begin) + tail), "g = vec3{};"));
  }
  CHECK(has(global("void main() {\n  if (x > 0.5) c = vec4(n, 1.0);\n  g = n;\n}\n"), "c = vec4{};"));
  CHECK(has(global("void fill() { if (x > 0.5) return; g = n; }\nvoid main() {\n  fill();\n" + tail), "g = vec3{};"));
  CHECK(
      has(global("void fill() { if (x > 0.5) discard; }\nvoid main() {\n  fill();\n  g = n;\n" + tail), "g = vec3{};"));
}

TEST_CASE("what is written first is found in no more time for calls in both branches, one within the other") {
  std::string text = "#version 450\nin float x;\nout vec4 c;\nvec3 g;\nvoid f0() { g = vec3(x); }\n";
  for (int i = 1; i <= 24; ++i) {
    const std::string callee = "f" + std::to_string(i - 1) + "();";
    text += "void f" + std::to_string(i) + "() { if (x > " + std::to_string(i) + ".5) " + callee + " else " + callee +
            " }\n";
  }
  const std::string cpp =
      of(text + "void main() {\n  f24();\n  c = vec4(g, 1.0);\n}\n").cpp;  // seconds, if not once for each
  CHECK_FALSE(has(cpp, "g = vec3{};"));
}

TEST_CASE("globals are passed themselves where the callee writes them, and does not know them otherwise") {
  const auto call = [](const std::string& functions, const std::string& arguments) {
    return of("#version 450\nin vec3 n;\nstruct S { vec3 a[2]; float f; };\nout vec4 c;\nvec3 g[2];\nS s;\n" +
                  functions + "void main() {\n  s.f = n.x;\n  fill(" + arguments + ");\n  c = vec4(g[1], s.f);\n}\n",
              false)
        .cpp;
  };
  CHECK(has(call("void fill(out vec3 to[2]) { to[0] = n; to[1] = n.zyx; }\n", "g"), "    fill(g);"));
  CHECK(has(call("void fill(vec3 by, out vec3 to[2]) { to[0] = n * by; to[1] = n.zyx; }\n", "n.yyy, g"), ", g);"));
  CHECK_FALSE(has(call("void fill(out vec3 to[2]) { to[0] = n; to[1] = g[0]; }\n", "g"), "    fill(g);"));
  // The structure could be the one that the variable is a part of.
  CHECK_FALSE(has(call("void fill(S by, out vec3 to[2]) { to[0] = by.a[1]; to[1] = by.a[0]; }\n", "s, g"), "s, g);"));
}

TEST_CASE("functions of shaders/exact/ that the runtime serves leave a float64 entry although they cast bits") {
  const Translation t =
      of("#version 450\n#include \"exact/exp2.glsl\"\nin float x;\nout vec4 c;\nvoid main() { c = vec4(exact_exp2(x)); "
         "}\n");
  CHECK(t.reflection.no_float64_reason.empty());
  CHECK(has(t.cpp, "if constexpr (served::has_exact_exp2<N>)"));
}

TEST_CASE("identifiers are made of any name") {
  CHECK(identifier_from("my shader-2") == "my_shader_2");
  CHECK(identifier_from("2d") == "s2d");
}

}  // namespace twinshade

#include "cpu_shaders/translate/free_names.h"

#include <doctest/doctest.h>

#include <string>

#include "base/error.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

const std::string kHead = "#version 450\nin float x; out float c;\n";

ShaderSource named_t(const std::string& text) { return resolve_shader("t", text, "t.frag"); }

// Whether the author's names were touched.
bool gets_endings(const std::string& text) {
  const ShaderSource source = named_t(text);
  return with_free_functions(source) != source.text;
}

std::string refusal_for(const std::string& text) {
  try {
    translate(named_t(text));
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("functions that hide built-in ones get an ending, however they are declared") {
  for (const char* text :
       {"float abs(float v) { return v; }", "vec2[2] abs(float v);", "#define ABS float abs(float v)\nABS;",
        "#define NAME abs\nfloat NAME(float v);", "#define OWN(name) float name(float v);\nOWN(abs)",
        "#define TYPE(t) t\nTYPE(float) abs(float v);", "#define OWN(name) float a##name(float v);\nOWN(bs)"})
    CHECK_MESSAGE(gets_endings(kHead + text + "\nvoid main() { c = abs(x); }\n"), text);
  for (const char* text :
       {"float own(float v) { return abs(v); }", "#if 0\nfloat abs(float v);\n#endif", "// float abs(float v);",
        "#define ABS float abs(float v)", "#define CALL(f) f(x)\nfloat f() { return CALL(abs); }",
        "float f() { if (x > 0.0) return abs(x); else abs(x); float distance = x; return distance; }"})
    CHECK_FALSE_MESSAGE(gets_endings(kHead + text + "\nvoid main() { c = abs(x); }\n"), text);
}

TEST_CASE("names that glslang knows and the version of GLSL ES does not are the author's, of functions and variables") {
  for (const std::string version : {"300 es", "310 es", "320 es"})
    for (const std::string use : {"float average(vec3 v) { return v.x; }\nvoid main() { c = average(vec3(x)); }\n",
                                  "uniform float average;\nvoid main() { c = x * average; }\n"})
      CHECK(refusal_for("#version " + version + "\nprecision highp float; in float x;\n" +
                        "layout(location = 0) out float c;\n" + use) == "");
  const std::string own =
      "\nprecision highp float; in float x; layout(location = 0) out float c;\n"
      "float imageLoad(float v) { return v; }\nvoid main() { c = imageLoad(x); }\n";
  CHECK(refusal_for("#version 300 es" + own) == "");
  CHECK(refusal_for("#version 310 es" + own).find("t.frag:3: 'imageLoad'") == 0);
}

TEST_CASE("translated code and reflection have the author's names of functions that hide built-in ones") {
  const std::string translated =
      translate(named_t("#version 450\nin float x; uniform Block { float roof; } b; struct S { float floor; };\n"
                        "uniform S s; out float c;\nfloat floor(float v) { return v + b.roof; }\n"
                        "float twice(float sqrt) { return floor(sqrt) + s.floor; }\nvoid main() { c = twice(x); }\n"))
          .cpp;
  CHECK_MESSAGE(translated.find("twinshade_name") == std::string::npos, translated);
  CHECK(translated.find("s.floor") != std::string::npos);
  // ES 300's own, that ES 310 has built in
  const std::string es = translate(named_t("#version 300 es\nprecision highp float; in float x; out float c;\n"
                                           "float fma(float a) { return a; }\nvoid main() { c = fma(x); }\n"))
                             .cpp;
  CHECK_MESSAGE(es.find("twinshade_name") == std::string::npos, es);
}

TEST_CASE("members may be called length, whose name translated code and messages keep") {
  const std::string cpp =
      translate(named_t(kHead + "struct Hit { float length; float list[3]; };\nuniform Block { float length; } block;\n"
                                "void main() {\n"
                                "  Hit hit;\n  hit.length = length(vec2(x, block.length));\n"
                                "  float length = hit.length;\n  c = length + float(hit.list.length());\n}\n"))
          .cpp;
  CHECK(cpp.find("block.length = load<UF>") != std::string::npos);
  CHECK(cpp.find("twinshade_name") == std::string::npos);
  const ShaderSource es = named_t(
      "#version 300 es\nprecision highp float;\nstruct Hit { float length; };\nout float c;\n"
      "void main() { Hit hit; hit.length = 1.0; c = hit.length; }\n");
  CHECK_NOTHROW(translate(es));
  CHECK(refusal_for(kHead + "void main() { float list[2]; c = list.length; }\n").find("twinshade_name") ==
        std::string::npos);
  for (const std::string text : {"c = length(vec2(x));", "float length = x;", "float l[2]; c = float(l.length());"}) {
    const ShaderSource source = named_t(kHead + "void main() { " + text + " }\n");
    CHECK(with_free_members(source) == source.text);
  }
}

TEST_CASE("calls that hidden built-in functions alone would fit are refused, at their lines and by their names") {
  const std::string reason = " : no matching overloaded function found (the shader's own ";
  CHECK(refusal_for(kHead + "int abs(int v) { return v; }\nvoid main() {\n  c = abs(x); }\n") ==
        "t.frag:5: 'abs'" + reason + "abs() hides the built-in ones: call it otherwise)");
  CHECK(refusal_for(kHead + "float max(float u, float v, float w) {\n  return max(max(u, v), w); }\n"
                            "void main() { c = max(x, 1.0, 2.0); }\n") ==
        "t.frag:4: 'max'" + reason + "max() hides the built-in ones: call it otherwise)");
  CHECK(refusal_for(kHead + "float abs(float v);\nvoid main() { c = abs(x); }\n") ==
        "t.frag:3: abs() is declared and called, but has no body");
  CHECK(
      refusal_for(kHead + "float sin(float v) {\n  return sin(v) * 2.0; }\nvoid main() { c = sin(x); }\n")
          .find("t.frag:4: sin calls itself, and GLSL has no recursion: write a loop; the calls are sin -> sin (t.") ==
      0);
  CHECK(refusal_for(kHead + "int fma(int v) { return v; }\nconst int k = fma(3);\nvoid main() { c = float(k); }\n")
            .find("t.frag:4: '=' : global const initializers must be constant") == 0);
  // variables hide functions as ever
  CHECK(refusal_for(kHead + "float sin(float v) { return v; }\nvoid main() {\n  float sin = x; c = sin(x); }\n")
            .find("t.frag:5: ") == 0);
  CHECK(refusal_for("#version 310 es\nprecision highp float; layout(location = 0) out float c;\n"
                    "float abs(float u, float v) { return u; }\nvoid main() { c = abs(1.0, 2.0); }\n")
            .find("t.frag:3: 'abs'") == 0);
}

}  // namespace twinshade

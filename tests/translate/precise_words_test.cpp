#include "cpu_shaders/translate/precise_words.h"

#include <doctest/doctest.h>

#include <string>

#include "base/error.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

std::string without(const std::string& text, bool es = false) {
  ShaderSource source;
  source.es = es;
  return without_precise(source, text);
}

// That the word goes, and every line and column stays.
void check_goes(const std::string& text) {
  const std::string made = without(text);
  CHECK(made.size() == text.size());
  CHECK_MESSAGE(made.find("precise") == std::string::npos, made);
}

}  // namespace

TEST_CASE("precise goes where it qualifies a declaration with a type, in its place, and stays elsewhere") {
  CHECK(without("a;\nprecise float x = y;\n") == "a;\n        float x = y;\n");
  for (const char* text :
       {"precise vec3 x;", "out precise vec4 c;", "void f(precise in float x) {}", "{ precise S s = t; }",
        "layout(location = 0) precise out vec4 c;", "precise layout(location = 0) out vec4 c;",
        "case 1: precise float x;", "precise float[2] x;", "for (precise float x = 0.0;;)",
        "precise /* as all */ const\nfloat x;", "precise struct { float a; } s;",
        "#define A(x) x\\\n y\nprecise float x;"})
    check_goes(text);
  for (const char* text : {"precise x;", "precise x, y;", "float precise = 1.0;", "x = precise * y;", "f(precise, x);",
                           "x = precise y z;", "// precise float x;", "/* precise float x; */",
                           "#define P precise float x\n", "#ifdef A\\\n precise float x\n#endif", "imprecise float x;"})
    CHECK(without(text) == text);
  CHECK(without("precise float x;", true) == "precise float x;");
}

TEST_CASE("precise among structs that are made from themselves does not keep glslang busy for ever") {
  const std::string begin =
      "#version 450\nstruct R { float o; float t; };\nflat in int k;\nin float x;\nout vec4 c;\n"
      "R next(float o) { return R(o, o); }\nvoid main() {\n  R r = R(1.0, 2.0), s = R(float(k), 3.0);\n";
  for (const char* statement :
       {"r = s.o < r.o ? s : r;", "r = next(r.o);", "r = r.o > 1.0 ? r : s;",
        "for (int i = 0; i < 3; ++i) r = next(r.o);", "R list[1] = R[1](r); r.t = list[0].t;"}) {
    CAPTURE(statement);
    CHECK_NOTHROW(translate(resolve_shader(
        "t", begin + statement + "\n  precise float y = r.t + 3.0 * x;\n  c = vec4(y);\n}\n", "t.frag")));
  }
}

TEST_CASE("a version that does not know precise is told so by glslang still") {
  const auto accepted = [](const std::string& text) {
    try {
      translate(resolve_shader("t", text, "t.frag"));
      return true;
    } catch (const UserError&) {
      return false;
    }
  };
  const std::string body = "in vec4 f;\nout vec4 c;\nvoid main() { precise vec4 x = f * f; c = x; }\n";
  CHECK(accepted("#version 330\n" + body));  // read as 450
  CHECK(!accepted("#version 310 es\nprecision highp float;\n" + body));
  CHECK(!accepted("#version 450\n" + body + "precise = 2;\n"));
}

}  // namespace twinshade

#include "cpu_shaders/translate/extra_semicolons.h"

#include <doctest/doctest.h>

#include <string>

#include "cpu_shaders/translate/translate.h"

namespace twinshade {

TEST_CASE("semicolons that end nothing are blanked, those of declarations stay") {
  CHECK(without_extra_semicolons("float f() { return 1.; };\nfloat a;;") == "float f() { return 1.; } \nfloat a; ");
  for (const std::string text :
       {"struct S { float a; };", "uniform B { float a; } b;", "uniform B { float a; };", "float a[2] = {1., 2.};",
        "void main() { if (true) { ; }; ; for (;;) {}; }", "void f();"})
    CHECK(without_extra_semicolons(text) == text);
}

TEST_CASE("a semicolon behind a function's body is accepted in all versions") {
  const std::string text = "out float c;\nfloat f() { return 1.0; };\nvoid main() { c = f(); };\n";
  for (const char* head : {"#version 330\n", "#version 450\n", "#version 460\n",
                           "#version 300 es\nprecision highp float;\n", "#version 310 es\nprecision highp float;\n"}) {
    CAPTURE(head);
    CHECK_NOTHROW(translate(resolve_shader("t", head + text, "t.frag")));
  }
}

}  // namespace twinshade

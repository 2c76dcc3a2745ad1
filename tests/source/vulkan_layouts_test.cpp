#include "cpu_shaders/source/vulkan_layouts.h"

#include <doctest/doctest.h>

#include <string>

using namespace twinshade;

TEST_CASE("descriptor sets and the bindings beside them leave layouts, without moving anything") {
  const auto check = [](const std::string& text, const std::string& expected) {
    CHECK(without_vulkan_layouts(text) == expected);
    CHECK(text.size() == expected.size());
  };
  check("layout(set = 0, binding = 1) uniform sampler2D a;", "                             uniform sampler2D a;");
  check("layout(binding=1, set=0, std140) uniform A", "layout(                  std140) uniform A");
  check("layout(std430, set=0) buffer A", "layout(std430       ) buffer A");
  check("layout(a=1,set=0,b=f(1,2)) x", "layout(a=1      ,b=f(1,2)) x");
  check("layout(set = 1,\n  /* set */ row_major) uniform A", "layout(        \n  /* set */ row_major) uniform A");
  check("#define BIND(s) layout(set = s, std140)\n", "#define BIND(s) layout(         std140)\n");
}

TEST_CASE("push constants are a uniform block as OpenGL lays it out") {
  CHECK(without_vulkan_layouts("layout(push_constant) uniform P") == "layout(std140       ) uniform P");
  CHECK(without_vulkan_layouts("layout(push_constant, std430) uniform P") == "layout(std140               ) uniform P");
}

TEST_CASE("layouts of OpenGL and other things called set stay as they are") {
  for (const std::string text :
       {"layout(binding = 1) uniform sampler2D set;", "layout(location = 0) out vec4 o; float set = 1.0;",
        "void set(int layout) {}", "layout(set", "// layout(set = 0) uniform A\nlayout(std140) uniform B"})
    CHECK(without_vulkan_layouts(text) == text);
}

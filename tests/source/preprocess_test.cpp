// What the preprocessor leaves, for every version that is translated.
#include "cpu_shaders/source/preprocess.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/error.h"

namespace twinshade {
namespace {

std::string preprocessed(const std::string& text, const std::string& file = "t.frag") {
  return preprocess(resolve_shader("t", text, file));
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("__VERSION__ is the author's in every version, and 450 where there is none") {
  const std::string body = "int version = __VERSION__;\n";
  for (const std::string version : {"330", "440", "450", "460"})
    CHECK(has(preprocessed("#version " + version + "\n" + body), "version = " + version));
  for (const std::string version : {"300", "310", "320"})
    CHECK(has(preprocessed("#version " + version + " es\n" + body), "version = " + version));
  CHECK(has(preprocessed(body), "version = 450"));
}

TEST_CASE("macros are expanded, conditionals decided, and comments gone") {
  const std::string text = preprocessed(
      "#define TWICE(x) ((x) + (x))\n#ifdef GL_SPIRV\nfloat a = TWICE(1.0);\n#else\n"
      "float b;\n#endif\n// gone\n");
  std::string dense = text;
  dense.erase(std::remove(dense.begin(), dense.end(), ' '), dense.end());
  CHECK(has(dense, "floata=((1.0)+(1.0));"));
  CHECK_FALSE(has(text, "float b"));
  CHECK_FALSE(has(text, "gone"));
}

TEST_CASE("lines continued by a backslash are read in versions that had none") {
  for (const std::string version : {"330", "400", "410", "420", "450", "300 es"})
    for (const std::string more : {"", "#if __VERSION__ > 200\n#endif\n"})
      CHECK(has(preprocessed("#version " + version + "\n" + more + "#define SUM(x) x + \\\n  one\nSUM(two)\n"), "two"));
  CHECK_THROWS_WITH_AS(preprocessed("#version 330\n#define SUM(x) x + \\\n  one\n#if FOO(\n#endif\n"),
                       doctest::Contains("t.frag:4: '#if'"), UserError);
}

TEST_CASE("compute shaders of versions that had none are read all the same") {
  for (const char* version : {"#version 330\n", "#version 450\n", "#version 310 es\n", ""})
    CHECK(has(preprocessed(std::string(version) + "layout(local_size_x = 4) in;\n", "t.comp"), "local_size_x"));
}

TEST_CASE("what the preprocessor rejects is named at its line") {
  CHECK_THROWS_WITH_AS(preprocessed("#version 450\nfloat a;\n#if FOO(\n#endif\n"), doctest::Contains("t.frag:3: '#if'"),
                       UserError);
}

}  // namespace twinshade

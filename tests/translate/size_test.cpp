// What a translation takes grows with the shader, not with its square or worse.
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/sanitizers.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

std::string translated(const std::string& text) { return translate(resolve_shader("large", text, "large.frag")).cpp; }

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

long most_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

const std::string kInterface = "#version 450\nin vec4 v;\nuniform float u;\nout vec4 c;\n";

// f(u, v.x, ...): the bits of `pattern` say which of ten arguments vary.
std::string call(unsigned pattern) {
  std::string text = "f(";
  for (int k = 0; k < 10; ++k) text += (k == 0 ? "" : ", ") + std::string((pattern >> k & 1) != 0 ? "v.x" : "u");
  return text + ")";
}

// 10 parameters and more than 1,000 instructions.
std::string function_of_ten() {
  std::string text = "float f(";
  for (int k = 0; k < 10; ++k) text += (k == 0 ? "float p" : ", float p") + std::to_string(k);
  text += ") {\n  float s = 0.0;\n";
  for (int k = 0; k < 160; ++k)
    text += "  s += p" + std::to_string(k % 10) + " * s + p" + std::to_string((k + 1) % 10) + ";\n";
  return text + "  return s;\n}\n";
}

}  // namespace

TEST_CASE("many variables that live across many statements take little memory") {
  constexpr int kMany = 2000;
  std::string declared, used;
  for (int k = 0; k < kMany; ++k) {
    const std::string name = "a" + std::to_string(k);
    declared += "  float " + name + " = v.x;\n";
    used += "  if (v.y > " + std::to_string(k) + ".0) " + name + " += v.z;\n";
  }
  for (int k = 0; k < kMany; ++k) used += "  s += a" + std::to_string(k) + ";\n";
  const long before = most_kilobytes();
  const std::string cpp =
      translated(kInterface + "void main() {\n  float s = 0.0;\n" + declared + used + "  c = vec4(s);\n}\n");
  CHECK(count_of(cpp, "assign(") == kMany);
  if constexpr (!kShadowMemory) CHECK(most_kilobytes() - before < 200 << 10);
}

TEST_CASE("loops within loops take no time that doubles with each") {
  std::string text = kInterface + "void main() {\n  float s = v.x;\n";
  constexpr int kDeep = 40;
  for (int k = 0; k < kDeep; ++k) text += "while (s < v.y) { s += v.z;\n";
  for (int k = 0; k < kDeep; ++k) text += "}\n";
  CHECK(count_of(translated(text + "  c = vec4(s);\n}\n"), "while (") == kDeep);
}

TEST_CASE("a function is written for each pattern of varying arguments, until there are too many") {
  std::string few, many;
  for (unsigned pattern = 0; pattern < 1024; ++pattern)
    (pattern < 8 ? few : many) += "  s += " + call(pattern) + " + " + call(pattern) + ";\n";
  const auto shader = [](const std::string& body) {
    return kInterface + function_of_ten() + "void main() {\n  float s = 0.0;\n" + body + "  c = vec4(s);\n}\n";
  };
  CHECK(count_of(translated(shader(few)), "_APART ") == 8);
  CHECK_THROWS_WITH_AS(translated(shader(few + many)),
                       doctest::Contains("large.frag:5: f() and others are called with"), UserError);
}

}  // namespace twinshade

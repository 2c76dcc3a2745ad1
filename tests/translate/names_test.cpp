// No name of a shader's own stands for what generated code means by it.
#include "cpu_shaders/translate/names.h"

#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

// Words of the class that stand by themselves: no members of something else (a.b, a::b), no text of literals.
std::set<std::string> unqualified_words(const std::string& cpp) {
  const std::size_t begin = cpp.find("template <class N>"), end = cpp.find("\n};\n", begin);
  std::string text = std::regex_replace(cpp.substr(begin, end - begin), std::regex("#line[^\n]*"), "");
  text = std::regex_replace(text, std::regex("\"[^\"]*\""), "");
  std::set<std::string> words;
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t last = at;
    while (last < text.size() && is_word(text[last])) ++last;
    const bool qualified = at > 0 && (text[at - 1] == '.' || text[at - 1] == ':');
    if (last > at && !qualified && !std::isdigit(static_cast<unsigned char>(text[at])))
      words.insert(text.substr(at, last - at));
    at = std::max(last, at + 1);
  }
  return words;
}

// Declared among the shader's own names, or where those do not reach; and GLSL's own types.
bool is_declared(const std::string& word) {
  static const std::regex declared(
      "(t|c|mask|here|element|again|selector|result|choice|argument|constants|i)[0-9]*_?|value|a|b|mat[234]x[234]|"
      "uniform_.*|.*_(of|values)");
  return std::regex_match(word, declared);
}

const char* const kComputing = R"(#version 450
layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Numbers { uint numbers[]; };
shared int sums[8];
void main() {
  uint at = gl_GlobalInvocationID.x + gl_LocalInvocationID.x + gl_NumWorkGroups.x + gl_WorkGroupID.x;
  sums[gl_LocalInvocationIndex] = 1;
  barrier();
  atomicAdd(numbers[0], 1u); atomicMin(numbers[0], 1u); atomicMax(numbers[0], 1u); atomicAnd(numbers[0], 1u);
  atomicOr(numbers[0], 1u); atomicXor(numbers[0], 1u); atomicExchange(numbers[0], 1u);
  atomicCompSwap(numbers[0], 1u, at);
  for (uint k = 0u; k < at; k++) numbers[k] = uint(sums[k % 8u]) + uint(numbers.length());
}
)";

}  // namespace

TEST_CASE("what generated code says without a qualifier is the name of nothing in a shader") {
  std::vector<ShaderSource> sources = {resolve_shader("computing", kComputing, "computing.comp")};
  const std::string folder = std::string(TWINSHADE_SOURCE_DIR) + "/tests/translate/shaders";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    sources.push_back(load_shader(entry.path().string(), {{std::string(TWINSHADE_SOURCE_DIR) + "/shaders"}}));
  CHECK(sources.size() > 8);
  for (const ShaderSource& source : sources) {
    CAPTURE(source.name);
    for (const std::string& word : unqualified_words(translate(source).cpp)) {
      const std::string in_glsl = word.substr(0, word.find_last_not_of("_0123456789") + 1);
      const bool own = std::regex_search(source.text, std::regex("\\b(" + word + "|" + in_glsl + ")\\b"));
      if (own || is_declared(word)) continue;
      CAPTURE(word);
      CHECK(spirv::NameTable().declare(word) != word);
    }
  }
}

TEST_CASE("names that the translator makes keep clear of a shader's and of macros'") {
  spirv::NameTable names;
  CHECK(names.declare("uniform_S") == "uniform_S_");
  CHECK(names.declare_own("uniform_S") == "uniform_S");
  CHECK(names.declare_own("uniform_S") == "uniform_S_2");
  CHECK(names.declare("S_") == "S_");
  CHECK(names.declare("S_") == "S_2");
  for (const char* name : {"INT_WIDTH", "linux", "typeof", "TWINSHADE_ISA_NUMBER_avx2"})
    CHECK(names.declare(name) == std::string(name) + "_");
}

}  // namespace twinshade

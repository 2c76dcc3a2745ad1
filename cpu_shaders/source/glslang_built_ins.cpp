// glslang makes an object of its class TBuiltIns for each version, asks it for the text of all declarations and parses
// that. The linker is told to call `__wrap_...` below where glslang's own code calls that class' constructor
// (-Wl,--wrap, in CMakeLists.txt): what is made there is of a class derived from it, which shortens the text. Were the
// linker not told, all would work as ever and take longer.
//
// Compiled without type information, as Debian's glslang is: there is none of the base class to refer to.
#include "cpu_shaders/source/glslang_built_ins.h"

#include <glslang/Include/Common.h>
#include <glslang/Include/PoolAlloc.h>
#include <glslang/Include/intermediate.h>
#include <glslang/MachineIndependent/Initialize.h>
#include <glslang/MachineIndependent/SymbolTable.h>
#include <glslang/MachineIndependent/Versions.h>
#include <glslang/Public/ShaderLang.h>

#include <algorithm>
#include <iterator>
#include <new>

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

// Atomic functions with a scope, storage classes and semantics (GL_KHR_memory_scope_semantics).
bool is_of_scope(std::string_view function, std::string_view declaration) {
  return function.find("tomic") != function.npos && ends_with(declaration, ", int, int, int);");
}

// float16_t, f16vec2, f16sampler2D, int64_t, u8vec4, i64image2D and so on. (Types of 32 bits by such names are the
// usual ones.)
bool is_of_other_width(std::string_view type) {
  if (ends_with(type, "_t")) return ends_with(type, "8_t") || ends_with(type, "16_t") || ends_with(type, "64_t");
  if (type.size() < 3 || (type[0] != 'f' && type[0] != 'i' && type[0] != 'u')) return false;
  const std::string_view width = type.substr(1);
  return width[0] == '8' || starts_with(width, "16") || starts_with(width, "64");
}

// Empty where no word is, as at npos.
std::string_view word_around(std::string_view text, std::size_t at) {
  std::size_t start = std::min(at, text.size()), end = start;
  while (start > 0 && is_word_character(text[start - 1])) --start;
  while (end < text.size() && is_word_character(text[end])) ++end;
  return text.substr(start, end - start);
}

// `declaration` ends at its semicolon: a function's, or a part of a block's.
bool is_left_out_declaration(std::string_view declaration) {
  const std::size_t bracket = declaration.find('(');
  if (bracket == declaration.npos || bracket == 0) return false;
  const std::string_view function = word_around(declaration, declaration.find_last_not_of(' ', bracket - 1));
  if (is_left_out(function) || is_of_scope(function, declaration)) return true;
  for (const char digit : {'6', '8'})
    for (std::size_t at = declaration.find(digit); at != declaration.npos; at = declaration.find(digit, at + 1))
      if (is_of_other_width(word_around(declaration, at))) return true;
  return false;
}

void leave_out(glslang::TString& declarations) {
  glslang::TString kept;
  kept.reserve(declarations.size());
  const std::string_view text(declarations.data(), declarations.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size() - 1) + 1;
    const std::string_view declaration = text.substr(at, end - at);
    if (!is_left_out_declaration(declaration)) kept.append(declaration.data(), declaration.size());
    at = end;
  }
  declarations.swap(kept);
}

// No other stage is ever compiled.
bool is_compiled(EShLanguage stage) { return stage == EShLangFragment || stage == EShLangCompute; }

class ShortBuiltIns final : public glslang::TBuiltIns {
 public:
  void initialize(int version, EProfile profile, const glslang::SpvVersion& spirv) override {
    TBuiltIns::initialize(version, profile, spirv);
    leave_out(commonBuiltins);
    for (int stage = 0; stage < EShLangCount; ++stage)
      if (is_compiled(static_cast<EShLanguage>(stage)))
        leave_out(stageBuiltins[stage]);
      else
        stageBuiltins[stage].clear();
  }

  void identifyBuiltIns(int version, EProfile profile, const glslang::SpvVersion& spirv, EShLanguage stage,
                        glslang::TSymbolTable& table) override {
    if (is_compiled(stage)) TBuiltIns::identifyBuiltIns(version, profile, spirv, stage, table);
  }

  using TBuiltIns::identifyBuiltIns;
  using TBuiltIns::initialize;
};
static_assert(sizeof(ShortBuiltIns) == sizeof(glslang::TBuiltIns), "made in the memory of the other");

}  // namespace

bool is_left_out(std::string_view function) {
  constexpr std::string_view kStarts[] = {"subgroup", "sparse"}, kEnds[] = {"ARB", "AMD", "NV", "EXT"};
  return std::any_of(std::begin(kStarts), std::end(kStarts),
                     [&](auto start) { return starts_with(function, start); }) ||
         std::any_of(std::begin(kEnds), std::end(kEnds), [&](auto end) { return ends_with(function, end); });
}

}  // namespace twinshade

// The constructor's name as the linker knows it, after its prefix. Derived classes call another symbol of it (C2).
extern "C" void __wrap__ZN7glslang9TBuiltInsC1Ev(void* memory);
extern "C" void __wrap__ZN7glslang9TBuiltInsC1Ev(void* memory) { ::new (memory) twinshade::ShortBuiltIns; }

#include "cpu_shaders/source/hidden_built_ins.h"

#include <doctest/doctest.h>
#include <glslang/Include/Common.h>
#include <glslang/Include/PoolAlloc.h>
#include <glslang/MachineIndependent/Initialize.h>

#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cpu_shaders/source/glslang_environment.h"

using namespace twinshade;

namespace {

// The text, whose words and symbols stand apart, with those that are told in brackets.
std::string marked(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  const std::vector<std::string_view> pieces(words.begin(), words.end());
  for (const std::size_t place : names_of_hiding_functions(pieces)) words[place] = "[" + words[place] + "]";
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : " ") + word;
  return result;
}

}  // namespace

TEST_CASE("a function of a built-in one's name is told wherever it is named, from its declaration on") {
  CHECK(marked("float f ( float v ) { return abs ( v ) ; } float abs ( int v ) ; void main ( ) { c = abs ( 1 ) ; }") ==
        "float f ( float v ) { return abs ( v ) ; } float [abs] ( int v ) ; void main ( ) { c = [abs] ( 1 ) ; }");
  CHECK(marked("vec2 [ 2 ] abs ( int v ) { return abs ( v ) ; }") ==
        "vec2 [ 2 ] [abs] ( int v ) { return [abs] ( v ) ; }");
  for (const char* text : {"float own ( float v ) { return abs ( v ) ; }", "float a = abs ( 1.0 ) ;",
                           "void f ( ) { float abs = 1.0 ; return abs ( 2.0 ) ; }", "uniform float abs ;"})
    CHECK(marked(text) == text);
}

TEST_CASE("variables and members of a hiding function's name go with it, methods do not") {
  CHECK(marked("struct S { int length ; } ; float length ( S s ) { return s . length ; }") ==
        "struct S { int [length] ; } ; float [length] ( S s ) { return s . [length] ; }");
  CHECK(marked("int length ( int v ) ; int f ( ) { return list . length ( ) + length ( 1 ) ; }") ==
        "int [length] ( int v ) ; int f ( ) { return list . length ( ) + [length] ( 1 ) ; }");
}

TEST_CASE("all functions that glslang has built in are known") {
  start_glslang();
  glslang::TPoolAllocator pool;
  glslang::TPoolAllocator& before = glslang::GetThreadPoolAllocator();
  glslang::SetThreadPoolAllocator(&pool);
  {
    // As glslang makes it: of a class that leaves out what is of extensions (glslang_built_ins.h).
    const std::unique_ptr<glslang::TBuiltInParseables> built_ins(new glslang::TBuiltIns);
    glslang::TBuiltInParseables* volatile made = built_ins.get();
    glslang::SpvVersion spirv;
    spirv.spv = 0x10000;
    spirv.openGl = 100;
    made->initialize(460, ECoreProfile, spirv);
    std::string text = made->getCommonString().c_str();
    for (const EShLanguage stage : {EShLangFragment, EShLangCompute}) text += made->getStageString(stage).c_str();
    const std::regex declaration(R"(\w+ (\w+) ?\()");
    std::size_t count = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at, ++count)
      CHECK_MESSAGE(is_built_in_function((*at)[1].str()), (*at)[1].str());
    CHECK(count > 1000);
  }
  glslang::SetThreadPoolAllocator(&before);
  CHECK(is_built_in_function("abs"));
  CHECK(is_built_in_function("usubBorrow"));
  CHECK_FALSE(is_built_in_function("ab"));
  CHECK_FALSE(is_built_in_function(""));
}

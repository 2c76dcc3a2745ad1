#include "cpu_shaders/translate/constant_initializers.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/source/glsl_pieces.h"

namespace twinshade {
namespace {

constexpr std::string_view kNotFolded =
    "sinh cosh tanh asinh acosh atanh transpose inverse determinant matrixCompMult outerProduct fma ldexp frexp mix "
    "bitfieldExtract bitfieldInsert "
    "bitfieldReverse bitCount findLSB findMSB floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat "
    "packUnorm2x16 packSnorm2x16 packUnorm4x8 packSnorm4x8 packHalf2x16 unpackUnorm2x16 unpackSnorm2x16 "
    "unpackUnorm4x8 unpackSnorm4x8 unpackHalf2x16 packDouble2x32 unpackDouble2x32";

using Pieces = std::vector<std::string_view>;

// Names that a declaration gives values: those before its outermost "=".
std::vector<std::string_view> names_of(const Pieces& pieces, std::size_t first, std::size_t end) {
  std::vector<std::string_view> names;
  std::string_view word;
  int depth = 0;
  for (std::size_t i = first; i < end; ++i) {
    const char c = pieces[i][0];
    depth += (c == '(' || c == '[' || c == '{') - (c == ')' || c == ']' || c == '}');
    if (depth == 0 && is_word_character(c)) word = pieces[i];
    if (depth == 0 && c == '=') names.push_back(word);
  }
  return names;
}

}  // namespace

bool is_about_constant_initializer(const std::string& complaint) {
  return complaint.find("global const initializers must be constant") != std::string::npos;
}

std::string with_computed_constants(std::string text) {
  const std::string original = text;
  const Pieces pieces = pieces_of(original);
  std::set<std::string_view> computed;
  int depth = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const char c = pieces[i][0];
    depth += (c == '(' || c == '{') - (c == ')' || c == '}');
    if (depth != 0 || pieces[i] != "const") continue;
    const std::size_t end =
        std::size_t(std::find(pieces.begin() + std::ptrdiff_t(i), pieces.end(), ";") - pieces.begin());
    bool is_computed = false;
    for (std::size_t k = i; k < end; ++k)
      is_computed |= computed.count(pieces[k]) != 0 ||
                     (k + 1 < end && pieces[k + 1] == "(" && find_word(kNotFolded, pieces[k]) != kNotFolded.npos);
    if (!is_computed) continue;
    text.replace(std::size_t(pieces[i].data() - original.data()), pieces[i].size(), pieces[i].size(), ' ');
    for (const std::string_view name : names_of(pieces, i, end)) computed.insert(name);
  }
  return text;
}

}  // namespace twinshade

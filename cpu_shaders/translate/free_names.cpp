#include "cpu_shaders/translate/free_names.h"

#include <glslang/SPIRV/spirv.hpp>

#include <algorithm>
#include <array>
#include <regex>
#include <string_view>
#include <vector>

#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/source/glsl_pieces.h"
#include "cpu_shaders/source/hidden_built_ins.h"
#include "cpu_shaders/source/preprocess.h"

namespace twinshade {
namespace {

constexpr std::string_view kEnding = "_twinshade_name";

// Of extensions that have no GLSL ES; glslang knows them in every version.
constexpr std::string_view kOfNoEs =
    "absoluteDifference addSaturate average averageRounded controlBarrier countLeadingZeros countTrailingZeros "
    "multiply32x16 subtractSaturate texelGradFetch texelGradFetchOffset texelProjFetch texelProjFetchOffset "
    "texelProjGradFetch";

constexpr std::string_view kNotOfEs300 =
    "atomicAdd atomicAnd atomicCompSwap atomicCounter atomicCounterDecrement atomicCounterIncrement atomicExchange "
    "atomicMax atomicMin atomicOr atomicXor bitCount bitfieldExtract bitfieldInsert bitfieldReverse buffer findLSB "
    "findMSB fma frexp imageAtomicAdd imageAtomicAnd imageAtomicCompSwap imageAtomicExchange imageAtomicMax "
    "imageAtomicMin imageAtomicOr imageAtomicXor imageLoad imageSize imageStore imulExtended ldexp memoryBarrier "
    "memoryBarrierAtomicCounter memoryBarrierBuffer memoryBarrierImage packSnorm4x8 packUnorm4x8 precise "
    "textureGather textureGatherOffset textureGatherOffsets uaddCarry umulExtended unpackSnorm4x8 unpackUnorm4x8 "
    "usubBorrow";

std::vector<std::string_view> names_free_in_es(int version) {
  std::vector<std::string_view> names = pieces_of(kOfNoEs);
  const std::vector<std::string_view> later = pieces_of(kNotOfEs300);
  if (version < 310) names.insert(names.end(), later.begin(), later.end());
  return names;
}

// Where the ending next stands as one, from `from` on.
std::size_t find_ending(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find(kEnding, from); at != text.npos; at = text.find(kEnding, at + 1)) {
    const std::size_t end = at + kEnding.size();
    if (end == text.size() || !is_word_character(text[end])) return at;
  }
  return text.npos;
}

// Whether the text, before it is preprocessed, may declare a function of a built-in one's name: as it stands, or by a
// macro that it is an argument of, stands in or gives the type.
bool may_hide_built_ins(std::string text) {
  const bool has_macros = find_word(text, "define") != text.npos;
  if (has_macros && text.find("##") != text.npos) return true;
  std::replace(text.begin(), text.end(), '#', ' ');  // directives count
  const std::vector<std::string_view> pieces = pieces_of(text);
  for (std::size_t i = 1; i + 1 < pieces.size(); ++i) {
    const std::string_view before = pieces[i - 1];
    const bool behind_word =
        is_word_character(before[0]) && before != "return" && before != "else" && before != "do" && before != "case";
    const bool is_called = pieces[i + 1] == "(";
    const bool is_declared = is_called && (behind_word || before == "]");
    const bool may_be_by_macro = has_macros && (!is_called || before == ")");
    if ((is_declared || may_be_by_macro) && is_built_in_function(pieces[i])) return true;
  }
  return false;
}

// Whether a piece is the name `length`, of no function and no method.
bool is_length(const std::vector<std::string_view>& pieces, std::size_t i) {
  return pieces[i] == "length" && !(i + 1 < pieces.size() && pieces[i + 1] == "(");
}

bool reads_member_length(const std::vector<std::string_view>& pieces) {
  for (std::size_t i = 1; i < pieces.size(); ++i)
    if (pieces[i - 1] == "." && is_length(pieces, i)) return true;
  return false;
}

}  // namespace

std::string with_free_names_of_es(const ShaderSource& source) {
  const std::vector<std::string_view> candidates = names_free_in_es(source.version);
  const auto stands_in = [](std::string_view text) {
    return [text](std::string_view name) { return find_word(text, name) != text.npos; };
  };
  if (std::none_of(candidates.begin(), candidates.end(), stands_in(source.text))) return source.text;
  const std::string text = preprocess(source);
  constexpr std::array kMakePreciseAKeyword = {"_gpu_shader5", "GL_ANDROID_extension_pack_es31a"};  // extensions
  const bool precise_is_keyword = std::any_of(kMakePreciseAKeyword.begin(), kMakePreciseAKeyword.end(),
                                              [&](const char* extension) { return text.find(extension) != text.npos; });
  std::string defines;
  for (const std::string_view name : candidates)
    if (stands_in(text)(name) && !(name == "precise" && precise_is_keyword))
      defines.append("#define ").append(name).append(" ").append(name).append(kEnding).append("\n");
  const std::size_t version_end = text.find('\n') + 1;
  return text.substr(0, version_end) + defines + text.substr(version_end);
}

std::string with_free_functions(const ShaderSource& source) {
  if (!may_hide_built_ins(source.text)) return source.text;
  const std::string original = preprocess(source);
  std::string text = original;
  const std::vector<std::string_view> pieces = pieces_of(original);
  const std::vector<std::size_t> places = names_of_hiding_functions(pieces);
  if (places.empty()) return source.text;
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    const std::string_view name = pieces[*place];
    text.insert(std::size_t(name.data() - original.data()) + name.size(), kEnding);
  }
  return text;
}

std::string with_free_members(const ShaderSource& source) {
  std::string readable = source.text;
  std::replace(readable.begin(), readable.end(), '#', ' ');  // directives count
  if (find_word(readable, "length") == std::string::npos || !reads_member_length(pieces_of(readable)))
    return source.text;
  const std::string original = preprocess(source);
  const std::vector<std::string_view> pieces = pieces_of(original);
  std::string text = original;
  for (std::size_t i = pieces.size(); i-- > 0;)
    if (is_length(pieces, i)) text.insert(std::size_t(pieces[i].data() - original.data()) + pieces[i].size(), kEnding);
  return text;
}

void drop_endings(std::vector<std::uint32_t>& words) {
  constexpr std::size_t kHeader = 5;
  for (std::size_t at = kHeader; at < words.size() && words[at] >> 16 != 0; at += words[at] >> 16) {
    const std::uint32_t op = words[at] & 0xffff;
    if (op != spv::OpName && op != spv::OpMemberName) continue;
    char* const name = reinterpret_cast<char*>(&words[at + (op == spv::OpName ? 2 : 3)]);
    std::string text = name;  // of a function "name(types;"
    const std::size_t length = text.size();
    for (std::size_t ending = find_ending(text, 0); ending != text.npos; ending = find_ending(text, ending))
      text.erase(ending, kEnding.size());
    std::fill(std::copy(text.begin(), text.end(), name), name + length, '\0');
  }
}

std::string without_endings(const std::string& message) {
  static const std::regex no_function(R"('(\w+)_twinshade_name' : no matching overloaded function found)");
  std::string text = message;
  std::smatch match;
  if (std::regex_search(message, match, no_function))
    text += " (the shader's own " + match[1].str() + "() hides the built-in ones: call it otherwise)";
  for (std::size_t ending = find_ending(text, 0); ending != text.npos; ending = find_ending(text, ending))
    text.erase(ending, kEnding.size());
  return text;
}

}  // namespace twinshade

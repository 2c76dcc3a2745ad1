#include "cpu_shaders/rewrite/new_keywords.h"

#include <algorithm>

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

struct KeywordVersion {
  const char* name;
  int version, es_version;  // that made it a keyword
};

constexpr KeywordVersion kNewKeywords[] = {
    {"sample", 400, 0},   {"patch", 400, 0},    {"subroutine", 400, 0}, {"precise", 400, 320}, {"coherent", 420, 0},
    {"restrict", 420, 0}, {"readonly", 420, 0}, {"writeonly", 420, 0},  {"buffer", 430, 310},  {"shared", 430, 310},
};

constexpr int kNever = 1000;

struct FunctionsVersion {
  int version, es_version;  // that made them built-in functions
  const char* names;
};

constexpr FunctionsVersion kNewFunctions[] = {
    {0, kNever,
     "noise1 noise2 noise3 noise4 shadow1D shadow1DProj shadow2D shadow2DProj texture1D texture1DProj texture2D "
     "texture2DProj texture3D texture3DProj textureCube textureQueryLOD"},
    {400, 300, "packUnorm2x16 unpackUnorm2x16"},
    {400, 310,
     "bitCount bitfieldExtract bitfieldInsert bitfieldReverse findLSB findMSB frexp imulExtended ldexp packSnorm4x8 "
     "packUnorm4x8 textureGather textureGatherOffset uaddCarry umulExtended unpackSnorm4x8 unpackUnorm4x8 usubBorrow"},
    {400, 320, "fma interpolateAtCentroid interpolateAtOffset interpolateAtSample textureGatherOffsets"},
    {400, kNever, "packDouble2x32 textureQueryLod unpackDouble2x32"},
    {420, 300, "packHalf2x16 packSnorm2x16 unpackHalf2x16 unpackSnorm2x16"},
    {420, 310,
     "atomicCounter atomicCounterDecrement atomicCounterIncrement barrier groupMemoryBarrier imageLoad imageSize "
     "imageStore memoryBarrier memoryBarrierAtomicCounter memoryBarrierBuffer memoryBarrierImage memoryBarrierShared"},
    {420, 320,
     "imageAtomicAdd imageAtomicAnd imageAtomicCompSwap imageAtomicExchange imageAtomicMax imageAtomicMin "
     "imageAtomicOr imageAtomicXor"},
    {430, 310, "atomicAdd atomicAnd atomicCompSwap atomicExchange atomicMax atomicMin atomicOr atomicXor"},
    {430, kNever, "textureQueryLevels"},
    // max3 and the like are an extension's, which glslang knows all the same
    {430, kNever, "max3 mid3 min3"},
    {450, kNever, "dFdxCoarse dFdxFine dFdyCoarse dFdyFine fwidthCoarse fwidthFine imageSamples textureSamples"},
};

std::vector<std::size_t> names_outside_layout(const std::vector<Token>& tokens) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text == "layout")
      while (i + 1 < tokens.size() && tokens[i].text != ")") ++i;
    if (tokens[i].kind == Token::Kind::name) list.push_back(i);
  }
  return list;
}

// An extension may have made it a keyword all the same: qualifiers stand before other names, or as
// layout(std430) buffer;
bool qualifies(const std::vector<Token>& tokens, std::size_t at) {
  if (at == 0 || at + 1 >= tokens.size() || tokens[at + 1].kind == Token::Kind::name) return true;
  return tokens[at - 1].text == ")" && tokens[at + 1].text == ";";
}

}  // namespace

std::vector<std::size_t> new_keyword_tokens(const std::vector<Token>& tokens, const ShaderSource& source) {
  std::vector<std::size_t> found;
  const std::vector<std::size_t> names = names_outside_layout(tokens);
  for (const KeywordVersion& word : kNewKeywords) {
    if (source.version >= (source.es ? word.es_version : word.version)) continue;
    std::vector<std::size_t> uses;
    std::copy_if(names.begin(), names.end(), std::back_inserter(uses),
                 [&](std::size_t at) { return tokens[at].text == word.name; });
    if (!std::all_of(uses.begin(), uses.end(), [&](std::size_t at) { return qualifies(tokens, at); }))
      found.insert(found.end(), uses.begin(), uses.end());
  }
  return found;
}

std::set<std::string> new_keywords(const TokenList& list, const ShaderSource& source) {
  std::set<std::string> names;
  for (const std::size_t at : new_keyword_tokens(list.tokens, source)) names.insert(list.tokens[at].text);
  return names;
}

std::map<std::string, std::size_t> declared_functions(const std::vector<Token>& tokens) {
  std::map<std::string, std::size_t> functions;
  int depth = 0;  // of braces: functions are declared outside all
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
    depth += (tokens[i].text == "{") - (tokens[i].text == "}");
    const bool behind_type = tokens[i - 1].kind == Token::Kind::name || tokens[i - 1].text == "]";
    if (depth == 0 && behind_type && tokens[i].kind == Token::Kind::name && tokens[i + 1].text == "(")
      functions.emplace(tokens[i].text, i);
  }
  return functions;
}

std::set<std::string> new_functions(const std::vector<Token>& tokens, const ShaderSource& source) {
  std::set<std::string> names;
  for (const auto& [name, token] : declared_functions(tokens))
    for (const FunctionsVersion& functions : kNewFunctions)
      if (source.version < (source.es ? functions.es_version : functions.version) &&
          find_word(functions.names, name) != std::string::npos)
        names.insert(name);
  return names;
}

}  // namespace twinshade

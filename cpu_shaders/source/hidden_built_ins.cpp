#include "cpu_shaders/source/hidden_built_ins.h"

#include <algorithm>
#include <map>
#include <unordered_set>

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

constexpr std::string_view kBuiltIns =
    "abs absoluteDifference acos acosh addSaturate all allInvocations allInvocationsEqual any anyInvocation asin "
    "asinh atan atanh atomicAdd atomicAnd atomicCompSwap atomicCounter atomicCounterAdd atomicCounterAnd "
    "atomicCounterCompSwap atomicCounterDecrement atomicCounterExchange atomicCounterIncrement atomicCounterMax "
    "atomicCounterMin atomicCounterOr atomicCounterSubtract atomicCounterXor atomicExchange atomicMax atomicMin "
    "atomicOr atomicXor average averageRounded barrier bitCount bitfieldExtract bitfieldInsert bitfieldReverse ceil "
    "clamp controlBarrier cos cosh countLeadingZeros countTrailingZeros cross dFdx dFdxCoarse dFdxFine dFdy "
    "dFdyCoarse dFdyFine degrees determinant distance dot equal exp exp2 faceforward findLSB findMSB floatBitsToInt "
    "floatBitsToUint floor fma fract frexp fwidth fwidthCoarse fwidthFine greaterThan greaterThanEqual "
    "groupMemoryBarrier imageAtomicAdd imageAtomicAnd imageAtomicCompSwap imageAtomicExchange imageAtomicMax "
    "imageAtomicMin imageAtomicOr imageAtomicXor imageLoad imageSamples imageSize imageStore imulExtended "
    "intBitsToFloat interpolateAtCentroid interpolateAtOffset interpolateAtSample inverse inversesqrt isinf isnan "
    "ldexp length lessThan lessThanEqual log log2 matrixCompMult max max3 memoryBarrier memoryBarrierAtomicCounter "
    "memoryBarrierBuffer memoryBarrierImage memoryBarrierShared mid3 min min3 mix mod modf multiply32x16 noise1 "
    "noise2 noise3 noise4 normalize not notEqual outerProduct packDouble2x32 packHalf2x16 packSnorm2x16 packSnorm4x8 "
    "packUnorm2x16 packUnorm4x8 pow radians reflect refract round roundEven shadow1D shadow1DLod shadow1DProj "
    "shadow1DProjLod shadow2D shadow2DLod shadow2DProj shadow2DProjLod sign sin sinh smoothstep sqrt step "
    "subtractSaturate tan tanh texelFetch texelFetchOffset texelGradFetch texelGradFetchOffset texelProjFetch "
    "texelProjFetchOffset texelProjGradFetch texture texture1D texture1DLod texture1DProj texture1DProjLod texture2D "
    "texture2DLod texture2DProj texture2DProjLod texture3D texture3DLod texture3DProj texture3DProjLod textureCube "
    "textureCubeLod textureGather textureGatherOffset textureGatherOffsets textureGrad textureGradOffset textureLod "
    "textureLodOffset textureOffset textureProj textureProjGrad textureProjGradOffset textureProjLod "
    "textureProjLodOffset textureProjOffset textureQueryLOD textureQueryLevels textureQueryLod textureSamples "
    "textureSize transpose trunc uaddCarry uintBitsToFloat umulExtended unpackDouble2x32 unpackHalf2x16 "
    "unpackSnorm2x16 unpackSnorm4x8 unpackUnorm2x16 unpackUnorm4x8 usubBorrow";

bool is_word(std::string_view piece) { return is_word_character(piece[0]); }

// Functions of those names that the text declares, and the piece where each is first named.
std::map<std::string_view, std::size_t> hiding_functions(const std::vector<std::string_view>& pieces) {
  std::map<std::string_view, std::size_t> functions;
  int depth = 0;  // of braces: functions are declared outside all
  for (std::size_t i = 1; i + 1 < pieces.size(); ++i) {
    depth += (pieces[i] == "{") - (pieces[i] == "}");
    const bool behind_type = is_word(pieces[i - 1]) || pieces[i - 1] == "]";
    if (depth == 0 && behind_type && pieces[i + 1] == "(" && is_built_in_function(pieces[i]))
      functions.emplace(pieces[i], i);
  }
  return functions;
}

}  // namespace

bool is_built_in_function(std::string_view name) {
  static const std::unordered_set<std::string_view> names = [] {
    std::unordered_set<std::string_view> words;
    for (std::size_t at = 0, end = 0; at < kBuiltIns.size(); at = end + 1) {
      end = std::min(kBuiltIns.find(' ', at), kBuiltIns.size());
      words.insert(kBuiltIns.substr(at, end - at));
    }
    return words;
  }();
  return names.count(name) != 0;
}

std::vector<std::size_t> names_of_hiding_functions(const std::vector<std::string_view>& pieces) {
  std::vector<std::size_t> places;
  const std::map<std::string_view, std::size_t> functions = hiding_functions(pieces);
  if (functions.empty()) return places;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const auto function = functions.find(pieces[i]);
    if (function == functions.end()) continue;
    const bool is_called = i + 1 < pieces.size() && pieces[i + 1] == "(";
    const bool calls_another = is_called && (i < function->second || pieces[i - 1] == ".");  // list.length()
    if (!calls_another) places.push_back(i);
  }
  return places;
}

}  // namespace twinshade

#include "cpu_shaders/translate/extended_instructions.h"

#include <algorithm>
#include <iterator>

namespace twinshade::spirv {
namespace {

constexpr const char* kInterpolate = "inputs are known at pixel centres only";
constexpr const char* kPair = "";  // emitted by FunctionEmitter::pair

constexpr ExtendedInstruction kInstructions[] = {
    {1, "round", "round", "", false},
    {2, "roundEven", "roundEven", "", false},
    {3, "trunc", "trunc", "", false},
    {4, "abs", "abs", "", false},
    {5, "abs", "abs", "", false},
    {6, "sign", "sign", "", false},
    {7, "sign", "sign", "", false},
    {8, "floor", "floor", "", false},
    {9, "ceil", "ceil", "", false},
    {10, "fract", "fract", "", false},
    {11, "radians", "radians", "", false},
    {12, "degrees", "degrees", "", false},
    {13, "sin", "sin", "", false},
    {14, "cos", "cos", "", false},
    {15, "tan", "tan", "", false},
    {16, "asin", "asin", "", false},
    {17, "acos", "acos", "", false},
    {18, "atan", "atan", "", false},
    {19, "sinh", "sinh", "", false},
    {20, "cosh", "cosh", "", false},
    {21, "tanh", "tanh", "", false},
    {22, "asinh", "asinh", "", false},
    {23, "acosh", "acosh", "", false},
    {24, "atanh", "atanh", "", false},
    {25, "atan", "atan", "", false},
    {26, "pow", "pow", "", false},
    {27, "exp", "exp", "", false},
    {28, "log", "log", "", false},
    {29, "exp2", "exp2", "", false},
    {30, "log2", "log2", "", false},
    {31, "sqrt", "sqrt", "", false},
    {32, "inversesqrt", "inversesqrt", "", false},
    {33, "determinant", "determinant", "", false},
    {34, "inverse", "inverse", "", false},
    {37, "min", "min", "", false},
    {38, "min", "min", "", false},
    {39, "min", "min", "", false},
    {40, "max", "max", "", false},
    {41, "max", "max", "", false},
    {42, "max", "max", "", false},
    {43, "clamp", "clamp", "", false},
    {44, "clamp", "clamp", "", false},
    {45, "clamp", "clamp", "", false},
    {46, "mix", "mix", "", false},
    {48, "step", "step", "", false},
    {49, "smoothstep", "smoothstep", "", false},
    {50, "fma", "fma", "", false},
    {52, "frexp", nullptr, kPair, false},
    {53, "ldexp", "ldexp", "", false},
    {54, "packSnorm4x8", "packSnorm4x8", "", true},
    {55, "packUnorm4x8", "packUnorm4x8", "", true},
    {56, "packSnorm2x16", "packSnorm2x16", "", true},
    {57, "packUnorm2x16", "packUnorm2x16", "", true},
    {58, "packHalf2x16", "packHalf2x16", "", true},
    {59, "packDouble2x32", nullptr, "there are no doubles", true},
    {60, "unpackSnorm2x16", "unpackSnorm2x16<N>", "", true},
    {61, "unpackUnorm2x16", "unpackUnorm2x16<N>", "", true},
    {62, "unpackHalf2x16", "unpackHalf2x16<N>", "", true},
    {63, "unpackSnorm4x8", "unpackSnorm4x8<N>", "", true},
    {64, "unpackUnorm4x8", "unpackUnorm4x8<N>", "", true},
    {65, "unpackDouble2x32", nullptr, "there are no doubles", true},
    {66, "length", "length", "", false},
    {67, "distance", "distance", "", false},
    {68, "cross", "cross", "", false},
    {69, "normalize", "normalize", "", false},
    {70, "faceforward", "faceforward", "", false},
    {71, "reflect", "reflect", "", false},
    {72, "refract", "refract", "", false},
    {73, "findLSB", "findLSB", "", false},
    {74, "findMSB", "findMSB", "", false},
    {75, "findMSB", "findMSB", "", false},
    {78, "interpolateAtOffset", nullptr, kInterpolate, false},
    {79, "min", "min", "", false},
    {80, "max", "max", "", false},
    {81, "clamp", "clamp", "", false},
};

}  // namespace

const ExtendedInstruction* extended_instruction(std::uint32_t number) {
  const auto found = std::find_if(std::begin(kInstructions), std::end(kInstructions),
                                  [&](const ExtendedInstruction& e) { return e.number == number; });
  return found == std::end(kInstructions) ? nullptr : found;
}

}  // namespace twinshade::spirv

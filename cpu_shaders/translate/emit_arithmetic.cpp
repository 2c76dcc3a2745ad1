// Operators, conversions and textures.
#include "cpu_shaders/translate/emit_function.h"

namespace twinshade::spirv {
namespace {

struct Operator {
  const char* text;
  int precedence;
};

Operator operator_of(spv::Op op) {
  switch (op) {
    case spv::OpFAdd:
    case spv::OpIAdd:
      return {"+", 6};
    case spv::OpFSub:
    case spv::OpISub:
      return {"-", 6};
    case spv::OpFMul:
    case spv::OpIMul:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
      return {"*", 5};
    case spv::OpFDiv:
    case spv::OpSDiv:
    case spv::OpUDiv:
      return {"/", 5};
    case spv::OpSMod:
    case spv::OpSRem:
    case spv::OpUMod:
      return {"%", 5};
    case spv::OpShiftLeftLogical:
      return {"<<", 7};
    case spv::OpShiftRightLogical:
    case spv::OpShiftRightArithmetic:
      return {">>", 7};
    case spv::OpBitwiseAnd:
      return {"&", 11};
    case spv::OpBitwiseXor:
      return {"^", 12};
    case spv::OpBitwiseOr:
      return {"|", 13};
    case spv::OpLogicalAnd:
      return {"&&", 14};
    case spv::OpLogicalOr:
      return {"||", 15};
    default:
      return {nullptr, 0};
  }
}

struct Comparison {
  const char* text;      // between scalars
  const char* function;  // between vectors
};

Comparison comparison_of(spv::Op op) {
  switch (op) {
    case spv::OpFOrdEqual:
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
      return {"==", "equal"};
    case spv::OpFOrdNotEqual:
    case spv::OpFUnordNotEqual:
    case spv::OpINotEqual:
    case spv::OpLogicalNotEqual:
      return {"!=", "notEqual"};
    case spv::OpFOrdLessThan:
    case spv::OpSLessThan:
    case spv::OpULessThan:
      return {"<", "lessThan"};
    case spv::OpFOrdLessThanEqual:
    case spv::OpSLessThanEqual:
    case spv::OpULessThanEqual:
      return {"<=", "lessThanEqual"};
    case spv::OpFOrdGreaterThan:
    case spv::OpSGreaterThan:
    case spv::OpUGreaterThan:
      return {">", "greaterThan"};
    case spv::OpFOrdGreaterThanEqual:
    case spv::OpSGreaterThanEqual:
    case spv::OpUGreaterThanEqual:
      return {">=", "greaterThanEqual"};
    default:
      return {nullptr, nullptr};
  }
}

// Functions that SPIR-V has instructions for.
const char* function_of(spv::Op op) {
  switch (op) {
    case spv::OpDot:
      return "glsl::dot";
    case spv::OpFMod:
      return "glsl::mod";
    case spv::OpOuterProduct:
      return "glsl::outerProduct";
    case spv::OpTranspose:
      return "glsl::transpose";
    case spv::OpAny:
      return "glsl::any";
    case spv::OpAll:
      return "glsl::all";
    case spv::OpIsNan:
      return "glsl::isnan";
    case spv::OpIsInf:
      return "glsl::isinf";
    case spv::OpDPdx:
    case spv::OpDPdxFine:
    case spv::OpDPdxCoarse:
      return "glsl::dFdx";
    case spv::OpDPdy:
    case spv::OpDPdyFine:
    case spv::OpDPdyCoarse:
      return "glsl::dFdy";
    case spv::OpFwidth:
    case spv::OpFwidthFine:
    case spv::OpFwidthCoarse:
      return "glsl::fwidth";
    case spv::OpBitFieldInsert:
      return "glsl::bitfieldInsert";
    case spv::OpBitFieldSExtract:
    case spv::OpBitFieldUExtract:
      return "glsl::bitfieldExtract";
    case spv::OpBitReverse:
      return "glsl::bitfieldReverse";
    case spv::OpBitCount:
      return "glsl::bitCount";
    case spv::OpConvertFToS:
      return "to_int";
    case spv::OpConvertFToU:
      return "to_uint";
    case spv::OpConvertSToF:
    case spv::OpConvertUToF:
      return "to_float<N>";
    default:
      return nullptr;
  }
}

}  // namespace

bool FunctionEmitter::arithmetic(const Instruction& i) {
  if (const Operator o = operator_of(i.op); o.text != nullptr) {
    define(i, is_narrow(i) ? in_half_operator(i, o.text) : binary(i, o.text, o.precedence));
    return true;
  }
  if (const Comparison c = comparison_of(i.op); c.text != nullptr) {
    if (compares_halves(i) && module_.type(i.type).kind == Kind::vector) {
      define(i, in_half(i, std::string("glsl::") + c.function, i.operands));
    } else if (module_.type(i.type).kind == Kind::vector) {
      Expression left = operand_as(i.operands[0], signedness(i));
      const Expression right = operand_as(i.operands[1], signedness(i));
      left.text = std::string("glsl::") + c.function + "(" + left.text + ", " + right.text + ")";
      left.precedence = 1;
      left.reads.insert(right.reads.begin(), right.reads.end());
      define(i, left);
    } else if (compares_halves(i)) {
      define(i, in_half_operator(i, c.text));
    } else {
      define(i, binary(i, c.text, c.text[0] == '=' || c.text[0] == '!' ? 10 : 9));
    }
    return true;
  }
  if (const char* function = function_of(i.op); function != nullptr) {
    const bool computes = is_narrow(i) && !rounds_result(i) && i.op != spv::OpTranspose;
    define(i, computes ? in_half(i, function, i.operands) : call_text(i, function, i.operands));
    return true;
  }
  const char* unary = i.op == spv::OpFNegate || i.op == spv::OpSNegate ? "-"
                      : i.op == spv::OpNot                             ? "~"
                      : i.op == spv::OpLogicalNot                      ? "!"
                                                                       : nullptr;
  if (unary != nullptr) {
    Expression e = value(i.operands[0]);
    // No operator next to its like: -(-x).
    if (e.precedence > 1) e.text = "(" + e.text + ")";
    e.text = unary + e.text;
    e.precedence = 3;
    define(i, e);
    return true;
  }
  if (i.op != spv::OpBitcast) return false;
  const Kind from = module_.scalar_kind(module_.value_types.at(i.operands[0])), to = module_.scalar_kind(i.type);
  if (from == Kind::real) {
    no_float64(i, to == Kind::integer ? "floatBitsToInt" : "floatBitsToUint");
    refuse_bits(i, to == Kind::integer ? "floatBitsToInt" : "floatBitsToUint");
    define(i, call_text(i, to == Kind::integer ? "float_as_int" : "float_as_uint", i.operands));
  } else if (to == Kind::real) {
    no_float64(i, from == Kind::integer ? "intBitsToFloat" : "uintBitsToFloat");
    refuse_bits(i, from == Kind::integer ? "intBitsToFloat" : "uintBitsToFloat");
    define(i, call_text(i, from == Kind::integer ? "int_as_float" : "uint_as_float", i.operands));
  } else {
    define(i, call_text(i, to == Kind::integer ? "to_int" : "to_uint", i.operands));
  }
  return true;
}

// Image operands: a mask, then its values in the order of the mask's bits.
bool FunctionEmitter::texture(const Instruction& i) {
  const std::uint32_t operands_mask = i.operands.size() > 2 ? i.operands[2] : 0;
  const auto has = [&](std::uint32_t bit) { return (operands_mask & bit) != 0; };
  switch (i.op) {
    case spv::OpImage:
      values_[i.result] = value(i.operands[0]);
      return true;
    case spv::OpImageSampleImplicitLod:
    case spv::OpImageSampleExplicitLod: {
      if (has(spv::ImageOperandsConstOffsetMask) || has(spv::ImageOperandsOffsetMask))
        define(i, call_text(i, "glsl::textureOffset", {i.operands[0], i.operands[1], i.operands.back()}));
      else if (has(spv::ImageOperandsLodMask))
        define(i, call_text(i, "glsl::textureLod", {i.operands[0], i.operands[1], i.operands[3]}));
      else
        define(i, call_text(i, "glsl::texture",
                            {i.operands[0], i.operands[1]}));  // one mip level: bias and gradients say nothing
      return true;
    }
    case spv::OpImageSampleProjImplicitLod:
    case spv::OpImageSampleProjExplicitLod: {
      std::vector<Id> arguments = {i.operands[0], i.operands[1]};
      if (has(spv::ImageOperandsConstOffsetMask) || has(spv::ImageOperandsOffsetMask))
        arguments.push_back(i.operands.back());
      define(i, call_text(i, "glsl::textureProj", arguments));
      return true;
    }
    case spv::OpImageGather: {
      std::vector<Id> arguments(i.operands.begin(), i.operands.begin() + 3);
      if (i.operands.size() > 4) arguments.push_back(i.operands[4]);  // one offset, or an array of four
      define(i, call_text(i, "glsl::textureGather", arguments));
      return true;
    }
    case spv::OpImageFetch: {
      const bool lod = has(spv::ImageOperandsLodMask);
      if (has(spv::ImageOperandsSampleMask)) refuse(i, "texelFetch on a multisample texture", "use sampler2D");
      Expression e;
      e.precedence = 1;
      const Expression image = value(i.operands[0]), where = value(i.operands[1]);
      const Expression level = lod ? value(i.operands[3]) : Expression{"UI(0)", 1, {}};
      e.reads = where.reads;
      e.reads.insert(level.reads.begin(), level.reads.end());
      std::string coordinate = where.text;
      if (has(spv::ImageOperandsConstOffsetMask)) {
        std::string offset = value(i.operands[lod ? 4 : 3]).text;
        if (module_.type_of(i.operands[1]).count == 3) offset = "vec<UI, 3>(" + offset + ", UI(0))";
        coordinate = (where.precedence > 6 ? "(" + where.text + ")" : where.text) + " + " + offset;
      }
      e.text = "glsl::texelFetch(" + image.text + ", " + coordinate + ", " + level.text + ")";
      define(i, e);
      return true;
    }
    case spv::OpImageQuerySizeLod:
      define(i, call_text(i, "glsl::textureSize", i.operands));
      return true;
    case spv::OpImageQueryLevels:
      define(i, Expression{"UI(1)", 1, {}});
      return true;
    case spv::OpImageQueryLod:
      refuse(i, "textureQueryLod",
             "there is one mip level, its number is 0, and levels that would be are not computed");
    case spv::OpImageDrefGather:
    case spv::OpImageSampleDrefImplicitLod:
    case spv::OpImageSampleDrefExplicitLod:
    case spv::OpImageSampleProjDrefImplicitLod:
    case spv::OpImageSampleProjDrefExplicitLod:
      refuse(i, "a shadow comparison", "fetch the depth with texelFetch and compare");
    case spv::OpImageRead:
    case spv::OpImageWrite:
    case spv::OpImageTexelPointer:
      refuse(i, "imageLoad, imageStore and image atomics", "use a buffer block");
    default:
      return false;
  }
}

}  // namespace twinshade::spirv

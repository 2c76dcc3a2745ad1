#include "cpu_shaders/lint/glsl_type.h"

#include <algorithm>
#include <array>

namespace twinshade::lint_detail {
namespace {

using Base = GlslType::Base;

GlslType vector_type(Base base, int rows) {
  GlslType type = scalar_type(base);
  type.rows = rows;
  return type;
}

GlslType with_base(GlslType type, Base base) {
  type.base = base;
  return type;
}

int component_count(char digit) { return digit >= '2' && digit <= '4' ? digit - '0' : 0; }

// Coordinates that textureSize answers with.
int size_components(std::string_view sampler) {
  const bool array = sampler.find("Array") != std::string_view::npos;
  int dimensions = 2;
  if (sampler.find("1D") != std::string_view::npos || sampler.find("Buffer") != std::string_view::npos) dimensions = 1;
  if (sampler.find("3D") != std::string_view::npos) dimensions = 3;
  return dimensions + (array ? 1 : 0);
}

GlslType texel_type(const GlslType& sampler) {
  if (sampler.name.find("Shadow") != std::string::npos) return scalar_type(Base::float32);
  const char first = sampler.name.empty() ? 's' : sampler.name[0];
  return vector_type(first == 'i' && !sampler.name.starts_with("image") ? Base::int32
                     : first == 'u'                                     ? Base::uint32
                                                                        : Base::float32,
                     4);
}

// The widest of the arguments: f(float, vec3) is a vec3.
GlslType widest(const std::vector<GlslType>& arguments) {
  GlslType type;
  for (const GlslType& argument : arguments)
    if (type.base == Base::unknown || argument.rows > type.rows) type = argument;
  return type;
}

// sampler2D, iimageCube, atomic_uint ...; image_size is a name like any other.
bool is_opaque(std::string_view keyword) {
  if (keyword == "atomic_uint") return true;
  const bool of_integers = keyword.starts_with('i') ? !keyword.starts_with("image") : keyword.starts_with('u');
  std::string_view shape = keyword.substr(of_integers ? 1 : 0);
  const bool is_sampler = shape.starts_with("sampler");
  if (!is_sampler && !shape.starts_with("image")) return false;
  shape.remove_prefix(std::string_view(is_sampler ? "sampler" : "image").size());
  if (is_sampler && !of_integers && shape.ends_with("Shadow"))
    return one_of(shape, {"1DShadow", "2DShadow", "CubeShadow", "2DRectShadow", "1DArrayShadow", "2DArrayShadow",
                          "CubeArrayShadow"});
  return one_of(shape,
                {"1D", "2D", "3D", "Cube", "2DRect", "1DArray", "2DArray", "CubeArray", "Buffer", "2DMS", "2DMSArray"});
}

}  // namespace

GlslType scalar_type(Base base) {
  GlslType type;
  type.base = base;
  return type;
}

GlslType keyword_type(std::string_view keyword) {
  if (keyword == "void") return scalar_type(Base::nothing);
  if (keyword == "bool") return scalar_type(Base::boolean);
  if (keyword == "int") return scalar_type(Base::int32);
  if (keyword == "uint") return scalar_type(Base::uint32);
  if (keyword == "float") return scalar_type(Base::float32);
  if (keyword == "double") return scalar_type(Base::float64);
  static constexpr std::array<std::pair<std::string_view, Base>, 5> kVectors = {{{"vec", Base::float32},
                                                                                 {"ivec", Base::int32},
                                                                                 {"uvec", Base::uint32},
                                                                                 {"bvec", Base::boolean},
                                                                                 {"dvec", Base::float64}}};
  for (const auto& [prefix, base] : kVectors)
    if (keyword.size() == prefix.size() + 1 && keyword.starts_with(prefix) && component_count(keyword.back()) != 0)
      return vector_type(base, component_count(keyword.back()));
  for (const auto& [prefix, base] : {std::pair{std::string_view("mat"), Base::float32}, {"dmat", Base::float64}}) {
    if (!keyword.starts_with(prefix)) continue;
    const std::string_view shape = keyword.substr(prefix.size());
    const bool square = shape.size() == 1, general = shape.size() == 3 && shape[1] == 'x';
    if ((!square && !general) || component_count(shape[0]) == 0 || component_count(shape.back()) == 0) continue;
    GlslType type = vector_type(base, component_count(shape.back()));
    type.columns = component_count(shape[0]);
    return type;
  }
  if (is_opaque(keyword)) {
    GlslType type = scalar_type(Base::opaque);
    type.name = keyword;
    return type;
  }
  return {};
}

GlslType binary_type(std::string_view op, const GlslType& a, const GlslType& b) {
  if (one_of(op, {"<", ">", "<=", ">=", "==", "!=", "&&", "||", "^^"})) return scalar_type(Base::boolean);
  if (one_of(op, {"<<", ">>"})) return a;
  GlslType type = a;
  if (op == "*" && a.is_matrix() && b.is_vector()) {
    type = vector_type(a.base, a.rows);
  } else if (op == "*" && a.is_vector() && b.is_matrix()) {
    type = vector_type(b.base, b.columns);
  } else if (op == "*" && a.is_matrix() && b.is_matrix()) {
    type.columns = b.columns;
  } else if (b.columns * b.rows > a.columns * a.rows || a.base == Base::unknown) {
    type = b;
  }
  type.base = std::max(a.base, b.base);  // implicit conversions go up this order: int, uint, float, double
  return type;
}

GlslType element_type(const GlslType& indexed) {
  GlslType type = indexed;
  if (type.array_dimensions > 0) {
    --type.array_dimensions;
  } else if (type.is_matrix()) {
    type.columns = 1;
  } else {
    type.rows = 1;
  }
  return type;
}

GlslType builtin_type(std::string_view f, const std::vector<GlslType>& arguments) {
  const GlslType first = arguments.empty() ? GlslType{} : arguments[0];
  if (f == "textureSize" || f == "imageSize") return vector_type(Base::int32, size_components(first.name));
  if (f == "textureQueryLevels" || f == "textureSamples" || f == "imageSamples") return scalar_type(Base::int32);
  if (f == "textureQueryLod") return vector_type(Base::float32, 2);
  if (f == "texelFetch" || f == "texelFetchOffset" || f.starts_with("texture") || f == "imageLoad")
    return texel_type(first);
  if (f == "floatBitsToInt") return with_base(first, Base::int32);
  if (f == "floatBitsToUint") return with_base(first, Base::uint32);
  if (f == "intBitsToFloat" || f == "uintBitsToFloat") return with_base(first, Base::float32);
  if (one_of(f, {"dot", "length", "distance", "determinant"})) return scalar_type(first.base);
  if (one_of(f, {"any", "all"})) return scalar_type(Base::boolean);
  if (one_of(f,
             {"lessThan", "lessThanEqual", "greaterThan", "greaterThanEqual", "equal", "notEqual", "isnan", "isinf"}))
    return with_base(first, Base::boolean);
  if (one_of(f, {"bitCount", "findLSB", "findMSB"})) return with_base(first, Base::int32);
  if (one_of(f, {"umulExtended", "imulExtended", "imageStore", "barrier", "memoryBarrier", "memoryBarrierBuffer",
                 "memoryBarrierImage", "memoryBarrierShared", "groupMemoryBarrier"}))
    return scalar_type(Base::nothing);
  if (one_of(f, {"not", "bitfieldExtract", "bitfieldInsert", "bitfieldReverse", "uaddCarry", "usubBorrow"}))
    return first;
  if (f.starts_with("atomic") || f.starts_with("imageAtomic")) return arguments.empty() ? GlslType{} : arguments.back();
  if (f.starts_with("pack")) return scalar_type(f == "packDouble2x32" ? Base::float64 : Base::uint32);
  if (f == "unpackDouble2x32") return vector_type(Base::uint32, 2);
  if (f.starts_with("unpack")) return vector_type(Base::float32, f.find("4x8") != std::string_view::npos ? 4 : 2);
  if (f.starts_with("noise")) return vector_type(Base::float32, f.size() == 6 ? std::max(f[5] - '0', 1) : 1);
  if (f == "transpose") {
    GlslType type = first;
    std::swap(type.columns, type.rows);
    return type;
  }
  if (f == "outerProduct" && arguments.size() == 2) {
    GlslType type = first;
    type.columns = arguments[1].rows;
    return type;
  }
  static constexpr std::array<std::string_view, 59> kSameType = {"abs",
                                                                 "acos",
                                                                 "acosh",
                                                                 "asin",
                                                                 "asinh",
                                                                 "atan",
                                                                 "atanh",
                                                                 "ceil",
                                                                 "clamp",
                                                                 "cos",
                                                                 "cosh",
                                                                 "cross",
                                                                 "dFdx",
                                                                 "dFdxCoarse",
                                                                 "dFdxFine",
                                                                 "dFdy",
                                                                 "dFdyCoarse",
                                                                 "dFdyFine",
                                                                 "degrees",
                                                                 "exp",
                                                                 "exp2",
                                                                 "faceforward",
                                                                 "floor",
                                                                 "fma",
                                                                 "fract",
                                                                 "frexp",
                                                                 "fwidth",
                                                                 "fwidthCoarse",
                                                                 "fwidthFine",
                                                                 "inversesqrt",
                                                                 "inverse",
                                                                 "ldexp",
                                                                 "log",
                                                                 "log2",
                                                                 "matrixCompMult",
                                                                 "max",
                                                                 "min",
                                                                 "mix",
                                                                 "mod",
                                                                 "modf",
                                                                 "normalize",
                                                                 "pow",
                                                                 "radians",
                                                                 "reflect",
                                                                 "refract",
                                                                 "round",
                                                                 "roundEven",
                                                                 "sign",
                                                                 "sin",
                                                                 "sinh",
                                                                 "smoothstep",
                                                                 "sqrt",
                                                                 "step",
                                                                 "tan",
                                                                 "tanh",
                                                                 "trunc",
                                                                 "interpolateAtCentroid",
                                                                 "interpolateAtSample",
                                                                 "interpolateAtOffset"};
  if (std::find(kSameType.begin(), kSameType.end(), f) == kSameType.end()) return {};
  GlslType type = one_of(f, {"ldexp", "frexp"}) || f.starts_with("interpolateAt") ? first : widest(arguments);
  const bool integers = one_of(f, {"abs", "min", "max", "clamp", "sign", "mix"});
  if (!integers && type.base != Base::float64) type.base = Base::float32;  // sqrt(2) is sqrt(2.0)
  if (integers && arguments.size() > 1 && f != "mix")
    for (const GlslType& argument : arguments) type.base = std::max(type.base, argument.base);
  return type;
}

}  // namespace twinshade::lint_detail

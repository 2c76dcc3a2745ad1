#include "cpu_shaders/translate/served.h"

#include <algorithm>

#include "cpu_shaders/runtime/served_names.h"

namespace twinshade::spirv {
namespace {

// A type as GLSL writes it.
std::string glsl_type(const Module& module, Id id) {
  const Type& t = module.type(id);
  const auto prefixed = [&](Id element) {
    const Kind kind = module.type(element).kind;
    return std::string(kind == Kind::integer            ? "i"
                       : kind == Kind::unsigned_integer ? "u"
                       : kind == Kind::boolean          ? "b"
                                                        : "");
  };
  switch (t.kind) {
    case Kind::none:
      return "void";
    case Kind::boolean:
      return "bool";
    case Kind::integer:
      return "int";
    case Kind::unsigned_integer:
      return "uint";
    case Kind::real:
      return "float";
    case Kind::vector:
      return prefixed(t.element) + "vec" + std::to_string(t.count);
    case Kind::structure:
      return module.name(id);
    case Kind::pointer:
      return glsl_type(module, t.element);
    case Kind::sampler: {
      const Type& image = module.type(t.element);
      return image.dimension == spv::DimCube ? "samplerCube" : image.arrayed ? "sampler2DArray" : "sampler2D";
    }
    default:
      return "other";
  }
}

}  // namespace

bool is_served(const Module& module, const Function& function) {
  if (module.position(function.file, function.line).file.rfind("shaders/exact/", 0) != 0) return false;
  std::string parameters;
  for (const Parameter& p : function.parameters)
    parameters += (parameters.empty() ? "" : ",") + glsl_type(module, p.type);
  const std::string result = glsl_type(module, function.result_type);
  return std::any_of(std::begin(kServedFunctions), std::end(kServedFunctions), [&](const ServedFunction& served) {
    return served.name == function.name && served.result == result && served.parameters == parameters;
  });
}

bool is_served_in_double(const Module& module, const Function& function) {
  return is_served(module, function) && module.type(function.result_type).kind == Kind::real;
}

}  // namespace twinshade::spirv

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
    case Kind::matrix:
      return "mat" + std::to_string(t.count) + "x" + std::to_string(module.type(t.element).count);
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
  const std::string& file = module.position(function.file, function.line).file;
  if (file.rfind("shaders/exact/", 0) != 0 && file.rfind("shaders/sphere_map/", 0) != 0) return false;
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

std::set<Id> samplers_with_layers_together(const Program& program) {
  std::set<Id> together;  // variables, and parameters that samplers are passed in
  const auto fetches_layers = [&](const FunctionInfo& info) {
    const Function& f = *info.function;
    return (f.name == "exact_fetch_4" || f.name == "sphere_map_fetch_4") && is_served(program.module, f);
  };
  for (const auto& [id, info] : program.functions)
    if (fetches_layers(info)) together.insert(info.function->parameters[0].id);
  for (std::size_t before = 0; before != together.size();) {
    before = together.size();
    for (const auto& [id, info] : program.functions)
      for_each_instruction(info.body.list, [&, &caller = info](const Instruction& i) {
        if (i.op != spv::OpFunctionCall) return;
        const auto& parameters = program.info(i.operands[0]).function->parameters;
        for (std::size_t k = 0; k < parameters.size(); ++k)
          if (together.count(parameters[k].id)) together.insert(root_of(caller, i.operands[k + 1]));
      });
  }
  return together;
}

std::map<Id, Id> samplers_side_by_side(const Program& program) {
  std::map<Id, Id> pairs;
  std::set<Id> taken;
  for (const auto& [id, info] : program.functions)
    for_each_instruction(info.body.list, [&](const Instruction& i) {
      if (i.op != spv::OpFunctionCall) return;
      const Function& callee = *program.info(i.operands[0]).function;
      if (callee.name != "exact_fetch_pair" || !is_served(program.module, callee)) return;
      const Id first = i.operands[1], second = i.operands[2];
      const auto& variables = program.module.variables;
      if (first == second || !variables.count(first) || !variables.count(second)) return;
      if (taken.count(first) || taken.count(second)) return;
      taken.insert({first, second});
      pairs[first] = second;
    });
  return pairs;
}

}  // namespace twinshade::spirv

#include "cpu_shaders/translate/served.h"

#include <algorithm>
#include <initializer_list>

#include "cpu_shaders/runtime/served_names.h"

namespace twinshade::spirv {
namespace {

// A type as GLSL writes it, arrays without their lengths.
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
    case Kind::array:
      return glsl_type(module, t.element) + "[]";
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

namespace {

bool is_served_as(const Module& module, const Function& f, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), f.name) != names.end() && is_served(module, f);
}

}  // namespace

bool fetches_colors(const Module& module, const Function& f) {
  return is_served_as(module, f, {"exact_fetch_colors", "sphere_map_fetch_colors"});
}

bool fetches_all(const Module& module, const Function& f) {
  return fetches_colors(module, f) || is_served_as(module, f, {"exact_fetch_layers"});
}

namespace {

using IsWhole = bool (*)(const Module&, const Function&);

// Adds the variables and parameters that samplers reach those of `samplers` from. Functions that are whole are as good
// as a single instruction.
void follow_samplers_back(const Program& program, std::set<Id>& samplers, IsWhole is_whole = fetches_colors) {
  for (std::size_t before = 0; before != samplers.size();) {
    before = samplers.size();
    for (const auto& [id, info] : program.functions) {
      if (is_whole(program.module, *info.function)) continue;
      for_each_instruction(info.body.list, [&, &caller = info](const Instruction& i) {
        if (i.op != spv::OpFunctionCall) return;
        const auto& parameters = program.info(i.operands[0]).function->parameters;
        for (std::size_t k = 0; k < parameters.size(); ++k)
          if (samplers.count(parameters[k].id)) samplers.insert(root_of(caller, i.operands[k + 1]));
      });
    }
  }
}

// The sampler that an instruction reads texels of.
Id fetched_sampler(const FunctionInfo& info, const Instruction& i) {
  const bool reads = i.op == spv::OpImageFetch || (i.op >= spv::OpImageSampleImplicitLod && i.op <= spv::OpImageRead);
  if (!reads) return 0;
  for (Id value = i.operands[0];;) {
    const Instruction& from = *info.definitions.at(value);
    value = from.operands[0];
    if (from.op == spv::OpLoad) return root_of(info, value);
  }
}

}  // namespace

namespace {

// The samplers that anything reads from but functions that are whole.
std::set<Id> samplers_read_apart(const Program& program, IsWhole is_whole) {
  std::set<Id> samplers;
  for (const auto& [id, info] : program.functions) {
    if (is_whole(program.module, *info.function)) continue;
    for_each_instruction(info.body.list, [&, &reader = info](const Instruction& i) {
      if (const Id sampler = fetched_sampler(reader, i)) samplers.insert(sampler);
    });
  }
  follow_samplers_back(program, samplers, is_whole);
  return samplers;
}

}  // namespace

std::map<Id, LayerOrder> layer_orders(const Program& program) {
  std::set<Id> together, colors;
  const std::set<Id> otherwise = samplers_read_apart(program, fetches_colors);
  for (const auto& [id, info] : program.functions) {
    const Function& f = *info.function;
    if (is_served_as(program.module, f, {"exact_fetch_ones", "exact_fetch_threes", "exact_fetch_layers"}))
      together.insert(f.parameters[0].id);
    if (fetches_colors(program.module, f)) colors.insert(f.parameters[0].id);
  }
  follow_samplers_back(program, together);
  follow_samplers_back(program, colors);
  std::map<Id, LayerOrder> orders;
  for (Id sampler : colors)
    if (!otherwise.count(sampler)) orders[sampler] = LayerOrder::colors_together;
  for (Id sampler : together) orders[sampler] = LayerOrder::together;
  return orders;
}

std::map<Id, std::uint32_t> layers_read(const Program& program) {
  const auto fetches_layers = [](const Module& module, const Function& f) {
    return is_served_as(module, f, {"exact_fetch_layers"});
  };
  const std::set<Id> otherwise = samplers_read_apart(program, fetches_layers);
  std::map<Id, std::uint32_t> read;
  for (const auto& [id, info] : program.functions) {
    const Function& f = *info.function;
    if (!fetches_layers(program.module, f)) continue;
    const Type& filled = program.module.type(program.module.type(f.parameters.back().type).element);
    std::set<Id> samplers{f.parameters[0].id};
    follow_samplers_back(program, samplers, fetches_layers);
    for (Id sampler : samplers)
      if (!otherwise.count(sampler)) read[sampler] = std::max(read[sampler], filled.count);
  }
  return read;
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

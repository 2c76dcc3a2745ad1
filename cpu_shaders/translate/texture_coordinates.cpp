// Patterns: exact_fetch and exact_fetch_pair of shaders/exact/bilinear.glsl, exact_fetch_layers and exact_fetch_colors
// beside it, with the taps of exact_taps_repeat(input, ...) or exact_taps_clamp(input, ...), the functions around
// these, and texture(sampler2D, input).
#include "cpu_shaders/translate/texture_coordinates.h"

namespace twinshade::spirv {
namespace {

class Reader {
 public:
  Reader(const Program& program, const FunctionInfo& info, std::map<Id, TextureCoordinates>& found)
      : module_(program.module), program_(program), info_(info), found_(found) {}

  void run() {
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      if (i.op == spv::OpStore && is_variable(i.operands[0], spv::StorageClassFunction))
        stored_[i.operands[0]] = i.operands[1];
    });
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      if (i.op == spv::OpFunctionCall) call(i);
      if (i.op == spv::OpImageSampleImplicitLod || i.op == spv::OpImageSampleExplicitLod) sample(i);
    });
  }

 private:
  bool is_variable(Id id, spv::StorageClass storage) const {
    const auto v = module_.variables.find(id);
    return v != module_.variables.end() && v->second.storage == storage;
  }

  // What made a value, or the value of a local variable that a pointer leads to. Null: something else.
  const Instruction* made_by(Id id) const {
    for (int steps = 0; steps < 16; ++steps) {
      if (const auto stored = stored_.find(id); stored != stored_.end()) {
        id = stored->second;
        continue;
      }
      const auto definition = info_.definitions.find(id);
      if (definition == info_.definitions.end()) return nullptr;
      const Instruction& i = *definition->second;
      const bool copies = i.op == spv::OpCopyObject || i.op == spv::OpCopyLogical;
      if (!copies && !(i.op == spv::OpLoad && stored_.count(i.operands[0]))) return &i;
      id = i.operands[0];
    }
    return nullptr;
  }

  // The variable that a value, or what a pointer leads to, is all of; 0: none.
  Id variable_behind(Id id, spv::StorageClass storage) const {
    if (is_variable(id, storage)) return id;
    const Instruction* load = made_by(id);
    return load && load->op == spv::OpLoad && is_variable(load->operands[0], storage) ? load->operands[0] : 0;
  }
  Id input_behind(Id id, Kind kind, std::uint32_t count) const {
    const Id variable = variable_behind(id, spv::StorageClassInput);
    if (variable == 0) return 0;
    const Type* type = &module_.type(module_.variables.at(variable).type);
    if (count > 1) {
      if (type->kind != Kind::vector || type->count != count) return 0;
      type = &module_.type(type->element);
    }
    return type->kind == kind ? variable : 0;
  }

  // operands: sampler, coordinates, and a layer where `layered`.
  void note(Id sampler, Id coordinates, bool layered, Id layer) {
    const Id map = variable_behind(sampler, spv::StorageClassUniformConstant);
    if (map == 0 || found_.count(map)) return;
    TextureCoordinates at;
    at.coordinates = input_behind(coordinates, Kind::real, 2);
    const bool first = !layered || is_zero(layer);
    if (!first) at.layer = input_behind(layer, Kind::integer, 1);
    if (at.coordinates != 0 && (first || at.layer != 0)) found_[map] = at;
  }

  bool is_zero(Id value) const {
    const Instruction* made = made_by(value);
    const auto constant = module_.constants.find(stored_.count(value) ? stored_.at(value) : value);
    return made == nullptr && constant != module_.constants.end() && constant->second.components.empty() &&
           constant->second.bits == 0;
  }

  bool is_exact(Id function, std::string_view name) const {
    const Function& f = *program_.info(function).function;
    return f.name == name && module_.position(f.file, f.line).file.rfind("shaders/exact/", 0) == 0;
  }

  void call(const Instruction& i) {
    const Id callee = i.operands[0];
    const auto argument = [&](std::size_t k) { return i.operands[k + 1]; };
    const std::size_t arguments = i.operands.size() - 1;
    // The coordinates of taps.
    const auto filtered_at = [&](Id taps) -> Id {
      const Instruction* made = made_by(taps);
      const bool found =
          made && made->op == spv::OpFunctionCall &&
          (is_exact(made->operands[0], "exact_taps_repeat") || is_exact(made->operands[0], "exact_taps_clamp"));
      return found ? made->operands[1] : 0;
    };
    if (is_exact(callee, "exact_bilinear_2d_repeat") || is_exact(callee, "exact_bilinear_2d")) {
      note(argument(0), argument(1), false, 0);
    } else if (is_exact(callee, "exact_bilinear_2d_array_repeat") || is_exact(callee, "exact_bilinear_2d_array")) {
      note(argument(0), argument(1), true, argument(2));
    } else if (is_exact(callee, "exact_fetch")) {
      note(argument(0), filtered_at(argument(1)), arguments > 2, arguments > 2 ? argument(2) : 0);
    } else if (is_exact(callee, "exact_fetch_pair")) {
      note(argument(0), filtered_at(argument(2)), true, argument(3));
      note(argument(1), filtered_at(argument(2)), true, argument(3));
    } else if (arguments == 3 && (is_exact(callee, "exact_fetch_layers") || is_exact(callee, "exact_fetch_colors"))) {
      note(argument(0), filtered_at(argument(1)), false, 0);
    }
  }

  void sample(const Instruction& i) {
    const Type& sampler = module_.type_of(i.operands[0]);
    if (sampler.kind != Kind::sampler) return;
    const Type& image = module_.type(sampler.element);
    if (image.dimension == spv::Dim2D && !image.arrayed) note(i.operands[0], i.operands[1], false, 0);
  }

  const Module& module_;
  const Program& program_;
  const FunctionInfo& info_;
  std::map<Id, TextureCoordinates>& found_;
  std::map<Id, Id> stored_;  // by local variable: the value that it was stored last, in the order of the code
};

}  // namespace

std::map<Id, TextureCoordinates> texture_coordinates(const Program& program) {
  std::map<Id, TextureCoordinates> found;
  for (const auto& [id, info] : program.functions) Reader(program, info, found).run();
  return found;
}

}  // namespace twinshade::spirv

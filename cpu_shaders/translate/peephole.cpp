// Small rewritings that bring back what the author wrote: vec4(v, 1.0) for the components of v one by one, v * s for v
// * vec3(s), c ? a : b for a condition repeated over components. The result is no longer valid SPIR-V; we are its only
// reader.
#include <algorithm>
#include <set>
#include <unordered_map>

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {
namespace {

class Peephole {
 public:
  Peephole(Module& module, Function& function) : module_(module), function_(function) {}

  void run() {
    for (Block& b : function_.blocks)
      for (Instruction& i : b.code)
        if (i.result != 0) definitions_[i.result] = &i;
    for (Block& b : function_.blocks)
      for (Instruction& i : b.code) {
        if (i.op == spv::OpCompositeConstruct) join_components(i);
        if (i.op == spv::OpMatrixTimesScalar) divide(i);
        drop_splats(i);
      }
    remove_unused();
  }

 private:
  const Instruction* definition(Id id) const {
    const auto found = definitions_.find(id);
    return found == definitions_.end() ? nullptr : found->second;
  }

  // The vector of which `operands[at]` onwards are all the components in order; 0 for none.
  Id whole_vector(const std::vector<Id>& operands, std::size_t at) const {
    Id vector = 0;
    for (std::uint32_t k = 0;; ++k) {
      if (vector != 0 && k == module_.type_of(vector).count) return vector;
      const Instruction* d = at + k < operands.size() ? definition(operands[at + k]) : nullptr;
      if (d == nullptr || d->op != spv::OpCompositeExtract || d->operands.size() != 2 || d->operands[1] != k) return 0;
      if (k == 0) vector = d->operands[0];
      if (d->operands[0] != vector || module_.type_of(vector).kind != Kind::vector) return 0;
    }
  }

  void join_components(Instruction& i) {
    if (module_.type(i.type).kind != Kind::vector) return;
    std::vector<Id> joined;
    for (std::size_t k = 0; k < i.operands.size();) {
      const Id whole = whole_vector(i.operands, k);
      joined.push_back(whole != 0 ? whole : i.operands[k]);
      k += whole != 0 ? module_.type_of(whole).count : 1;
    }
    i.operands = joined;
    if (joined.size() == 1 && module_.value_types.at(joined[0]) == i.type) i.op = spv::OpCopyObject;
  }

  // m * (1.0 / s) back into m / s, where it is glslang's doing (mark_divisions.h).
  void divide(Instruction& i) {
    const Instruction* d = definition(i.operands[1]);
    if (d == nullptr || d->op != spv::OpFDiv || module_.decorations_of(d->result).has(spv::DecorationNoContraction))
      return;
    constexpr std::uint32_t kOne = 0x3f800000;
    const auto dividend = module_.constants.find(d->operands[0]);
    if (dividend == module_.constants.end() || dividend->second.bits != kOne) return;
    reciprocals_.insert(d->result);
    i.op = spv::OpFDiv;
    i.operands[1] = d->operands[1];
  }

  // The scalar that every component of a vector is; 0 for none.
  Id splat(Id id) const {
    const std::vector<Id>* parts = nullptr;
    const auto constant = module_.constants.find(id);
    Id type = 0;
    if (constant != module_.constants.end()) {
      parts = &constant->second.components;
      type = constant->second.type;
    } else if (const Instruction* d = definition(id); d != nullptr && d->op == spv::OpCompositeConstruct) {
      parts = &d->operands;
      type = d->type;
    }
    if (parts == nullptr || module_.type(type).kind != Kind::vector || parts->size() != module_.type(type).count)
      return 0;
    return std::all_of(parts->begin(), parts->end(), [&](Id p) { return p == parts->front(); }) ? parts->front() : 0;
  }

  void drop_splat(Id& operand) const {
    if (const Id scalar = splat(operand); scalar != 0) operand = scalar;
  }

  void drop_splats(Instruction& i) const {
    switch (i.op) {
      case spv::OpFAdd:
      case spv::OpFSub:
      case spv::OpFMul:
      case spv::OpFDiv:
      case spv::OpFMod:
      case spv::OpIAdd:
      case spv::OpISub:
      case spv::OpIMul:
      case spv::OpSDiv:
      case spv::OpUDiv:
      case spv::OpUMod:
      case spv::OpSMod:
      case spv::OpShiftLeftLogical:
      case spv::OpShiftRightLogical:
      case spv::OpShiftRightArithmetic:
      case spv::OpBitwiseAnd:
      case spv::OpBitwiseOr:
      case spv::OpBitwiseXor: {
        // One operand must stay a vector.
        const Id a = splat(i.operands[0]), b = splat(i.operands[1]);
        if (b != 0)
          i.operands[1] = b;
        else if (a != 0)
          i.operands[0] = a;
        return;
      }
      case spv::OpSelect:
        return drop_splat(i.operands[0]);
      case spv::OpExtInst: {
        const std::uint32_t number = i.operands[1];
        const bool min_max = (number >= 37 && number <= 42) || number == 79 || number == 80;
        const bool clamp = (number >= 43 && number <= 45) || number == 81;
        if (min_max) drop_splat(i.operands[3]);
        if (clamp) drop_splat(i.operands[3]), drop_splat(i.operands[4]);
        if (number == 46) drop_splat(i.operands[4]);                           // mix
        if (number == 48) drop_unless_all(i, 2, 3);                            // step(edge, x)
        if (number == 49) drop_unless_all(i, 2, 4), drop_unless_all(i, 3, 4);  // smoothstep(low, high, x)
        return;
      }
      default:
        return;
    }
  }

  // Drops the operand unless the one that gives the result its size may be a scalar as well.
  void drop_unless_all(Instruction& i, std::size_t operand, std::size_t vector) const {
    if (module_.type_of(i.operands[vector]).kind == Kind::vector) drop_splat(i.operands[operand]);
  }

  void remove_unused() {
    std::unordered_map<Id, int> uses;
    const auto note = [&](const Instruction& i, int by) {
      for (Id id : value_operands(i)) uses[id] += by;
      if (i.op == spv::OpPhi)
        for (std::size_t k = 0; k < i.operands.size(); k += 2) uses[i.operands[k]] += by;
    };
    for (const Block& b : function_.blocks) {
      for (const Instruction& i : b.code) note(i, 1);
      for (const Instruction& i : b.phis) note(i, 1);
      note(b.terminator, 1);
    }
    for (auto b = function_.blocks.rbegin(); b != function_.blocks.rend(); ++b)
      for (std::size_t k = b->code.size(); k-- > 0;) {
        const Instruction& i = b->code[k];
        const bool only_shapes = i.op == spv::OpCompositeExtract || i.op == spv::OpCompositeConstruct;
        if ((!only_shapes && !reciprocals_.count(i.result)) || uses[i.result] != 0) continue;
        note(i, -1);
        b->code.erase(b->code.begin() + static_cast<std::ptrdiff_t>(k));
      }
  }

  Module& module_;
  Function& function_;
  std::unordered_map<Id, const Instruction*> definitions_;
  std::set<Id> reciprocals_;  // of which divisions were made
};

}  // namespace

void simplify(Module& module, Function& function) { Peephole(module, function).run(); }

}  // namespace twinshade::spirv

#include <algorithm>
#include <unordered_map>

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {
namespace {

// More than this many instructions in an arm are worth a branch, without those that become no code: naming variables,
// taking values apart and putting them together.
constexpr std::ptrdiff_t kMostInstructionsInArm = 24;

bool is_pure(const Instruction& i) {
  switch (i.op) {
    case spv::OpStore:
    case spv::OpFunctionCall:
    case spv::OpVariable:
    case spv::OpImageSampleImplicitLod:
    case spv::OpImageSampleExplicitLod:
    case spv::OpImageSampleProjImplicitLod:
    case spv::OpImageSampleProjExplicitLod:
    case spv::OpImageGather:
    case spv::OpImageFetch:
    case spv::OpDPdx:
    case spv::OpDPdy:
    case spv::OpFwidth:
    case spv::OpDPdxFine:
    case spv::OpDPdyFine:
    case spv::OpFwidthFine:
    case spv::OpDPdxCoarse:
    case spv::OpDPdyCoarse:
    case spv::OpFwidthCoarse:
      return false;
    case spv::OpExtInst:
      return i.operands[1] != 35;  // modf stores
    default:
      return i.result != 0 && !(i.op >= spv::OpAtomicLoad && i.op <= spv::OpAtomicXor);
  }
}

class Folder {
 public:
  Folder(Module& module, Body& body) : module_(module) {
    for_each_instruction(body.list, [&](const Instruction& i) {
      if (i.op == spv::OpStore) ++stores_[i.operands[0]];
      if (i.op == spv::OpLoad) ++loads_[i.operands[0]];
      for (Id id : value_operands(i)) ++mentions_[id];
      if (i.is_chain()) pointers_into_[i.result] = is_free(i) && !is_buffer(i.operands[0]);
    });
    fold(body.list);
    for_each_instruction(body.list, [&](Instruction& i) {
      if (i.op == spv::OpLoad && folded_.count(i.operands[0])) i.op = spv::OpCopyObject;
    });
  }

 private:
  // A temporary of glslang's (?:) or ours (phi): no name, `stores` stores, one load, no other use.
  bool is_temporary(Id variable, int stores) {
    return module_.variables.count(variable) && module_.name(variable).empty() && stores_[variable] == stores &&
           loads_[variable] == 1 && mentions_[variable] == stores + 1;
  }

  // The arm as pure instructions; null if it is anything else.
  static std::vector<Instruction>* pure_code(List& arm, std::size_t statements = 1) {
    if (arm.size() != statements || arm[0]->shape != Shape::code) return nullptr;
    return &arm[0]->code;
  }

  bool all_pure(const std::vector<Instruction>& code, std::size_t count) const {
    const auto end = code.begin() + static_cast<std::ptrdiff_t>(count);
    return std::all_of(code.begin(), end, is_pure) && std::count_if(code.begin(), end, [&](const Instruction& i) {
                                                        return !is_free(i);
                                                      }) <= kMostInstructionsInArm;
  }

  bool is_buffer(Id variable) const {
    const auto v = module_.variables.find(variable);
    return v != module_.variables.end() &&
           (v->second.storage == spv::StorageClassUniform || v->second.storage == spv::StorageClassWorkgroup);
  }

  bool is_free(const Instruction& i) const {
    switch (i.op) {
      case spv::OpCopyObject:
      case spv::OpCompositeConstruct:
      case spv::OpCompositeExtract:
      case spv::OpVectorShuffle:
        return true;
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
        return std::all_of(i.operands.begin() + 1, i.operands.end(),
                           [&](Id index) { return module_.is_constant(index); });
      case spv::OpLoad:  // of a variable, a parameter, or a part of one; buffers are memory
        if (!pointers_into_.count(i.operands[0])) return !is_buffer(i.operands[0]);
        return pointers_into_.at(i.operands[0]);
      default:
        return false;
    }
  }

  static void merge_neighbours(List& list) {
    for (std::size_t k = 0; k + 1 < list.size();) {
      if (list[k]->shape == Shape::code && list[k + 1]->shape == Shape::code) {
        auto& code = list[k]->code;
        code.insert(code.end(), list[k + 1]->code.begin(), list[k + 1]->code.end());
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      } else {
        ++k;
      }
    }
  }

  void fold(List& list) {
    for (auto& s : list) {
      fold(s->then_list);
      fold(s->else_list);
      fold(s->body);
      fold(s->continuing);
      for (Case& c : s->cases) fold(c.body);
    }
    merge_neighbours(list);
    while (fold_one(list)) merge_neighbours(list);
  }

  bool fold_one(List& list) {
    for (std::size_t k = 0; k < list.size(); ++k)
      if (list[k]->shape == Shape::choice && (ternary(*list[k]) || logical(list, k) || returns(list, k))) return true;
    return false;
  }

  // if (c) { ...; t = a; } else { ...; t = b; }
  bool ternary(Statement& s) {
    auto* then_code = pure_code(s.then_list);
    auto* else_code = pure_code(s.else_list);
    if (!then_code || !else_code) return false;
    const Instruction &a = then_code->back(), &b = else_code->back();
    if (a.op != spv::OpStore || b.op != spv::OpStore || a.operands[0] != b.operands[0]) return false;
    if (!is_temporary(a.operands[0], 2) || !all_pure(*then_code, then_code->size() - 1) ||
        !all_pure(*else_code, else_code->size() - 1))
      return false;
    become_select(s, *then_code, *else_code, a.operands[0], a.operands[1], b.operands[1]);
    return true;
  }

  // The temporary's id from now on names the value that was stored in it.
  Id become_value(Id temporary) {
    module_.value_types[temporary] = module_.variables.at(temporary).type;
    module_.variables.erase(temporary);
    folded_.insert(temporary);
    return temporary;
  }

  void become_select(Statement& s, std::vector<Instruction> then_code, std::vector<Instruction> else_code, Id temporary,
                     Id a, Id b) {
    const Instruction store = then_code.back();
    then_code.pop_back();
    else_code.pop_back();
    s.code = std::move(then_code);
    s.code.insert(s.code.end(), else_code.begin(), else_code.end());
    Instruction select = store;
    select.op = spv::OpSelect;
    select.type = module_.variables.at(temporary).type;
    select.result = become_value(temporary);
    select.operands = {s.condition, a, b};
    s.code.push_back(select);
    s.shape = Shape::code;
    s.condition = 0;
    s.then_list.clear();
    s.else_list.clear();
  }

  // t = c; if (c) { ...; t = a; }     is t = c && a
  // t = c; if (!c) { ...; t = a; }    is t = c || a
  bool logical(List& list, std::size_t k) {
    Statement& s = *list[k];
    auto* then_code = pure_code(s.then_list);
    if (k == 0 || !then_code || !s.else_list.empty() || list[k - 1]->shape != Shape::code) return false;
    auto& before = list[k - 1]->code;
    const Instruction& a = then_code->back();
    if (before.empty() || before.back().op != spv::OpStore || a.op != spv::OpStore) return false;
    const Id temporary = before.back().operands[0], first = before.back().operands[1];
    if (a.operands[0] != temporary || !is_temporary(temporary, 2) || !all_pure(*then_code, then_code->size() - 1))
      return false;
    spv::Op op = spv::OpLogicalAnd;
    if (s.condition != first) {
      const bool inverted = std::any_of(before.begin(), before.end(), [&](const Instruction& i) {
        return i.result == s.condition && i.op == spv::OpLogicalNot && i.operands[0] == first;
      });
      if (!inverted) return false;
      op = spv::OpLogicalOr;
      before.erase(
          std::remove_if(before.begin(), before.end(), [&](const Instruction& i) { return i.result == s.condition; }),
          before.end());
    }
    Instruction result = a;
    result.op = op;
    result.type = module_.variables.at(temporary).type;
    result.result = become_value(temporary);
    result.operands = {first, a.operands[1]};
    before.pop_back();
    s.code.assign(then_code->begin(), then_code->end() - 1);
    s.code.push_back(result);
    s.shape = Shape::code;
    s.condition = 0;
    s.then_list.clear();
    return true;
  }

  // if (c) return a; return b;  and the same with else, at the end of a function, both pure
  bool returns(List& list, std::size_t k) {
    Statement& s = *list[k];
    std::vector<Instruction> then_code, else_code;
    Id a = 0, b = 0;
    if (!pure_return(s.then_list, then_code, a)) return false;
    if (s.else_list.empty()) {
      std::vector<const Statement*> rest;
      for (std::size_t i = k + 1; i < list.size(); ++i) rest.push_back(list[i].get());
      if (!pure_return(rest, else_code, b)) return false;
    } else if (k + 1 != list.size() || !pure_return(s.else_list, else_code, b)) {
      return false;
    }
    Instruction select;
    select.op = spv::OpSelect;
    select.type = module_.value_types.at(a);
    select.operands = {s.condition, a, b};
    select.file = s.file;
    select.line = s.line;
    select.result = module_.new_id();
    s.code = std::move(then_code);
    s.code.insert(s.code.end(), else_code.begin(), else_code.end());
    s.code.push_back(select);
    auto give_back = std::make_unique<Statement>();
    give_back->shape = Shape::give_back;
    give_back->id = s.id;
    give_back->file = s.file;
    give_back->line = s.line;
    give_back->value = select.result;
    module_.value_types[select.result] = select.type;
    s.shape = Shape::code;
    s.condition = 0;
    s.then_list.clear();
    s.else_list.clear();
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(k) + 1, list.end());
    list.push_back(std::move(give_back));
    return true;
  }

  template <class Statements>
  bool pure_return(const Statements& arm, std::vector<Instruction>& code, Id& value) {
    if (arm.empty() || arm.size() > 2 || arm.back()->shape != Shape::give_back || arm.back()->value == 0) return false;
    if (arm.size() == 2) {
      if (arm[0]->shape != Shape::code || !all_pure(arm[0]->code, arm[0]->code.size())) return false;
      code = arm[0]->code;
    }
    value = arm.back()->value;
    return true;
  }

  Module& module_;
  std::set<Id> folded_;
  std::unordered_map<Id, bool> pointers_into_;  // by access chain: whether it leads to a part at constant indices
  std::unordered_map<Id, int> stores_, loads_, mentions_;
};

}  // namespace

void fold_conditionals(Module& module, Body& body) { Folder folder(module, body); }

}  // namespace twinshade::spirv

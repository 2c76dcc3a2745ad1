#include "cpu_shaders/translate/direct_arguments.h"

#include <algorithm>

namespace twinshade::spirv {
namespace {

class Finder {
 public:
  Finder(const Program& program, const Instances& instances, const Instance& at)
      : program_(program), module_(program.module), info_(*at.info), instances_(instances), at_(at) {
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      for (Id id : value_operands(i)) mentions_[id].push_back(&i);
    });
  }

  DirectArguments run() {
    for_each_statement(info_.body.list, [&](const Statement& s) {
      for (std::size_t k = 0; k < s.code.size(); ++k)
        if (s.code[k].op == spv::OpFunctionCall) call(s.code, k);
    });
    return std::move(result_);
  }

 private:
  bool is_stored_in(Id id, spv::StorageClass storage) const {
    const auto v = module_.variables.find(id);
    return v != module_.variables.end() && v->second.storage == storage;
  }
  bool is_local(Id id) const { return is_stored_in(id, spv::StorageClassFunction); }
  bool is_global(Id id) const { return is_stored_in(id, spv::StorageClassPrivate); }

  static std::size_t position(const std::vector<Instruction>& code, const Instruction* i) {
    return i >= code.data() && i < code.data() + code.size() ? static_cast<std::size_t>(i - code.data()) : code.size();
  }

  bool touches(const Instruction& i, Id variable) const {
    for (Id id : value_operands(i))
      if (root_of(info_, id) == variable) return true;
    return false;
  }

  // Whether a value of the one type can be the whole or a part of one of the other.
  bool overlap(Id a, Id b) const { return holds(a, b) || holds(b, a); }
  bool holds(Id whole, Id part) const {
    if (whole == part) return true;
    const Type& t = module_.type(whole);
    if (t.kind == Kind::array) return holds(t.element, part);
    return t.kind == Kind::structure &&
           std::any_of(t.members.begin(), t.members.end(), [&](Id member) { return holds(member, part); });
  }

  // A structure or an array that is passed uncopied could be the very variable, or a part of it.
  bool may_be_passed_twice(const Instruction& i, const FunctionInfo& callee, Id variable) const {
    for (std::size_t k = 0; k + 1 < i.operands.size(); ++k) {
      const Id type = callee.parameter_type(module_, k);
      const Kind kind = module_.type(type).kind;
      if (!callee.is_reference(k) && (kind == Kind::structure || kind == Kind::array) &&
          overlap(type, module_.variables.at(variable).type))
        return true;
    }
    return false;
  }

  void call(const std::vector<Instruction>& code, std::size_t at) {
    const Instruction& i = code[at];
    const FunctionInfo& callee = program_.info(i.operands[0]);
    std::set<Id> taken;
    for (std::size_t k = 0; k + 1 < i.operands.size(); ++k)
      if (callee.is_reference(k)) argument(code, at, i.operands[k + 1], taken);
  }

  // `temporary` is stored at most once before the call and loaded once after it, into a variable that could have been
  // passed.
  void argument(const std::vector<Instruction>& code, std::size_t at, Id temporary, std::set<Id>& taken) {
    if (!is_local(temporary) || module_.name(temporary) != "param") return;
    const Instruction *in = nullptr, *out = nullptr;
    for (const Instruction* m : mentions_[temporary]) {
      const std::size_t where = position(code, m);
      if (where == code.size()) return;
      if (where == at) continue;
      if (m->op == spv::OpStore && m->operands[0] == temporary && where < at && in == nullptr) {
        in = m;
      } else if (m->op == spv::OpLoad && where > at && out == nullptr) {
        out = m;
      } else {
        return;
      }
    }
    if (out == nullptr || mentions_[out->result].size() != 1) return;
    const Instruction* copy = mentions_[out->result][0];
    const std::size_t copied = position(code, copy);
    if (copied == code.size() || copy->op != spv::OpStore || copy->operands[1] != out->result) return;
    const Id variable = copy->operands[0];
    if (!may_stand_for(variable, temporary, code[at])) return;
    if (at_.partial.count(copy) || taken.count(variable)) return;
    for (std::size_t k = at + 1; k < copied; ++k)
      if (touches(code[k], variable)) return;
    const Instruction* loaded = nullptr;
    if (in != nullptr) {
      const auto definition = info_.definitions.find(in->operands[1]);
      if (definition == info_.definitions.end()) return;
      loaded = definition->second;
      const std::size_t from = position(code, loaded);
      if (from >= at || loaded->op != spv::OpLoad || loaded->operands[0] != variable ||
          mentions_[loaded->result].size() != 1)
        return;
      for (std::size_t k = from + 1; k < at; ++k)
        if (touches(code[k], variable) && code[k].op != spv::OpLoad && code[k].op != spv::OpAccessChain) return;
    }
    taken.insert(variable);
    result_.variable[temporary] = variable;
    for (const Instruction* skipped : {in, static_cast<const Instruction*>(loaded), out, copy})
      if (skipped != nullptr) result_.skipped.insert(skipped);
  }

  bool may_stand_for(Id variable, Id temporary, const Instruction& call) const {
    const FunctionInfo& callee = program_.info(call.operands[0]);
    bool varying = at_.is_varying(variable);
    if (is_global(variable)) {
      if (callee.globals_read.count(variable) || callee.globals_written.count(variable)) return false;
      varying = instances_.varying_globals.count(variable) != 0;
    } else if (!is_local(variable) || module_.name(variable) == "param" || info_.constant_tables.count(variable)) {
      return false;
    }
    return varying == at_.is_varying(temporary) && !may_be_passed_twice(call, callee, variable);
  }

  const Program& program_;
  const Module& module_;
  const FunctionInfo& info_;
  const Instances& instances_;
  const Instance& at_;
  DirectArguments result_;
  std::map<Id, std::vector<const Instruction*>> mentions_;
};

}  // namespace

DirectArguments DirectArguments::find(const Program& program, const Instances& instances, const Instance& instance) {
  return Finder(program, instances, instance).run();
}

}  // namespace twinshade::spirv

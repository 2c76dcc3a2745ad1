// Which local variables may still be read: backwards over the statement tree, one invocation's view (Aho, Lam, Sethi,
// Ullman, Compilers, 2nd edition, section 9.2.5). A store that only some lanes execute must keep the other lanes'
// values exactly where the variable is live for them.
#include <map>

#include "cpu_shaders/translate/function_info.h"
#include "cpu_shaders/translate/served.h"

namespace twinshade::spirv {
namespace {

using Set = IdSet;

class Liveness {
 public:
  Liveness(Program& program, FunctionInfo& info) : program_(program), module_(program.module), info_(info) {
    for (std::size_t k : info.written_parameters)
      if (info.returned_parameters.count(k)) live_out_.insert(info.function->parameters[k].id);
  }

  Set run() { return before(info_.body.list, live_out_); }

 private:
  Set before(List& list, Set live) {
    for (std::size_t k = list.size(); k-- > 0;) live = before(*list[k], std::move(live));
    return live;
  }

  Set before(Statement& s, Set live) {
    s.live_after = live;
    switch (s.shape) {
      case Shape::code:
        return code(s, std::move(live));
      case Shape::choice: {
        s.live_else = before(s.else_list, live);
        Set result = before(s.then_list, live);
        result.insert(s.live_else);
        return result;
      }
      case Shape::loop:
        return loop(s, live);
      case Shape::cases:
        return cases(s, live);
      case Shape::leave_loop:
      case Shape::leave_cases:
        return s.target->live_after;
      case Shape::next_iteration:
        return s.target->live_continuing;
      case Shape::give_back:
        return live_out_;
      case Shape::discard:
      case Shape::unreachable:
        return {};
    }
    return live;
  }

  Set loop(Statement& s, const Set& after) {
    // Sets only grow from one visit to the next: what the last one found is a start, lest the time double with each
    // loop around this one.
    Set head = s.live_head;
    for (;;) {
      Set back = head;
      if (s.back_condition != 0) back.insert(after);
      s.live_continuing = before(s.continuing, back);
      Set next = before(s.body, s.live_continuing);
      if (next == head) return s.live_head = head;
      next.insert(head);
      head = std::move(next);
    }
  }

  Set cases(Statement& s, const Set& after) {
    Set result;
    s.live_cases.assign(s.cases.size(), {});
    bool has_default = false;
    for (std::size_t k = s.cases.size(); k-- > 0;) {
      Case& c = s.cases[k];
      has_default |= c.is_default;
      s.live_cases[k] = before(c.body, c.falls_through ? s.live_cases[k + 1] : after);
      result.insert(s.live_cases[k]);
    }
    if (!has_default) result.insert(after);
    return result;
  }

  bool tracked(Id root) const {
    const auto v = module_.variables.find(root);
    if (v != module_.variables.end()) return v->second.storage == spv::StorageClassFunction;
    for (const Parameter& p : info_.function->parameters)
      if (p.id == root) return true;
    return false;
  }

  // Members that stores write one by one, until all are written: then the variable is written whole.
  void member_store(Id pointer, Id root, Set& live) {
    const auto found = info_.definitions.find(pointer);
    if (found == info_.definitions.end() || found->second->operands.size() != 2 || found->second->operands[0] != root)
      return;
    const Id index = found->second->operands[1];
    const Type& type = module_.type(module_.type_of(root).element);
    const std::size_t members = type.kind == Kind::structure ? type.members.size() : type.count;
    if (!module_.is_constant(index) || members == 0) return;
    auto& written = written_members_[root];
    written.insert(module_.constants.at(index).bits);
    if (written.size() == members) live.erase(root);
  }

  void read(Id pointer, Set& live) {
    const Id root = root_of(info_, pointer);
    if (!tracked(root)) return;
    live.insert(root);
    written_members_.erase(root);
  }

  Set code(const Statement& s, Set live) {
    written_members_.clear();
    for (std::size_t k = s.code.size(); k-- > 0;) {
      const Instruction& i = s.code[k];
      if (i.op == spv::OpLoad) {
        read(i.operands[0], live);
      } else if (i.op == spv::OpStore) {
        const Id root = root_of(info_, i.operands[0]);
        if (i.operands[0] == root)
          live.erase(root);
        else
          member_store(i.operands[0], root, live);
      } else if (i.op == spv::OpFunctionCall) {
        const FunctionInfo& callee = program_.info(i.operands[0]);
        for (std::size_t a = 0; a + 1 < i.operands.size(); ++a)
          if (callee.written_parameters.count(a) && !callee.read_first_parameters.count(a))
            live.erase(i.operands[a + 1]);
        for (std::size_t a = 0; a + 1 < i.operands.size(); ++a) {
          const bool only_written = callee.written_parameters.count(a) && !callee.read_first_parameters.count(a);
          if (module_.type_of(i.operands[a + 1]).kind == Kind::pointer && !only_written) read(i.operands[a + 1], live);
        }
      }
    }
    return live;
  }

  Program& program_;
  const Module& module_;
  FunctionInfo& info_;
  Set live_out_;
  std::map<Id, std::set<std::uint32_t>> written_members_;
};

}  // namespace

void compute_liveness(Program& program, FunctionInfo& info) {
  const Set entry = Liveness(program, info).run();
  for (std::size_t k = 0; k < info.function->parameters.size(); ++k)
    if (entry.count(info.function->parameters[k].id)) info.read_first_parameters.insert(k);
  // These fill the whole of their last parameter, their GLSL element by element.
  if (fetches_all(program.module, *info.function))
    info.read_first_parameters.erase(info.function->parameters.size() - 1);
}

}  // namespace twinshade::spirv

#include "cpu_shaders/translate/written_first.h"

#include <algorithm>
#include <map>

namespace twinshade::spirv {
namespace {

enum class First { nothing, whole, other };

class Search {
 public:
  Search(const Program& program, Id global) : program_(program), global_(global) {}

  // What becomes of the global first in the function. Only what every lane comes to counts: branches must both write it
  // or leave it alone, loops must leave it alone, and nothing must let some lanes go, since stores of the whole
  // function have masks then.
  First in_function(const FunctionInfo& info) {
    const auto [found, is_new] = found_.try_emplace(&info, First::other);  // each once, however often it is called
    if (!is_new) return found->second;
    if (std::none_of(info.body.list.begin(), info.body.list.end(), [](const auto& s) { return lanes_may_go(*s); }))
      found->second = in_list(info, info.body.list);
    return found->second;
  }

 private:
  First in_list(const FunctionInfo& info, const List& list) {
    for (const auto& s : list) {
      if (s->shape == Shape::give_back) break;
      First first = First::nothing;
      if (s->shape == Shape::choice) {
        first = in_list(info, s->then_list);
        if (in_list(info, s->else_list) != first) first = First::other;
      } else if (s->shape != Shape::code && is_mentioned(*s)) {
        first = First::other;
      }
      for (const Instruction& i : s->code)
        if (first == First::nothing) first = in_instruction(info, i);
      if (first != First::nothing) return first;
    }
    return First::nothing;
  }

  First in_instruction(const FunctionInfo& info, const Instruction& i) {
    if (i.op == spv::OpStore && i.operands[0] == global_)
      return is_partly_filled(info, i.operands[1]) ? First::other : First::whole;
    for (Id id : value_operands(i))
      if (id == global_) return First::other;
    if (i.op != spv::OpFunctionCall) return First::nothing;
    const FunctionInfo& callee = program_.info(i.operands[0]);
    if (callee.discards) return First::other;
    const bool knows = callee.globals_read.count(global_) || callee.globals_written.count(global_);
    return knows ? in_function(callee) : First::nothing;
  }

  // Whether a value is what a callee gives back in a parameter that it may leave as it was, in part: the global itself
  // may have been passed.
  bool is_partly_filled(const FunctionInfo& info, Id value) const {
    const auto load = info.definitions.find(value);
    if (load == info.definitions.end() || load->second->op != spv::OpLoad) return false;
    bool found = false;
    for_each_instruction(info.body.list, [&](const Instruction& i) {
      if (i.op != spv::OpFunctionCall) return;
      const FunctionInfo& callee = program_.info(i.operands[0]);
      for (std::size_t k = 0; k + 1 < i.operands.size(); ++k)
        found |= i.operands[k + 1] == load->second->operands[0] && callee.read_first_parameters.count(k) != 0;
    });
    return found;
  }

  static bool lanes_may_go(const Statement& s) {
    bool found = s.shape == Shape::discard;
    for_each_inside(
        s, [&](const Statement& inner) { found |= inner.shape == Shape::give_back || inner.shape == Shape::discard; });
    return found;
  }

  bool is_mentioned(const Statement& s) const {
    bool found = false;
    for_each_inside(s, [&](const Statement& inner) {
      for (const Instruction& i : inner.code) {
        for (Id id : value_operands(i)) found |= id == global_;
        if (i.op != spv::OpFunctionCall) continue;
        const FunctionInfo& callee = program_.info(i.operands[0]);
        found |= callee.discards || callee.globals_read.count(global_) || callee.globals_written.count(global_);
      }
    });
    return found;
  }

  template <class Visit>
  static void for_each_inside(const Statement& s, Visit visit) {
    for (const List* list : {&s.then_list, &s.else_list, &s.body, &s.continuing}) for_each_statement(*list, visit);
    for (const Case& c : s.cases) for_each_statement(c.body, visit);
  }

  const Program& program_;
  const Id global_;
  std::map<const FunctionInfo*, First> found_;
};

}  // namespace

bool is_written_first(const Program& program, Id global) {
  return Search(program, global).in_function(program.info(program.module.entry)) == First::whole;
}

}  // namespace twinshade::spirv

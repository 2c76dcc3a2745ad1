// The control flow of a function as a tree of statements, rebuilt from SPIR-V's structured blocks.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "cpu_shaders/translate/id_set.h"

namespace twinshade::spirv {

struct Statement;
using List = std::vector<std::unique_ptr<Statement>>;

struct Case {
  std::vector<std::uint32_t> values;
  bool is_default = false;
  bool falls_through = false;  // into the next case; otherwise its end leaves the switch
  List body;
};

enum class Shape {
  code,
  choice,
  loop,
  cases,
  leave_loop,
  next_iteration,
  leave_cases,
  give_back,
  discard,
  unreachable
};

struct Statement {
  Shape shape = Shape::code;
  int id = 0;  // unique in its function
  std::uint32_t file = 0;
  int line = 0;

  std::vector<Instruction> code;  // code

  Id condition = 0;  // choice: the condition; cases: the selector
  List then_list, else_list;

  // loop: body, then `continuing`, then again while back_condition (0: always; inverted: while it is false)
  List body, continuing;
  Id back_condition = 0;
  bool back_inverted = false;

  std::vector<Case> cases;

  Statement* target = nullptr;  // leave_loop, next_iteration, leave_cases
  Id value = 0;                 // give_back; 0: void

  // Filled by liveness (variables whose value may still be read): after the statement, at the start of the else branch,
  // of a loop's `continuing` and body, of each case.
  IdSet live_after, live_else, live_continuing, live_head;
  std::vector<IdSet> live_cases;
};

struct Body {
  List list;
  int statement_count = 0;
};

// Makes phis of `function` into variables of `module` (new ids), then builds the tree.
Body structure(Module& module, Function& function);

// Calls visit(statement) on every statement, outer before inner.
template <class Visit>
void for_each_statement(const List& list, Visit&& visit) {
  for (const auto& s : list) {
    visit(*s);
    for_each_statement(s->then_list, visit);
    for_each_statement(s->else_list, visit);
    for_each_statement(s->body, visit);
    for_each_statement(s->continuing, visit);
    for (const Case& c : s->cases) for_each_statement(c.body, visit);
  }
}

template <class Visit>
void for_each_instruction(const List& list, Visit&& visit) {
  for_each_statement(list, [&](Statement& s) {
    for (Instruction& i : s.code) visit(i);
  });
}

}  // namespace twinshade::spirv

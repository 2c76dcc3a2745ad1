#include "cpu_shaders/translate/structure.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "cpu_shaders/translate/limits.h"

namespace twinshade::spirv {
namespace {

// A phi becomes a variable: stored at the end of each predecessor, loaded where the phi was. (glslang writes phis for
// && and || only: no two of them feed each other.)
void lower_phis(Module& module, Function& function) {
  const auto pointer_to = [&](Id type) {
    for (const auto& [id, t] : module.types)
      if (t.kind == Kind::pointer && t.storage == spv::StorageClassFunction && t.element == type) return id;
    Type t;
    t.kind = Kind::pointer;
    t.element = type;
    const Id id = module.new_id();
    module.types[id] = t;
    return id;
  };
  std::map<Id, Block*> blocks;
  for (Block& b : function.blocks) blocks[b.label] = &b;
  for (Block& b : function.blocks) {
    for (const Instruction& phi : b.phis) {
      Variable v;
      const Id pointer = pointer_to(phi.type);
      v.id = module.new_id();
      v.type = phi.type;
      module.variables[v.id] = v;
      module.value_types[v.id] = pointer;
      for (std::size_t k = 0; k + 1 < phi.operands.size(); k += 2) {
        Instruction store;
        store.op = spv::OpStore;
        store.operands = {v.id, phi.operands[k]};
        Block& from = *blocks.at(phi.operands[k + 1]);
        store.file = from.terminator.file;
        store.line = from.terminator.line;
        from.code.push_back(store);
      }
      Instruction load;
      load.op = spv::OpLoad;
      load.type = phi.type;
      load.result = phi.result;
      load.operands = {v.id};
      load.file = phi.file;
      load.line = phi.line;
      b.code.insert(b.code.begin(), load);
    }
    b.phis.clear();
  }
}

class Builder {
 public:
  Builder(const Module& module, const Function& function) : module_(module) {
    for (const Block& b : function.blocks) blocks_[b.label] = &b;
  }

  // Where control may go from inside a construct, innermost last.
  struct Exit {
    Id label;
    enum class To { merge, loop_end, loop_next, cases_end, next_case } to;
    Statement* construct;
  };

  // Statements from block `label` on, until an exit. `reaches_end` tells whether the innermost `merge` or next case is
  // reached.
  List from(Id label, bool& reaches_end) {
    List list;
    reaches_end = false;
    if (++depth_ > kMostNesting)
      throw UserError(module_.position(blocks_.at(label)->terminator).text() + ": statements are nested more than " +
                      std::to_string(kMostNesting) + " deep");
    for (Id at = label; at != 0 && !leave(at, list, reaches_end);) at = block(*blocks_.at(at), list);
    --depth_;
    return list;
  }

  int count() const { return next_id_; }

 private:
  Statement* add(List& list, Shape shape, const Instruction& where) {
    auto s = std::make_unique<Statement>();
    s->shape = shape;
    s->id = next_id_++;
    s->file = where.file;
    s->line = where.line;
    list.push_back(std::move(s));
    return list.back().get();
  }

  // If `label` is an exit of an enclosing construct, says so in the list.
  bool leave(Id label, List& list, bool& reaches_end) {
    for (std::size_t k = exits_.size(); k-- > 0;) {
      const Exit& e = exits_[k];
      if (e.label != label) continue;
      const Instruction nowhere;
      switch (e.to) {
        case Exit::To::merge:
        case Exit::To::next_case:
          TWINSHADE_CHECK_EQ(k, exits_.size() - 1);
          reaches_end = true;
          break;
        case Exit::To::loop_end:
          add(list, Shape::leave_loop, nowhere)->target = e.construct;
          left_.insert(e.construct);
          break;
        case Exit::To::loop_next:
          add(list, Shape::next_iteration, nowhere)->target = e.construct;
          break;
        case Exit::To::cases_end:
          add(list, Shape::leave_cases, nowhere)->target = e.construct;
          left_.insert(e.construct);
          break;
      }
      return true;
    }
    return false;
  }

  void append_code(const Block& b, List& list) {
    if (b.code.empty()) return;
    add(list, Shape::code, b.code.front())->code = b.code;
  }

  // Appends a block and what its terminator makes; returns the block that follows, 0 for none.
  Id block(const Block& b, List& list) {
    if (b.loop_merge != 0 && !loops_.count(b.label)) return loop(b, list);
    append_code(b, list);
    const Instruction& t = b.terminator;
    switch (t.op) {
      case spv::OpBranch:
        return t.operands[0];
      case spv::OpBranchConditional:
        return conditional(b, list);
      case spv::OpSwitch:
        return cases(b, list);
      case spv::OpReturn:
        add(list, Shape::give_back, t);
        return 0;
      case spv::OpReturnValue:
        add(list, Shape::give_back, t)->value = t.operands[0];
        return 0;
      case spv::OpKill:
        add(list, Shape::discard, t);
        return 0;
      default:
        add(list, Shape::unreachable, t);
        return 0;
    }
  }

  Id conditional(const Block& b, List& list) {
    const Instruction& t = b.terminator;
    Statement* s = add(list, Shape::choice, t);
    s->condition = t.operands[0];
    const Id then_label = t.operands[1], else_label = t.operands[2];
    if (b.selection_merge == 0) {
      // The test at a loop's head: one side leaves, the other goes on.
      bool reaches = false;
      if (leave(else_label, s->else_list, reaches)) return then_label;
      TWINSHADE_CHECK_EQ(leave(then_label, s->then_list, reaches), true);
      return else_label;
    }
    exits_.push_back({b.selection_merge, Exit::To::merge, s});
    bool then_reaches = false, else_reaches = false;
    s->then_list = from(then_label, then_reaches);
    s->else_list = from(else_label, else_reaches);
    exits_.pop_back();
    return then_reaches || else_reaches ? b.selection_merge : 0;
  }

  Id loop(const Block& b, List& list) {
    loops_.insert(b.label);
    Statement* s = add(list, Shape::loop, b.terminator);
    exits_.push_back({b.loop_merge, Exit::To::loop_end, s});
    // A loop whose header is its own continue target has an empty body before the test.
    exits_.push_back({b.loop_continue, Exit::To::loop_next, s});
    bool reaches = false;
    s->body = from(b.label, reaches);
    exits_.pop_back();
    exits_.pop_back();
    if (!s->body.empty() && s->body.back()->shape == Shape::next_iteration && s->body.back()->target == s)
      s->body.pop_back();
    continuing(b, *s);
    return left_.count(s) ? b.loop_merge : 0;
  }

  // The blocks from the continue target to the back edge.
  void continuing(const Block& header, Statement& s) {
    exits_.push_back({header.loop_merge, Exit::To::loop_end, &s});
    for (Id at = header.loop_continue; at != header.label;) {
      const Block& b = *blocks_.at(at);
      append_code(b, s.continuing);
      const Instruction& t = b.terminator;
      if (t.op == spv::OpBranch) {
        at = t.operands[0];
      } else if (t.op == spv::OpBranchConditional && b.selection_merge != 0) {
        Statement* choice = add(s.continuing, Shape::choice, t);
        choice->condition = t.operands[0];
        exits_.push_back({b.selection_merge, Exit::To::merge, choice});
        bool then_reaches = false, else_reaches = false;
        choice->then_list = from(t.operands[1], then_reaches);
        choice->else_list = from(t.operands[2], else_reaches);
        exits_.pop_back();
        at = b.selection_merge;
      } else if (t.op == spv::OpBranchConditional) {
        s.back_condition = t.operands[0];
        s.back_inverted = t.operands[2] == header.label;
        left_.insert(&s);
        break;
      } else {
        break;  // a continue target that nothing reaches
      }
    }
    exits_.pop_back();
  }

  Id cases(const Block& b, List& list) {
    const Instruction& t = b.terminator;
    Statement* s = add(list, Shape::cases, t);
    s->condition = t.operands[0];
    // Targets in the order of their blocks, which is the order of the GLSL: fall-through goes to the next one.
    std::vector<Id> labels;
    const auto note = [&](Id label) {
      if (label != b.selection_merge && std::find(labels.begin(), labels.end(), label) == labels.end())
        labels.push_back(label);
    };
    for (std::size_t k = 3; k < t.operands.size(); k += 2) note(t.operands[k]);
    const Id default_label = t.operands[1];
    if (std::find(labels.begin(), labels.end(), default_label) == labels.end() && default_label != b.selection_merge)
      place_default(default_label, b.selection_merge, labels);
    exits_.push_back({b.selection_merge, Exit::To::cases_end, s});
    for (std::size_t k = 0; k < labels.size(); ++k) {
      Case c;
      c.is_default = labels[k] == default_label;
      for (std::size_t v = 2; v + 1 < t.operands.size(); v += 2)
        if (t.operands[v + 1] == labels[k]) c.values.push_back(t.operands[v]);
      if (k + 1 < labels.size()) exits_.push_back({labels[k + 1], Exit::To::next_case, s});
      bool reaches = false;
      c.body = from(labels[k], reaches);
      c.falls_through = reaches;
      if (k + 1 < labels.size()) exits_.pop_back();
      if (!c.body.empty() && c.body.back()->shape == Shape::leave_cases && c.body.back()->target == s)
        c.body.pop_back();
      s->cases.push_back(std::move(c));
    }
    exits_.pop_back();
    // No default: the values without a case go straight to the end.
    const bool has_default = default_label != b.selection_merge;
    return left_.count(s) || !has_default ? b.selection_merge : 0;
  }

  // Finds where the default stands among the cases: before the one that it falls into, or after the one that falls into
  // it.
  void place_default(Id default_label, Id end, std::vector<Id>& labels) const {
    std::set<Id> all(labels.begin(), labels.end());
    all.insert(default_label);
    const Id next = falls_into(default_label, all, end);
    const auto before = std::find(labels.begin(), labels.end(), next);
    if (next != 0) {
      labels.insert(before, default_label);
      return;
    }
    for (std::size_t k = 0; k < labels.size(); ++k) {
      if (falls_into(labels[k], all, end) != default_label) continue;
      labels.insert(labels.begin() + static_cast<std::ptrdiff_t>(k) + 1, default_label);
      return;
    }
    labels.push_back(default_label);
  }

  // The case label that control reaches from `label` without leaving the switch; 0 for none.
  Id falls_into(Id label, const std::set<Id>& labels, Id end) const {
    std::set<Id> seen = {end};
    for (const Exit& e : exits_) seen.insert(e.label);
    std::vector<Id> work = {label};
    while (!work.empty()) {
      const Id at = work.back();
      work.pop_back();
      if (!seen.insert(at).second) continue;
      if (at != label && labels.count(at)) return at;
      const Block& b = *blocks_.at(at);
      const auto& operands = b.terminator.operands;
      if (b.loop_merge != 0) {
        work.push_back(b.loop_merge);
      } else if (b.terminator.op == spv::OpSwitch) {
        work.push_back(b.selection_merge);
      } else if (b.terminator.op == spv::OpBranchConditional) {
        work.insert(work.end(), {operands[1], operands[2]});
      } else if (b.terminator.op == spv::OpBranch) {
        work.push_back(operands[0]);
      }
    }
    return 0;
  }

  std::map<Id, const Block*> blocks_;
  std::vector<Exit> exits_;
  std::set<Id> loops_;
  std::set<const Statement*> left_;  // loops and switches that something leaves
  const Module& module_;
  int next_id_ = 0, depth_ = 0;
};

}  // namespace

Body structure(Module& module, Function& function) {
  lower_phis(module, function);
  Builder builder(module, function);
  Body body;
  bool reaches = false;
  body.list = builder.from(function.blocks.front().label, reaches);
  body.statement_count = builder.count();
  return body;
}

}  // namespace twinshade::spirv

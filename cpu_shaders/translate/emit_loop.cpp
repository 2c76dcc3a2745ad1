// Loops and switches. A loop that lanes leave at different times has a mask of the lanes still in it and runs while
// there are any; one in which some lanes skip to the next iteration has, inside, a mask of the lanes still in this
// iteration.
#include <algorithm>

#include "cpu_shaders/translate/emit_function.h"
#include "cpu_shaders/translate/trip_count.h"

namespace twinshade::spirv {
namespace {

// The test at the head of a loop: a choice of which one side leaves the loop and the other is empty.
const Statement* head_test(const Statement& s, std::size_t at) {
  if (at >= s.body.size() || s.body[at]->shape != Shape::choice) return nullptr;
  const Statement& c = *s.body[at];
  const List& leaving = c.then_list.empty() ? c.else_list : c.then_list;
  if (!(c.then_list.empty() || c.else_list.empty()) || leaving.size() != 1) return nullptr;
  return leaving[0]->shape == Shape::leave_loop && leaving[0]->target == &s ? &c : nullptr;
}

std::string signed_literal(std::uint32_t bits) {
  return bits == 0x80000000u ? "-2147483647 - 1" : std::to_string(static_cast<std::int32_t>(bits));
}

std::string trimmed(const std::string& line) { return line.substr(line.find_first_not_of(' ')); }

// Lines that declare nothing, joined by commas to stand in the head of a `for`; false if they cannot.
bool as_increment(const std::vector<std::string>& lines, std::string& increment) {
  std::string text;
  for (const std::string& line : lines) {
    if (line.rfind("#line", 0) == 0 || trimmed(line).rfind("//", 0) == 0) continue;
    text += (text.empty() ? "" : " ") + trimmed(line);
  }
  if (text.size() > 100) return false;
  for (const char* word : {"{", "if (", "for (", "while ("})
    if (text.find(word) != std::string::npos) return false;
  if (!text.empty() && text.back() == ';') text.pop_back();
  for (std::size_t at = text.find("; "); at != std::string::npos; at = text.find("; ")) text.replace(at, 2, ", ");
  increment = text;
  return true;
}

// Whether all that the end of an iteration does is to move the counter.
bool moves_only(const List& continuing, Id counter) {
  int stores = 0;
  bool other = false;
  for_each_statement(continuing, [&](const Statement& s) {
    other |= s.shape != Shape::code;
    for (const Instruction& i : s.code) {
      const bool store = i.op == spv::OpStore && i.operands[0] == counter;
      stores += store;
      other |= !store && i.op != spv::OpLoad && i.op != spv::OpIAdd && i.op != spv::OpISub;
    }
  });
  return stores == 1 && !other;
}

}  // namespace

// What keeps the loop going, nothing where that is always so; advances the loop's mask where lanes may differ.
std::string FunctionEmitter::loop_condition(const Statement& s, Id condition, bool inverted,
                                            const std::string& own_mask) {
  bool may_discard = false;
  for_each_statement(s.body, [&](const Statement& inner) { may_discard |= discards(inner); });
  std::string test;
  bool varying = false;
  if (condition != 0 && module_.is_constant(condition) && (module_.constants.at(condition).bits != 0) != inverted)
    condition = 0;
  if (condition != 0) {
    const Expression c = value(condition);
    varying = at_.is_varying(condition);
    test = inverted ? (c.precedence > 1 ? "!(" + c.text + ")" : "!" + c.text) : c.text;
    if (varying) {
      test = own_mask + " &= " + test;
      return may_discard ? "any((" + test + ") & kept)" : "any(" + test + ")";
    }
    if (!own_mask.empty() || may_discard) {
      test = "bool(" + test + ") && ";
    }
  }
  if (!own_mask.empty()) return test + "any(" + own_mask + (may_discard ? " & kept)" : ")");
  if (!may_discard) return test;
  // lanes that did not come here are kept too
  return test + (masks_.empty() ? "any(kept)" : "any(" + mask() + " & kept)");
}

// Instructions of a list, those of inlined callees included; nothing where there is a loop among them.
std::optional<std::size_t> FunctionEmitter::straight_cost(const List& statements, const Instance& at) const {
  std::size_t total = 0;
  bool loops = false;
  for_each_statement(statements, [&](const Statement& s) {
    loops |= s.shape == Shape::loop;
    for (const Instruction& i : s.code) {
      ++total;
      const auto callee = at.callees.find(&i);
      if (loops || callee == at.callees.end() || !callee->second->inlined) continue;
      const auto inner = straight_cost(callee->second->info->body.list, *callee->second);
      loops |= !inner;
      total += inner.value_or(0);
    }
  });
  return loops ? std::nullopt : std::optional(total);
}

// The values of the counter, each as C++, where the loop is better written out once for each: a short one without loops
// inside whose turns are known, and which does something with the number. Compilers unroll such loops too late, or not
// at all: what the number picks from an array would be looked up while the shader runs.
std::vector<std::string> FunctionEmitter::written_out(const Statement& s) const {
  constexpr std::size_t kMostInstructions = 1000, kMostTurns = 64;
  const auto init = regions_.loop_init.find(&s);
  if (shared_.readable || at_.is_masked(s) || info_.counted_loops.count(s.id) || init == regions_.loop_init.end())
    return {};
  const Instruction& store = *init->second;
  if (!module_.is_constant(store.operands[1])) return {};
  const auto counted = counted_loop(module_, info_, s, {{store.operands[0], store.operands[1]}});
  if (!counted || counted->counter != store.operands[0] || counted->turns == 0 || counted->turns > kMostTurns ||
      !moves_only(s.continuing, counted->counter))
    return {};
  const auto once = straight_cost(s.body, at_);
  if (!once || *once * counted->turns > kMostInstructions) return {};
  bool is_read = false, is_passed = false, is_continued = false;
  for_each_statement(s.body, [&](const Statement& inner) {
    is_continued |= inner.shape == Shape::next_iteration && inner.target == &s;
    const bool is_head = &inner == s.body[0].get();  // what the test needs
    for (const Instruction& i : inner.code) {
      is_read |= !is_head && i.op == spv::OpLoad && i.operands[0] == counted->counter;
      is_passed |= i.op == spv::OpFunctionCall &&
                   std::find(i.operands.begin(), i.operands.end(), counted->counter) != i.operands.end();
    }
  });
  if (!is_read || is_passed || is_continued) return {};
  std::vector<std::string> values;
  const bool is_signed = module_.type(module_.variables.at(counted->counter).type).kind == Kind::integer;
  for (std::uint64_t turn = 0; turn < counted->turns; ++turn) {
    const auto bits = static_cast<std::uint32_t>(counted->first + static_cast<std::int64_t>(turn) * counted->step);
    values.push_back(is_signed ? "UI(" + signed_literal(bits) + ")" : "UU(" + std::to_string(bits) + "u)");
  }
  return values;
}

void FunctionEmitter::loop(const Statement& s) {
  const std::vector<std::string> values = written_out(s);
  const bool masked = at_.is_masked(s);
  std::string init;
  init.swap(for_init_);
  position(s.file, s.line);
  const std::string where = module_.position(s.file, s.line).text();
  std::string own;  // declared before the loop, so that its name is taken after it too
  if (masked) own = new_mask();
  names_.open();
  if (masked) {
    out_.line("B " + own + " = " + mask_or_all() + ";");
    masks_.push_back({own, &s, false, 0});
  } else {
    for (Mask& m : masks_) ++m.uniform_depth;
  }

  const std::string again = names_.declare("again");  // stands in a head, whose names the body must not have

  // Everything is written aside first: the form of the loop depends on what fits into its head.
  names_.open();
  out_.indent();
  std::size_t mark = out_.mark();
  // A loop that is tested at its end starts with its body, even if that begins with a break.
  const Statement* test = s.back_condition == 0 ? head_test(s, 0) : nullptr;
  std::size_t rest = 1;
  if (test == nullptr && s.back_condition == 0 && !s.body.empty() && s.body[0]->shape == Shape::code) {
    test = head_test(s, 1);
    rest = 2;
  }
  std::string condition;
  const bool has_condition = test != nullptr || s.back_condition != 0;
  std::vector<std::string> head;
  if (test != nullptr) {
    if (rest == 2) {
      declare_before(*s.body[0]);
      code(*s.body[0]);
    }
    const Id tested = test->condition;
    const bool inverted = test->else_list.empty();
    condition = loop_condition(s, tested, inverted, own);
    flush();
    head = out_.take(mark);
  }
  std::string iteration;
  if (at_.waits_at_next.count(s.id)) {
    iteration = new_mask();
    out_.line("B " + iteration + " = " + own + ";");
    masks_.push_back({iteration, &s, true, 0});
  }
  if (const auto counted = info_.counted_loops.find(s.id); counted != info_.counted_loops.end())
    out_.line("this->iterate(" + std::to_string(counted->second) + ", " + quoted(where) + ");");
  list(s.body, &s, test == nullptr ? 0 : rest);
  if (!iteration.empty()) masks_.pop_back();
  flush();
  const std::vector<std::string> body = out_.take(mark);
  names_.close();

  names_.open();
  const auto declared = [&] { return variables_.size() + static_cast<std::size_t>(temporary_count_ + mask_count_); };
  const std::size_t declared_before = declared();
  list(s.continuing, &s);
  std::string back;
  if (s.back_condition != 0) back = loop_condition(s, s.back_condition, s.back_inverted, own);
  flush();
  const bool declares = declared() != declared_before;
  const std::vector<std::string> continuing = out_.take(mark);
  last_line_ = 0;  // what was written last may stand in the head, above the body
  names_.close();
  if (!has_condition) condition = loop_condition(s, 0, false, own);
  out_.outdent();

  std::string increment;
  const bool simple = !declares && as_increment(continuing, increment);
  const std::string open_for = "for (" + init + ";";
  if (!values.empty() && simple && head.empty()) {
    const std::string declaration = "const " + init.substr(0, init.find(" = ") + 3);
    for (const std::string& value : values) {
      out_.open("{");
      out_.line(declaration + value + ";");
      out_.append(body);
      out_.close("}");
    }
  } else if (s.back_condition != 0 && test == nullptr && simple && increment.empty()) {
    if (!init.empty()) out_.line(init + ";");
    out_.line("do {");
    out_.append(body);
    out_.line("} while (" + (back.empty() ? "true" : back) + ");");
  } else if (simple && s.back_condition == 0 && head.empty()) {
    if (init.empty() && increment.empty() && !condition.empty())
      out_.line("while (" + condition + ") {");
    else
      out_.line(open_for + (condition.empty() ? "" : " " + condition) + ";" +
                (increment.empty() ? "" : " " + increment) + ") {");
    out_.append(body);
    out_.line("}");
  } else {
    // Something does not fit into the head: the end of each iteration moves to the beginning of the next.
    if (!init.empty()) out_.line(init + ";");
    out_.open("for (bool " + again + " = false;; " + again + " = true) {");
    if (!continuing.empty() || !back.empty()) {
      out_.line("if (" + again + ") {");
      out_.append(continuing);
      if (!back.empty()) out_.line("  if (!(" + back + ")) break;");
      out_.line("}");
    }
    out_.append(head);
    if (!condition.empty()) out_.line("if (!(" + condition + ")) break;");
    out_.append(body);
    out_.close("}");
  }

  if (masked) {
    masks_.pop_back();
  } else {
    for (Mask& m : masks_) --m.uniform_depth;
  }
  names_.close();
}

void FunctionEmitter::cases(const Statement& s) {
  if (at_.is_masked(s)) return masked_cases(s);
  const Expression selector = value(s.condition);
  flush();
  position(s.file, s.line);
  for (Mask& m : masks_) ++m.uniform_depth;
  out_.open("switch (" + (selector.precedence > 1 ? "(" + selector.text + ")" : selector.text) + ".value()) {");
  const bool is_signed = module_.type_of(s.condition).kind == Kind::integer;
  for (const Case& c : s.cases) {
    std::vector<std::string> labels;
    for (std::uint32_t v : c.values)
      labels.push_back("case " + (is_signed ? signed_literal(v) : std::to_string(v) + "u") + ":");
    if (c.is_default) labels.push_back("default:");
    for (std::size_t k = 0; k < labels.size(); ++k) out_.line(labels[k] + (k + 1 == labels.size() ? " {" : ""));
    scope(c.body, &s);
    const bool jumps =
        !c.body.empty() && (c.body.back()->shape == Shape::next_iteration || c.body.back()->shape == Shape::give_back);
    out_.line(c.falls_through || jumps ? "}" : "} break;");
    if (c.falls_through) out_.line("[[fallthrough]];");
  }
  // clang warns, with no way to say otherwise, of a constant that no case names.
  if (std::none_of(s.cases.begin(), s.cases.end(), [](const Case& c) { return c.is_default; }))
    out_.line("default: break;");
  out_.close("}");
  for (Mask& m : masks_) --m.uniform_depth;
}

// Case by case, each under the lanes that its values select and those that fall through from the case before.
void FunctionEmitter::masked_cases(const Statement& s) {
  Expression selector = value(s.condition);
  flush();
  position(s.file, s.line);
  const bool is_signed = module_.type_of(s.condition).kind == Kind::integer;
  const std::string name = names_.declare("selector");
  out_.line("const " + types_.name(module_.value_types.at(s.condition), at_.is_varying(s.condition)) + " " + name +
            " = " + selector.text + ";");
  const auto match = [&](const std::vector<std::uint32_t>& values) {
    std::string text;
    for (std::uint32_t v : values) {
      const std::string literal = is_signed ? "UI(" + signed_literal(v) + ")" : "UU(" + std::to_string(v) + "u)";
      text += (text.empty() ? "" : " || ") + name + " == " + literal;
    }
    return text;
  };
  std::vector<std::uint32_t> all;
  for (const Case& c : s.cases) all.insert(all.end(), c.values.begin(), c.values.end());
  std::string falling;  // mask of the lanes that fall through
  for (const Case& c : s.cases) {
    std::string chosen;
    if (c.is_default) {
      // default takes what no case names, also if it has case values beside it.
      std::vector<std::uint32_t> others;
      for (std::uint32_t v : all)
        if (std::find(c.values.begin(), c.values.end(), v) == c.values.end()) others.push_back(v);
      chosen = others.empty() ? "B(true)" : "!(" + match(others) + ")";
    } else {
      chosen = "(" + match(c.values) + ")";
    }
    const std::string own = new_mask();
    std::string text = masks_.empty() ? chosen : mask() + " & " + chosen;
    if (!falling.empty()) text = falling + " | (" + text + ")";
    out_.line("B " + own + " = " + (at_.is_varying(s.condition) || !masks_.empty() ? text : "B(" + text + ")") + ";");
    out_.line("if (any(" + own + ")) {");
    masks_.push_back({own, &s, false, 0});
    scope(c.body, &s);
    masks_.pop_back();
    out_.line("}");
    falling = c.falls_through ? own : "";
  }
}

}  // namespace twinshade::spirv

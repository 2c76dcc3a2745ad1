// Control flow other than loops and switches. Where lanes part, a mask says which of them are running; each construct
// that parts them has its own, and lanes that leave for somewhere outside are taken out of every mask on the way.
#include <algorithm>

#include "cpu_shaders/translate/emit_function.h"
#include "cpu_shaders/translate/served.h"

namespace twinshade::spirv {

FunctionEmitter::FunctionEmitter(Emission& shared, const Instance& instance, bool runs_in_double)
    : shared_(shared),
      at_(instance),
      info_(*instance.info),
      program_(shared.program),
      module_(shared.program.module),
      types_(shared.types),
      names_(shared.names),
      out_(shared.out),
      direct_(DirectArguments::find(shared.program, shared.instances, instance)),
      regions_(Regions::find(shared.program, instance, direct_)),
      runs_in_double_(runs_in_double) {}

// That C++ numbers at most, less what of the translation may follow on lines of its own.
constexpr int kMostLine = 2147483647 - 1000000;

void FunctionEmitter::position(std::uint32_t file, int line) {
  if (line == 0) return;
  const Position p = module_.position(file, line);
  if (p.line == last_line_ && p.file == last_file_) return;
  if (shared_.readable) {
    std::string text = shared_.lines.text(p.file, p.line);
    while (!text.empty() && text.back() == '\\') text.pop_back();  // it would continue the comment
    // Mostly braces say nothing that the C++ does not.
    if (text.find_first_not_of("{}; ") != std::string::npos)
      out_.line("// " + (p.file == last_file_ ? "" : p.file + ":") + std::to_string(p.line) + ": " + text);
  } else {
    // GLSL's #line takes what C++'s does not.
    out_.raw("#line " + std::to_string(std::clamp(p.line, 1, kMostLine)) + " " + quoted(p.file));
  }
  last_file_ = p.file;
  last_line_ = p.line;
}

std::string FunctionEmitter::narrowed(const std::string& condition, int precedence) const {
  if (masks_.empty()) return condition;
  return mask() + " & " + (precedence > 3 ? "(" + condition + ")" : condition);
}

void FunctionEmitter::run() {
  names_.open();
  const auto& parameters = info_.function->parameters;
  std::string list_text, argument_text;
  if (at_.needs_mask) {
    masks_.push_back({names_.declare("mask"), nullptr, false, 0});
    list_text = "B " + mask();
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& p = parameters[k];
    const Type& t = module_.type(p.type);
    const bool pointer = t.kind == Kind::pointer;
    const bool varying = at_.is_varying(p.id);
    const Id type = info_.parameter_type(module_, k);
    std::string text = types_.name(type, varying);
    if (info_.is_reference(k))
      text += "&";
    else if (info_.passed_uncopied(module_, k))
      text = "const " + text + "&";
    const std::string name = declare(p.id, module_.name(p.id));
    list_text += (list_text.empty() ? "" : ", ") + text + " " + name;
    argument_text += (k == 0 ? "" : ", ") + name;
    Expression e;
    e.text = name;
    e.precedence = 1;
    if (!pointer || module_.type(type).kind == Kind::sampler) values_[p.id] = e;
  }
  const Id result_type = info_.function->result_type;
  const bool returns_value = module_.type(result_type).kind != Kind::none;
  const std::string result = returns_value ? types_.name(result_type, at_.result_varying) : "void";
  position(info_.function->file, info_.function->line);
  out_.open((at_.inlined ? "TWINSHADE_FUNCTION " : "TWINSHADE_APART ") + result + " " + at_.name + "(" + list_text +
            ") {");
  const bool served = is_served(module_, *info_.function);
  if (served) {
    const std::string& name = info_.function->name;
    // One number serves all lanes where all arguments are the same for all.
    bool varying = at_.result_varying;
    for (std::size_t k = 0; k < parameters.size(); ++k)
      varying |= info_.is_reference(k) && at_.is_varying(parameters[k].id);
    const std::string policy = varying ? "N" : "Steps<typename N::real, 1>";
    out_.line(is_served_in_full() ? "if constexpr (true) {" : "if constexpr (served::has_" + name + "<N>) {");
    out_.line("  return served::" + name + "<" + policy + ">(" + argument_text + ");");
    out_.open("} else {");
  }
  if (at_.divergent_return) {
    if (masks_.empty()) {
      masks_.push_back({names_.declare("mask"), nullptr, false, 0});
      out_.line("B " + mask() + "(true);");
    }
    if (returns_value) {
      result_ = names_.declare("result");
      out_.line(result + " " + result_ + "{};");
    }
  }
  list(info_.body.list, nullptr);
  const bool ends_in_return = !info_.body.list.empty() && info_.body.list.back()->shape == Shape::give_back;
  if (returns_value && !ends_in_return) out_.line("return " + (result_.empty() ? result + "{}" : result_) + ";");
  if (served) out_.close("}");
  out_.close("}");
  names_.close();
}

void FunctionEmitter::scope(const List& statements, const Statement* owner) {
  names_.open();
  out_.indent();
  list(statements, owner);
  out_.outdent();
  names_.close();
}

// Statements of one list. After one that some lanes have left, the rest runs only if lanes remain.
void FunctionEmitter::list(const List& statements, const Statement* owner, std::size_t first) {
  int wrapped = 0;
  for (std::size_t k = first; k < statements.size(); ++k) {
    const Statement& s = *statements[k];
    declare_before(s);
    switch (s.shape) {
      case Shape::code: {
        code(s);
        // What the next statement tests or returns is written there; all else gets a name now, where it was computed.
        const Statement* next = k + 1 < statements.size() ? statements[k + 1].get() : nullptr;
        const Id wanted = next == nullptr
                              ? (owner != nullptr && owner->shape == Shape::loop && &statements == &owner->continuing
                                     ? owner->back_condition
                                     : 0)
                          : next->shape == Shape::choice || next->shape == Shape::cases ? next->condition
                          : next->shape == Shape::give_back                             ? next->value
                                                                                        : 0;
        const auto kept =
            std::find_if(pending_.begin(), pending_.end(), [&](const Pending& p) { return p.id == wanted; });
        if (kept == pending_.end()) {
          flush();
        } else {
          Pending own = std::move(*kept);
          pending_.erase(kept);
          flush();
          pending_.push_back(std::move(own));
        }
        break;
      }
      case Shape::choice:
        choice(s);
        break;
      case Shape::loop:
        flush();
        loop(s);
        break;
      case Shape::cases:
        cases(s);
        break;
      case Shape::leave_loop:
      case Shape::next_iteration:
      case Shape::leave_cases:
        leave(s);
        break;
      case Shape::give_back:
        give_back(s);
        break;
      case Shape::discard:
        position(s.file, s.line);
        out_.line("leave(" + mask_or_all() + ", kept);");
        break;
      case Shape::unreachable:
        break;
    }
    if (k + 1 < statements.size() && skip_rest(s, owner)) ++wrapped;
  }
  for (; wrapped > 0; --wrapped) {
    names_.close();
    out_.close("}");
  }
}

// The author's name; glslang's own variables are arguments (after the parameter) and results of ?:, && and ||.
std::string FunctionEmitter::local_name(Id variable) const {
  const std::string name = module_.name(variable);
  if (name.empty()) return "choice";
  if (name != "param") return name;
  const auto found = info_.parameter_of.find(variable);
  return found == info_.parameter_of.end() || found->second.empty() ? "argument" : found->second;
}

void FunctionEmitter::declare_empty(const std::vector<Id>& variables) {
  for (Id v : variables)
    out_.line(types_.name(module_.variables.at(v).type, at_.is_varying(v)) + " " + declare(v, local_name(v)) + "{};");
}

void FunctionEmitter::declare_before(const Statement& s) {
  const auto declared = regions_.before.find(&s);
  if (declared != regions_.before.end()) declare_empty(declared->second);
}

void FunctionEmitter::code(const Statement& s) {
  for (const Instruction& i : s.code) {
    if (direct_.skipped.count(&i)) continue;
    const auto declared = regions_.before_instruction.find(&i);
    if (declared != regions_.before_instruction.end()) {
      position(i.file, i.line);
      declare_empty(declared->second);
    }
    instruction(i);
  }
}

// True if it opened a block around the rest of the list.
bool FunctionEmitter::skip_rest(const Statement& s, const Statement* owner) {
  const bool is_main = info_.function->id == module_.entry;
  if (owner == nullptr && is_main && !departs(s) && discards(s)) {
    out_.line("if (none(kept)) return;");
    return false;
  }
  if (!departs(s) || masks_.empty()) return false;
  if (owner == nullptr) {
    out_.line("if (none(" + mask() + ")) return" + (result_.empty() ? "" : " " + result_) + ";");
    return false;
  }
  if (owner->shape == Shape::loop && masks_.back().construct == owner && masks_.back().uniform_depth == 0) {
    out_.line("if (none(" + mask() + ")) continue;");
    return false;
  }
  out_.open("if (any(" + mask() + ")) {");
  names_.open();
  return true;
}

bool FunctionEmitter::departs(const Statement& s) const {
  std::set<const Statement*> inside;
  bool found = false;
  const auto look = [&](const List& l) {
    for_each_statement(l, [&](const Statement& inner) { inside.insert(&inner); });
  };
  look(s.then_list), look(s.else_list), look(s.body), look(s.continuing);
  for (const Case& c : s.cases) look(c.body);
  inside.insert(&s);
  for (const Statement* inner : inside) {
    const bool leaves = inner->shape == Shape::leave_loop || inner->shape == Shape::next_iteration ||
                        inner->shape == Shape::leave_cases || inner->shape == Shape::give_back;
    if (leaves && at_.divergent.count(inner->id) && (inner->target == nullptr || !inside.count(inner->target)))
      found = true;
    // In a switch with masks every break goes through them.
    if (inner->shape == Shape::leave_cases && at_.is_masked(*inner->target) && !inside.count(inner->target))
      found = true;
  }
  return found;
}

bool FunctionEmitter::discards(const Statement& s) const {
  bool found = s.shape == Shape::discard;
  const auto look = [&](const List& l) {
    for_each_statement(l, [&](const Statement& inner) {
      found |= inner.shape == Shape::discard;
      for (const Instruction& i : inner.code)
        if (i.op == spv::OpFunctionCall) found |= program_.info(i.operands[0]).discards;
    });
  };
  for (const Instruction& i : s.code)
    if (i.op == spv::OpFunctionCall) found |= program_.info(i.operands[0]).discards;
  look(s.then_list), look(s.else_list), look(s.body), look(s.continuing);
  for (const Case& c : s.cases) look(c.body);
  return found;
}

void FunctionEmitter::choice(const Statement& s) {
  if (at_.is_masked(s)) return masked_choice(s);
  const Expression condition = value(s.condition);
  flush();
  position(s.file, s.line);
  for (Mask& m : masks_) ++m.uniform_depth;
  if (s.then_list.empty()) {
    out_.line("if (" + std::string(condition.precedence > 1 ? "!(" + condition.text + ")" : "!" + condition.text) +
              ") {");
    scope(s.else_list, &s);
  } else {
    out_.line("if (" + condition.text + ") {");
    scope(s.then_list, &s);
    if (!s.else_list.empty()) {
      out_.line("} else {");
      scope(s.else_list, &s);
    }
  }
  out_.line("}");
  for (Mask& m : masks_) --m.uniform_depth;
}

void FunctionEmitter::masked_choice(const Statement& s) {
  Expression condition = value(s.condition);
  flush();
  position(s.file, s.line);
  if (departing_arm(s, condition)) return;
  const bool both = !s.then_list.empty() && !s.else_list.empty();
  if (both && (condition.precedence > 1 || condition.text.find('(') != std::string::npos || !condition.reads.empty())) {
    const std::string name = names_.declare("c" + std::to_string(++temporary_count_));
    out_.line("const B " + name + " = " + condition.text + ";");
    condition = Expression{name, 1, {}};
  }
  const auto arm = [&](const List& statements, const std::string& narrowed_mask) {
    if (statements.empty()) return;
    names_.open();
    const std::string own = new_mask();
    out_.line("if (B " + own + " = " + narrowed_mask + "; any(" + own + ")) {");
    masks_.push_back({own, &s, false, 0});
    scope(statements, &s);
    masks_.pop_back();
    names_.close();
    out_.line("}");
  };
  arm(s.then_list, narrowed(condition.text, condition.precedence));
  arm(s.else_list, narrowed(condition.precedence > 1 ? "!(" + condition.text + ")" : "!" + condition.text, 3));
}

// if (c) break;  and its like: the lanes of the condition leave, without a mask of their own.
bool FunctionEmitter::departing_arm(const Statement& s, const Expression& condition) {
  const List& arm = s.then_list.empty() ? s.else_list : s.then_list;
  if ((!s.then_list.empty() && !s.else_list.empty()) || arm.size() != 1) return false;
  const Statement& only = *arm[0];
  const bool jump = only.shape == Shape::leave_loop || only.shape == Shape::next_iteration ||
                    only.shape == Shape::leave_cases || (only.shape == Shape::give_back && only.value == 0) ||
                    only.shape == Shape::discard;
  if (!jump) return false;
  const bool inverted = s.then_list.empty();
  const std::string test =
      inverted ? (condition.precedence > 1 ? "!(" + condition.text + ")" : "!" + condition.text) : condition.text;
  const std::string gone = narrowed(test, inverted ? 3 : condition.precedence);
  if (only.shape == Shape::discard) {
    out_.line("leave(" + gone + ", kept);");
    return true;
  }
  std::string left;
  for (std::size_t k = masks_.size(); k-- > 0;) {
    const Mask& m = masks_[k];
    const bool at_target = only.shape != Shape::give_back && m.construct == only.target;
    if (at_target && only.shape == Shape::next_iteration && !m.iteration) break;
    left += ", " + m.name;
    if (at_target && !(m.iteration && only.shape == Shape::leave_loop)) break;
  }
  out_.line("leave(" + gone + left + ");");
  return true;
}

// break and continue
void FunctionEmitter::leave(const Statement& s) {
  const bool through_masks = at_.divergent.count(s.id) || (s.shape == Shape::leave_cases && at_.is_masked(*s.target));
  if (!through_masks) {
    out_.line(s.shape == Shape::next_iteration ? "continue;" : "break;");
    return;
  }
  // From the innermost mask to the target's, which a `continue` keeps. The lanes' own mask is emptied last.
  std::string left, own;
  for (std::size_t k = masks_.size(); k-- > 0;) {
    const Mask& m = masks_[k];
    const bool at_target = m.construct == s.target;
    if (at_target && s.shape == Shape::next_iteration && !m.iteration) break;
    // The current mask matters no more if nothing can follow under it.
    const bool innermost = k + 1 == masks_.size();
    if (!innermost) left += ", " + m.name;
    if (innermost && (m.uniform_depth > 0 || at_target)) own = ", " + m.name;
    const bool has_outer = at_target && m.iteration && s.shape == Shape::leave_loop;
    if (at_target && !has_outer) break;
  }
  out_.line("leave(" + mask() + left + own + ");");
}

void FunctionEmitter::give_back(const Statement& s) {
  if (at_.divergent.count(s.id)) {
    if (s.value != 0) {
      const Expression v = value(s.value);
      position(s.file, s.line);
      out_.line("assign(" + mask() + ", " + result_ + ", " + v.text + ");");
    } else {
      position(s.file, s.line);
    }
    std::string left, own;
    for (std::size_t k = masks_.size(); k-- > 0;) {
      const bool innermost = k + 1 == masks_.size();
      if (!innermost) left += ", " + masks_[k].name;
      // a loop asks its mask for the next iteration, whatever follows in this one
      const Statement* construct = masks_[k].construct;
      const bool asked_again = masks_[k].uniform_depth > 0 || (construct != nullptr && construct->shape == Shape::loop);
      if (innermost && (asked_again || k == 0)) own = ", " + masks_[k].name;
    }
    out_.line("leave(" + mask() + left + own + ");");
    return;
  }
  if (s.value == 0) {
    // Falling off the end says as much.
    if (&s != info_.body.list.back().get()) {
      position(s.file, s.line);
      out_.line("return;");
    }
    return;
  }
  const Expression v = value(s.value);
  flush();
  position(s.file, s.line);
  if (result_.empty()) {
    out_.line("return " + v.text + ";");
  } else {
    out_.line("return select(" + mask() + ", " + types_.name(info_.function->result_type, true) + "(" + v.text + "), " +
              result_ + ");");
  }
}

}  // namespace twinshade::spirv

#include "cpu_shaders/rewrite/probe.h"

#include <algorithm>
#include <set>

#include "cpu_shaders/lint/parser.h"
#include "cpu_shaders/rewrite/exact_functions.h"
#include "cpu_shaders/rewrite/new_keywords.h"
#include "cpu_shaders/rewrite/probe_functions.h"
#include "cpu_shaders/rewrite/token_edits.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {
namespace lint_detail {
namespace {

using Base = GlslType::Base;
using Kind = Expression::Kind;

bool may_hold_floats(const GlslType& type) { return !type.is_integer() && type.base != Base::boolean; }

// What drivers may round or rearrange as they like; what is left out copies values or is about integers alone.
bool computes(const Expression& e) {
  return any_of_tree(e, [](const Expression& node) {
    const auto floats = [](const ExpressionPtr& operand) { return may_hold_floats(operand->type); };
    const bool any = may_hold_floats(node.type) || std::any_of(node.operands.begin(), node.operands.end(), floats);
    const bool all = may_hold_floats(node.type) && std::all_of(node.operands.begin(), node.operands.end(), floats);
    switch (node.kind) {
      case Kind::unary:
      case Kind::binary:
      case Kind::builtin:
      case Kind::call:
        return any;
      case Kind::assign:
        return any && (!all || node.text != "=");
      case Kind::construct:
      case Kind::declaration:
        return any && !all;
      default:
        return false;
    }
  });
}

class Probe : public Listener {
 public:
  Probe(const ShaderSource& source, const TokenList& list, const std::optional<std::set<std::size_t>>& only)
      : edits_(list), source_(source), list_(list), only_(only) {
    for (std::size_t i = 0; i < list.tokens.size(); ++i)
      if (list.tokens[i].text == "discard") edits_.replace(i, "");
  }
  void read() {
    Parser parser(list_, *this);
    parser_ = &parser;
    parser.run();
    // Behind everything, where those that stand below main are known too.
    end_ = std::string("void ") + kGlobals + "() {";
    for (const Target& global : globals_) end_ += tell(global.first, global.last, {global});
    end_ += " }\n";
  }

  void function_begin(const std::string& name, const GlslType& result, std::size_t body_first) override {
    function_ = name;
    body_first_ = body_first;
    body_last_ = closing(body_first);
    if (result.base == Base::nothing) discard_by_return();
    std::size_t at = opening(body_first - 1) - 1;  // the name
    const std::size_t behind_result = at--;
    while (list_.tokens[at].text == "]") at = opening(at) - 1;
    result_type_.clear();
    for (std::size_t i = at; i < behind_result; ++i) result_type_ += list_.tokens[i].text + " ";
    for (header_first_ = at; header_first_ > 0; --header_first_)
      if (const std::string& text = list_.tokens[header_first_ - 1].text; text == ";" || text == "}") break;
    if (is_exact(list_.tokens[body_first].file)) exact_names_.insert(name);
    if (name == "main")
      edits_.behind(
          body_first,
          std::string(
              " twinshadeprobe_count = 0; twinshadeprobe_value = uvec4(0u); twinshadeprobe_place = uvec4(0u); ") +
              kGlobals + "();");
  }

  void expression(const Expression& e, Role role) override {
    if (role == Role::constant || is_exact(e.file)) return;
    if (e.first >= body_last_) {  // at global scope
      if (e.kind == Kind::declaration && !e.operands.empty()) globals_.push_back(target(e));
      return;
    }
    arguments(e);
    conversions(e);
    if (role == Role::condition || role == Role::selector) return condition(e, role);
    if (role == Role::result) {
      if (!e.operands.empty()) result(*e.operands[0]);
      return;
    }
    collect(e, role == Role::loop_header ? headers_.back() : stored_);
  }

  void statement_end(std::size_t first, std::size_t last) override {
    if (!returned_.text.empty()) return_end(first, last);
    if (stored_.empty()) return;
    std::vector<Target> targets;
    targets.swap(stored_);
    const std::string after = tell(first, last, targets);
    if (after.empty()) return;
    // A call within a declaration may come first; what is declared must outlive the statement all the same, unless it
    // is all that an if, an else or a loop does.
    const bool alone = one_of(list_.tokens[first - 1].text, {")", "else", "do"});
    if (!alone && std::any_of(targets.begin(), targets.end(), [](const Target& target) { return target.declared; })) {
      edits_.behind(last - 1, after);
    } else {
      edits_.before(first, "{ ");
      edits_.behind(last - 1, after + " }");
    }
  }

  void for_begin() override { headers_.emplace_back(); }
  void for_end(std::size_t body_first, std::size_t body_last) override {
    const std::vector<Target> targets = std::move(headers_.back());
    headers_.pop_back();
    if (targets.empty()) return;
    const std::string start = tell(targets.front().first, targets.front().last, targets);
    if (start.empty()) return;
    edits_.before(body_first, "{" + start + " ");
    edits_.behind(body_last - 1, " }");
  }

  TokenEdits edits_;
  std::string end_;  // to stand behind the shader
  std::vector<ProbedStatement> statements_;
  std::vector<ProbedValue> values_;
  bool complete_ = true;

 private:
  struct Target {
    std::string text;  // to read it by
    std::string what;  // to name it by
    GlslType type;
    std::size_t first = 0, last = 0;  // tokens of its statement
    bool declared = false;
    bool computed = false;
  };

  bool is_exact(int number) const {
    const std::string& file = list_.files[std::size_t(number)];
    return file == kExactFunctions || !exact_file(source_, file).empty();
  }

  // The bracket that goes with the one at a token.
  std::size_t closing(std::size_t at) const {
    for (int depth = 0;; ++at) {
      const std::string& text = list_.tokens[at].text;
      depth += one_of(text, {"(", "[", "{"}) ? 1 : one_of(text, {")", "]", "}"}) ? -1 : 0;
      if (depth == 0 || at + 1 == list_.tokens.size()) return at;
    }
  }
  std::size_t opening(std::size_t at) const {
    for (int depth = 0;; --at) {
      const std::string& text = list_.tokens[at].text;
      depth += one_of(text, {")", "]", "}"}) ? 1 : one_of(text, {"(", "[", "{"}) ? -1 : 0;
      if (depth == 0 || at == 0) return at;
    }
  }

  // Where a loop may end by discarding alone.
  void discard_by_return() {
    const auto begin = list_.tokens.begin();
    const bool loops =
        std::any_of(begin + std::ptrdiff_t(body_first_), begin + std::ptrdiff_t(body_last_), [](const Token& token) {
          return one_of(token.text, {"for", "while"});
        });
    for (std::size_t i = body_first_; loops && i < body_last_; ++i)
      if (list_.tokens[i].text == "discard") edits_.replace(i, "return");
  }

  // Tokens [first, last) as the author wrote them.
  std::string written(std::size_t first, std::size_t last, const std::string& between = "") const {
    std::string text;
    for (std::size_t i = first; i < last; ++i) text += (i > first ? between : "") + list_.tokens[i].text;
    return text;
  }

  // To read once more what was stored: without the probes that may have begun around it. Within it there are none, as
  // it is repeatable and they are in calls.
  std::string place_text(const Expression& place) const { return written(place.first, place.last, " "); }

  Target target(const Expression& e) const {
    const bool declared = e.kind == Kind::declaration;
    const Expression& place = declared ? e : *e.operands[0];
    const std::string text = declared ? e.text : place_text(place);
    return {text,       declared ? text : written(place.first, place.last), place.type, e.first, e.last, declared,
            computes(e)};
  }

  // What an expression stores, in the order in which it does.
  void collect(const Expression& e, std::vector<Target>& targets) {
    for (const ExpressionPtr& operand : e.operands) collect(*operand, targets);
    const auto add = [&](Target stored) {
      if (std::none_of(targets.begin(), targets.end(), [&](const Target& t) { return t.text == stored.text; }))
        targets.push_back(std::move(stored));
    };
    if (e.kind == Kind::assign || (e.kind == Kind::declaration && !e.operands.empty())) {
      if (e.kind == Kind::declaration || is_repeatable(*e.operands[0]))
        add(target(e));
      else
        complete_ = false;
    }
    // A function of the shader may compute anything, a built-in one does with floats what it is given of these.
    const bool computed =
        e.kind == Kind::call || std::any_of(e.operands.begin(), e.operands.end(), [](const ExpressionPtr& operand) {
          return may_hold_floats(operand->type) || computes(*operand);
        });
    for (std::size_t i = 0; i < e.operands.size() && i < e.written.size(); ++i) {
      if (!e.written[i]) continue;
      const Expression& argument = *e.operands[i];
      if (is_repeatable(argument))
        add({place_text(argument), written(argument.first, argument.last), argument.type, e.first, e.last, false,
             computed});
      else
        complete_ = false;
    }
  }

  // What is handed to the shader's own functions, told on its way there: at the line of the call.
  void arguments(const Expression& e) {
    for (const ExpressionPtr& operand : e.operands) arguments(*operand);
    if (e.kind != Kind::call || exact_names_.count(e.text) != 0) return;
    for (std::size_t i = 0; i < e.operands.size() && i < e.written.size(); ++i) {
      const Expression& argument = *e.operands[i];
      if (e.written[i] || argument.kind == Kind::literal) continue;
      const std::string what = "argument " + std::to_string(i + 1) + " of " + e.text;
      if (argument.type.array_dimensions > 0 || argument.type.base == Base::structure)
        composed_argument(argument, what);
      else
        through(argument, what);
    }
  }

  // Floats that become integers, but where a place is named: what is stored at an index that calls a function is not
  // told.
  void conversions(const Expression& e) {
    for (std::size_t i = 0; i < e.operands.size(); ++i) {
      const bool is_place = e.kind == Kind::assign ? i == 0 : i < e.written.size() && e.written[i];
      if (!is_place) conversions(*e.operands[i]);
    }
    if (e.kind != Kind::construct || !e.type.is_integer() || e.type.array_dimensions > 0) return;
    for (const ExpressionPtr& operand : e.operands) {
      const std::size_t before = statements_.size();
      if (operand->type.is_floating() && !operand->constant) through(*operand, e.text + "()");
      if (statements_.size() > before) statements_.back().converted_to = e.text;
    }
  }

  // Arrays and structures that are constructed: variables were told when they were stored, results when returned.
  void composed_argument(const Expression& e, const std::string& what) {
    const auto begin = list_.tokens.begin();
    const bool local_types = std::any_of(begin + std::ptrdiff_t(body_first_), begin + std::ptrdiff_t(body_last_),
                                         [](const Token& token) { return token.text == "struct"; });
    if (e.kind != Kind::construct || local_types) return;
    std::string type;
    for (std::size_t i = e.first; i < e.last && list_.tokens[i].text != "("; ++i) {
      type += list_.tokens[i].text;
      if (list_.tokens[i].text != "[") continue;
      // The function stands outside: a constant that is a size may be unknown there.
      const bool literal = list_.tokens[i + 1].kind == Token::Kind::number && list_.tokens[i + 2].text == "]";
      if (e.type.array_dimensions > 1 && !literal) return;
      type += (literal ? list_.tokens[i + 1].text : std::to_string(e.operands.size())) + "]";
      i = closing(i);
    }
    const std::string name = kThrough + ("_" + std::to_string(statements_.size()));
    const std::string told = tell(e.first, e.last, {{"v", what, e.type, e.first, e.last, false, computes(e)}});
    if (told.empty()) return;
    edits_.before(header_first_, type + " " + name + "(" + type + " v) {" + told + " return v; } ");
    edits_.before(e.outer_first, name + "(");
    edits_.behind(e.outer_last - 1, ")");
  }

  // A value told within its expression.
  void through(const Expression& e, const std::string& what) {
    if (!is_basic(e.type)) return;
    const std::string first = std::to_string(values_.size());
    const std::size_t statement = statements_.size();
    for (int c = 0; c < e.type.columns; ++c) {
      values_.push_back({statement, {e.type.is_matrix() ? "[" + std::to_string(c) + "]" : ""}});
      prefix(values_.back().name, what);
    }
    if (!number(e.outer_first, e.outer_last, what, computes(e))) return;
    if (is_bare_sequence(e)) edits_.parenthesize(e.first, e.last);
    edits_.before(e.outer_first, kThrough + ("(" + first + ", "));
    edits_.behind(e.outer_last - 1, ")");
  }

  static bool is_basic(const GlslType& type) {
    return type.array_dimensions == 0 &&
           (type.is_integer() || type.base == Base::float32 || type.base == Base::boolean);
  }

  // "s" before ".v": "s.v"; "result of f" before ".v": "(result of f).v".
  static void prefix(std::vector<std::string>& name, const std::string& what) {
    const bool whole = name.size() == 1 && name[0].empty();
    name[0].insert(0, whole || what.find(' ') == std::string::npos ? what : "(" + what + ")");
  }

  // Numbers a statement and gives the text that tells of it: empty where it is not asked for.
  std::string tell(std::size_t first, std::size_t last, const std::vector<Target>& targets) {
    std::string text, what;
    bool computed = false;
    for (const Target& target : targets) {
      const std::size_t before = values_.size();
      const std::string told = value(target.text, {""}, target.type);
      for (std::size_t i = before; i < values_.size(); ++i) prefix(values_[i].name, target.what);
      if (told.empty()) {
        complete_ = false;
        continue;
      }
      text += told;
      what += (what.empty() ? "" : ", ") + target.what;
      computed = computed || target.computed;
    }
    if (text.empty()) return "";
    return number(first, last, what, computed) ? text : "";
  }

  bool number(std::size_t first, std::size_t last, const std::string& what, bool computed) {
    const Token& begin = list_.tokens[first];
    const Token& end = list_.tokens[last - 1];
    statements_.push_back({list_.files[std::size_t(begin.file)], begin.line,
                           end.file == begin.file ? end.line : begin.line, what, computed});
    return !only_ || only_->count(statements_.size() - 1) != 0;
  }

  // Calls of twinshadeprobe_tell for a value of any type. path: how it is reached from the target, cut where loops go
  // through elements.
  std::string value(const std::string& text, std::vector<std::string> path, const GlslType& type) {
    if (type.array_dimensions > 0) {
      const std::string i = "twinshadeprobe_" + std::to_string(path.size() - 1);
      path.emplace_back();
      const std::string inner = value(text + "[" + i + "]", path, element_type(type));
      if (inner.empty()) return "";
      return " for (int " + i + " = 0; " + i + " < " + text + ".length(); ++" + i + ") {" + inner + " }";
    }
    if (type.base == Base::structure) {
      const auto members = parser_->structures().find(type.name);
      std::string all;
      if (members == parser_->structures().end()) return all;
      for (const auto& [name, member] : members->second) {
        std::vector<std::string> to_member = path;
        to_member.back() += "." + name;
        all += value(text + "." + name, to_member, member.type);
      }
      return all;
    }
    if (!is_basic(type)) return "";
    std::string told;
    for (int c = 0; c < type.columns; ++c) {
      const std::string column = type.is_matrix() ? "[" + std::to_string(c) + "]" : "";
      std::vector<std::string> name = path;
      name.back() += column;
      told += " twinshadeprobe_tell(" + std::to_string(values_.size()) + ", " + elements(path.size() - 1) + ", " +
              text + column + ");";
      values_.push_back({statements_.size(), std::move(name)});
    }
    return told;
  }

  // Where the loops around are, as kProbePlace has it.
  static std::string elements(std::size_t loops) {
    const std::string third = loops > 2 ? "uint(twinshadeprobe_2) << 16" : "0u";
    const std::string first = loops > 0 ? "uint(twinshadeprobe_0)" : "0u",
                      second = loops > 1 ? " | uint(twinshadeprobe_1) << 16" : "";
    return "uvec2(" + third + ", " + first + second + ")";
  }

  // What an if, a loop or a switch tests. What it stores is told in the same place, before the test is.
  void condition(const Expression& whole, Role role) {
    const Expression& e = whole.kind == Kind::declaration ? *whole.operands[0] : whole;  // while (bool b = ...)
    if (e.kind == Kind::variable || e.kind == Kind::literal) return;
    if (e.kind == Kind::construct && e.text == "{") {
      complete_ = false;
      return;
    }
    std::vector<Target> targets;
    collect(e, targets);
    const bool is_uint = role == Role::selector && e.type.base == Base::uint32;
    const bool is_known = role == Role::condition || e.type.is_integer();
    // Elements are told in loops, which are no expressions.
    const auto left_out = std::erase_if(targets, [&](const Target& t) { return !is_known || has_elements(t.type); });
    if (left_out > 0) complete_ = false;
    if (const std::string told = tell(e.outer_first, e.outer_last, targets); !told.empty()) {
      const std::string kept = kKept + std::string(role == Role::condition ? "_bool" : is_uint ? "_uint" : "_int");
      if (is_bare_sequence(e)) edits_.parenthesize(e.first, e.last);
      edits_.before(e.outer_first, "(" + kept + " = ");
      edits_.behind(e.outer_last - 1, as_operands(told) + ", " + kept + ")");
    }
    through(e, "condition");
  }

  // Calls of twinshadeprobe_tell as further operands of a sequence: " a(); b();" gives ", a(), b()".
  static std::string as_operands(std::string told) {
    told.pop_back();
    std::replace(told.begin(), told.end(), ';', ',');
    return "," + told;
  }

  bool has_elements(const GlslType& type) const {
    if (type.array_dimensions > 0) return true;
    const auto members = parser_->structures().find(type.name);
    return type.base == Base::structure && members != parser_->structures().end() &&
           std::any_of(members->second.begin(), members->second.end(),
                       [this](const auto& member) { return has_elements(member.second.type); });
  }

  // A variable was told when it was stored.
  void result(const Expression& returned) {
    if (returned.kind == Kind::variable || returned.constant) return;
    collect(returned, stored_);
    returned_ = {"twinshadeprobe_result", "result of " + function_, returned.type, 0, 0, false, computes(returned)};
    if (is_bare_sequence(returned)) edits_.parenthesize(returned.first, returned.last);
    returned_value_ = edits_.text(returned.outer_first, returned.outer_last);
  }

  // Of `return ...;`, its tokens: what it stores is told before its result, which waits in a variable. That and the
  // function that tells the result stand outside, where nothing hides the type.
  void return_end(std::size_t first, std::size_t last) {
    const std::string number = "_" + std::to_string(statements_.size());
    const std::string stores = tell(first, last, stored_), told = tell(first, last, {returned_});
    const std::string kept = kKept + number, name = kThrough + number;
    if (!told.empty())
      edits_.before(header_first_, result_type_ + name + "(" + result_type_ + returned_.text + ") {" + told +
                                       " return " + returned_.text + "; } ");
    if (!stores.empty()) {
      edits_.before(header_first_, result_type_ + kept + "; ");
      edits_.collapse(first, last,
                      "{ " + kept + " = " + returned_value_ + ";" + stores + " return " +
                          (told.empty() ? kept : name + "(" + kept + ")") + "; }");
    } else if (!told.empty()) {
      edits_.collapse(first, last, "return " + name + "(" + returned_value_ + ");");
    }
    stored_.clear();
    returned_.text.clear();
  }

  const ShaderSource& source_;
  const TokenList& list_;
  const Parser* parser_ = nullptr;
  const std::optional<std::set<std::size_t>>& only_;
  // The function that was begun last: its tokens, from its header's first to its closing brace.
  std::string function_, result_type_;
  std::size_t header_first_ = 0, body_first_ = 0, body_last_ = 0;
  std::set<std::string> exact_names_;  // functions of shaders/exact/
  std::vector<Target> globals_, stored_;
  std::vector<std::vector<Target>> headers_;  // of the for loops around
  Target returned_;
  std::string returned_value_;
};

}  // namespace
}  // namespace lint_detail

ProbedShader add_probes(const ShaderSource& source, const std::optional<std::set<std::size_t>>& only) {
  using namespace lint_detail;
  if (!only) compile_glsl(source);  // the parser relies on valid GLSL
  const TokenList tokens = tokens_to_parse(source);
  Probe probe(source, tokens, only);
  probe.read();

  ProbedShader result;
  result.source = source;
  result.statements = std::move(probe.statements_);
  result.values = std::move(probe.values_);
  result.complete = probe.complete_;
  std::string text;
  if (source.es) {  // where every output would need a location; in earlier versions its names are no keywords yet
    const std::set<std::string> names = new_keywords(tokens, source);
    result.source.version = names.empty() ? 450 : names.count("precise") == 0 ? 420 : 330;
    result.source.es = false;
  } else {
    text = probe.edits_.head(source);
  }
  text += "#line 1 \"probes\"\n" + probe_functions();
  result.source.files.emplace_back("probes");
  result.source.text = text + probe.edits_.lines() + "#line 1 \"probes\"\n" + probe.end_;
  return result;
}

}  // namespace twinshade

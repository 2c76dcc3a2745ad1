#include "cpu_shaders/rewrite/probe.h"

#include <algorithm>

#include "cpu_shaders/lint/parser.h"
#include "cpu_shaders/rewrite/exact_functions.h"
#include "cpu_shaders/rewrite/token_edits.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {
namespace lint_detail {
namespace {

using Base = GlslType::Base;
using Kind = Expression::Kind;

constexpr const char* kPrelude = R"(flat in int probe_target;
out uvec4 probe_value;
out uvec4 probe_place;
int probe_twin_count;
void probe_twin_bits(int statement, uvec4 bits, uint is_float, uint components) {
  if (probe_twin_count == probe_target) {
    probe_value = bits;
    probe_place = uvec4(uint(statement + 1), 0u, is_float, components);
  }
  ++probe_twin_count;
  probe_place.y = uint(probe_twin_count);
}
)";

// Overloads of probe_twin, which tells, and of probe_twin_condition, which also gives back what it was given.
std::string probe_functions() {
  std::string text = kPrelude;
  struct Row {
    const char *scalar, *prefix, *cast;
    bool is_float;
  };
  for (const Row& row : {Row{"float", "vec", "floatBitsToUint", true}, Row{"int", "ivec", "uvec4", false},
                         Row{"uint", "uvec", "uvec4", false}, Row{"bool", "bvec", "uvec4", false}})
    for (int n = 1; n <= 4; ++n) {
      const std::string type = n == 1 ? row.scalar : row.prefix + std::to_string(n);
      const std::string padding = n == 1 ? ", 0, 0, 0" : n == 2 ? ", 0, 0" : n == 3 ? ", 0" : "";
      const std::string four = row.is_float ? "floatBitsToUint(vec4(v" + padding + "))" : "uvec4(v" + padding + ")";
      text += "void probe_twin(int s, " + type + " v) { probe_twin_bits(s, " + four + ", " +
              (row.is_float ? "1u" : "0u") + ", " + std::to_string(n) + "u); }\n";
    }
  for (int columns = 2; columns <= 4; ++columns)
    for (int rows = 2; rows <= 4; ++rows) {
      const std::string type = "mat" + std::to_string(columns) + (rows == columns ? "" : "x" + std::to_string(rows));
      text += "void probe_twin(int s, " + type + " m) { ";
      for (int c = 0; c < columns; ++c) text += "probe_twin(s, m[" + std::to_string(c) + "]); ";
      text += "}\n";
    }
  for (const char* type : {"bool", "int", "uint"})
    text += std::string(type) + " probe_twin_condition(int s, " + type + " v) { probe_twin(s, v); return v; }\n";
  return text;
}

// Integers alone cannot differ.
bool touches_floats(const Expression& e) {
  return any_of_tree(e, [](const Expression& node) {
    return node.type.is_floating() || node.type.base == Base::unknown || node.type.base == Base::structure ||
           node.kind == Kind::call;
  });
}

class Probe : public Listener {
 public:
  Probe(const TokenList& list, std::optional<std::size_t> only) : edits_(list), list_(list), only_(only) {
    for (std::size_t i = 0; i < list.tokens.size(); ++i)
      if (list.tokens[i].text == "discard") edits_.replace(i, "");
  }
  void read() {
    Parser parser(list_, *this);
    parser_ = &parser;
    parser.run();
  }

  void function_begin(const std::string& name, const GlslType& result, std::size_t body_first) override {
    inside_ = name;
    result_ = result;
    if (name != "main") return;
    std::string start = " probe_twin_count = 0; probe_value = uvec4(0u); probe_place = uvec4(0u);";
    for (const Target& target : globals_) start += tell(target.first, target.last, {target});
    edits_.behind(body_first, start);
  }

  void expression(const Expression& e, Role role) override {
    if (role == Role::constant || is_exact(e)) return;
    if (inside_.empty()) {
      if (e.kind == Kind::declaration && !e.operands.empty() && touches_floats(e)) globals_.push_back(target(e));
      return;
    }
    if (role == Role::condition || role == Role::selector) return condition(e);
    if (role == Role::result) {
      if (!e.operands.empty()) returned_ = result(e);
      return;
    }
    collect(e, role == Role::loop_header ? headers_.back() : stored_);
  }

  void statement_end(std::size_t first, std::size_t last) override {
    if (!returned_.empty()) {
      if (const std::string start = tell(first, last, {{returned_, "result of " + inside_, result_, first, last}});
          !start.empty()) {
        edits_.collapse(first, last,
                        "{ " + result_text() + " " + returned_ + " = " + returned_value_ + ";" + start + " return " +
                            returned_ + "; }");
      }
      returned_.clear();
    }
    if (stored_.empty()) return;
    std::vector<Target> targets;
    targets.swap(stored_);
    const std::string after = tell(first, last, targets);
    if (after.empty()) return;
    // A call within a declaration may come first; what is declared must outlive the statement all the same.
    if (std::any_of(targets.begin(), targets.end(), [](const Target& target) { return target.declared; })) {
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
  std::vector<ProbedStatement> statements_;

 private:
  struct Target {
    std::string text;  // to read it by
    std::string what;  // to name it by
    GlslType type;
    std::size_t first = 0, last = 0;  // tokens of its statement
    bool declared = false;
  };

  bool is_exact(const Expression& e) const {
    const std::string& file = list_.files[std::size_t(e.file)];
    return file == kExactFunctions || !exact_file(file).empty();
  }

  Target target(const Expression& e) const {
    const bool declared = e.kind == Kind::declaration;
    const Expression& place = declared ? e : *e.operands[0];
    const std::string text = declared ? e.text : edits_.text(place.first, place.last);
    std::string what;
    for (const char c : text)
      if (c != ' ') what += c;
    return {text, what, place.type, e.first, e.last, declared};
  }

  // What an expression stores, in the order in which it does.
  void collect(const Expression& e, std::vector<Target>& targets) const {
    for (const ExpressionPtr& operand : e.operands) collect(*operand, targets);
    const bool stores = e.kind == Kind::assign || (e.kind == Kind::declaration && !e.operands.empty());
    if (stores && touches_floats(e) && (e.kind == Kind::declaration || is_repeatable(*e.operands[0])))
      targets.push_back(target(e));
    if (e.kind != Kind::call) return;
    for (std::size_t i = 0; i < e.operands.size() && i < e.written.size(); ++i) {
      if (!e.written[i] || !is_repeatable(*e.operands[i])) continue;
      const Expression& argument = *e.operands[i];
      const std::string text = edits_.text(argument.first, argument.last);
      targets.push_back({text, text, argument.type, e.first, e.last, false});
    }
  }

  // Numbers a statement and gives the text that tells of it: empty where it is not asked for.
  std::string tell(std::size_t first, std::size_t last, const std::vector<Target>& targets) {
    std::string text, what;
    const std::string statement = std::to_string(statements_.size());
    for (const Target& target : targets) {
      const std::string told = value(statement, target.text, target.type, 0);
      if (told.empty()) continue;
      text += told;
      what += (what.empty() ? "" : ", ") + target.what;
    }
    if (text.empty()) return "";
    return number(first, last, what) ? text : "";
  }

  bool number(std::size_t first, std::size_t last, const std::string& what) {
    const Token& begin = list_.tokens[first];
    const Token& end = list_.tokens[last - 1];
    statements_.push_back(
        {list_.files[std::size_t(begin.file)], begin.line, end.file == begin.file ? end.line : begin.line, what});
    return !only_ || *only_ + 1 == statements_.size();
  }

  // Calls of probe_twin for a value of any type.
  std::string value(const std::string& statement, const std::string& text, const GlslType& type, int depth) const {
    if (type.array_dimensions > 0) {
      const std::string i = "probe_" + std::to_string(depth);
      const std::string inner = value(statement, text + "[" + i + "]", element_type(type), depth + 1);
      if (inner.empty()) return "";
      return " for (int " + i + " = 0; " + i + " < " + text + ".length(); ++" + i + ") {" + inner + " }";
    }
    if (type.base == Base::structure) {
      const auto members = parser_->structures().find(type.name);
      std::string all;
      if (members != parser_->structures().end())
        for (const auto& [name, member] : members->second)
          all += value(statement, text + "." + name, member.type, depth);
      return all;
    }
    if (!type.is_integer() && type.base != Base::float32 && type.base != Base::boolean) return "";
    return " probe_twin(" + statement + ", " + text + ");";
  }

  void condition(const Expression& e) {
    if (e.kind == Kind::declaration || e.kind == Kind::variable || e.kind == Kind::literal || !touches_floats(e))
      return;
    const std::string statement = std::to_string(statements_.size());
    if (!number(e.outer_first, e.outer_last, "condition")) return;
    edits_.before(e.outer_first, "probe_twin_condition(" + statement + ", ");
    edits_.behind(e.outer_last - 1, ")");
  }

  std::string result_text() const {
    const std::string text = type_text(result_);
    if (!text.empty()) return text;
    if (result_.array_dimensions > 0) return "";
    if (result_.base == Base::structure) return result_.name;
    const char* prefix = result_.base == Base::int32 ? "i" : result_.base == Base::uint32 ? "u" : "b";
    const char* scalar = result_.base == Base::int32 ? "int" : result_.base == Base::uint32 ? "uint" : "bool";
    return result_.rows > 1 ? prefix + ("vec" + std::to_string(result_.rows)) : scalar;
  }

  // The variable that holds a returned value; empty where it is not worth looking at.
  std::string result(const Expression& e) {
    const Expression& returned = *e.operands[0];
    if (returned.kind == Kind::variable || returned.constant || !touches_floats(returned) || result_text().empty())
      return "";
    returned_value_ = edits_.text(returned.outer_first, returned.outer_last);
    return "probe_twin_result";
  }

  const TokenList& list_;
  const Parser* parser_ = nullptr;
  const std::optional<std::size_t> only_;
  std::string inside_;  // the function
  GlslType result_;
  std::vector<Target> globals_, stored_;
  std::vector<std::vector<Target>> headers_;  // of the for loops around
  std::string returned_, returned_value_;
};

}  // namespace
}  // namespace lint_detail

ProbedShader add_probes(const ShaderSource& source, std::optional<std::size_t> only) {
  using namespace lint_detail;
  compile_glsl(source);  // the parser relies on valid GLSL
  const TokenList tokens = tokenize(source);
  Probe probe(tokens, only);
  probe.read();

  ProbedShader result;
  result.source = source;
  result.statements = probe.statements_;
  std::string text;
  if (source.es) {  // where every output would need a location
    result.source.version = 450;
    result.source.es = false;
  } else {
    text = probe.edits_.head(source);
  }
  text += "#line 1 \"probes\"\n" + probe_functions();
  result.source.files.emplace_back("probes");
  result.source.text = text + probe.edits_.lines();
  return result;
}

}  // namespace twinshade

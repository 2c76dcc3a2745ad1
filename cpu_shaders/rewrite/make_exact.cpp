#include "cpu_shaders/rewrite/make_exact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "base/error.h"
#include "cpu_shaders/lint/parser.h"
#include "cpu_shaders/rewrite/exact_functions.h"
#include "cpu_shaders/rewrite/token_edits.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {
namespace lint_detail {
namespace {

using Base = GlslType::Base;
using Kind = Expression::Kind;

bool is_comparison(const std::string& op) {
  return op == "<" || op == ">" || op == "<=" || op == ">=" || op == "==" || op == "!=";
}

bool is_arithmetic(const std::string& op) { return op == "+" || op == "-" || op == "*" || op == "/"; }

bool is_float(const GlslType& type) { return type.base == Base::float32 && type.array_dimensions == 0; }

GlslType as_float(GlslType type) {
  if (type.is_integer()) type.base = Base::float32;
  return type;
}

bool is_integer_zero(const Expression& e) {
  return e.kind == Kind::literal && e.type.is_integer() && e.integer && *e.integer == 0;
}

// Nine significant digits of the float that is meant, zeros at the end left out where what is left is the float
// exactly.
std::string literal_text(float value) {
  std::string text = fmt::format("{:.9g}", value);
  if (std::stod(text) != double{value}) text = fmt::format("{:#.9g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

// The constants that must stay constants, by name: those that array sizes, case labels, other constants than floats
// and initial values of uniforms are made of.
class NeededConstants : public Listener {
 public:
  explicit NeededConstants(const TokenList& list) { Parser(list, *this).run(); }

  void expression(const Expression& e, Role role) override {
    if (role == Role::constant) return need(e);
    if (e.kind != Kind::declaration) return;
    if (needs_constant(e)) need(e);
    if (e.const_token) made_of_[e.text].push_back(names(e));
  }
  bool has(const std::string& name) const { return names_.count(name) != 0; }

  static bool is_constant(const Expression& e) {
    return e.const_token && !e.operands.empty() && e.operands[0]->constant;
  }
  // Whether a declaration's value is asked to be a constant expression whatever reads it.
  static bool needs_constant(const Expression& e) {
    return e.is_uniform || (is_constant(e) && !e.type.is_floating() && e.type.base != Base::structure);
  }

 private:
  static std::set<std::string> names(const Expression& e) {
    std::set<std::string> all;
    if (e.kind == Kind::variable) all.insert(e.text);
    for (const ExpressionPtr& operand : e.operands) all.merge(names(*operand));
    return all;
  }
  void need(const Expression& e) {
    for (const std::string& name : names(e)) need(name);
  }
  void need(const std::string& name) {
    if (!names_.insert(name).second) return;
    if (const auto found = made_of_.find(name); found != made_of_.end())
      for (const std::set<std::string>& parts : found->second)
        for (const std::string& part : parts) need(part);
  }

  std::set<std::string> names_;
  std::map<std::string, std::vector<std::set<std::string>>> made_of_;
};

class MakeExact : public Listener {
 public:
  MakeExact(const TokenList& list, ExactScope scope)
      : edits_(list), functions_(scope == ExactScope::written_out), list_(list), needed_(list), scope_(scope) {}

  // The result is GLSL 450, which has keywords that are names in older versions.
  void rename_keywords(const ShaderSource& source) {
    struct Keyword {
      const char* name;
      int version, es_version;
    };
    for (std::size_t i = 0; i < list_.tokens.size(); ++i)
      for (const Keyword& word : {Keyword{"sample", 400, 0}, Keyword{"patch", 400, 0}, Keyword{"subroutine", 400, 0},
                                  Keyword{"buffer", 430, 310}})
        if (list_.tokens[i].text == word.name && source.version < (source.es ? word.es_version : word.version))
          edits_.replace(i, std::string(word.name) + "_name");
  }

  // Names that are the shader's own, but begin as those of the functions that come before it.
  template <class StandsBefore>
  void rename_own_names(const StandsBefore& stands_before) {
    const auto is_ours = [](const std::string& name) {
      return name.rfind("exact_", 0) == 0 || name.rfind("written_", 0) == 0;
    };
    const auto stands = [&](const Token& token) {
      return stands_before(list_.files[static_cast<std::size_t>(token.file)]);
    };
    std::set<std::string> included;
    for (const Token& token : list_.tokens)
      if (token.kind == Token::Kind::name && is_ours(token.text) && stands(token)) included.insert(token.text);
    for (std::size_t i = 0; i < list_.tokens.size(); ++i) {
      const Token& token = list_.tokens[i];
      if (token.kind == Token::Kind::name && is_ours(token.text) && included.count(token.text) == 0)
        edits_.replace(i, token.text + "_name");
    }
  }

  void expression(const Expression& e, Role role) override {
    if (role == Role::constant || must_stay_constant(e)) return;
    rewrite(e, {false, role == Role::condition || role == Role::selector || role == Role::result});
  }

  TokenEdits edits_;
  ExactFunctions functions_;
  bool uses_zero_ = false;

 private:
  struct Place {
    bool compared = false;  // operand of a comparison: a zero there does no harm
    bool used = true;       // something takes the value
  };

  bool must_stay_constant(const Expression& e) const {
    return e.kind == Kind::declaration && !e.operands.empty() &&
           (NeededConstants::needs_constant(e) || (NeededConstants::is_constant(e) && needed_.has(e.text)));
  }

  bool in_scope(const Expression& e) const {
    switch (scope_) {
      case ExactScope::everything:
        return true;
      case ExactScope::constants:
        return e.constant;
      case ExactScope::written_out:
        return !e.constant;
    }
    return false;
  }
  // Arguments of functions are out of `precise`'s reach: where an operator becomes a call, so do those in its operands.
  bool operator_in_scope(const std::string& op) const {
    return scope_ != ExactScope::written_out || op[0] == '/' || in_argument_ > 0;
  }

  // While the operands of what becomes a call are rewritten.
  class Argument {
   public:
    Argument(int& depth, bool is_one) : depth_(depth), is_one_(is_one) { depth_ += is_one ? 1 : 0; }
    ~Argument() { depth_ -= is_one_ ? 1 : 0; }
    Argument(const Argument&) = delete;
    Argument& operator=(const Argument&) = delete;

   private:
    int& depth_;
    bool is_one_;
  };

  // Each returns whether the expression, as rewritten, is no longer a constant one.

  bool rewrite(const Expression& e, Place place) {
    switch (e.kind) {
      case Kind::literal:
        return literal(e, place);
      case Kind::variable:
        return made_variable_.count(e.text) != 0;
      case Kind::binary:
        return binary(e);
      case Kind::assign:
        return assign(e, place);
      case Kind::builtin:
        return builtin(e);
      case Kind::construct:
        return construct(e);
      case Kind::declaration:
        return declaration(e);
      case Kind::sequence: {
        for (std::size_t i = 0; i < e.operands.size(); ++i)
          rewrite(*e.operands[i], {false, place.used && i + 1 == e.operands.size()});
        return true;
      }
      case Kind::select: {
        bool varies = operands(e);
        for (std::size_t i = 1; i < e.operands.size(); ++i)
          if (is_float(e.type)) varies |= to_float(*e.operands[i]);
        return varies;
      }
      default:
        return operands(e, place.compared) || e.kind == Kind::call;
    }
  }

  bool operands(const Expression& e, bool compared = false) {
    bool varies = false;
    for (const ExpressionPtr& operand : e.operands) varies |= rewrite(*operand, {compared, true});
    return varies;
  }

  bool zero_at(const Expression& e) {
    uses_zero_ = true;
    edits_.replace(e.at, kExactZero);
    return true;
  }

  bool literal(const Expression& e, Place place) {
    if (scope_ != ExactScope::everything || e.type.base != Base::float32) return false;
    const float value = std::strtof(e.text.c_str(), nullptr);
    if (value == 0.0F && !place.compared) return zero_at(e);
    if (std::isnormal(value)) edits_.replace(e.at, literal_text(value));
    return false;
  }

  // An operand that GLSL converts by itself, converted in writing.
  bool to_float(const Expression& e) {
    if (!e.type.is_integer() || e.type.array_dimensions > 0) return false;
    if (is_integer_zero(e) && scope_ == ExactScope::everything) return zero_at(e);
    edits_.before(e.outer_first, type_text(as_float(e.type)) + "(");
    edits_.behind(e.outer_last - 1, ")");
    return false;
  }

  bool binary(const Expression& e) {
    const Expression &left = *e.operands[0], &right = *e.operands[1];
    // A product of matrices is none of their components: it is outside the dialect, and left alone.
    const bool whole_matrices =
        scope_ == ExactScope::written_out && e.text == "*" && (left.type.is_matrix() || right.type.is_matrix());
    const bool becomes_call = !whole_matrices && is_arithmetic(e.text) && is_float(e.type) && in_scope(e) &&
                              operator_in_scope(e.text) && !type_text(as_float(left.type)).empty() &&
                              !type_text(as_float(right.type)).empty();
    bool varies;
    {
      const Argument argument(in_argument_, becomes_call);
      varies = operands(e, is_comparison(e.text));
    }
    if (!becomes_call) return varies;
    to_float(left);
    to_float(right);
    edits_.before(e.first, functions_.arithmetic(e.text, as_float(left.type), as_float(right.type)) + "(");
    edits_.replace(e.at, ",");
    edits_.behind(e.last - 1, ")");
    return true;
  }

  std::string text(const Expression& e) const { return edits_.text(e.outer_first, e.outer_last); }

  // = += ++ ... where the target is a float.
  bool assign(const Expression& e, Place place) {
    const bool computes = is_float(e.type) && scope_ != ExactScope::constants && operator_in_scope(e.text);
    {
      const Argument argument(in_argument_, computes);
      operands(e);
    }
    const Expression& target = *e.operands[0];
    if (!computes) return true;
    const bool steps = e.text == "++" || e.text == "--";
    GlslType value_type;
    std::string value;
    if (steps) {
      value_type.base = Base::float32;
      value = "1.0";
    } else {
      to_float(*e.operands[1]);
      value_type = as_float(e.operands[1]->type);
      value = text(*e.operands[1]);
    }
    if (e.text != "=" && (!is_arithmetic(e.text.substr(0, 1)) || type_text(value_type).empty())) return true;

    const bool postfix = steps && e.at != e.first && place.used;
    if (postfix || (e.text != "=" && !is_repeatable(target))) {
      edits_.collapse(
          e.first, e.last,
          functions_.assignment(e.text, e.type, value_type, postfix) + "(" + text(target) + ", " + value + ")");
      return true;
    }
    if (e.text != "=")
      value = functions_.arithmetic(e.text, e.type, value_type) + "(" + text(target) + ", " + value + ")";
    const bool component = scope_ == ExactScope::everything && target.kind == Kind::index &&
                           target.operands[0]->type.is_vector() && !target.operands[1]->constant &&
                           is_repeatable(target);
    if (component) {
      const std::string vector = text(*target.operands[0]), index = text(*target.operands[1]);
      const std::string store =
          vector + " = " + functions_.with_component() + "(" + vector + ", int(" + index + "), " + value + ")";
      // as a value, the assignment is the component
      edits_.collapse(e.first, e.last, place.used ? "(" + store + ")[" + index + "]" : store);
    } else if (e.text != "=") {
      const std::string store = text(target) + " = " + value;
      edits_.collapse(e.first, e.last, place.used ? "(" + store + ")" : store);
    }
    return true;
  }

  bool builtin(const Expression& e) {
    bool varies;
    {
      const Argument argument(in_argument_, in_scope(e) && ExactFunctions::is_written_out(e.text));
      varies = operands(e);
    }
    const bool classifies = e.text == "isnan" || e.text == "isinf";
    if ((!is_float(e.type) && !classifies) || !in_scope(e)) return varies;
    if (e.text == "mix" && e.operands.size() == 3 && e.operands[2]->type.base == Base::boolean) return varies;
    std::vector<GlslType> arguments;
    for (const ExpressionPtr& argument : e.operands) {
      arguments.push_back(as_float(argument->type));
      if (type_text(arguments.back()).empty()) return varies;
    }
    if (arguments.empty()) return varies;
    const std::string name = functions_.function(e.text, arguments);
    if (name.empty()) return varies;
    for (const ExpressionPtr& argument : e.operands) to_float(*argument);
    edits_.replace(e.at, name);
    return true;
  }

  bool construct(const Expression& e) {
    bool varies = operands(e);
    if (e.type.base != Base::float32 || scope_ != ExactScope::everything) return varies;
    for (const ExpressionPtr& operand : e.operands)
      if (is_integer_zero(*operand)) varies = zero_at(*operand);
    const bool diagonal = e.type.is_matrix() && e.type.columns == e.type.rows && e.operands.size() == 1 &&
                          e.operands[0]->type.rows == 1 && e.operands[0]->type.columns == 1 && e.text != "{";
    if (diagonal) {
      uses_zero_ = true;
      edits_.replace(e.at, functions_.diagonal(e.type));
      edits_.behind(e.operands[0]->outer_last - 1, std::string(", ") + kExactZero);
      varies = true;
    }
    return varies;
  }

  // A constant whose value is now computed by functions becomes a variable.
  bool declaration(const Expression& e) {
    if (e.operands.empty()) return false;
    bool varies = operands(e);
    if (is_float(e.type)) varies |= to_float(*e.operands[0]);
    if (!e.const_token) return varies;
    std::set<std::string>& names = constants_[*e.const_token];
    names.insert(e.text);
    if (varies) {
      edits_.replace(*e.const_token, "");
      write_size(e);
    }
    if (varies || made_variable_.count(*names.begin()) != 0) made_variable_.insert(names.begin(), names.end());
    return varies;
  }

  // const float k[] = float[](1.0, 2.0): a variable of global scope wants its size written.
  void write_size(const Expression& e) {
    const Expression& value = *e.operands[0];
    if (e.type.array_dimensions != 1 || value.kind != Kind::construct || value.operands.empty()) return;
    for (std::size_t i = *e.const_token; i + 1 < value.outer_first; ++i)
      if (list_.tokens[i].text == "[" && list_.tokens[i + 1].text == "]" && (i == e.at + 1 || i < e.at))
        edits_.replace(i + 1, std::to_string(value.operands.size()) + "]");
  }

  const TokenList& list_;
  const NeededConstants needed_;
  const ExactScope scope_;
  int in_argument_ = 0;
  std::set<std::string> made_variable_;
  std::map<std::size_t, std::set<std::string>> constants_;  // by their `const`
};

}  // namespace
}  // namespace lint_detail

ExactShader make_exact(const ShaderSource& source, ExactScope scope) {
  using namespace lint_detail;
  compile_glsl(source);  // the parser relies on valid GLSL
  const TokenList tokens = tokenize(source);
  // The files of shaders/exact/ stand as they are before the shader, unless it is they too that are rewritten.
  const auto stands_before = [&](const std::string& file) {
    return scope == ExactScope::written_out ? exact_file(file) == "written_out" : !exact_file(file).empty();
  };
  MakeExact rewrite(tokens, scope);
  rewrite.rename_keywords(source);
  rewrite.rename_own_names(stands_before);
  Parser(tokens, rewrite).run();

  ExactShader result;
  result.source = source;
  result.source.version = 450;
  result.source.es = false;
  result.uses_zero = rewrite.uses_zero_;
  result.changed = result.uses_zero || !rewrite.functions_.empty();
  std::string text;
  if (!source.es)
    for (const std::string& extension : tokens.extensions) text += extension + "\n";
  for (const std::string& file : tokens.files)
    if (stands_before(file)) rewrite.functions_.include(exact_file(file));
  text += rewrite.functions_.text(result.source.files);
  if (result.uses_zero) text += std::string("uniform float ") + kExactZero + ";\n";
  text += rewrite.edits_.lines(stands_before);
  result.source.text = text;
  try {
    result.left = lint(result.source);
  } catch (const UserError& error) {
    throw UserError(std::string(error.what()) + " (in the shader as rewritten for exactness)");
  }
  return result;
}

}  // namespace twinshade

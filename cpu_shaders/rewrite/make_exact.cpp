#include "cpu_shaders/rewrite/make_exact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "base/error.h"
#include "cpu_shaders/lint/parser.h"
#include "cpu_shaders/rewrite/constants.h"
#include "cpu_shaders/rewrite/exact_functions.h"
#include "cpu_shaders/rewrite/kinds_of_expression.h"
#include "cpu_shaders/rewrite/new_keywords.h"
#include "cpu_shaders/rewrite/token_edits.h"
#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/translate/compile_glsl.h"

namespace twinshade {
namespace lint_detail {
namespace {

using Base = GlslType::Base;
using Kind = Expression::Kind;

// Nine significant digits of the float that is meant, zeros at the end left out where what is left is the float
// exactly.
std::string literal_text(float value) {
  std::string text = fmt::format("{:.9g}", value);
  if (std::stod(text) != double{value}) text = fmt::format("{:#.9g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

class MakeExact : public Listener {
 public:
  MakeExact(const TokenList& list, ExactScope scope)
      : edits_(list), functions_(scope == ExactScope::written_out), list_(list), needed_(list), scope_(scope) {}

  void rename(const std::map<std::string, std::string>& names) {
    for (std::size_t i = 0; i < list_.tokens.size(); ++i)
      if (const auto found = names.find(list_.tokens[i].text); found != names.end()) edits_.replace(i, found->second);
  }

  void expression(const Expression& e, Role role) override {
    if (role == Role::constant) return;
    if (!must_stay_constant(e))
      rewrite(e, {Known::nothing, role == Role::condition || role == Role::selector || role == Role::result});
    if (NeededConstants::is_constant(e)) nonzero_.declare(e);
  }
  void function_begin(const std::string&, const GlslType& result, std::size_t) override { result_ = result; }

  TokenEdits edits_;
  ExactFunctions functions_;
  bool uses_zero_ = false;

 private:
  // Which constants compilers may know at a place. Of what they know they compute zeros, for which they drop x + 0.0
  // and x * 0.0 even where told to be precise.
  enum class Known {
    nothing,
    nonzero,     // operand of an operation on something unknown
    everything,  // operand of a comparison or a conversion to int
  };
  struct Place {
    Known known = Known::nothing;
    bool used = true;  // something takes the value
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
    if (!hides(e, place)) return rewrite_seen(e, place);
    ++hidden_;
    rewrite_seen(e, {Known::everything, true});
    --hidden_;
    return unseen(e, e.type);
  }

  bool rewrite_seen(const Expression& e, Place place) {
    const Known inner = nonzero_.is_nonzero(e) ? place.known : Known::nothing;
    switch (e.kind) {
      case Kind::literal:
        return literal(e, place);
      case Kind::variable:
        return made_variable_.count(e.text) != 0;
      case Kind::binary:
        return binary(e, place);
      case Kind::assign:
        return assign(e, place);
      case Kind::builtin:
        return builtin(e, place);
      case Kind::construct:
        return construct(e, inner);
      case Kind::declaration:
        return declaration(e);
      case Kind::call:
        return call(e);
      case Kind::result:
        operands(e);
        if (!e.operands.empty() && is_float(result_)) to_float(*e.operands[0]);
        return true;
      case Kind::sequence: {
        for (std::size_t i = 0; i < e.operands.size(); ++i)
          rewrite(*e.operands[i], {Known::nothing, place.used && i + 1 == e.operands.size()});
        if (is_bare_sequence(e) && place.used) edits_.parenthesize(e.first, e.last);
        return true;
      }
      case Kind::select: {
        bool varies = operands(e);
        for (std::size_t i = 1; i < e.operands.size(); ++i)
          if (is_float(e.type)) varies |= to_float(*e.operands[i]);
        return varies;
      }
      default:
        return operands(e, inner);
    }
  }

  bool operands(const Expression& e, Known known = Known::nothing) {
    bool varies = false;
    for (const ExpressionPtr& operand : e.operands) varies |= rewrite(*operand, {known, true});
    return varies;
  }

  bool hiding() const { return scope_ == ExactScope::everything && hidden_ == 0; }

  // Made of what compilers know alone; a component of such a thing is too, whichever it is.
  bool is_known(const Expression& e) const {
    if (e.kind == Kind::index) return is_known(*e.operands[0]);
    if (e.kind == Kind::variable && made_variable_.count(e.text) != 0 && !nonzero_.has(e.text)) return false;
    if (e.operands.empty()) return e.constant;
    if (e.kind == Kind::call || e.kind == Kind::assign || e.kind == Kind::declaration || e.kind == Kind::result)
      return false;
    return std::all_of(e.operands.begin(), e.operands.end(), [&](const ExpressionPtr& o) { return is_known(*o); });
  }

  // Whether a known value must be made unknown as a whole. Literal zeros and diagonals are taken one by one, and what
  // is computed by what it is computed of: of several steps compilers know some before others, and drop -0.0 + 0.0.
  bool hides(const Expression& e, Place place) const {
    if (!hiding() || place.known == Known::everything || type_text(e.type).empty() || !is_known(e)) return false;
    if (place.known == Known::nonzero && nonzero_.is_nonzero(e)) return false;
    const bool zeros =
        e.kind == Kind::construct &&
        std::all_of(e.operands.begin(), e.operands.end(), [](const ExpressionPtr& o) { return is_zero_literal(*o); });
    return !is_zero_literal(e) && !zeros && !is_diagonal(e) && e.text != "{" && !any_of_tree(e, is_step);
  }

  bool unseen(const Expression& e, const GlslType& type) {
    uses_zero_ = true;
    edits_.before(e.outer_first, functions_.unseen(type) + "(");
    edits_.behind(e.outer_last - 1, std::string(", ") + kExactZero + ")");
    return true;
  }

  // One of two values, so that compilers do not see what they have in common: in min(x, -x), or in x < y ? x : y, which
  // they take for min. The choice between 0 and -0, or with a NaN, would be theirs.
  void part(const Expression& left, const Expression& right) {
    const Expression& one = is_float(left.type) && !is_known(left) ? left : right;
    if (hiding() && is_float(one.type) && !is_known(one)) unseen(one, one.type);
  }

  bool zero_at(const Expression& e) {
    uses_zero_ = true;
    edits_.replace(e.at, kExactZero);
    return true;
  }

  bool literal(const Expression& e, Place place) {
    if (scope_ != ExactScope::everything || e.type.base != Base::float32) return false;
    const float value = std::strtof(e.text.c_str(), nullptr);
    if (value == 0.0F && hiding() && place.known != Known::everything) return zero_at(e);
    if (std::isnormal(value)) edits_.replace(e.at, literal_text(value));
    return false;
  }

  // An operand that GLSL converts by itself, converted in writing.
  bool to_float(const Expression& e, Known known = Known::nothing) {
    if (!e.type.is_integer() || e.type.array_dimensions > 0) return false;
    if (is_zero_literal(e) && hiding()) return zero_at(e);
    edits_.before(e.outer_first, type_text(as_float(e.type)) + "(");
    edits_.behind(e.outer_last - 1, ")");
    const bool stays = known == Known::everything || (known == Known::nonzero && nonzero_.is_nonzero(e));
    return hiding() && !stays && unseen(e, as_float(e.type));
  }

  bool binary(const Expression& e, Place place) {
    const Expression &left = *e.operands[0], &right = *e.operands[1];
    // A product of matrices is none of their components: it is outside the dialect, and left alone.
    const bool whole_matrices =
        scope_ == ExactScope::written_out && e.text == "*" && (left.type.is_matrix() || right.type.is_matrix());
    const bool becomes_call = !whole_matrices && is_arithmetic(e.text) && is_float(e.type) && in_scope(e) &&
                              operator_in_scope(e.text) && !type_text(as_float(left.type)).empty() &&
                              !type_text(as_float(right.type)).empty();
    // where the whole may be known, so may its operands
    const Known known = is_comparison(e.text) ? Known::everything : known_in(e, place);
    bool varies;
    {
      const Argument argument(in_argument_, becomes_call);
      varies = operands(e, known);
    }
    if (is_comparison(e.text) && e.text != "==" && e.text != "!=") part(left, right);
    if (!becomes_call) return varies;
    to_float(left, known);
    to_float(right, known);
    edits_.before(e.first, functions_.arithmetic(e.text, as_float(left.type), as_float(right.type)) + "(");
    edits_.replace(e.at, ",");
    edits_.behind(e.last - 1, ")");
    return true;
  }

  std::string text(const Expression& e) const { return edits_.text(e.outer_first, e.outer_last); }

  // = += ++ ... where the target is a float.
  bool assign(const Expression& e, Place place) {
    const bool computes = is_float(e.type) && scope_ != ExactScope::constants && operator_in_scope(e.text);
    const Known known = e.text == "=" ? Known::nothing : Known::nonzero;
    {
      const Argument argument(in_argument_, computes);
      operands(e, known);
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
      to_float(*e.operands[1], known);
      value_type = as_float(e.operands[1]->type);
      value = text(*e.operands[1]);
    }
    if (e.text != "=" && (!is_arithmetic(e.text.substr(0, 1)) || type_text(value_type).empty())) return true;

    const bool postfix = steps && e.at != e.first && place.used;
    // Else the value might change what the target is, or what it holds, between the places where it is written.
    const bool repeats = is_repeatable(target) && (steps || is_repeatable(*e.operands[1]));
    const bool component = scope_ == ExactScope::everything && target.kind == Kind::index &&
                           target.operands[0]->type.is_vector() && !target.operands[1]->constant;
    if (component) {
      const std::string vector = text(*target.operands[0]), index = "int(" + text(*target.operands[1]) + ")";
      if (place.used || !repeats) {
        edits_.collapse(e.first, e.last,
                        functions_.component_assignment(e.text, target.operands[0]->type, postfix) + "(" + vector +
                            ", " + index + ", " + value + ")");
        return true;
      }
      if (e.text != "=")
        value = functions_.arithmetic(e.text, e.type, value_type) + "(" + text(target) + ", " + value + ")";
      edits_.collapse(e.first, e.last,
                      vector + " = " + functions_.with_component() + "(" + vector + ", " + index + ", " + value + ")");
    } else if (e.text != "=" && (postfix || !repeats)) {
      edits_.collapse(
          e.first, e.last,
          functions_.assignment(e.text, e.type, value_type, postfix) + "(" + text(target) + ", " + value + ")");
    } else if (e.text != "=") {
      const std::string store = text(target) + " = " + functions_.arithmetic(e.text, e.type, value_type) + "(" +
                                text(target) + ", " + value + ")";
      edits_.collapse(e.first, e.last, place.used ? "(" + store + ")" : store);
    }
    return true;
  }

  // Which of its operands a step may know: none, if they were all known, unless the whole may be.
  Known known_in(const Expression& step, Place place) const {
    if (!is_known(step)) return Known::nonzero;
    return place.known == Known::everything ? Known::everything : Known::nothing;
  }

  bool builtin(const Expression& e, Place place) {
    const bool selects = e.text == "mix" && e.operands.size() == 3 && e.operands[2]->type.base == Base::boolean;
    Known known = is_float(e.type) ? known_in(e, place) : Known::everything;
    if (selects) known = Known::nothing;
    bool varies;
    {
      const Argument argument(in_argument_, in_scope(e) && ExactFunctions::is_written_out(e.text));
      varies = operands(e, known);
    }
    const bool classifies = e.text == "isnan" || e.text == "isinf";
    if (one_of(e.text, {"lessThan", "lessThanEqual", "greaterThan", "greaterThanEqual"}))
      part(*e.operands[0], *e.operands[1]);
    if (one_of(e.text, {"intBitsToFloat", "uintBitsToFloat"}) && hiding()) return unseen(e, e.type);
    if ((!is_float(e.type) && !classifies) || !in_scope(e) || selects) return varies;
    std::vector<GlslType> arguments;
    for (const ExpressionPtr& argument : e.operands) {
      arguments.push_back(as_float(argument->type));
      if (type_text(arguments.back()).empty()) return varies;
    }
    if (arguments.empty()) return varies;
    const std::string name = functions_.function(e.text, arguments);
    if (name.empty()) return varies;
    for (const ExpressionPtr& argument : e.operands) to_float(*argument, known);
    if (one_of(e.text, {"min", "max", "clamp"}) && !is_known(*e.operands[0]) && !is_known(*e.operands[1]))
      part(*e.operands[0], *e.operands[1]);
    edits_.replace(e.at, name);
    return true;
  }

  // An argument that GLSL converts to float, though we do not know which one: an integer of the same value.
  bool convertible(const Expression& e) {
    const bool hides = hiding() && e.type.is_integer() && e.type.array_dimensions == 0;
    if (hides) unseen(e, e.type);
    return hides;
  }

  bool call(const Expression& e) {
    operands(e);
    for (std::size_t i = 0; i < e.operands.size(); ++i)
      if (e.converts && (i >= e.written.size() || !e.written[i])) convertible(*e.operands[i]);
    return true;
  }

  // known: nothing, or all of it may be.
  bool construct(const Expression& e, Known known) {
    if (is_integral(e.type)) known = Known::everything;
    bool varies = operands(e, known);
    if (known != Known::nothing || !hiding()) return varies;
    if (e.type.base == Base::structure)
      for (const ExpressionPtr& operand : e.operands) varies |= convertible(*operand);
    if (e.type.base != Base::float32) return varies;
    bool converts = false;
    for (const ExpressionPtr& operand : e.operands) {
      if (is_zero_literal(*operand) && operand->type.is_integer())
        varies = zero_at(*operand);
      else if (type_text(e.type).empty() || e.text == "{")
        varies |= to_float(*operand);
      else
        converts |= is_integral(operand->type);
    }
    if (is_diagonal(e)) {
      uses_zero_ = true;
      if (const Expression& one = *e.operands[0]; one.type.base == Base::boolean) {  // no parameter converts it
        edits_.before(one.outer_first, "float(");
        edits_.behind(one.outer_last - 1, ")");
        unseen(one, scalar_type(Base::float32));
      }
      edits_.replace(e.at, functions_.diagonal(e.type));
      edits_.behind(e.operands[0]->outer_last - 1, std::string(", ") + kExactZero);
      return true;
    }
    // what it adds of its own: the rest of a matrix
    const bool fills = e.type.is_matrix() && e.operands.size() == 1;
    return (converts || fills) && e.text != "{" ? unseen(e, e.type) : varies;
  }

  // A constant whose value is now computed by functions becomes a variable.
  bool declaration(const Expression& e) {
    if (e.operands.empty()) return false;
    const Known known = e.const_token && nonzero_.is_nonzero(*e.operands[0]) ? Known::nonzero : Known::nothing;
    bool varies = operands(e, known);
    if (is_float(e.type)) varies |= to_float(*e.operands[0], known);
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
  NonzeroConstants nonzero_;
  GlslType result_;  // of the function that is being read
  int hidden_ = 0;   // within what is made unknown as a whole
  int in_argument_ = 0;
  std::set<std::string> made_variable_;
  std::map<std::size_t, std::set<std::string>> constants_;  // by their `const`
};

}  // namespace
}  // namespace lint_detail

ExactShader make_exact(const ShaderSource& source, ExactScope scope) {
  using namespace lint_detail;
  compile_glsl(source);  // the parser relies on valid GLSL
  const TokenList tokens = tokens_to_parse(source);
  // The files of shaders/exact/ stand as they are before the shader, unless it is they too that are rewritten.
  const auto stands_before = [&](const std::string& file) {
    const std::string exact = exact_file(source, file);
    return scope == ExactScope::written_out ? exact == "written_out" : !exact.empty();
  };
  std::set<std::string> own, taken;
  for (const Token& token : tokens.tokens)
    if (token.kind == Token::Kind::name) own.insert(token.text);
  ExactShader result;
  const auto give_way = [&](const std::set<std::string>& names) {
    for (const std::string& name : names) {
      std::string& now = result.renamed[name] = name + "_name";
      while (own.count(now) != 0) now += "_name";
    }
  };
  const auto rewrite_and_rename = [&] {
    MakeExact rewrite(tokens, scope);
    rewrite.rename(result.renamed);
    Parser(tokens, rewrite).run();
    result.source = source;
    result.source.version = source.es ? 450 : std::max(450, source.version);
    result.source.es = false;
    result.uses_zero = rewrite.uses_zero_;
    result.changed = result.uses_zero || !rewrite.functions_.empty();
    for (const std::string& file : tokens.files)
      if (stands_before(file)) rewrite.functions_.include(exact_file(source, file));
    std::string before = rewrite.functions_.text(result.source);
    if (result.uses_zero) before += std::string("uniform float ") + kExactZero + ";\n";
    result.source.text.clear();
    if (!source.es)
      for (const std::string& extension : tokens.extensions) result.source.text += extension + "\n";
    result.source.text += before + rewrite.edits_.lines(stands_before);
    return before;
  };
  // The shader's own names give way to those of what comes to stand before it.
  std::set<std::string> candidates = own;
  for (const Token& token : tokens.tokens)
    if (stands_before(tokens.files[static_cast<std::size_t>(token.file)])) candidates.erase(token.text);
  give_way(new_keywords(tokens, source));
  const std::string before = rewrite_and_rename();
  for (const std::string& name : candidates)
    if ((name.rfind("exact_", 0) == 0 || name.rfind("written_", 0) == 0) && find_word(before, name) != before.npos)
      taken.insert(name);
  give_way(taken);
  if (!taken.empty()) rewrite_and_rename();
  try {
    result.left = lint(result.source);
  } catch (const UserError& error) {
    throw UserError(std::string(error.what()) + " (in the shader as rewritten for exactness)");
  }
  return result;
}

}  // namespace twinshade

// A GLSL expression with what the rules ask about it. Declarations with initialisers and return statements are
// expressions too: they are where values go.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cpu_shaders/lint/glsl_type.h"
#include "cpu_shaders/lint/zeros.h"

namespace twinshade::lint_detail {

// Of a value that may be infinite or NaN.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>;

struct Expression {
  enum class Kind {
    literal,      // text: as spelled
    variable,     // text: name
    unary,        // text: + - ! ~
    binary,       // text: operator; comma is a sequence
    assign,       // text: operator, ++ and -- included; operands: target, value (none for ++ and --)
    select,       // condition ? a : b
    builtin,      // text: function; operands: arguments
    call,         // a function of the shader's own
    construct,    // text: type; also { ... }
    member,       // text: component or member name; operands: object
    index,        // operands: object, index
    sequence,     // operands in order
    declaration,  // text: name; operands: initialiser or none
    result,       // return, with its value
  };
  Kind kind = Kind::literal;
  std::string text;
  int file = 0, line = 0;
  std::size_t at = 0;                           // token that `text` is
  std::size_t first = 0, last = 0;              // its tokens, [first, last)
  std::size_t outer_first = 0, outer_last = 0;  // the same with the parentheses around it
  GlslType type;
  std::vector<ExpressionPtr> operands;

  bool constant = false;  // built of literals and constants alone
  Zeros zeros;
  double limit = kUnlimited;    // never NaN, nor farther from zero than this: of constants and integers by + - *
  std::optional<long> integer;  // value, where it is a plain integer constant
  bool precise = false;         // assign and declaration: the target is `precise`; lvalues: their variable is
  bool has_effect = false;      // assign, call, or a built-in function that writes an argument or memory
  std::vector<bool> written;    // call, and of built-in functions modf and the like: arguments that are out or inout
  bool converts = false;        // call: some argument's type is not its parameter's
  std::optional<std::size_t> const_token;  // declaration: its `const`
  bool is_uniform = false;                 // declaration
};

// Whether `is` holds for the expression or some part of it.
inline bool any_of_tree(const Expression& e, bool (*is)(const Expression&)) {
  return is(e) || std::any_of(e.operands.begin(), e.operands.end(),
                              [is](const ExpressionPtr& operand) { return any_of_tree(*operand, is); });
}

// a, b without parentheses around it, which an argument or an initialiser needs.
inline bool is_bare_sequence(const Expression& e) {
  return e.kind == Expression::Kind::sequence && e.outer_first == e.first && e.outer_last == e.last;
}

// Can be written twice: evaluating it once more changes nothing.
inline bool is_repeatable(const Expression& e) {
  return !any_of_tree(e, [](const Expression& node) { return node.has_effect; });
}

}  // namespace twinshade::lint_detail

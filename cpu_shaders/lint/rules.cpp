#include "cpu_shaders/lint/rules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>

namespace twinshade::lint_detail {
namespace {

using Base = GlslType::Base;
using Kind = Expression::Kind;

// Where a node stands in its statement.
struct Place {
  bool precise = false;                    // its value goes into a `precise` variable
  bool compared = false;                   // it is an operand of a comparison
  const Expression* arithmetic = nullptr;  // the arithmetic it is an operand of
  bool arm = false;                        // it is an arm of ?:, or within one
  bool in_arm_arithmetic = false;          // within arithmetic that is within an arm
};

bool is_operator(const Expression& e) { return e.kind == Kind::binary || e.kind == Kind::assign; }

bool is_comparison(const Expression& e) {
  return (e.kind == Kind::binary && one_of(e.text, {"<", ">", "<=", ">=", "==", "!="})) ||
         (e.kind == Kind::builtin &&
          one_of(e.text, {"lessThan", "lessThanEqual", "greaterThan", "greaterThanEqual", "equal", "notEqual"}));
}

// Operations of the dialect that compilers may rearrange unless told not to.
bool is_arithmetic(const Expression& e) {
  if (!e.type.is_floating()) return false;
  if (is_operator(e)) return one_of(e.text, {"+", "-", "*", "/", "+=", "-=", "*=", "/=", "++", "--"});
  return e.kind == Kind::builtin && one_of(e.text, {"sqrt", "min", "max", "clamp", "step"});
}

bool is_texture_query(std::string_view f) {
  return one_of(f, {"textureSize", "texelFetch", "texelFetchOffset", "textureQueryLevels", "textureSamples"});
}

bool is_filter(std::string_view f) {
  return (f.starts_with("texture") && !is_texture_query(f)) || f.starts_with("interpolateAt") ||
         f.starts_with("shadow");
}

bool is_transcendental(std::string_view f) {
  return one_of(f, {"sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
                    "pow", "exp", "log", "exp2", "log2", "inversesqrt"});
}

bool has_exact_version(std::string_view f) {
  return one_of(f, {"dot", "length", "normalize", "cross", "reflect", "mix", "fract", "mod"});
}

// Moves, selects or rounds in one way only, or works on integers.
bool is_exact_builtin(std::string_view f) {
  return is_texture_query(f) || f.starts_with("atomic") || f.starts_with("image") || f.starts_with("bit") ||
         f.starts_with("dFdx") || f.starts_with("dFdy") || f.starts_with("memoryBarrier") ||
         one_of(f, {"abs",
                    "floor",
                    "ceil",
                    "trunc",
                    "min",
                    "max",
                    "clamp",
                    "step",
                    "sqrt",
                    "transpose",
                    "floatBitsToInt",
                    "floatBitsToUint",
                    "intBitsToFloat",
                    "uintBitsToFloat",
                    "lessThan",
                    "lessThanEqual",
                    "greaterThan",
                    "greaterThanEqual",
                    "equal",
                    "notEqual",
                    "any",
                    "all",
                    "not",
                    "findLSB",
                    "findMSB",
                    "umulExtended",
                    "imulExtended",
                    "uaddCarry",
                    "usubBorrow",
                    "groupMemoryBarrier",
                    "barrier"});
}

bool works_on_integers(const Expression& e) {
  return !e.operands.empty() && !e.type.is_floating() &&
         std::all_of(e.operands.begin(), e.operands.end(), [](const ExpressionPtr& argument) {
           return argument->type.is_integer() || argument->type.base == Base::boolean;
         });
}

// A written-out decimal: digits from the first that is not zero to the end of the significand.
int significant_digits(const std::string& literal) {
  int digits = 0;
  for (const char c : literal) {
    if (c == 'e' || c == 'E' || c == 'f' || c == 'F' || c == 'l' || c == 'L') break;
    if (c != '.' && (c != '0' || digits > 0)) ++digits;
  }
  return digits;
}

// Of a vector of floats, or a column of a matrix: integers need not be `precise`.
bool has_variable_index(const Expression& target) {
  const Expression* e = &target;
  for (; e->kind == Kind::member || e->kind == Kind::index; e = e->operands[0].get()) {
    if (e->operands.empty()) return false;
    const GlslType& indexed = e->operands[0]->type;
    if (e->kind == Kind::index && indexed.is_vector() && indexed.is_floating() && !e->operands[1]->constant)
      return true;
  }
  return false;
}

// Each check answers with the operation to name, or with nothing.

std::string not_precise(const Expression& e, const Place& place) {
  const bool precise = e.kind == Kind::assign ? e.precise : place.precise;
  return is_arithmetic(e) && !e.constant && !precise && !place.compared && !place.arithmetic ? e.text : "";
}

std::string compared(const Expression& e, const Place& place) {
  return is_arithmetic(e) && !e.constant && place.compared && !place.arithmetic ? e.text : "";
}

std::string constant_arithmetic(const Expression& e, const Place& place) {
  const bool folded = is_arithmetic(e) && e.constant && !one_of(e.text, {"min", "max", "clamp", "step"});
  return folded && !(place.arithmetic && place.arithmetic->constant) ? e.text : "";
}

std::string zero_operand(const Expression& e, const Place&) {
  if (!is_operator(e) || !is_arithmetic(e) || e.constant || e.operands.size() != 2) return "";
  const char op = e.text[0];
  const bool left = e.operands[0]->zeros.any, right = e.operands[1]->zeros.any;
  return left || (right && op != '/') ? e.text : "";
}

std::string literal(const Expression& e, const Place&) {
  if (e.kind != Kind::literal || e.type.base != Base::float32) return "";
  const char* text = e.text.c_str();
  const float value = std::strtof(text, nullptr);
  const bool exact = std::strtold(text, nullptr) == static_cast<long double>(value);
  const bool one_rounding = value == static_cast<float>(std::strtod(text, nullptr));
  const bool ordinary = value == 0.0F || std::fpclassify(value) == FP_NORMAL;
  return ordinary && (exact || (one_rounding && significant_digits(e.text) >= 9)) ? "" : e.text;
}

std::string function_with_exact_version(const Expression& e, const Place&) {
  if (e.kind != Kind::builtin || !has_exact_version(e.text)) return "";
  const bool selects = e.text == "mix" && e.operands.size() == 3 && e.operands[2]->type.base == Base::boolean;
  return selects ? "" : e.text;
}

std::string transcendental(const Expression& e, const Place&) {
  return e.kind == Kind::builtin && is_transcendental(e.text) ? e.text : "";
}

std::string matrix_product(const Expression& e, const Place&) {
  if (!is_operator(e) || !one_of(e.text, {"*", "*="}) || e.operands.size() != 2) return "";
  const GlslType &a = e.operands[0]->type, &b = e.operands[1]->type;
  const bool product = (a.is_matrix() && (b.is_matrix() || b.is_vector())) || (a.is_vector() && b.is_matrix());
  return product ? e.text : "";
}

std::string fused(const Expression& e, const Place&) {
  return e.kind == Kind::builtin && e.text == "fma" ? e.text : "";
}

std::string filtered(const Expression& e, const Place&) {
  return e.kind == Kind::builtin && is_filter(e.text) ? e.text : "";
}

std::string other_builtin(const Expression& e, const Place&) {
  if (e.kind != Kind::builtin || e.text == "fma" || is_exact_builtin(e.text) || is_transcendental(e.text) ||
      has_exact_version(e.text) || is_filter(e.text))
    return "";
  return works_on_integers(e) ? "" : e.text;
}

std::string vector_store(const Expression& e, const Place&) {
  if (e.kind == Kind::assign) return has_variable_index(*e.operands[0]) ? "[]" : "";
  if (e.kind != Kind::call) return "";
  for (std::size_t i = 0; i < e.operands.size() && i < e.written.size(); ++i)
    if (e.written[i] && has_variable_index(*e.operands[i])) return "[]";
  return "";
}

std::string double_type(const Expression& e, const Place&) {
  const bool names_it = e.kind == Kind::declaration || e.kind == Kind::construct || e.kind == Kind::literal ||
                        e.kind == Kind::variable || e.kind == Kind::builtin;
  return names_it && e.type.base == Base::float64 ? e.text : "";
}

// Whether it is a constant of which no component, as an int or a uint, is 0 or the int -1.
bool divides_safely(const Expression& e, Base as) {
  if (e.integer) return *e.integer != 0 && (as == Base::uint32 || static_cast<std::int32_t>(*e.integer) != -1);
  return e.kind == Kind::construct && e.type.is_integer() &&
         std::all_of(e.operands.begin(), e.operands.end(),
                     [as](const ExpressionPtr& operand) { return divides_safely(*operand, as); });
}

std::string division(const Expression& e, const Place&) {
  if (!is_operator(e) || !one_of(e.text, {"/", "/=", "%", "%="}) || !e.type.is_integer()) return "";
  return divides_safely(*e.operands[1], e.type.base) ? "" : e.text;
}

std::string remainder(const Expression& e, const Place&) {
  return is_operator(e) && one_of(e.text, {"%", "%="}) && e.type.base == Base::int32 && !e.constant ? e.text : "";
}

bool has_arithmetic(const Expression& e) {
  if (is_arithmetic(e) && !e.constant) return true;
  if (e.kind == Kind::call || e.kind == Kind::index) return false;
  return std::any_of(e.operands.begin(), e.operands.end(), [](const ExpressionPtr& o) { return has_arithmetic(*o); });
}

std::string arm(const Expression& e, const Place& place) {
  if (!place.precise || !place.arm || place.in_arm_arithmetic || !is_arithmetic(e) || e.constant) return "";
  const bool several =
      std::any_of(e.operands.begin(), e.operands.end(), [](const ExpressionPtr& o) { return has_arithmetic(*o); });
  return several ? e.text : "";
}

// The same value twice: alike but for parentheses and the spelling of literals.
bool same(const Expression& a, const Expression& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == Kind::literal && a.type.base != Base::boolean)
    return std::strtod(a.text.c_str(), nullptr) == std::strtod(b.text.c_str(), nullptr);
  return a.text == b.text && std::equal(a.operands.begin(), a.operands.end(), b.operands.begin(), b.operands.end(),
                                        [](const ExpressionPtr& x, const ExpressionPtr& y) { return same(*x, *y); });
}

// Of a choice between the two values that its condition compares, the one that it takes where either is NaN.
const Expression* taken_for_nan(const Expression& condition, const Expression& yes, const Expression& no) {
  if (condition.kind == Kind::unary || (condition.kind == Kind::builtin && condition.text == "not"))
    return taken_for_nan(*condition.operands[0], no, yes);
  if (!is_comparison(condition) || one_of(condition.text, {"==", "!=", "equal", "notEqual"})) return nullptr;
  const Expression &left = *condition.operands[0], &right = *condition.operands[1];
  const bool chooses = (same(left, yes) && same(right, no)) || (same(left, no) && same(right, yes));
  return chooses ? &no : nullptr;
}

// Where one is NaN, min and max give the other: no harm where the choice gives what never is NaN.
std::string select_minmax(const Expression& e, const Place& place) {
  if (e.type.base != Base::float32 || e.operands.size() != 3) return "";
  const bool mixes = e.kind == Kind::builtin && e.text == "mix" && !place.precise;
  if (e.kind != Kind::select && !mixes) return "";
  const Expression *first = e.operands[0].get(), *second = e.operands[1].get(), *third = e.operands[2].get();
  const Expression* taken = mixes ? taken_for_nan(*third, *second, *first) : taken_for_nan(*first, *second, *third);
  return taken && !taken->constant && taken->limit == kUnlimited ? (mixes ? e.text : "?:") : "";
}

// Without the signs and the abs around it.
const Expression& magnitude(const Expression& e) {
  const bool wrapped = e.kind == Kind::unary || (e.kind == Kind::builtin && e.text == "abs");
  return wrapped ? magnitude(*e.operands[0]) : e;
}

std::string minmax_abs(const Expression& e, const Place&) {
  const bool limits = (e.kind == Kind::builtin && one_of(e.text, {"min", "max", "clamp"})) ||
                      (e.kind == Kind::call && one_of(e.text, {"exact_min", "exact_max", "exact_clamp"}));
  if (!limits || e.type.base != Base::float32 || e.constant || e.operands.size() < 2) return "";
  const Expression &a = *e.operands[0], &b = *e.operands[1];
  return same(magnitude(a), magnitude(b)) && !same(a, b) ? e.text : "";
}

struct Row {
  LintRule rule;
  std::string (*check)(const Expression&, const Place&);
};

constexpr Row kTable[] = {
    {{"precise",
      "arithmetic that does not go straight into a precise variable may be rearranged: "
      "store it in a `precise` one first, also before it is passed, returned or converted"},
     not_precise},
    {{"compare",
      "`precise` does not reach arithmetic inside a comparison: store it in a `precise` variable, compare that"},
     compared},
    {{"arm",
      "drivers may lose `precise` between the operations within an arm of ?: (NVIDIA's does): "
      "store the arm's value in a `precise` variable first"},
     arm},
    {{"select-minmax",
      "compilers turn a choice between the two values that its condition compares into min or max, which differ where "
      "one is NaN: write min or max, or mix(b, a, condition) straight into a `precise` variable"},
     select_minmax},
    {{"minmax-abs",
      "compilers know min and max of a value and its own negative or absolute value, but not the sign of their zero: "
      "write x, abs(x) or -abs(x)"},
     minmax_abs},
    {{"constant",
      "arithmetic between constants is folded in double here and in float there: "
      "write the result as one literal, its closed form in a comment"},
     constant_arithmetic},
    {{"literal",
      "a float literal needs nine significant digits (or to be exact in float), one rounding, and no denormal or "
      "infinite value: write the digits of the float that is meant"},
     literal},
    {{"zero",
      "compilers drop x + 0.0 and fold x * 0.0 and 0.0 - x without regard to the sign of zero and to NaN: "
      "write -x, or leave the operation out"},
     zero_operand},
    {{"function", "the order of its operations is the driver's choice: include exact/NAME.glsl and call exact_NAME"},
     function_with_exact_version},
    {{"transcendental",
      "drivers approximate it differently: include the function's file from exact/ and call exact_NAME "
      "(inversesqrt: 1.0 / sqrt(x))"},
     transcendental},
    {{"matrix",
      "the order of a matrix product's sums is the driver's choice: include exact/matrix.glsl, "
      "call exact_multiply"},
     matrix_product},
    {{"fma", "fused on some machines only: write a * b + c"}, fused},
    {{"filter", "filter weights and interpolation differ between machines: texelFetch and exact/bilinear.glsl"},
     filtered},
    {{"builtin",
      "not in the exact dialect: write it with + - * / sqrt, abs, floor, ceil, trunc, min, max, clamp, step"},
     other_builtin},
    {{"vector-store", "`precise` does not reach a store through a variable index: assign the whole vector"},
     vector_store},
    {{"double", "double is not in the exact dialect: use float"}, double_type},
    {{"division",
      "integer division by zero, or of the smallest int by -1, is undefined: divide by a constant other than "
      "0 and -1"},
     division},
    {{"remainder", "% of a negative int differs between machines: use uint"}, remainder},
};

void walk(const Expression& e, const Place& place, const Report& report);

void walk_operands(const Expression& e, std::size_t first, const Place& place, const Report& report) {
  for (std::size_t i = first; i < e.operands.size(); ++i) walk(*e.operands[i], place, report);
}

void walk(const Expression& e, const Place& place, const Report& report) {
  for (const Row& row : kTable)
    if (const std::string operation = row.check(e, place); !operation.empty()) report(e, row.rule, operation);

  Place inner = place;
  if (is_arithmetic(e)) {
    inner.arithmetic = &e;
    inner.in_arm_arithmetic = inner.arm;
  }
  if (is_comparison(e)) return walk_operands(e, 0, {false, true}, report);
  switch (e.kind) {
    case Kind::declaration:
      return walk_operands(e, 0, {e.precise}, report);
    case Kind::assign:
      walk(*e.operands[0], {}, report);
      return walk_operands(e, 1, {e.precise, false, is_arithmetic(e) ? &e : nullptr}, report);
    case Kind::select:
      walk(*e.operands[0], {}, report);
      inner.arm = true;
      inner.in_arm_arithmetic = false;
      return walk_operands(e, 1, inner, report);
    case Kind::index:
      walk(*e.operands[0], inner, report);
      return walk(*e.operands[1], {}, report);
    case Kind::sequence:
      for (std::size_t i = 0; i + 1 < e.operands.size(); ++i) walk(*e.operands[i], {}, report);
      return walk(*e.operands.back(), inner, report);
    case Kind::call:
    case Kind::result:
      return walk_operands(e, 0, {}, report);
    case Kind::builtin:
      return walk_operands(e, 0, is_texture_query(e.text) || is_filter(e.text) ? Place{} : inner, report);
    case Kind::binary:
      return walk_operands(e, 0, one_of(e.text, {"&&", "||", "^^"}) ? Place{} : inner, report);
    default:
      return walk_operands(e, 0, inner, report);
  }
}

}  // namespace

void apply_rules(const Expression& expression, const Report& report) { walk(expression, {}, report); }

}  // namespace twinshade::lint_detail

namespace twinshade {

std::span<const LintRule> lint_rules() {
  static const std::vector<LintRule> rules = [] {
    std::vector<LintRule> list;
    for (const auto& row : lint_detail::kTable) list.push_back(row.rule);
    return list;
  }();
  return rules;
}

}  // namespace twinshade

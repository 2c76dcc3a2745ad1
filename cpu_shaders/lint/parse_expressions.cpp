// Expressions of the lint's parser: precedence climbing over GLSL's table of operators (GLSL 4.50 specification, 5.1).
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>

#include "cpu_shaders/lint/parser.h"

namespace twinshade::lint_detail {
namespace {

using Base = GlslType::Base;
using Kind = Expression::Kind;

int precedence(std::string_view op) {
  static const std::map<std::string_view, int> table = {
      {"||", 1}, {"^^", 2}, {"&&", 3}, {"|", 4},  {"^", 5},  {"&", 6},  {"==", 7}, {"!=", 7}, {"<", 8}, {">", 8},
      {"<=", 8}, {">=", 8}, {"<<", 9}, {">>", 9}, {"+", 10}, {"-", 10}, {"*", 11}, {"/", 11}, {"%", 11}};
  const auto found = table.find(op);
  return found == table.end() ? 0 : found->second;
}

bool is_assignment(std::string_view op) {
  static const std::vector<std::string_view> operators = {
      "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};
  return std::find(operators.begin(), operators.end(), op) != operators.end();
}

bool all_constant(const std::vector<ExpressionPtr>& list) {
  return std::all_of(list.begin(), list.end(), [](const ExpressionPtr& e) { return e->constant; });
}

// Expression::limit, as a float.
double limit(const Expression& e) {
  if (e.type.base == Base::boolean) return 1.0;
  return e.type.is_integer() ? 4294967296.0 : e.limit;
}

double finite_or_unlimited(double value) {
  constexpr double kFiniteFloat = 3e38;  // short of the greatest, for the roundings on the way
  return value <= kFiniteFloat ? value : kUnlimited;
}

double limit(std::string_view op, const Expression& a, const Expression& b) {
  double result = kUnlimited;
  if (op == "+" || op == "-") result = limit(a) + limit(b);
  if (op == "*") result = limit(a) * limit(b) * (a.type.is_matrix() || b.type.is_matrix() ? 4.0 : 1.0);
  return finite_or_unlimited(result);
}

// Expression::integer of a op b, which wraps at 32 bits; nothing for operators that constants are seldom made with.
std::optional<long> integer(std::string_view op, const GlslType& type, long a, long b) {
  const auto x = static_cast<std::uint32_t>(a), y = static_cast<std::uint32_t>(b);
  if (!type.is_integer() || !one_of(op, {"+", "-", "*"})) return {};
  const std::uint32_t result = op == "+" ? x + y : op == "-" ? x - y : x * y;
  return type.base == Base::int32 ? long{static_cast<std::int32_t>(result)} : long{result};
}

GlslType literal_type(const std::string& text) {
  const bool hexadecimal = text.size() > 1 && (text[1] == 'x' || text[1] == 'X');
  const char last = text.back();
  if (last == 'u' || last == 'U') return scalar_type(Base::uint32);
  if (hexadecimal) return scalar_type(Base::int32);
  if (text.size() > 2 && (last == 'f' || last == 'F') && (text[text.size() - 2] == 'l' || text[text.size() - 2] == 'L'))
    return scalar_type(Base::float64);
  const bool real = text.find_first_of(".eEfF") != std::string::npos;
  return scalar_type(real ? Base::float32 : Base::int32);
}

bool takes(const Function& function, const std::vector<ExpressionPtr>& given) {
  return std::equal(given.begin(), given.end(), function.parameters.begin(), function.parameters.end(),
                    [](const ExpressionPtr& e, const GlslType& t) { return e->type == t; });
}

// How far an implicit conversion goes: 0, none is needed; nothing, there is none. A type that is not known may be any.
std::optional<int> conversion(const GlslType& from, const GlslType& to) {
  if (from == to || from.base == Base::unknown || to.base == Base::unknown) return 0;
  const auto is_numeric = [](const GlslType& t) { return t.is_integer() || t.is_floating(); };
  const bool same_shape =
      from.columns == to.columns && from.rows == to.rows && from.array_dimensions == 0 && to.array_dimensions == 0;
  if (!is_numeric(from) || !is_numeric(to) || !same_shape || from.base > to.base) return {};
  return from.is_integer() && to.base == Base::float64 ? 2 : 1;
}

// Of each argument, or of what is written back into it; nothing where the function does not take them.
std::optional<std::vector<int>> conversions(const Function& function, const std::vector<ExpressionPtr>& given) {
  std::vector<int> list;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const GlslType &argument = given[i]->type, &parameter = function.parameters[i];
    const auto in = function.read[i] ? conversion(argument, parameter) : 0;
    const auto out = function.written[i] ? conversion(parameter, argument) : 0;
    if (!in || !out) return {};
    list.push_back(std::max(*in, *out));
  }
  return list;
}

// Goes less far somewhere, and nowhere farther.
bool is_better(const std::vector<int>& a, const std::vector<int>& b) {
  return a != b && std::equal(a.begin(), a.end(), b.begin(), std::less_equal<>());
}

GlslType builtin_result(const Expression& call) {
  std::vector<GlslType> types;
  for (const ExpressionPtr& argument : call.operands) types.push_back(argument->type);
  return builtin_type(call.text, types);
}

// The first argument that a built-in function writes, and all behind it; as many as there are where it writes none.
std::size_t first_written(const Expression& builtin) {
  if (one_of(builtin.text, {"modf", "frexp"})) return 1;
  if (one_of(builtin.text, {"uaddCarry", "usubBorrow", "umulExtended", "imulExtended"})) return 2;
  return builtin.text.starts_with("atomic") ? 0 : builtin.operands.size();
}

}  // namespace

ExpressionPtr Parser::make(Kind kind, std::size_t at) const {
  auto made = std::make_unique<Expression>();
  made->kind = kind;
  made->text = tokens_[at].text;
  made->file = tokens_[at].file;
  made->line = tokens_[at].line;
  made->at = at;
  return made;
}

// From a token to where the parser is.
ExpressionPtr Parser::spanning(ExpressionPtr made, std::size_t first) const {
  made->first = made->outer_first = first;
  made->last = made->outer_last = at_;
  return made;
}

void Parser::full_expression(Role role) { listener_.expression(*expression(), role); }

ExpressionPtr Parser::expression() {
  ExpressionPtr first = assignment();
  if (!is(",")) return first;
  ExpressionPtr sequence = make(Kind::sequence, at_);
  const std::size_t start = first->outer_first;
  sequence->operands.push_back(std::move(first));
  while (accept(",")) sequence->operands.push_back(assignment());
  sequence->type = sequence->operands.back()->type;
  return spanning(std::move(sequence), start);
}

ExpressionPtr Parser::assignment() {
  ExpressionPtr left = conditional();
  if (!is_assignment(peek().text)) return left;
  const std::size_t op = at_;
  take();
  const std::size_t first = left->outer_first;
  return assign(op, first, std::move(left), assignment());
}

// first: of its tokens; op stands there for ++x.
ExpressionPtr Parser::assign(std::size_t op, std::size_t first, ExpressionPtr target, ExpressionPtr value) {
  ExpressionPtr made = make(Kind::assign, op);
  made->type = target->type;
  made->precise = target->precise;
  made->has_effect = true;
  stored(*target, tokens_[op].text == "=" ? value.get() : nullptr);
  made->operands.push_back(std::move(target));
  if (value) made->operands.push_back(std::move(value));
  return spanning(std::move(made), first);
}

void Parser::stored(const Expression& target, const Expression* value) {
  const Expression* root = &target;
  while (root->kind == Kind::member || root->kind == Kind::index) root = root->operands[0].get();
  Variable* const variable = root->kind == Kind::variable ? find_variable(root->text) : nullptr;
  if (!variable) return;
  store_zeros(target, value ? value->zeros : Zeros{});
  double& known = stored_limits_[variable->declared_at];
  known = std::max(known, value ? limit(*value) : kUnlimited);
}

// What the variable is known to hold from here on.
void Parser::store_zeros(const Expression& target, const Zeros& value) {
  if (target.kind == Kind::variable) {
    if (Variable* variable = find_variable(target.text)) variable->zeros = value;
    return;
  }
  const Expression& object = *target.operands[0];
  const GlslType& type = object.type;
  std::size_t count = std::size_t(type.is_matrix() ? type.columns : type.rows);
  Zeros whole = object.zeros;
  if (target.kind == Kind::index) {
    const auto index = target.operands[1]->integer;
    if (type.array_dimensions > 0) count = std::size_t(index.value_or(0)) + 2;  // and others, of which nothing is known
    whole = with_part(whole, count, index, value);
  } else if (const Variable* member = find_member(type, target.text)) {
    whole = with_part(whole, structures_.at(type.name).size(), member->position, value);
  } else if (type.base == Base::structure) {
    whole = {};
  } else {
    for (std::size_t i = 0; i < target.text.size(); ++i)
      whole = with_part(whole, count, component_index(target.text[i]),
                        target.text.size() == 1 ? value : part_zeros(value, long(i)));
  }
  store_zeros(object, whole);
}

// While the stores of the text are not known, a variable may hold anything.
double Parser::limit_of(std::size_t declared_at, double initial) const {
  if (!stores_are_known_) return kUnlimited;
  const auto found = stored_limits_.find(declared_at);
  return found == stored_limits_.end() ? initial : std::max(initial, found->second);
}

ExpressionPtr Parser::conditional() {
  ExpressionPtr condition = binary(1);
  if (!is("?")) return condition;
  ExpressionPtr select = make(Kind::select, at_);
  take();
  const std::size_t first = condition->outer_first;
  select->operands.push_back(std::move(condition));
  select->operands.push_back(expression());
  expect(":");
  select->operands.push_back(assignment());
  select->type = binary_type("?:", select->operands[1]->type, select->operands[2]->type);
  select->constant = all_constant(select->operands);
  return spanning(std::move(select), first);
}

ExpressionPtr Parser::binary(int lowest_precedence) {
  ExpressionPtr left = unary();
  for (int level = precedence(peek().text); level >= lowest_precedence && level > 0; level = precedence(peek().text)) {
    ExpressionPtr made = make(Kind::binary, at_);
    take();
    const std::size_t first = left->outer_first;
    ExpressionPtr right = binary(level + 1);
    made->type = binary_type(made->text, left->type, right->type);
    made->constant = left->constant && right->constant;
    made->limit = limit(made->text, *left, *right);
    if (left->integer && right->integer)
      made->integer = integer(made->text, made->type, *left->integer, *right->integer);
    made->operands.push_back(std::move(left));
    made->operands.push_back(std::move(right));
    left = spanning(std::move(made), first);
  }
  return left;
}

ExpressionPtr Parser::unary() {
  if (is("++") || is("--")) {
    const std::size_t op = at_;
    take();
    return assign(op, op, unary(), nullptr);
  }
  if (!is("+") && !is("-") && !is("!") && !is("~")) return postfix();
  const std::size_t first = at_;
  ExpressionPtr made = make(Kind::unary, first);
  take();
  ExpressionPtr operand = unary();
  made->type = operand->type;
  made->constant = operand->constant;
  made->zeros = operand->zeros;
  made->limit = operand->limit;
  if (operand->integer && made->text == "-") made->integer = -*operand->integer;
  if (operand->integer && made->text == "+") made->integer = operand->integer;
  made->operands.push_back(std::move(operand));
  return spanning(std::move(made), first);
}

ExpressionPtr Parser::postfix() {
  ExpressionPtr object = primary();
  const std::size_t first = object->outer_first;
  for (;;) {
    if (is("[")) {
      ExpressionPtr made = make(Kind::index, at_);
      take();
      made->precise = object->precise;
      made->constant = object->constant;
      made->limit = object->limit;
      made->type = element_type(object->type);
      made->operands.push_back(std::move(object));
      made->operands.push_back(expression());
      made->constant = made->constant && made->operands[1]->constant;
      made->zeros = part_zeros(made->operands[0]->zeros, made->operands[1]->integer);
      expect("]");
      object = spanning(std::move(made), first);
    } else if (is(".")) {
      take();
      object = member_access(std::move(object));
    } else if (is("++") || is("--")) {
      const std::size_t op = at_;
      take();
      object = assign(op, first, std::move(object), nullptr);
    } else {
      return object;
    }
  }
}

const Variable* Parser::find_member(const GlslType& structure, const std::string& name) const {
  if (structure.base != Base::structure) return nullptr;
  const auto members = structures_.find(structure.name);
  if (members == structures_.end()) return nullptr;
  const auto member = members->second.find(name);
  return member == members->second.end() ? nullptr : &member->second;
}

ExpressionPtr Parser::member_access(ExpressionPtr object) {
  const std::size_t first = object->outer_first;
  ExpressionPtr made = make(Kind::member, at_);
  take();
  if (made->text == "length" && accept("(")) {
    expect(")");
    made->type = scalar_type(Base::int32);
    made->constant = true;
    return spanning(std::move(made), first);
  }
  made->precise = object->precise;
  if (object->type.base == Base::structure) {
    if (const Variable* member = find_member(object->type, made->text)) {
      made->type = member->type;
      made->precise = made->precise || member->precise;
      made->zeros = part_zeros(object->zeros, member->position);
    }
  } else {
    made->type = object->type;
    made->type.rows = static_cast<int>(made->text.size());
    std::vector<Zeros> components;
    for (const char letter : made->text) components.push_back(part_zeros(object->zeros, component_index(letter)));
    made->zeros = components.size() == 1 ? components[0] : composed_zeros(std::move(components));
  }
  made->constant = object->constant;
  made->limit = object->limit;
  made->operands.push_back(std::move(object));
  return spanning(std::move(made), first);
}

ExpressionPtr Parser::initializer(const GlslType& type) {
  if (!is("{")) return assignment();
  const std::size_t first = at_;
  ExpressionPtr list = make(Kind::construct, first);
  take();
  while (!accept("}")) {
    list->operands.push_back(initializer(element_type(type)));
    if (!accept(",") && !is("}")) lost();
  }
  list->type = type;
  list->constant = all_constant(list->operands);
  std::vector<Zeros> parts;
  for (const ExpressionPtr& operand : list->operands) parts.push_back(operand->zeros);
  list->zeros = composed_zeros(std::move(parts));
  return spanning(std::move(list), first);
}

std::vector<ExpressionPtr> Parser::arguments() {
  std::vector<ExpressionPtr> list;
  expect("(");
  if (is("void") && is(")", 1)) take();
  while (!accept(")")) {
    list.push_back(assignment());
    if (!accept(",") && !is(")")) lost();
  }
  return list;
}

// The overloads that GLSL's implicit conversions may mean. Several: a prototype and its function, or types that we
// cannot tell from each other, as of arrays that differ in size.
std::vector<const Function*> Parser::find_functions(const Expression& call) const {
  std::vector<const Function*> candidates, best;
  std::vector<std::pair<const Function*, std::vector<int>>> fitting;
  const auto [first, last] = functions_.equal_range(call.text);
  for (auto it = first; it != last; ++it) {
    if (it->second.parameters.size() != call.operands.size()) continue;
    candidates.push_back(&it->second);
    if (auto list = conversions(it->second, call.operands)) fitting.emplace_back(&it->second, std::move(*list));
  }
  // None fits: we took some argument for another type than it is. (Built-in functions of the same name are hidden.)
  if (fitting.empty()) return candidates;
  for (const auto& [function, list] : fitting) {
    const bool is_best = std::none_of(fitting.begin(), fitting.end(),
                                      [&list = list](const auto& other) { return is_better(other.second, list); });
    if (is_best) best.push_back(function);
  }
  return best;
}

// name(...): a constructor, a function of the shader, or a built-in one.
ExpressionPtr Parser::invocation(std::size_t name, GlslType constructed) {
  ExpressionPtr made = make(Kind::builtin, name);
  made->operands = arguments();
  made->constant = all_constant(made->operands);
  if (constructed.base != Base::unknown) {
    made->kind = Kind::construct;
    made->type = constructed;
    std::vector<std::pair<GlslType, Zeros>> operands;
    for (const ExpressionPtr& operand : made->operands) operands.emplace_back(operand->type, operand->zeros);
    made->zeros = constructed_zeros(constructed, operands);
    made->limit = 0.0;
    for (const ExpressionPtr& operand : made->operands) made->limit = std::max(made->limit, limit(*operand));
    if (constructed.is_integer() && made->operands.size() == 1) made->integer = made->operands[0]->integer;
  } else if (const auto functions = find_functions(*made); !functions.empty()) {
    made->kind = Kind::call;
    made->type = functions[0]->result;
    made->has_effect = true;
    made->written.resize(made->operands.size());
    for (const Function* function : functions) {
      for (std::size_t i = 0; i < made->operands.size(); ++i)
        made->written[i] = made->written[i] || function->written[i];
      made->converts = made->converts || !takes(*function, made->operands);
    }
    for (std::size_t i = 0; i < made->operands.size(); ++i)
      if (made->written[i]) stored(*made->operands[i], nullptr);
    made->constant = false;
  } else {
    made->type = builtin_result(*made);
    const std::size_t first = first_written(*made);
    made->has_effect = first < made->operands.size() || made->text.starts_with("imageAtomic");
    for (std::size_t i = first; i < made->operands.size(); ++i) stored(*made->operands[i], nullptr);
    // What an atomic function leaves in memory is another invocation's as much as this one's.
    for (std::size_t i = 0; first > 0 && i < made->operands.size(); ++i) made->written.push_back(i >= first);
  }
  return spanning(std::move(made), name);
}

ExpressionPtr Parser::primary() {
  const Token token = peek();
  const std::size_t start = at_;
  if (accept("(")) {
    ExpressionPtr inner = expression();
    expect(")");
    inner->outer_first = start;
    inner->outer_last = at_;
    return inner;
  }
  if (token.kind == Token::Kind::number) {
    ExpressionPtr literal = make(Kind::literal, start);
    take();
    literal->type = literal_type(token.text);
    literal->constant = true;
    if (literal->type.is_integer()) literal->integer = static_cast<long>(std::strtoul(token.text.c_str(), nullptr, 0));
    literal->zeros =
        scalar_zeros(literal->integer ? *literal->integer == 0 : std::strtod(token.text.c_str(), nullptr) == 0.0);
    literal->limit = finite_or_unlimited(std::strtod(token.text.c_str(), nullptr));
    return spanning(std::move(literal), start);
  }
  if (token.kind != Token::Kind::name) lost();
  if (is_type(token) || is("struct")) {
    GlslType type = type_specifier();
    return invocation(start, type);
  }
  take();
  if (is("(")) return invocation(start, {});
  ExpressionPtr variable = make(Kind::variable, start);
  if (token.text == "true" || token.text == "false") {
    variable->kind = Kind::literal;
    variable->type = scalar_type(Base::boolean);
    variable->constant = true;
  } else if (const Variable* known = find_variable(token.text)) {
    variable->type = known->type;
    variable->precise = known->precise;
    variable->constant = known->constant;
    variable->zeros = known->zeros;
    variable->limit = known->limit;
    variable->integer = known->integer;
  } else if (token.text.rfind("gl_Max", 0) == 0 || token.text.rfind("gl_Min", 0) == 0) {
    variable->type = scalar_type(Base::int32);
    variable->constant = true;
  }
  return spanning(std::move(variable), start);
}

}  // namespace twinshade::lint_detail

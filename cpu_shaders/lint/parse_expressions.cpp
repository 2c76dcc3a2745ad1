// Expressions of the lint's parser: precedence climbing over GLSL's table of operators (GLSL 4.50 specification, 5.1).
#include <algorithm>
#include <cstdlib>

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

bool number(const ExpressionPtr& e) { return e->is_number || e->type.is_integer() || e->type.base == Base::boolean; }

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
  // What the variable is known to hold from here on; a component store tells nothing of the whole.
  const Expression* root = target.get();
  while (root->kind == Kind::member || root->kind == Kind::index) root = root->operands[0].get();
  if (Variable* variable = root->kind == Kind::variable ? find_variable(root->text) : nullptr) {
    const bool whole = root == target.get() && tokens_[op].text == "=";
    variable->has_zero = whole && value != nullptr && value->has_zero;
    variable->all_zero = whole && value != nullptr && value->all_zero;
    variable->is_number = variable->is_number && value != nullptr && value->is_number;
  }
  made->operands.push_back(std::move(target));
  if (value) made->operands.push_back(std::move(value));
  return spanning(std::move(made), first);
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
    made->is_number = one_of(made->text, {"+", "-", "*"}) && number(left) && number(right);
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
  made->has_zero = operand->has_zero;
  made->all_zero = operand->all_zero;
  made->is_number = operand->is_number;
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
      made->has_zero = made->all_zero = object->all_zero;
      made->is_number = object->is_number;
      made->type = element_type(object->type);
      made->operands.push_back(std::move(object));
      made->operands.push_back(expression());
      made->constant = made->constant && made->operands[1]->constant;
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
    const auto members = structures_.find(object->type.name);
    if (members != structures_.end() && members->second.count(made->text) != 0) {
      made->type = members->second.at(made->text).type;
      made->precise = made->precise || members->second.at(made->text).precise;
    }
  } else {
    made->type = object->type;
    made->type.rows = static_cast<int>(made->text.size());
  }
  made->constant = object->constant;
  made->has_zero = made->all_zero = object->all_zero;
  made->is_number = object->is_number;
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
    accept(",");
  }
  list->type = type;
  list->constant = all_constant(list->operands);
  return spanning(std::move(list), first);
}

std::vector<ExpressionPtr> Parser::arguments() {
  std::vector<ExpressionPtr> list;
  expect("(");
  if (is("void") && is(")", 1)) take();
  while (!accept(")")) {
    list.push_back(assignment());
    accept(",");
  }
  return list;
}

// By exact types, else by their number: implicit conversions do not change what the rules ask.
const Function* Parser::find_function(const std::string& name, const std::vector<ExpressionPtr>& given) const {
  const Function* by_number = nullptr;
  const auto [first, last] = functions_.equal_range(name);
  for (auto it = first; it != last; ++it) {
    const Function& candidate = it->second;
    if (candidate.parameters.size() != given.size()) continue;
    if (takes(candidate, given)) return &candidate;
    by_number = &candidate;
  }
  return by_number;
}

// name(...): a constructor, a function of the shader, or a built-in one.
ExpressionPtr Parser::invocation(std::size_t name, GlslType constructed) {
  ExpressionPtr made = make(Kind::builtin, name);
  made->operands = arguments();
  made->constant = all_constant(made->operands);
  if (constructed.base != Base::unknown) {
    made->kind = Kind::construct;
    made->type = constructed;
    const auto has_zero = [](const ExpressionPtr& e) { return e->has_zero; };
    const auto all_zero = [](const ExpressionPtr& e) { return e->all_zero; };
    made->has_zero = std::any_of(made->operands.begin(), made->operands.end(), has_zero);
    made->all_zero = !made->operands.empty() && std::all_of(made->operands.begin(), made->operands.end(), all_zero);
    // a matrix of one scalar is zero off its diagonal
    if (constructed.is_matrix() && made->operands.size() == 1 && made->operands[0]->type.rows == 1)
      made->has_zero = true;
    made->is_number = std::all_of(made->operands.begin(), made->operands.end(), number);
    if (constructed.is_integer() && made->operands.size() == 1) made->integer = made->operands[0]->integer;
  } else if (const Function* function = find_function(made->text, made->operands)) {
    made->kind = Kind::call;
    made->type = function->result;
    made->written = function->written;
    made->converts = !takes(*function, made->operands);
    made->constant = false;
  } else {
    std::vector<GlslType> types;
    for (const ExpressionPtr& argument : made->operands) types.push_back(argument->type);
    made->type = builtin_type(made->text, types);
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
    literal->has_zero = literal->all_zero =
        literal->integer ? *literal->integer == 0 : std::strtod(token.text.c_str(), nullptr) == 0.0;
    literal->is_number = true;
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
    variable->has_zero = known->has_zero;
    variable->all_zero = known->all_zero;
    variable->is_number = known->is_number;
    variable->integer = known->integer;
  } else if (token.text.rfind("gl_Max", 0) == 0 || token.text.rfind("gl_Min", 0) == 0) {
    variable->type = scalar_type(Base::int32);
    variable->constant = true;
  }
  return spanning(std::move(variable), start);
}

}  // namespace twinshade::lint_detail

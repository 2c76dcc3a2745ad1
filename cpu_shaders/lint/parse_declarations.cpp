// Declarations and statements of the lint's parser.
#include <algorithm>
#include <array>

#include "base/error.h"
#include "cpu_shaders/lint/parser.h"

namespace twinshade::lint_detail {
namespace {

using Base = GlslType::Base;

constexpr std::array<std::string_view, 33> kQualifiers = {
    "in",        "out",        "inout",         "uniform",   "buffer",        "shared",
    "const",     "precise",    "invariant",     "flat",      "smooth",        "noperspective",
    "centroid",  "sample",     "patch",         "attribute", "varying",       "highp",
    "mediump",   "lowp",       "coherent",      "volatile",  "restrict",      "readonly",
    "writeonly", "subroutine", "layout",        "superp",    "nonuniformEXT", "static",
    "inline",    "extern",     "perprimitiveNV"};

bool is_qualifier(const Token& token) {
  return token.kind == Token::Kind::name &&
         std::find(kQualifiers.begin(), kQualifiers.end(), token.text) != kQualifiers.end();
}

// Of the reading that only gathers what is stored.
struct Silent : Listener {
  void expression(const Expression&, Role) override {}
};

Variable builtin_variable(std::string_view keyword, int array_dimensions = 0) {
  Variable variable;
  variable.type = keyword_type(keyword);
  variable.type.array_dimensions = array_dimensions;
  return variable;
}

}  // namespace

Parser::Parser(const TokenList& list, Listener& listener) : list_(list), tokens_(list.tokens), listener_(listener) {
  scopes_.emplace_back();
  for (const char* name : {"gl_FragCoord"}) declare(name, builtin_variable("vec4"));
  for (const char* name : {"gl_PointCoord", "gl_SamplePosition"}) declare(name, builtin_variable("vec2"));
  for (const char* name : {"gl_FragDepth"}) declare(name, builtin_variable("float"));
  for (const char* name : {"gl_FrontFacing", "gl_HelperInvocation"}) declare(name, builtin_variable("bool"));
  for (const char* name : {"gl_PrimitiveID", "gl_SampleID", "gl_NumSamples", "gl_Layer", "gl_ViewportIndex"})
    declare(name, builtin_variable("int"));
  for (const char* name : {"gl_SampleMask", "gl_SampleMaskIn"}) declare(name, builtin_variable("int", 1));
  for (const char* name : {"gl_ClipDistance", "gl_CullDistance"}) declare(name, builtin_variable("float", 1));
}

const Token& Parser::peek(std::size_t ahead) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }

bool Parser::is(std::string_view text, std::size_t ahead) const { return peek(ahead).text == text; }

Token Parser::take() {
  const Token token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

TokenList tokens_to_parse(const ShaderSource& source) {
  TokenList list = tokenize(source);
  list.tokens.push_back(list.end);
  return list;
}

bool Parser::accept(std::string_view text) {
  if (!is(text)) return false;
  take();
  return true;
}

void Parser::expect(std::string_view text) {
  if (!accept(text)) lost();
}

// glslang accepted the text: being here means that this parser does not know a construct. Never guess past it.
void Parser::lost() const {
  const Token& token = peek();
  throw UserError(list_.files[static_cast<std::size_t>(token.file)] + ":" + std::to_string(token.line) +
                  ": the lint does not know the construct at \"" + token.text + "\": write it another way");
}

void Parser::skip_balanced() {
  int depth = 0;
  do {
    const Token token = take();
    if (token.kind == Token::Kind::end) return;
    if (token.text == "(" || token.text == "[" || token.text == "{") ++depth;
    if (token.text == ")" || token.text == "]" || token.text == "}") --depth;
  } while (depth > 0);
}

// precision highp float;
void Parser::skip_precision() {
  for (int words = 0; words < 3; ++words) take();
  expect(";");
}

// [[unroll]] before a statement (GL_EXT_control_flow_attributes)
void Parser::skip_attributes() {
  while (is("[") && is("[", 1)) skip_balanced();
}

Variable* Parser::find_variable(const std::string& name) {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
    if (const auto found = scope->find(name); found != scope->end()) return &found->second;
  return nullptr;
}

// Keywords of newer versions are names in older ones: of blocks too, whose members follow.
bool Parser::at_qualifier() {
  return is_qualifier(peek()) && !is("{", 1) && find_variable(peek().text) == nullptr &&
         functions_.count(peek().text) == 0;
}

bool Parser::is_type(const Token& token) {
  if (token.kind != Token::Kind::name) return false;
  if (const Variable* named = find_variable(token.text)) return named->is_structure;
  return keyword_type(token.text).base != Base::unknown && functions_.count(token.text) == 0;
}

// Twice: a loop, or a function that is called, reaches a line with what later lines store.
void Parser::run() {
  Silent silent;
  Parser stores(list_, silent);
  stores.read();
  stored_limits_ = std::move(stores.stored_limits_);
  stores_are_known_ = true;
  read();
}

void Parser::read() {
  while (peek().kind != Token::Kind::end) external_declaration();
}

// A type name starts a declaration unless it is a constructor: vec3(...), float[2](...), Light(...). `int;` declares
// nothing, and is one all the same.
bool Parser::at_declaration() {
  if (at_qualifier() || is("struct") || is("precision")) return true;
  if (!is_type(peek())) return false;
  std::size_t ahead = 1;
  while (is("[", ahead)) {
    while (!is("]", ahead) && peek(ahead).kind != Token::Kind::end) ++ahead;
    ++ahead;
  }
  return peek(ahead).kind == Token::Kind::name || is(";", 1);
}

GlslType Parser::type_specifier() {
  GlslType type;
  if (is("struct")) {
    type = structure();
  } else {
    const Token name = take();
    const Variable* named = find_variable(name.text);
    type = named && named->is_structure ? named->type : keyword_type(name.text);
  }
  array_suffix(type);
  return type;
}

void Parser::array_suffix(GlslType& type) {
  while (accept("[")) {
    if (!is("]")) full_expression(Role::constant);
    expect("]");
    ++type.array_dimensions;
  }
}

GlslType Parser::structure() {
  expect("struct");
  const std::string name = is("{") ? "" : take().text;
  Variable structure;
  structure.is_structure = true;
  structure.type = structure_type(name);
  members(structure.type, false);
  if (!name.empty()) declare(name, structure);  // among its members the name is still another's
  return structure.type;
}

GlslType Parser::structure_type(const std::string& name) {
  GlslType type = scalar_type(Base::structure);
  type.name = name + " at " + std::to_string(at_);
  structures_[type.name];
  return type;
}

// { type name, name[2]; ... } of a structure or a block; global: members are names of their own.
void Parser::members(GlslType owner, bool global) {
  expect("{");
  while (!accept("}")) {
    const Declarator declarator = qualifiers_and_type();
    do {
      const std::string name = take().text;
      Variable member;
      member.type = declarator.type;
      member.precise = declarator.precise;
      member.position = static_cast<long>(structures_[owner.name].size());
      array_suffix(member.type);
      structures_[owner.name][name] = member;
      if (global) declare(name, member);
    } while (accept(","));
    expect(";");
  }
}

Parser::Declarator Parser::qualifiers_and_type() {
  Declarator declarator;
  while (at_qualifier()) {
    const std::size_t token = at_;
    const std::string qualifier = take().text;
    declarator.has_qualifier = true;
    if (qualifier == "precise") declarator.precise = true;
    if (qualifier == "const") {
      declarator.constant = true;
      declarator.const_token = token;
    }
    if (qualifier == "uniform") declarator.is_uniform = true;
    if (qualifier == "out" || qualifier == "inout") declarator.is_output = true;
    if (qualifier == "out") declarator.is_input = false;
    if ((qualifier == "layout" || qualifier == "subroutine") && is("(")) skip_balanced();
  }
  // `layout(...) in;` and `precise name;` have no type; a block has a name that is none
  if (!is(";") && (is_type(peek()) || is("struct"))) declarator.type = type_specifier();
  return declarator;
}

// precise a, b;
void Parser::redeclare_precise() {
  do {
    if (Variable* variable = find_variable(take().text)) variable->precise = true;
  } while (accept(","));
  expect(";");
}

void Parser::external_declaration() {
  if (accept(";")) return;
  if (is("precision")) return skip_precision();
  const Declarator declarator = qualifiers_and_type();
  if (accept(";")) return;
  if (declarator.type.base == Base::unknown && declarator.has_qualifier) {
    if (!is("{", 1)) return redeclare_precise();
    const GlslType block = structure_type(take().text);
    const bool named = [&] {
      const std::size_t start = at_;
      skip_balanced();
      const bool instance = !is(";");
      at_ = start;
      return instance;
    }();
    members(block, !named);
    if (named) {
      Declarator instance;
      instance.type = block;
      declarators(instance);
    } else {
      expect(";");
    }
    return;
  }
  if (is("(", 1)) {
    const std::string name = take().text;
    function(declarator, name);
  } else {
    declarators(declarator);
  }
}

void Parser::function(const Declarator& declarator, const std::string& name) {
  expect("(");
  Function function;
  function.result = declarator.type;
  scopes_.emplace_back();
  while (!accept(")")) {
    Declarator parameter = qualifiers_and_type();
    const std::string parameter_name = peek().kind == Token::Kind::name ? take().text : "";
    array_suffix(parameter.type);
    if (parameter.type.base != Base::nothing) {
      Variable variable;
      variable.type = parameter.type;
      variable.precise = parameter.precise;
      if (!parameter_name.empty()) declare(parameter_name, variable);
      function.parameters.push_back(parameter.type);
      function.read.push_back(parameter.is_input);
      function.written.push_back(parameter.is_output);
    }
    if (!accept(",") && !is(")")) lost();
  }
  functions_.emplace(name, function);
  if (!accept(";")) {
    listener_.function_begin(name, function.result, at_);
    block();
  }
  scopes_.pop_back();
}

// name [= initialiser], ... ;
void Parser::declarators(Declarator declarator) {
  if (accept(";")) return;
  do {
    const std::size_t name = at_;
    take();
    Variable variable;
    variable.type = declarator.type;
    variable.precise = declarator.precise;
    variable.declared_at = name;
    array_suffix(variable.type);
    ExpressionPtr declaration = make(Expression::Kind::declaration, name);
    declaration->const_token = declarator.const_token;
    declaration->is_uniform = declarator.is_uniform;
    declaration->type = variable.type;
    declaration->precise = declarator.precise;
    if (accept("=")) {
      ExpressionPtr value = initializer(variable.type);
      variable.constant = declarator.constant && value->constant;
      variable.zeros = value->zeros;
      variable.limit = declarator.constant ? value->limit : limit_of(name, value->limit);
      if (variable.constant) variable.integer = value->integer;
      declaration->operands.push_back(std::move(value));
    }
    declaration = spanning(std::move(declaration), name);
    listener_.expression(*declaration, in_for_header_ ? Role::loop_header : Role::statement);
    declare(tokens_[name].text, variable);
  } while (accept(","));
  expect(";");
}

void Parser::block() {
  expect("{");
  scopes_.emplace_back();
  while (!is("}") && peek().kind != Token::Kind::end) statement();
  expect("}");
  scopes_.pop_back();
}

// The part in brackets of if, while and switch.
void Parser::condition(Role role) {
  expect("(");
  tested(role);
  expect(")");
}

// What is tested: in while and for it may be a declaration.
void Parser::tested(Role role) {
  if (!at_declaration()) return full_expression(role);
  const Declarator declarator = qualifiers_and_type();
  const std::size_t name = at_;
  take();
  expect("=");
  ExpressionPtr declaration = make(Expression::Kind::declaration, name);
  declaration->type = declarator.type;
  declaration->operands.push_back(initializer(declarator.type));
  declaration = spanning(std::move(declaration), name);
  listener_.expression(*declaration, Role::condition);
  Variable variable;
  variable.type = declarator.type;
  declare(tokens_[name].text, variable);
}

void Parser::scoped_statement() {
  scopes_.emplace_back();
  statement();
  scopes_.pop_back();
}

void Parser::statement() {
  skip_attributes();
  const std::size_t first = at_;
  if (is("{")) return block();
  if (accept(";")) return;
  if (accept("if")) {
    condition(Role::condition);
    scoped_statement();
    if (accept("else")) scoped_statement();
  } else if (is("while") || is("switch")) {
    const Role role = take().text == "while" ? Role::condition : Role::selector;
    scopes_.emplace_back();
    condition(role);
    statement();
    scopes_.pop_back();
  } else if (accept("do")) {
    scoped_statement();
    expect("while");
    condition(Role::condition);
    expect(";");
  } else if (accept("for")) {
    for_loop();
  } else if (accept("return")) {
    ExpressionPtr result = make(Expression::Kind::result, first);
    if (!is(";")) result->operands.push_back(expression());
    result = spanning(std::move(result), first);
    expect(";");
    listener_.expression(*result, Role::result);
    listener_.statement_end(first, at_);
  } else if (accept("case")) {
    full_expression(Role::constant);
    expect(":");
  } else if (accept("default")) {
    expect(":");
  } else if (accept("break") || accept("continue") || accept("discard")) {
    expect(";");
  } else if (is("precision")) {
    skip_precision();
  } else if (at_declaration()) {
    const Declarator declarator = qualifiers_and_type();
    if (declarator.type.base == Base::unknown)
      redeclare_precise();
    else
      declarators(declarator);
    listener_.statement_end(first, at_);
  } else {
    full_expression(in_for_header_ ? Role::loop_header : Role::statement);
    expect(";");
    listener_.statement_end(first, at_);
  }
}

void Parser::for_loop() {
  scopes_.emplace_back();
  listener_.for_begin();
  expect("(");
  in_for_header_ = true;
  statement();
  in_for_header_ = false;
  if (!is(";")) tested(Role::condition);
  expect(";");
  if (!is(")")) full_expression(Role::loop_header);
  expect(")");
  const std::size_t body = at_;
  statement();
  listener_.for_end(body, at_);
  scopes_.pop_back();
}

}  // namespace twinshade::lint_detail

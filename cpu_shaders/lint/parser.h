// Finds every expression of a translation unit that glslang has already accepted. Tolerant by design: it need not
// reject anything, but it must not lose its place, and it says where it did.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cpu_shaders/lint/expression.h"
#include "cpu_shaders/source/glsl_tokens.h"

namespace twinshade::lint_detail {

// The shader's tokens, and behind them that of their end, at which a parser stops.
TokenList tokens_to_parse(const ShaderSource& source);

struct Variable {
  bool is_structure = false;  // no variable: the name of a structure, which type is
  GlslType type;
  bool precise = false;
  bool constant = false;        // const, initialised with a constant
  Zeros zeros;                  // as last assigned, in the order of the text
  double limit = kUnlimited;    // Expression::limit, of every value that the text assigns anywhere
  std::size_t declared_at = 0;  // token
  std::optional<long> integer;  // of a constant
  long position = 0;            // of a member
};

// What the parser tells of, in the order of the text.
class Listener {
 public:
  // What a full expression is for.
  enum class Role {
    statement,    // an expression or declaration statement, and what is declared at global scope
    loop_header,  // the first and the last part of for (...; ...; ...)
    condition,    // of if, while, do and for
    selector,     // of switch
    constant,     // array size, case label
    result,       // return
  };
  Listener() = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  virtual ~Listener() = default;
  // Each full expression once; declarations with several names give one each.
  virtual void expression(const Expression& expression, Role role) = 0;
  // A function's body follows; its tokens begin with the brace.
  virtual void function_begin(const std::string& /*name*/, const GlslType& /*result*/, std::size_t /*body_first*/) {}
  // Behind a statement that is one expression, declaration or return: its tokens, with the semicolon.
  virtual void statement_end(std::size_t /*first*/, std::size_t /*last*/) {}
  // The header of a for loop follows; its body's tokens, once it has been read.
  virtual void for_begin() {}
  virtual void for_end(std::size_t /*body_first*/, std::size_t /*body_last*/) {}
};

struct Function {
  GlslType result;
  std::vector<GlslType> parameters;
  std::vector<bool> read;     // in, inout
  std::vector<bool> written;  // out, inout
};

class Parser {
 public:
  using Role = Listener::Role;

  Parser(const TokenList& list, Listener& listener);
  void run();

  // Members of each structure and block that has been read so far, by GlslType::name.
  const std::map<std::string, std::map<std::string, Variable>>& structures() const { return structures_; }

 private:
  struct Declarator {
    GlslType type;
    bool precise = false, constant = false, is_input = true, is_output = false, is_uniform = false,
         has_qualifier = false;
    std::optional<std::size_t> const_token;
  };

  // tokens
  const Token& peek(std::size_t ahead = 0) const;
  bool is(std::string_view text, std::size_t ahead = 0) const;
  bool accept(std::string_view text);
  void expect(std::string_view text);
  Token take();
  [[noreturn]] void lost() const;
  void skip_precision();
  void skip_attributes();
  void skip_balanced();  // from an opening bracket to behind its closing one

  // declarations
  void read();
  void external_declaration();
  bool at_declaration();
  Declarator qualifiers_and_type();
  GlslType type_specifier();
  GlslType structure();
  // name: the author's, or empty. Two structures of one name, each in its scope, are two types.
  GlslType structure_type(const std::string& name);
  void members(GlslType owner, bool global);
  void function(const Declarator& declarator, const std::string& name);
  void declarators(Declarator declarator);
  void array_suffix(GlslType& type);
  void redeclare_precise();

  // statements
  void statement();
  void scoped_statement();  // of if, else and do: what it declares is seen there alone, with braces or without
  void block();
  void condition(Role role);
  void tested(Role role);
  void for_loop();

  // expressions
  ExpressionPtr expression();
  ExpressionPtr assignment();
  ExpressionPtr conditional();
  ExpressionPtr binary(int lowest_precedence);
  ExpressionPtr unary();
  ExpressionPtr postfix();
  ExpressionPtr primary();
  ExpressionPtr member_access(ExpressionPtr object);
  ExpressionPtr initializer(const GlslType& type);
  ExpressionPtr invocation(std::size_t name, GlslType constructed);
  std::vector<ExpressionPtr> arguments();
  void full_expression(Role role);
  ExpressionPtr make(Expression::Kind kind, std::size_t at) const;
  ExpressionPtr spanning(ExpressionPtr made, std::size_t first) const;
  ExpressionPtr assign(std::size_t op, std::size_t first, ExpressionPtr target, ExpressionPtr value);
  // value: what the whole target then holds; null where that is not known.
  void stored(const Expression& target, const Expression* value);
  void store_zeros(const Expression& target, const Zeros& value);
  double limit_of(std::size_t declared_at, double initial) const;
  std::vector<const Function*> find_functions(const Expression& call) const;

  // names
  void declare(const std::string& name, const Variable& variable) { scopes_.back()[name] = variable; }
  Variable* find_variable(const std::string& name);
  const Variable* find_member(const GlslType& structure, const std::string& name) const;
  bool at_qualifier();
  bool is_type(const Token& token);  // a variable may hide a structure

  const TokenList& list_;
  const std::vector<Token>& tokens_;
  Listener& listener_;
  bool in_for_header_ = false;
  std::size_t at_ = 0;
  std::vector<std::map<std::string, Variable>> scopes_;
  std::map<std::string, std::map<std::string, Variable>> structures_;
  std::multimap<std::string, Function> functions_;
  // By the token that declares a variable: the limit of what is stored into it. Complete once the text has been read.
  std::map<std::size_t, double> stored_limits_;
  bool stores_are_known_ = false;
};

}  // namespace twinshade::lint_detail

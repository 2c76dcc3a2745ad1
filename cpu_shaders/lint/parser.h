// Finds every expression of a translation unit that glslang has already accepted. Tolerant by design: it need not
// reject anything, but it must not lose its place, and it says where it did.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cpu_shaders/lint/expression.h"
#include "cpu_shaders/lint/tokens.h"

namespace twinshade::lint_detail {

struct Variable {
  GlslType type;
  bool precise = false;
  bool constant = false;                    // const, initialised with a constant
  bool has_zero = false, all_zero = false;  // as last assigned, in the order of the text
  std::optional<long> integer;              // of a constant
};

struct Function {
  GlslType result;
  std::vector<GlslType> parameters;
  std::vector<bool> written;  // out, inout
};

class Parser {
 public:
  using Sink = std::function<void(const Expression&)>;  // gets each full expression once, in the order of the text

  Parser(const TokenList& list, Sink sink);
  void run();

 private:
  struct Declarator {
    GlslType type;
    bool precise = false, constant = false, is_input = true, is_output = false, has_qualifier = false;
  };

  // tokens
  const Token& peek(std::size_t ahead = 0) const;
  bool is(std::string_view text, std::size_t ahead = 0) const;
  bool accept(std::string_view text);
  void expect(std::string_view text);
  Token take();
  [[noreturn]] void lost() const;
  void skip_balanced();  // from an opening bracket to behind its closing one

  // declarations
  void external_declaration();
  bool at_declaration() const;
  Declarator qualifiers_and_type();
  GlslType type_specifier();
  GlslType structure();
  void members(GlslType owner, bool global);
  void function(const Declarator& declarator, const std::string& name);
  void declarators(Declarator declarator);
  void array_suffix(GlslType& type);
  void redeclare_precise();

  // statements
  void statement();
  void block();
  void condition();

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
  ExpressionPtr invocation(const Token& name, GlslType constructed);
  std::vector<ExpressionPtr> arguments();
  void full_expression();
  ExpressionPtr make(Expression::Kind kind, const Token& at) const;
  ExpressionPtr assign(const Token& op, ExpressionPtr target, ExpressionPtr value);
  const Function* find_function(const std::string& name, const std::vector<ExpressionPtr>& given) const;

  // names
  void declare(const std::string& name, const Variable& variable) { scopes_.back()[name] = variable; }
  Variable* find_variable(const std::string& name);
  bool is_type(const Token& token) const;

  const TokenList& list_;
  const std::vector<Token>& tokens_;
  Sink sink_;
  std::size_t at_ = 0;
  std::vector<std::map<std::string, Variable>> scopes_;
  std::map<std::string, std::map<std::string, Variable>> structures_;
  std::multimap<std::string, Function> functions_;
};

}  // namespace twinshade::lint_detail

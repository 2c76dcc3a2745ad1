// The generator's state. generator_values.cpp writes expressions, generator_statements.cpp statements,
// program_generator.cpp what stands around them.
#pragma once

#include <initializer_list>
#include <map>
#include <random>

#include "tests/fuzz/program_generator.h"

namespace twinshade::fuzz {

class Generator {
 public:
  explicit Generator(std::uint64_t seed);
  GeneratedProgram program();

 private:
  struct Variable {
    std::string name;
    GlslType type;
    bool writable = true;
    bool precise = false;  // declared so: arithmetic may be assigned to it
  };
  using Scope = std::vector<Variable>;
  enum class Direction { in, constant_in, out, inout };
  struct Parameter {
    Direction direction;
    GlslType type;
  };
  struct Function {
    std::string name;
    GlslType result;
    bool returns_value = true, pure = true;
    std::vector<Parameter> parameters;
    int cost = 0;
  };

  // --- program_generator.cpp
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  bool chance(int percent) { return below(100) < percent; }
  std::string pick(std::initializer_list<const char*> all) { return all.begin()[below(static_cast<int>(all.size()))]; }
  template <class T>
  const T& pick(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  // Joins texts that are made from left to right: the operands of + would be made in any order, and so at random.
  static std::string join(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts) text += part;
    return text;
  }
  std::string fresh();
  std::string name_of(const GlslType& type) const { return type_name(type, structures_); }
  void structures();
  void interface(GeneratedProgram& program);
  void function();
  void observe(Scope& scope);  // all that is in scope goes into the outputs

  // --- generator_values.cpp
  Scalar base();
  GlslType plain_type();
  GlslType any_type();
  std::string index(int length);
  void places(const std::string& text, const GlslType& type, const GlslType& wanted, bool to_write,
              std::vector<std::string>& found);
  std::string swizzle(const std::string& text, int from, int to, bool distinct);
  std::vector<std::string> all_places(const GlslType& wanted, bool to_write);
  std::string literal(Scalar base);
  std::string constant(const GlslType& type);
  std::string leaf(const GlslType& type);
  std::string value(const GlslType& type, int depth);  // of any type, usable anywhere in an expression
  std::string integer(const GlslType& type, int depth);
  std::string integer_function(const GlslType& type, int depth);
  std::string divided(const GlslType& type, int depth);
  std::string converted(const GlslType& type, int depth);
  std::string truth(int depth);
  std::string truths(int rows, int depth);
  std::string comparison(int depth);
  std::string real(const GlslType& type, int depth);  // arithmetic: goes into a precise variable only
  std::string held(const std::string& text, const GlslType& type);
  std::string tame(int rows, bool narrow);
  std::string composite(const GlslType& type, int depth);
  std::string maker(const GlslType& type);  // name of a function that is given the elements of an array
  std::string pure_call(const GlslType& type, int depth);

  // --- generator_statements.cpp
  void line(const std::string& code) { text_ += std::string(static_cast<std::size_t>(2 * indent_), ' ') + code + "\n"; }
  void block(int statements);
  void statement();
  void declaration();
  void assignment();
  void assign_real(const std::string& place, const GlslType& type);
  void choice();
  void loop();
  void loop_body();
  void switch_statement();
  void leave();
  void call();
  void increment();
  void side_effects();
  bool affordable(const Function& f) const { return cost_ + times_ * f.cost < 4000; }

  std::mt19937_64 random_;
  bool allowed(int feature) const { return (features_ >> feature & 1) != 0; }
  std::uint64_t features_;
  std::string text_, prefix_;
  Structures structures_;
  std::map<std::string, std::string> makers_;  // by name; they stand behind the structures
  std::vector<Function> functions_;
  Scope scope_;                       // innermost last
  std::vector<std::string> globals_;  // may be written by functions
  Function current_;
  bool in_main_ = false, may_hoist_ = true, in_loop_ = false;
  int switches_ = 0;  // around, within the loop
  int indent_ = 0, names_ = 0, nesting_ = 0, statements_left_ = 0;
  int cost_ = 0, times_ = 1;  // statements that an invocation runs so far; of them how many for one written here
};

}  // namespace twinshade::fuzz

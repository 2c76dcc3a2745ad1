// Writes one instance of a function. emit_expression.cpp has values, emit_place.cpp memory, emit_statement.cpp control
// flow, emit_loop.cpp loops and switches, emit_precision.cpp what is computed in half.
#pragma once

#include <array>
#include <optional>

#include "cpu_shaders/translate/emit_types.h"
#include "cpu_shaders/translate/instances.h"
#include "cpu_shaders/translate/interface.h"
#include "cpu_shaders/translate/regions.h"

namespace twinshade::spirv {

// What all functions of a shader share.
struct Emission {
  const Program& program;
  const Instances& instances;
  const Interface& interface;
  const SourceLines& lines;
  TypeNames& types;
  NameTable& names;
  Precision precision = Precision::full;
  bool readable = false;
  std::string half_lines;  // Precision::by_line: the name of the switches
  std::map<std::pair<Id, Id>, std::string>
      tables;                     // constant tables by (function, variable) and of private constants (0, variable)
  std::string no_float64_reason;  // set by the first bit cast
  std::vector<Position> switched;  // lines, by switch
  Writer out;
};

struct Expression {
  std::string text;
  int precedence =
      0;  // C++'s: 1 postfix, 3 unary, 5 * /, 6 + -, 7 shifts, 9 < >, 10 ==, 11 &, 12 ^, 13 |, 14 &&, 15 ||
  std::set<Id> reads;  // variables whose change would change it
};

// Stands for the contents of all buffers in Expression::reads.
inline constexpr Id kBuffers = ~0u;
// Marks an expression that changes something: it is written before anything else that reads or writes.
inline constexpr Id kEffects = ~0u - 1;

// An expression rounded to half, unless it is one already.
std::string rounded_to_half(const std::string& text);

class FunctionEmitter {
 public:
  // runs_in_double: reachable in float64, where some functions are replaced by the runtime's.
  FunctionEmitter(Emission& shared, const Instance& instance, bool runs_in_double);
  void run();

 private:
  // --- emit_expression.cpp
  struct Pending {
    Id id;
    Expression expression;
  };
  Expression value(Id id);            // consumes a pending value
  std::string text(Id id, int most);  // in parentheses where it binds less tightly than `most`
  std::string argument(Id id) { return text(id, 17); }
  void define(const Instruction& i, Expression e);
  void materialise(Pending& pending);
  void flush();                // gives every pending value a name
  void before_write(Id root);  // ... those that read `root` or have effects
  void settle_effects();       // ... those that have effects
  void instruction(const Instruction& i);
  bool arithmetic(const Instruction& i);
  bool texture(const Instruction& i);
  Kind signedness(const Instruction& i) const;
  Expression operand_as(Id id, Kind wanted);
  Expression binary(const Instruction& i, const char* op, int precedence);
  Expression call_text(const Instruction& i, const std::string& function, const std::vector<Id>& arguments);
  Expression extended(const Instruction& i);
  bool pair(const Instruction& i);
  Expression composite(const Instruction& i);
  Expression extract(const Instruction& i);
  Expression select(const Instruction& i);
  Id passed(Id argument) const;
  void call(const Instruction& i);
  void atomic(const Instruction& i);
  void no_float64(const Instruction& i, const std::string& what);
  [[noreturn]] void refuse(const Instruction& i, const std::string& what, const std::string& remedy) const;
  bool is_real(Id value) const { return module_.scalar_kind(module_.value_types.at(value)) == Kind::real; }
  // "const " before a declaration of this type, but not of what is put together of others: g++ keeps a constant of that
  // kind in memory instead of registers, because it is stored to.
  std::string constant(Id type) const {
    const Kind kind = module_.type(type).kind;
    return kind == Kind::matrix || kind == Kind::array || kind == Kind::structure ? "" : "const ";
  }
  std::string type_of(Id value) { return types_.name(module_.value_types.at(value), at_.is_varying(value)); }

  // --- emit_precision.cpp
  bool is_relaxed(Id value) const;  // of lower precision than float, by declaration or because everything is
  bool everything_may_be_half() const;
  bool is_relaxed_place(Id pointer) const;
  bool is_narrow(const Instruction& i) const;  // its result is a half
  bool compares_halves(const Instruction& i) const;
  std::string half_switch(const Instruction& i);
  std::string half_call(const Instruction& i);
  std::string rounded(const Instruction& i, const std::string& text);
  Expression in_half(const Instruction& i, const std::string& function, const std::vector<Id>& arguments);
  Expression in_half_operator(const Instruction& i, const char* op);
  bool rounds_result(const Instruction& i) const;
  std::string to_store(const Instruction& i, const std::string& value);
  bool is_served_in_full() const;
  void refuse_bits(const Instruction& i, const std::string& what) const;

  // --- emit_place.cpp
  struct Step {
    enum class Kind { member, constant, uniform_index, varying_index } kind;
    std::string text;
    Id container;  // type that is stepped into
    std::uint32_t index = 0;
    Id index_value = 0;
  };
  struct Place {
    Id root = 0;
    Expression base;
    std::vector<Step> steps;
    Id type = 0;
    const Global* buffer = nullptr;  // memory is read and written where it is used
  };
  Place place(Id pointer);
  Expression load(const Place& p);
  bool holds_structure(Id type) const;
  bool is_block_array(Id type) const;
  std::string builtin_text(const Global& g);
  std::string step_text(const std::string& base, const Step& s);
  void store(const Instruction& i);
  void store_to(const Instruction& i, const Place& p, const std::string& value);
  std::string nested_store(const std::string& base, const Place& p, std::size_t first, const std::string& mask,
                           bool masked, const std::string& value, int depth);
  struct Offset {
    explicit Offset(const Layout& l) : layout(l) {}
    Layout layout;
    std::uint32_t constant = 0;
    std::string dynamic;
    bool varying = false;
    Id type = 0;
    MatrixLayout matrix;
    std::set<Id> reads;
    std::string text(std::uint32_t more = 0) const;
  };
  Offset offset_of(const Place& p);
  void name_dynamic(Offset& at);
  std::string load_memory(const std::string& buffer, const Offset& at, Id type, std::uint32_t more,
                          const MatrixLayout& matrix, bool varying);
  void store_memory(const std::string& buffer, const Offset& at, Id type, std::uint32_t more,
                    const MatrixLayout& matrix, const std::string& value);
  std::string variable_name(Id variable);
  std::string declare(Id variable, const std::string& wanted);

  // --- emit_statement.cpp
  struct Mask {
    std::string name;
    const Statement* construct;  // null: the function's
    bool iteration = false;      // lanes of one iteration, as against those still in the loop
    int uniform_depth = 0;       // uniform branches and loops entered since
  };
  void list(const List& statements, const Statement* owner, std::size_t first = 0);
  std::string local_name(Id variable) const;
  void declare_empty(const std::vector<Id>& variables);
  void declare_before(const Statement& s);
  void code(const Statement& s);
  void choice(const Statement& s);
  void masked_choice(const Statement& s);
  bool departing_arm(const Statement& s, const Expression& condition);
  void leave(const Statement& s);
  void give_back(const Statement& s);
  bool skip_rest(const Statement& s, const Statement* owner);
  void position(std::uint32_t file, int line);
  void statement(const std::string& text) { out_.line(text); }
  std::string mask() const { return masks_.empty() ? "" : masks_.back().name; }
  std::string mask_or_all() const { return masks_.empty() ? "B(true)" : masks_.back().name; }
  std::string narrowed(const std::string& condition, int precedence) const;  // mask & condition
  std::string new_mask() { return names_.declare("mask" + std::to_string(++mask_count_)); }
  void scope(const List& statements, const Statement* owner);
  bool departs(const Statement& s) const;  // some lanes leave s for somewhere outside it, others stay
  bool discards(const Statement& s) const;
  std::string signature() const;

  // --- emit_loop.cpp
  void loop(const Statement& s);
  std::vector<std::string> written_out(const Statement& s) const;
  std::optional<std::size_t> straight_cost(const List& statements, const Instance& at) const;
  void cases(const Statement& s);
  void masked_cases(const Statement& s);
  std::string loop_condition(const Statement& s, Id condition, bool inverted, const std::string& own_mask);

  Emission& shared_;
  const Instance& at_;
  const FunctionInfo& info_;
  const Program& program_;
  const Module& module_;
  TypeNames& types_;
  NameTable& names_;
  Writer& out_;
  DirectArguments direct_;
  Regions regions_;
  const bool runs_in_double_;
  std::map<Id, Expression> values_;
  std::map<Id, std::array<std::string, 2>> pairs_;  // values of functions that give two
  std::vector<Pending> pending_;
  std::map<Id, std::string> variables_;
  std::map<Id, Id> argument_values_;  // argument temporaries
  std::vector<Mask> masks_;
  std::string result_;  // variable for the value of divergent returns
  std::string for_init_;
  const Instruction* for_init_store_ = nullptr;
  int mask_count_ = 0, temporary_count_ = 0;
  std::string last_file_;
  int last_line_ = 0;
};

}  // namespace twinshade::spirv

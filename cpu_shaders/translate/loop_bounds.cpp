// Which loops end by themselves: those that count one variable by a constant from constants to a constant, soon. All
// others count their iterations while they run, so that a shader that never ends is an error and not a hang.
#include <algorithm>
#include <optional>

#include "base/endless_loop.h"
#include "base/error.h"
#include "cpu_shaders/translate/function_info.h"
#include "cpu_shaders/translate/limits.h"

namespace twinshade::spirv {
namespace {

constexpr std::uint64_t kMany = std::uint64_t{1} << 40;

std::uint64_t product(std::uint64_t a, std::uint64_t b) { return b != 0 && a > kMany / b ? kMany : a * b; }
std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return std::min(a + b, kMany); }

class LoopBounds {
 public:
  LoopBounds(const Program& program, FunctionInfo& info) : program_(program), module_(program.module), info_(info) {}

  void run() {
    info_.work = sum(1, work(info_.body.list));
    if (info_.work > kMostWork)
      throw UserError(module_.position(info_.function->file, info_.function->line).text() + ": " +
                      info_.function->name + " calls functions that call functions: more than " +
                      std::to_string(kMostWork) + " calls in all");
  }

 private:
  // Iterations and calls of one run through the list, those of counted loops once.
  std::uint64_t work(const List& list) {
    std::uint64_t total = 0;
    for (const auto& s : list) {
      for (const Instruction& i : s->code)
        if (i.op == spv::OpFunctionCall) total = sum(total, program_.info(i.operands[0]).work);
      if (s->shape == Shape::loop) {
        total = sum(total, loop(*s));
        continue;
      }
      total = sum(total, sum(work(s->then_list), work(s->else_list)));
      for (const Case& c : s->cases) total = sum(total, work(c.body));
    }
    return total;
  }

  std::uint64_t loop(const Statement& s) {
    const std::uint64_t once = sum(1, sum(work(s.body), work(s.continuing)));
    const std::uint64_t all = product(once, trips(s));
    if (all <= kMostUncounted) return all;
    info_.counted_loops[s.id] = static_cast<std::uint32_t>(std::min<std::uint64_t>(once, kMostIterations));
    return once;
  }

  // At most so many iterations, unless it is left before; kMany where nothing says so.
  std::uint64_t trips(const Statement& s) const {
    const Statement* test = nullptr;
    for (std::size_t k = 0; k < std::min<std::size_t>(s.body.size(), 2) && test == nullptr; ++k) {
      if (s.body[k]->shape == Shape::choice) test = s.body[k].get();
      if (s.body[k]->shape != Shape::code) break;
    }
    if (test == nullptr) return kMany;
    const List& leaving = test->then_list.empty() ? test->else_list : test->then_list;
    if (leaving.size() != 1 || leaving[0]->shape != Shape::leave_loop || leaving[0]->target != &s) return kMany;
    const auto compared = info_.definitions.find(test->condition);
    if (compared == info_.definitions.end()) return kMany;
    const Instruction& c = *compared->second;
    const bool is_signed = c.op == spv::OpSLessThan || c.op == spv::OpSLessThanEqual || c.op == spv::OpSGreaterThan ||
                           c.op == spv::OpSGreaterThanEqual;
    const bool up = c.op == spv::OpSLessThan || c.op == spv::OpSLessThanEqual || c.op == spv::OpULessThan ||
                    c.op == spv::OpULessThanEqual;
    const bool down = c.op == spv::OpSGreaterThan || c.op == spv::OpSGreaterThanEqual || c.op == spv::OpUGreaterThan ||
                      c.op == spv::OpUGreaterThanEqual;
    // The loop goes on while the comparison holds.
    if ((!up && !down) || !test->then_list.empty() || !module_.is_constant(c.operands[1])) return kMany;
    const Id variable = loaded_variable(c.operands[0]);
    if (variable == 0) return kMany;
    const std::optional<std::int64_t> step = only_step(s, variable);
    if (!step || (up ? *step <= 0 : *step >= 0)) return kMany;
    const std::int64_t bound = number(c.operands[1], is_signed);
    const std::optional<std::int64_t> start = start_of(s, variable, is_signed, up);
    if (!start) return kMany;
    const std::int64_t distance = up ? bound - *start : *start - bound;
    // Past the bound by a step before it is compared again: must not wrap around.
    const std::int64_t beyond = bound + *step, least = is_signed ? INT32_MIN : 0,
                       most = is_signed ? INT32_MAX : UINT32_MAX;
    if (beyond < least || beyond > most) return kMany;
    return distance < 0 ? 1 : static_cast<std::uint64_t>(distance / std::abs(*step) + 2);
  }

  std::int64_t number(Id constant, bool is_signed) const {
    const std::uint32_t bits = module_.constants.at(constant).bits;
    return is_signed ? static_cast<std::int64_t>(static_cast<std::int32_t>(bits)) : static_cast<std::int64_t>(bits);
  }

  // The local variable that a value is loaded from, whole; 0 for others.
  Id loaded_variable(Id value) const {
    const auto found = info_.definitions.find(value);
    if (found == info_.definitions.end() || found->second->op != spv::OpLoad) return 0;
    const Id variable = found->second->operands[0];
    return std::find(info_.locals.begin(), info_.locals.end(), variable) == info_.locals.end() ? 0 : variable;
  }

  bool is_stored(const Instruction& i, Id variable) const { return i.op == spv::OpStore && i.operands[0] == variable; }
  bool is_passed(const Instruction& i, Id variable) const {
    return i.op == spv::OpFunctionCall && std::count(i.operands.begin() + 1, i.operands.end(), variable) > 0;
  }

  // By what every iteration moves the variable; nothing if it does so in any other way.
  std::optional<std::int64_t> only_step(const Statement& s, Id variable) const {
    const Instruction* step = nullptr;
    bool other = false;
    const auto look = [&](const List& list) {
      for_each_instruction(list,
                           [&](const Instruction& i) { other |= is_stored(i, variable) || is_passed(i, variable); });
    };
    look(s.body);
    for (const auto& part : s.continuing) {
      if (part->shape != Shape::code) other = true;
      for (const Instruction& i : part->code) {
        other |= is_passed(i, variable) || (step != nullptr && is_stored(i, variable));
        if (is_stored(i, variable)) step = &i;
      }
    }
    if (step == nullptr || other) return std::nullopt;
    const auto added = info_.definitions.find(step->operands[1]);
    if (added == info_.definitions.end()) return std::nullopt;
    const Instruction& a = *added->second;
    if ((a.op != spv::OpIAdd && a.op != spv::OpISub) || loaded_variable(a.operands[0]) != variable ||
        !module_.is_constant(a.operands[1]))
      return std::nullopt;
    const std::int64_t by = number(a.operands[1], true);
    return a.op == spv::OpIAdd ? by : -by;
  }

  // The value at the start that gives most iterations, if all are constants.
  std::optional<std::int64_t> start_of(const Statement& s, Id variable, bool is_signed, bool up) const {
    std::optional<std::int64_t> start;
    bool other = false;
    int inside = 0;
    for_each_instruction(s.continuing, [&](const Instruction& i) { inside += is_stored(i, variable); });
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      other |= is_passed(i, variable);
      if (!is_stored(i, variable)) return;
      if (!module_.is_constant(i.operands[1])) {
        --inside;  // its own step; a second one is not known
        return;
      }
      const std::int64_t value = number(i.operands[1], is_signed);
      start = !start ? value : up ? std::min(*start, value) : std::max(*start, value);
    });
    return other || inside != 0 ? std::nullopt : start;
  }

  const Program& program_;
  const Module& module_;
  FunctionInfo& info_;
};

}  // namespace

void find_endless_loops(const Program& program, FunctionInfo& info) { LoopBounds(program, info).run(); }

}  // namespace twinshade::spirv

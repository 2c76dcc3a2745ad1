#include "cpu_shaders/translate/trip_count.h"

namespace twinshade::spirv {
namespace {

// More turns than any shader of ours takes: not worth simulating.
constexpr std::uint64_t kMostTurns = 1 << 16;

struct LoopReader {
  const Module& module;
  const FunctionInfo& info;

  const Instruction* definition(Id id, spv::Op op) const {
    const auto found = info.definitions.find(id);
    return found != info.definitions.end() && found->second->op == op ? found->second : nullptr;
  }
  // The variable whose value `id` is; 0: none.
  Id loaded(Id id) const {
    const Instruction* load = definition(id, spv::OpLoad);
    return load ? load->operands[0] : 0;
  }
  std::optional<std::int64_t> constant(Id id) const {
    if (!module.is_constant(id)) return std::nullopt;
    const Kind kind = module.type_of(id).kind;
    const std::uint32_t bits = module.constants.at(id).bits;
    if (kind == Kind::integer) return std::int32_t(bits);
    if (kind == Kind::unsigned_integer) return bits;
    return std::nullopt;
  }
};

bool holds(spv::Op op, std::int64_t a, std::int64_t b) {
  switch (op) {
    case spv::OpSLessThan:
    case spv::OpULessThan:
      return a < b;
    case spv::OpSLessThanEqual:
    case spv::OpULessThanEqual:
      return a <= b;
    case spv::OpSGreaterThan:
    case spv::OpUGreaterThan:
      return a > b;
    case spv::OpSGreaterThanEqual:
    case spv::OpUGreaterThanEqual:
      return a >= b;
    default:
      return false;
  }
}

bool is_comparison(spv::Op op) {
  return op == spv::OpSLessThan || op == spv::OpULessThan || op == spv::OpSLessThanEqual ||
         op == spv::OpULessThanEqual || op == spv::OpSGreaterThan || op == spv::OpUGreaterThan ||
         op == spv::OpSGreaterThanEqual || op == spv::OpUGreaterThanEqual;
}

// The test at the loop's head; its condition. Everything else that ends the loop makes this 0.
Id only_condition(const Statement& loop) {
  Id condition = 0;
  int ends = 0;
  for (const auto& s : loop.body) {
    if (s->shape != Shape::choice || s->condition == 0) continue;
    const List& leaving = s->then_list.empty() ? s->else_list : s->then_list;
    if (leaving.size() == 1 && leaving[0]->shape == Shape::leave_loop && s->then_list.empty()) condition = s->condition;
    break;
  }
  for_each_statement(loop.body, [&](const Statement& s) {
    ends +=
        (s.shape == Shape::leave_loop && s.target == &loop) || s.shape == Shape::give_back || s.shape == Shape::discard;
  });
  return ends == 1 ? condition : 0;
}

}  // namespace

std::optional<CountedLoop> counted_loop(const Module& module, const FunctionInfo& info, const Statement& loop,
                                        const StoredConstants& before) {
  const LoopReader reader{module, info};
  const Id condition = only_condition(loop);
  const auto found = info.definitions.find(condition);
  if (condition == 0 || loop.back_condition != 0 || found == info.definitions.end()) return std::nullopt;
  const Instruction& test = *found->second;
  if (!is_comparison(test.op)) return std::nullopt;
  const Id counter = reader.loaded(test.operands[0]);
  const auto limit = reader.constant(test.operands[1]);
  const auto start = before.find(counter);
  if (counter == 0 || !limit || start == before.end()) return std::nullopt;

  // The counter changes once, in `continuing`, by a constant.
  std::optional<std::int64_t> step;
  for_each_instruction(loop.continuing, [&](const Instruction& i) {
    if (i.op != spv::OpStore || i.operands[0] != counter) return;
    for (const spv::Op op : {spv::OpIAdd, spv::OpISub})
      if (const Instruction* sum = reader.definition(i.operands[1], op);
          sum && reader.loaded(sum->operands[0]) == counter)
        if (const auto change = reader.constant(sum->operands[1])) step = op == spv::OpIAdd ? *change : -*change;
  });
  bool changed = false;
  for_each_instruction(loop.body, [&](const Instruction& i) {
    changed = changed || (i.op == spv::OpStore && root_of(info, i.operands[0]) == counter);
  });
  const auto first = reader.constant(start->second);
  if (!step || *step == 0 || changed || !first) return std::nullopt;

  std::uint64_t turns = 0;
  for (std::int64_t value = *first; holds(test.op, value, *limit); value += *step)
    if (++turns > kMostTurns) return std::nullopt;
  return CountedLoop{counter, *first, *step, turns};
}

std::optional<std::uint64_t> trip_count(const Module& module, const FunctionInfo& info, const Statement& loop,
                                        const StoredConstants& before) {
  const auto counted = counted_loop(module, info, loop, before);
  return counted ? std::optional(counted->turns) : std::nullopt;
}

}  // namespace twinshade::spirv

#include "cpu_shaders/translate/count_operations.h"

#include <map>

#include "base/error.h"
#include "cpu_shaders/translate/compile_glsl.h"
#include "cpu_shaders/translate/function_info.h"
#include "cpu_shaders/translate/served.h"
#include "cpu_shaders/translate/trip_count.h"

namespace twinshade {
namespace {

using namespace spirv;

void add(OperationCount& to, const OperationCount& from, int times = 1) {
  to.additions += times * from.additions;
  to.multiplications += times * from.multiplications;
  to.divisions += times * from.divisions;
  to.square_roots += times * from.square_roots;
  to.selections += times * from.selections;
  to.others += times * from.others;
  to.integers += times * from.integers;
  to.texels += times * from.texels;
  to.loops = to.loops || from.loops;
}

class Counter {
 public:
  Counter(const Program& program, const std::string& free) : program_(program), free_(free) {}

  const OperationCount& function(Id id) {
    const auto found = counts_.find(id);
    if (found != counts_.end()) return found->second;
    const FunctionInfo& info = program_.info(id);
    if (info.function->name == free_) return counts_[id];
    StoredConstants stored;
    OperationCount count = list(info, info.body.list, stored);
    if (fetches_colors(program_.module, *info.function)) {
      // As served: fives of colours are a cache line, four fetches of 16 bytes, and a last one alone is one.
      const Function& f = *info.function;
      const Module& module = program_.module;
      const int colors = int(module.type(info.parameter_type(module, f.parameters.size() - 1)).count);
      const int taps = count.texels / colors;
      count.texels = taps * (colors / 5 * 4 + (colors % 5 == 0 ? 0 : colors % 5 == 1 ? 1 : 4));
      count.multiplications = 3 * colors * taps;
      count.additions = 3 * colors * (taps - 1);
    }
    return counts_[id] = count;
  }

 private:
  // stored: what is known of variables at the start, then at the end.
  OperationCount list(const FunctionInfo& info, const List& statements, StoredConstants& stored) {
    OperationCount count;
    for (const auto& s : statements) {
      for (const Instruction& i : s->code) {
        instruction(i, count);
        remember(i, stored);
      }
      OperationCount dearest = list(info, s->then_list, stored);
      const auto compare = [&](const OperationCount& arm) {
        if (arm.total() > dearest.total()) dearest = arm;
      };
      compare(list(info, s->else_list, stored));
      for (const Case& c : s->cases) compare(list(info, c.body, stored));
      add(count, dearest);
      if (s->shape != Shape::loop) continue;
      const auto turns = trip_count(program_.module, info, *s, stored);
      OperationCount turn = list(info, s->body, stored);
      add(turn, list(info, s->continuing, stored));
      turn.loops = turn.loops || !turns;
      add(count, turn, int(turns.value_or(1)));
    }
    return count;
  }

  void remember(const Instruction& i, StoredConstants& stored) const {
    if (i.op != spv::OpStore) return;
    if (program_.module.is_constant(i.operands[1]))
      stored[i.operands[0]] = i.operands[1];
    else
      stored.erase(i.operands[0]);
  }

  bool is_real(Id type) const { return program_.module.scalar_kind(type) == Kind::real; }

  void instruction(const Instruction& i, OperationCount& count) {
    const Module& module = program_.module;
    const auto operand_type = [&](std::size_t k) { return module.value_types.at(i.operands[k]); };
    const int n = i.type == 0 ? 0 : int(module.component_count(i.type));
    switch (i.op) {
      case spv::OpFunctionCall:
        add(count, function(i.operands[0]));
        return;
      case spv::OpFAdd:
      case spv::OpFSub:
        count.additions += n;
        return;
      case spv::OpFMul:
      case spv::OpVectorTimesScalar:
      case spv::OpMatrixTimesScalar:
      case spv::OpOuterProduct:
        count.multiplications += n;
        return;
      case spv::OpDot:
        products(count, 1, int(module.component_count(operand_type(0))));
        return;
      case spv::OpMatrixTimesVector:
        products(count, n, int(module.component_count(operand_type(1))));
        return;
      case spv::OpVectorTimesMatrix:
        products(count, n, int(module.component_count(operand_type(0))));
        return;
      case spv::OpMatrixTimesMatrix:
        products(count, n, int(module.type(operand_type(0)).count));
        return;
      case spv::OpFDiv:
        count.divisions += n;
        return;
      case spv::OpFNegate:
        count.selections += n;
        return;
      case spv::OpSelect:
        (is_real(i.type) ? count.selections : count.integers) += n;
        return;
      case spv::OpFOrdEqual:
      case spv::OpFOrdNotEqual:
      case spv::OpFUnordNotEqual:
      case spv::OpFOrdLessThan:
      case spv::OpFOrdLessThanEqual:
      case spv::OpFOrdGreaterThan:
      case spv::OpFOrdGreaterThanEqual:
      case spv::OpIsNan:
      case spv::OpIsInf:
        count.selections += n;
        return;
      case spv::OpFMod:
      case spv::OpFRem:
        count.others += n;
        return;
      case spv::OpImageFetch:
        ++count.texels;
        return;
      case spv::OpImageSampleImplicitLod:
      case spv::OpImageSampleExplicitLod:
        count.texels += 4;
        return;
      case spv::OpExtInst:
        extended(i.operands[1], is_real(i.type), n, count);
        return;
      default:
        if (is_integer_operation(i.op)) count.integers += n;
    }
  }

  // `sums` sums of `terms` products.
  static void products(OperationCount& count, int sums, int terms) {
    count.multiplications += sums * terms;
    count.additions += sums * (terms - 1);
  }

  // GLSL.std.450.
  static void extended(std::uint32_t number, bool real, int n, OperationCount& count) {
    const bool rounding = number <= 9 && number != 5 && number != 7;  // round, trunc, abs, sign, floor, ceil
    const bool extreme = number == 37 || number == 40 || number == 79 || number == 80 || number == 48;  // step too
    if (!real)
      count.integers += n;
    else if (number == 31)
      count.square_roots += n;
    else if (number == 32)  // inversesqrt
      count.square_roots += n, count.divisions += n;
    else if (rounding || extreme)
      count.selections += n;
    else if (number == 43 || number == 81)  // clamp
      count.selections += 2 * n;
    else
      count.others += n;
  }

  static bool is_integer_operation(spv::Op op) {
    return (op >= spv::OpSNegate && op <= spv::OpSMod && op != spv::OpFNegate) ||
           (op >= spv::OpLogicalEqual && op <= spv::OpLogicalNot) ||
           (op >= spv::OpIEqual && op <= spv::OpSLessThanEqual) ||
           (op >= spv::OpShiftRightLogical && op <= spv::OpNot) ||
           (op >= spv::OpConvertFToU && op <= spv::OpConvertUToF);
  }

  const Program& program_;
  const std::string& free_;
  std::map<Id, OperationCount> counts_;
};

}  // namespace

OperationCount count_operations(const ShaderSource& source, const std::string& function, const std::string& free) {
  const SourceLines lines(source);
  const Program program = analyse(parse(compile_glsl(source), lines));
  for (const auto& [id, info] : program.functions)
    if (info.function->name == function) return Counter(program, free).function(id);
  throw UserError("shader " + source.name + " has no function " + function + " that its main uses");
}

}  // namespace twinshade

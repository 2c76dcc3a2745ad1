#include "cpu_shaders/translate/count_operations.h"

#include <map>

#include "base/error.h"
#include "cpu_shaders/translate/compile_glsl.h"
#include "cpu_shaders/translate/count_instruction.h"
#include "cpu_shaders/translate/function_info.h"
#include "cpu_shaders/translate/trip_count.h"

namespace twinshade {
namespace {

using namespace spirv;

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
    count_as_served(program_.module, info, count);
    return counts_[id] = count;
  }

 private:
  // stored: what is known of variables at the start, then at the end.
  OperationCount list(const FunctionInfo& info, const List& statements, StoredConstants& stored) {
    OperationCount count;
    for (const auto& s : statements) {
      for (const Instruction& i : s->code) {
        if (i.op == spv::OpFunctionCall)
          add(count, function(i.operands[0]));
        else
          count_instruction(program_.module, i, count);
        remember(program_.module, i, stored);
      }
      // Each arm begins with what is known before all of them.
      const auto arm_count = [&](const List& arm) {
        StoredConstants known = stored;
        return list(info, arm, known);
      };
      OperationCount dearest = arm_count(s->then_list);
      const auto compare = [&](const OperationCount& arm) {
        if (arm.total() > dearest.total()) dearest = arm;
      };
      compare(arm_count(s->else_list));
      for (const Case& c : s->cases) compare(arm_count(c.body));
      add(count, dearest);
      const auto turns = s->shape == Shape::loop ? trip_count(program_.module, info, *s, stored) : std::nullopt;
      forget(*s, stored);
      if (s->shape != Shape::loop) continue;
      OperationCount turn = arm_count(s->body);
      add(turn, arm_count(s->continuing));
      turn.loops = turn.loops || !turns;
      add(count, turn, std::int64_t(turns.value_or(1)));
    }
    return count;
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

#include <algorithm>
#include <map>
#include <set>

#include "cpu_shaders/translate/compile_glsl.h"
#include "cpu_shaders/translate/count_instruction.h"
#include "cpu_shaders/translate/instances.h"

namespace twinshade {
namespace {

using namespace spirv;

class LeastCounter {
 public:
  explicit LeastCounter(const Module& module) : module_(module) {}

  const OperationCount& function(const Instance& instance) {
    const auto found = counts_.find(&instance);
    if (found != counts_.end()) return found->second;
    OperationCount count = list(instance, instance.info->body.list, {});
    count_as_served(module_, *instance.info, count);
    return counts_[&instance] = count;
  }

 private:
  // Up to the first statement from which some invocations may not go on. `known`: constants that variables hold.
  OperationCount list(const Instance& instance, const List& statements, StoredConstants known) {
    OperationCount count;
    for (const auto& s : statements) {
      for (const Instruction& i : s->code)
        if (!instruction(instance, i, count, known)) return count;
      const auto turns = s->shape == Shape::loop ? trip_count(module_, *instance.info, *s, known) : std::nullopt;
      if (s->shape == Shape::choice) {
        add(count, least(list(instance, s->then_list, known), list(instance, s->else_list, known)));
        forget(*s, known);
      } else if (s->shape == Shape::cases) {
        add(count, cases(instance, *s, known));
        forget(*s, known);
      } else if (s->shape == Shape::loop) {
        forget(*s, known);
        add(count, loop(instance, *s, turns, known));
      }
      if (may_leave(*s)) break;
    }
    return count;
  }

  OperationCount cases(const Instance& instance, const Statement& s, const StoredConstants& known) {
    OperationCount count;
    bool first = true, any = false;
    for (const Case& c : s.cases) {
      const OperationCount one = list(instance, c.body, known);
      count = first ? one : least(count, one);
      first = false;
      any = any || c.is_default;
    }
    return any ? count : OperationCount{};
  }

  // Of loops whose turns are not known, what precedes the first way out of them.
  OperationCount loop(const Instance& instance, const Statement& s, std::optional<std::uint64_t> turns,
                      const StoredConstants& known) {
    if (turns) counted_.insert(&s);
    OperationCount turn = list(instance, s.body, known);
    if (turns) add(turn, list(instance, s.continuing, known));
    turn.loops = turn.loops || !turns;
    OperationCount count;
    add(count, turn, std::int64_t(turns.value_or(1)));
    return count;
  }

  static OperationCount least(const OperationCount& a, const OperationCount& b) {
    OperationCount count;
    for (const auto member : kOperationCounts) count.*member = std::min(a.*member, b.*member);
    count.loops = a.loops || b.loops;
    return count;
  }

  // Whether there is a way out that leads to behind the statement's end. Counted loops have none but their condition's.
  bool may_leave(const Statement& s) const {
    std::set<const Statement*> within;
    const auto visit = [&](const Statement& inner, const auto& self) -> bool {
      within.insert(&inner);
      switch (inner.shape) {
        case Shape::give_back:
        case Shape::discard:
        case Shape::unreachable:
          return true;
        case Shape::leave_loop:
          return !within.count(inner.target) && !counted_.count(inner.target);
        case Shape::next_iteration:
        case Shape::leave_cases:
          return !within.count(inner.target);
        default:
          break;
      }
      const auto any = [&](const List& statements) {
        return std::any_of(statements.begin(), statements.end(), [&](const auto& x) { return self(*x, self); });
      };
      return any(inner.then_list) || any(inner.else_list) || any(inner.body) || any(inner.continuing) ||
             std::any_of(inner.cases.begin(), inner.cases.end(), [&](const Case& c) { return any(c.body); });
    };
    return visit(s, visit);
  }

  // Whether all invocations go on behind it.
  bool instruction(const Instance& instance, const Instruction& i, OperationCount& count, StoredConstants& known) {
    if (i.op == spv::OpFunctionCall) {
      const Instance& callee = *instance.callees.at(&i);
      add(count, function(callee));
      if (callee.info->discards) return false;
    } else if (i.op == spv::OpImageFetch || i.op == spv::OpImageSampleImplicitLod ||
               i.op == spv::OpImageSampleExplicitLod) {
      count.texels += instance.is_varying(i.operands[1]);  // the coordinates
    } else if (i.result == 0 || instance.is_varying(i.result)) {
      count_instruction(module_, i, count);
    }
    remember(module_, i, known);
    return true;
  }

  const Module& module_;
  std::map<const Instance*, OperationCount> counts_;
  std::set<const Statement*> counted_;  // loops with a known number of turns
};

}  // namespace

OperationCount least_operations(const ShaderSource& source) {
  const SourceLines lines(source);
  const Program program = analyse(parse(compile_glsl(source), lines));
  const Instances instances = analyse_uniformity(program);
  return LeastCounter(program.module).function(*instances.main);
}

}  // namespace twinshade

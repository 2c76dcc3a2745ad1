#include "cpu_shaders/translate/regions.h"

#include <algorithm>

namespace twinshade::spirv {
namespace {

struct Access {
  std::vector<std::pair<const List*, std::size_t>> path;  // from the function's list inwards
  std::vector<const Statement*> owners;                   // owner of each list of the path; null for the first
  const Instruction* instruction;
};

class Finder {
 public:
  Finder(const Program& program, const Instance& at, const DirectArguments& direct)
      : program_(program), info_(*at.info), at_(at), direct_(direct) {
    walk(info_.body.list, nullptr);
  }

  Regions run() {
    for (Id v : info_.locals) {
      if (info_.constant_tables.count(v) || info_.argument_temporaries.count(v) || !accesses_.count(v)) continue;
      decide(v);
    }
    return std::move(result_);
  }

 private:
  void walk(const List& list, const Statement* owner) {
    owners_.push_back(owner);
    path_.push_back({&list, 0});
    for (std::size_t k = 0; k < list.size(); ++k) {
      path_.back().second = k;
      const Statement& s = *list[k];
      for (const Instruction& i : s.code) note(i);
      walk_children(s);
    }
    path_.pop_back();
    owners_.pop_back();
  }

  void walk_children(const Statement& s) {
    for (const List* child : {&s.then_list, &s.else_list, &s.body, &s.continuing})
      if (!child->empty()) walk(*child, &s);
    for (const Case& c : s.cases) walk(c.body, &s);
  }

  void note(const Instruction& i) {
    std::set<Id> roots;
    if (i.is_chain()) return;  // counts where it is used
    if (direct_.skipped.count(&i)) return;
    for (Id id : value_operands(i)) {
      const auto type = program_.module.value_types.find(id);
      if (type == program_.module.value_types.end() || program_.module.type(type->second).kind != Kind::pointer)
        continue;
      roots.insert(named(root_of(info_, id)));
    }
    for (Id root : roots) accesses_[root].push_back({path_, owners_, &i});
  }

  void decide(Id v) {
    const std::vector<Access>& all = accesses_[v];
    // The innermost list that has them all, moved out of loops that carry the value round.
    std::size_t depth = all[0].path.size();
    for (const Access& a : all) {
      std::size_t common = 0;
      while (common < depth && common < a.path.size() && a.path[common].first == all[0].path[common].first) ++common;
      depth = std::min(depth, common);
    }
    for (std::size_t d = 1; d < depth; ++d) {
      const Statement* owner = all[0].owners[d];
      if (owner->shape == Shape::loop && owner->live_head.count(v)) depth = d;
    }
    const List& list = *all[0].path[depth - 1].first;
    std::size_t first = list.size(), last = 0;
    for (const Access& a : all) {
      first = std::min(first, a.path[depth - 1].second);
      last = std::max(last, a.path[depth - 1].second);
    }
    const Statement& at = *list[first];
    const Instruction& i = *all[0].instruction;
    const bool begins = at.shape == Shape::code && i.op == spv::OpStore && i.operands[0] == v && i.operands[1] != v &&
                        !at_.partial.count(&i);
    if (!begins) {
      if (at.shape == Shape::code)
        result_.before_instruction[&i].push_back(v);
      else
        result_.before[&at].push_back(v);
      return;
    }
    result_.declaring_stores.insert(&i);
    if (all.end() ==
        std::find_if(all.begin() + 1, all.end(), [&](const Access& a) { return writes(*a.instruction, v); }))
      result_.constant.insert(v);
    const bool only_in_loop =
        last == first + 1 && list[last]->shape == Shape::loop && &i == &at.code.back() &&
        std::all_of(all.begin() + 1, all.end(), [&](const Access& a) { return a.path[depth - 1].second == last; });
    if (only_in_loop && !result_.constant.count(v)) result_.loop_init[list[last].get()] = &i;
  }

  Id named(Id argument) const {
    const auto found = direct_.variable.find(argument);
    return found == direct_.variable.end() ? argument : found->second;
  }

  bool writes(const Instruction& i, Id v) const {
    if (i.op == spv::OpStore) return root_of(info_, i.operands[0]) == v;
    if (i.op == spv::OpFunctionCall) {
      const FunctionInfo& callee = program_.info(i.operands[0]);
      for (std::size_t k = 0; k + 1 < i.operands.size(); ++k)
        if (named(i.operands[k + 1]) == v && callee.written_parameters.count(k)) return true;
      return false;
    }
    return i.op == spv::OpExtInst && i.operands[1] == 35 && root_of(info_, i.operands[3]) == v;  // modf
  }

  const Program& program_;
  const FunctionInfo& info_;
  const Instance& at_;
  const DirectArguments& direct_;
  Regions result_;
  std::vector<std::pair<const List*, std::size_t>> path_;
  std::vector<const Statement*> owners_;
  std::map<Id, std::vector<Access>> accesses_;
};

}  // namespace

Regions Regions::find(const Program& program, const Instance& instance, const DirectArguments& direct) {
  return Finder(program, instance, direct).run();
}

}  // namespace twinshade::spirv

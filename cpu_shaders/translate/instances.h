// Which values are the same in all lanes, and which control flow therefore needs masks. A function is analysed once for
// each pattern of uniform and varying arguments that it is called with, and written out once for each.
#pragma once

#include <memory>
#include <tuple>

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {

struct Instance {
  const FunctionInfo* info = nullptr;
  std::string name;  // in C++

  bool whole = false;                         // all lanes run when it is called
  std::vector<bool> varying_in, varying_out;  // parameters: the value, or what the pointer points to, before and after
  bool result_varying = false;

  std::set<Id> varying;         // values and variables
  std::set<int> masked;         // choices, loops and switches with masks of their own, by statement id
  std::set<int> waits_at_end;   // loops that some lanes leave before others
  std::set<int> waits_at_next;  // loops in which some lanes skip to the next iteration
  std::set<int> divergent;      // departures (break, continue, return) that only some lanes take
  bool divergent_return = false;
  bool inlined = true;                   // always: small, or called from one place
  bool needs_mask = false;               // takes the caller's mask
  std::set<const Instruction*> partial;  // stores that must keep the values of lanes outside the mask
  std::map<const Instruction*, Instance*> callees;

  bool is_varying(Id id) const { return varying.count(id) != 0; }
  bool is_masked(const Statement& s) const { return masked.count(s.id) != 0; }
};

struct Instances {
  // By function, varying parameters and `whole`.
  std::map<std::tuple<Id, std::vector<bool>, bool>, std::unique_ptr<Instance>> all;
  std::set<Id> varying_globals;  // private variables
  Instance* main = nullptr;
  std::vector<Instance*> callees_first;
};

Instances analyse_uniformity(const Program& program);

}  // namespace twinshade::spirv

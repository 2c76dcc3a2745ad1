// How often a loop that counts between constants runs, and with which values.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {

// Variables and the constant that was stored to them last, before the loop.
using StoredConstants = std::unordered_map<Id, Id>;

struct CountedLoop {
  Id counter = 0;  // variable
  std::int64_t first = 0, step = 0;
  std::uint64_t turns = 0;
};

// Of for (int i = A; i < B; i += C) with constants A, B and C, also <=, > and >=, signed or not. Nothing where the loop
// has another form, or a break, return or discard that may end it earlier.
std::optional<CountedLoop> counted_loop(const Module& module, const FunctionInfo& info, const Statement& loop,
                                        const StoredConstants& before);
std::optional<std::uint64_t> trip_count(const Module& module, const FunctionInfo& info, const Statement& loop,
                                        const StoredConstants& before);

}  // namespace twinshade::spirv

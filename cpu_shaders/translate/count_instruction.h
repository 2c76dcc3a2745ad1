// What one instruction costs, and sums of costs: what the dearest and the least way through a shader are made of.
#pragma once

#include "cpu_shaders/translate/count_operations.h"
#include "cpu_shaders/translate/function_info.h"
#include "cpu_shaders/translate/trip_count.h"

namespace twinshade::spirv {

// Stays at INT64_MAX, where it would be more.
void add(OperationCount& to, const OperationCount& from, std::int64_t times = 1);

// Of an instruction other than a call.
void count_instruction(const Module& module, const Instruction& i, OperationCount& count);

// What a function's body was counted as becomes what the runtime does in its place, if it serves it by something else.
void count_as_served(const Module& module, const FunctionInfo& info, OperationCount& count);

// After the instruction: what variables hold. After a statement with lists of its own: what it may have stored to is
// not known.
void remember(const Module& module, const Instruction& i, StoredConstants& stored);
void forget(const Statement& s, StoredConstants& stored);

}  // namespace twinshade::spirv

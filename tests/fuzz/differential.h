// Generated programs on every machine against the interpreter.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"
#include "evaluate/evaluator.h"
#include "tests/fuzz/program_generator.h"

namespace twinshade::fuzz {

inline constexpr std::uint32_t kRows = 64;

ShaderSource source_of(std::uint64_t seed, const GeneratedProgram& program);

// Inputs and uniforms of kRows invocations.
ValueTable table_of(std::uint64_t seed, const GeneratedProgram& program);

// What the program computes according to the interpreter.
EvaluatedRows interpreted(std::uint64_t seed, const GeneratedProgram& program);

// The first difference, as "row 3: out_uint[0] is 0x..., not 0x... (0x1.8p+1)"; empty for none. NaNs are one value.
std::string first_difference(const EvaluatedRows& computed, const EvaluatedRows& expected);

struct Tally {
  std::size_t programs = 0, runs = 0, discarded_rows = 0;
  std::vector<std::string> mistranslated;   // the CPU differs from the interpreter, or refuses: ours to put right
  std::vector<std::string> driver_differs;  // the interpreter and every CPU agree against the driver
};

// Programs first to first + count - 1 on each target, `batch` of them prepared at a time; `progress` gets the tally so
// far after each batch.
Tally compare_programs(std::uint64_t first, std::uint64_t count, const std::vector<EvaluationTarget>& targets,
                       std::size_t batch, const std::function<void(const Tally&)>& progress = {});

}  // namespace twinshade::fuzz

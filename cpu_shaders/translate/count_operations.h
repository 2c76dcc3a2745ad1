// How much arithmetic a function of a shader is, counted in what the translator makes C++ of.
#pragma once

#include <cstdint>
#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// Scalar operations on floats, a vector's components one each.
struct OperationCount {
  std::int64_t additions = 0;  // and subtractions
  std::int64_t multiplications = 0;
  std::int64_t divisions = 0;
  std::int64_t square_roots = 0;
  std::int64_t selections = 0;  // comparisons, selections, minimum, maximum, absolute value, negation, rounding
  std::int64_t others = 0;      // transcendental built-ins and the like, one each
  std::int64_t integers = 0;    // operations on integers and booleans: not in the total
  std::int64_t texels = 0;      // fetched; four where texture() filters: not in the total
  bool loops = false;           // a loop whose number of turns is not constant is counted as if it ran once

  std::int64_t total() const { return additions + multiplications + divisions + square_roots + selections + others; }
};

inline constexpr std::int64_t OperationCount::*kOperationCounts[] = {
    &OperationCount::additions,    &OperationCount::multiplications, &OperationCount::divisions,
    &OperationCount::square_roots, &OperationCount::selections,      &OperationCount::others,
    &OperationCount::integers,     &OperationCount::texels};

// Of one call of the function of this name with all that it calls. Of branches the dearest counts; of ?: that the
// translator turns into selections, both sides, since both are computed. `free`: a function that costs nothing, such as
// one that stands for reading memory. UserError where the shader has no such function.
OperationCount count_operations(const ShaderSource& source, const std::string& function, const std::string& free);

// What an invocation of main cannot do without, however it is compiled: of branches the least of each kind of
// operation, up to where some invocations leave; of what is the same for all invocations nothing; texture() reads one
// texel.
OperationCount least_operations(const ShaderSource& source);

}  // namespace twinshade

// Seeded generator of GLSL fragment shaders: expressions, control flow of every kind, functions with in, out and inout
// parameters, structs, arrays of arrays, vectors, matrices, int, uint, bool and float. After Yang, Chen, Eide, Regehr,
// Finding and Understanding Bugs in C Compilers (PLDI 2011): every program has one meaning only. Each program leaves
// out some features, which finds more (Groce et al., Swarm Testing, ISSTA 2012).
//
// Floats stay in the exact dialect (docs/exact-dialect.md): arithmetic goes into precise variables, comparisons are
// between variables, no value is known to be zero while compiling. Loops end, indices and divisors are in range.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/glsl_types.h"

namespace twinshade::fuzz {

struct Interface {
  std::string name;
  GlslType type;  // scalar, vector, or an array of them
};

struct GeneratedProgram {
  std::string text;  // #version 450
  std::vector<Interface> inputs, uniforms, outputs;
};

// The same text for the same seed, on every machine.
GeneratedProgram generate_program(std::uint64_t seed);

// The scalars of one input (row: of the table) or uniform (row 0) of a program: small and large numbers, no denormals,
// NaN or infinity.
std::vector<std::uint32_t> interface_value(std::uint64_t seed, const Interface& variable, std::uint32_t row);

}  // namespace twinshade::fuzz

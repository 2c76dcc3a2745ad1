// How much arithmetic a function of a shader is, counted in what the translator makes C++ of.
#pragma once

#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

// Scalar operations on floats, a vector's components one each.
struct OperationCount {
  int additions = 0;  // and subtractions
  int multiplications = 0;
  int divisions = 0;
  int square_roots = 0;
  int selections = 0;  // comparisons, selections, minimum, maximum, absolute value, negation, rounding
  int others = 0;      // transcendental built-ins and the like, one each
  int integers = 0;    // operations on integers and booleans: not in the total
  int texels = 0;      // fetched; four where texture() filters: not in the total
  bool loops = false;  // a loop whose number of turns is not constant is counted as if it ran once

  int total() const { return additions + multiplications + divisions + square_roots + selections + others; }
};

// Of one call of the function of this name with all that it calls. Of branches the dearest counts; of ?: that the
// translator turns into selections, both sides, since both are computed. `free`: a function that costs nothing, such as
// one that stands for reading memory. UserError where the shader has no such function.
OperationCount count_operations(const ShaderSource& source, const std::string& function, const std::string& free);

}  // namespace twinshade

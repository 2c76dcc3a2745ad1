// The cases of a shader as JSON (docs/eval.md): tables of inputs and uniforms, the outputs that are expected, how close
// they must be.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "evaluate/values.h"

namespace twinshade {

// A float is close enough if it is within any of the three. Integers and bools must be equal.
struct Tolerance {
  std::uint64_t ulp = 0;  // representable floats between the two; -0 and 0 are one
  double abs = 0;
  double rel = 0;  // of the expected value
};

// Of one output.
struct ExpectedOutput {
  Values values;                            // doubles hold what the file says, bits that rounded to float
  std::vector<std::uint8_t> has_value;      // by row: 0 where the file has null, which admits everything
  std::vector<std::uint8_t> left_out = {};  // by row and component: 1 where everything is admitted; empty: nowhere
};

struct Cases {
  ValueTable table;  // no textures, no buffers
  std::vector<ExpectedOutput> expected;
  Tolerance tolerance;
};

// Decimals, hex floats and whole numbers are rounded to float once; doubles hold what the file says to one step of a
// double. UserError "origin: ..." for malformed JSON (with its line), unknown keys and types (with the nearest), values
// that do not fit their type, lists of unequal length. Whether names and types are the shader's, Evaluator::run and
// check_expected say.
Cases parse_cases(std::string_view json, const std::string& origin);

// UserError where an expected output is none of `outputs` (name and type alone are looked at) or has another type.
void check_expected(const Cases& cases, const std::vector<Values>& outputs, const std::string& origin);

}  // namespace twinshade

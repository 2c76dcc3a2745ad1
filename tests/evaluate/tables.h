// Tables for tests, written shortly.
#pragma once

#include <string>
#include <vector>

#include "evaluate/evaluator.h"

namespace twinshade::test {

ShaderSource fragment(const std::string& text);  // "test.frag"

// values: all rows, one after the other.
Values floats(const std::string& name, const std::string& type, const std::vector<float>& values);
Values ints(const std::string& name, const std::string& type, const std::vector<std::int64_t>& values);

// cpu as lanes4 and scalar, and the OpenGL backends of this machine; says aloud which are missing.
std::vector<EvaluationTarget> every_target();
std::string name_of(const EvaluationTarget& target);

// "row 3: r.y = 0x1p+0" of every value, to compare and to print.
std::vector<std::string> listing(const EvaluatedRows& rows);

// What an action's exception says; empty: none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace twinshade::test

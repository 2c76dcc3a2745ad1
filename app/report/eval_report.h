// What eval found, for people, as JSON and as results of cases.
#pragma once

#include <string>
#include <vector>

#include "app/output.h"
#include "app/report/case_result.h"
#include "evaluate/cases.h"
#include "evaluate/compare_outputs.h"
#include "evaluate/evaluator.h"

namespace twinshade {

struct EvaluatedBackend {
  std::string name;
  std::string error;  // why it could not run: its driver refuses the shader, say; empty: it ran
  EvaluatedRows rows;
  OutputComparison comparison;
  double seconds = 0;
};

struct EvaluatedCase {
  std::string name;  // of the shader's file, without folder and ending
  std::string file;  // the shader's
  std::string cases_file;
  std::string hash;   // content_hash of the shader; empty where it cannot be read
  std::string error;  // what is wrong with the shader or its cases, one of them missing included; empty: nothing
  Cases cases;
  std::vector<EvaluatedBackend> backends;

  bool has_error() const;
  bool pass() const;
};

// One line a case and backend; where there are many cases, of those alone that did not pass. Then the failures, with
// inputs, in decimal and as hex floats; then a total.
std::string eval_text(const std::vector<EvaluatedCase>& cases, bool many);
Json eval_json(const std::vector<EvaluatedCase>& cases);
std::vector<CaseResult> eval_results(const std::vector<EvaluatedCase>& cases);

}  // namespace twinshade

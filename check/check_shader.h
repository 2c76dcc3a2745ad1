// One shader checked: compiled, translated, linted, run on every backend over generated inputs, compared bit by bit;
// where it differs, the smallest input and the first source line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/compare_rows.h"
#include "check/first_line.h"
#include "check/generate_rows.h"
#include "cpu_shaders/lint/lint.h"
#include "evaluate/evaluator.h"

namespace twinshade {

struct CheckOptions {
  std::vector<EvaluationTarget> on;  // the first is what the others are compared with
  GenerateOptions generate;
  std::string inputs_file;  // side file; empty: SHADER.inputs where there is one
  SourceOptions source;
  bool make_exact = false;
  std::optional<std::uint64_t> ulp;  // largest distance that is still called the same; none: every bit has to be
  bool timing = true;
};

struct BackendCheck {
  EvaluationTarget target;
  std::string not_run;           // empty, or why there is nothing to compare: its driver refuses the shader, say
  RowComparison comparison;      // with the first backend
  double ns_per_invocation = 0;  // 0: not measured
  std::vector<std::pair<std::string, std::string>> provenance = {};  // what the backend says about itself
};

// An input on which two machines differ.
struct Counterexample {
  Backend a = Backend::cpu, b = Backend::egl;
  ValueTable values;  // one row, or the quad that it is in
  std::size_t row = 0;
  RowDifference difference;
  FirstLine first_line;
  bool constant_folding = false;  // gone where the compilers fold no constants
};

enum class Verdict {
  same_bits,
  same_to_ulp,  // within CheckOptions::ulp
  differs,
  refused,  // no valid GLSL, not supported, or its inputs cannot be made; or every other backend refuses it
  not_run,  // no backend to compare with could run
};

struct CheckedShader {
  std::string path;
  Verdict verdict = Verdict::refused;
  std::string message;             // refused, not_run: why; differs: where no input shows it when run alone
  std::vector<std::string> files;  // that it is made of
  std::string hash;                // content_hash of the source that is run; empty: it could not be read
  std::vector<LintFinding>
      findings;  // where it leaves the exact dialect; with make_exact: what could not be made exact
  std::vector<BackendCheck> backends;
  std::uint64_t max_ulp = 0;
  double seconds = 0;  // that the check took, without compilation
  std::optional<Counterexample> counterexample;
};

// Called with each shader's index before it is run.
using CheckProgress = std::function<void(std::size_t index)>;

// All are translated and compiled together, then run one after another. Never throws because of a shader.
std::vector<CheckedShader> check_shaders(Evaluator& evaluator, const std::vector<std::string>& paths,
                                         const CheckOptions& options, const CheckProgress& progress = {});

}  // namespace twinshade

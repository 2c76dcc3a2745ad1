#include "check/half_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/compare_outputs.h"

namespace twinshade {
namespace {

class HalfTrials {
 public:
  HalfTrials(Evaluator& evaluator, ShaderSource shader, Cases cases, const EvaluationTarget& target)
      : evaluator_(evaluator), shader_(std::move(shader)), cases_(std::move(cases)), target_(target) {}

  // What float gives: which rows are kept.
  void run_float(const std::string& cases_file) {
    const EvaluatedRows rows = evaluator_.run(shader_, cases_.table, target_);
    check_expected(cases_, rows.outputs, cases_file);
    const OutputComparison comparison = compare_outputs(cases_, rows);
    if (!comparison.failures.empty())
      throw UserError(cases_file + ": " + std::to_string(comparison.failed_rows) +
                      " rows are beyond the tolerance in float already: see twinshade eval");
    kept_ = rows.kept;
    shader_.precision = Precision::by_line;
    half_.name = kHalfLines;
    const auto& lines = evaluator_.reflection(shader_).half_lines;
    half_.type = {Scalar::u32, 1, 1, std::uint32_t(lines.size())};
    half_.bits.assign(lines.size(), 0);
    for (const auto& [file, line] : lines) found.lines.push_back({with_real_names(shader_.files, file), line});
  }

  void set(std::size_t line, bool half) { half_.bits[line] = half; }

  // Times the tolerance, with the lines that are set.
  double measure() {
    ++runs_;
    if (done) done(runs_, 2 * found.lines.size() + 1);
    ValueTable table = cases_.table;
    table.uniforms.push_back(half_);
    const EvaluatedRows rows = evaluator_.run(shader_, table, target_);
    return rows.kept == kept_ ? compare_outputs(cases_, rows).times_allowed : HUGE_VAL;
  }

  HalfLines found;
  std::function<void(std::size_t, std::size_t)> done;

 private:
  Evaluator& evaluator_;
  ShaderSource shader_;
  const Cases cases_;
  const EvaluationTarget target_;
  std::vector<std::uint8_t> kept_;
  Values half_;
  std::size_t runs_ = 0;
};

bool is_finite(const Values& values, std::size_t row) {
  for (std::uint32_t c = 0; c < values.type.components(); ++c)
    if (!std::isfinite(value_at(values, row, c))) return false;
  return true;
}

}  // namespace

Cases cases_of_float(Evaluator& evaluator, const ShaderSource& shader, const ValueTable& table,
                     const EvaluationTarget& target, const Tolerance& tolerance) {
  const EvaluatedRows rows = evaluator.run(shader, table, target);
  Cases cases{table, {}, tolerance};
  for (const Values& output : rows.outputs) {
    ExpectedOutput expected{output, std::vector<std::uint8_t>(table.rows)};
    for (std::size_t row = 0; row < table.rows; ++row)
      expected.has_value[row] = rows.kept[row] != 0 && is_finite(output, row);
    cases.expected.push_back(std::move(expected));
  }
  return cases;
}

HalfLines find_half_lines(Evaluator& evaluator, ShaderSource shader, Cases cases, const EvaluationTarget& target,
                          const std::string& cases_file, const std::function<void(std::size_t, std::size_t)>& done) {
  const std::string main_file = shader.files.empty() ? "" : shader.files[0];
  const std::size_t rows = cases.table.rows;
  std::size_t left_out = 0;
  for (std::size_t row = 0; row < rows; ++row)
    left_out += std::all_of(cases.expected.begin(), cases.expected.end(),
                            [&](const ExpectedOutput& output) { return output.has_value[row] == 0; });
  HalfTrials trials(evaluator, std::move(shader), std::move(cases), target);
  trials.done = done;
  trials.run_float(cases_file);
  std::vector<HalfLine>& lines = trials.found.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    trials.set(i, true);
    lines[i].alone = trials.measure();
    trials.set(i, false);
  }
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lines[a].alone < lines[b].alone; });
  for (const std::size_t i : order) {
    if (lines[i].alone > 1) break;
    trials.set(i, true);
    const double together = trials.measure();
    lines[i].together = together <= 1;
    if (lines[i].together)
      trials.found.together = together;
    else
      trials.set(i, false);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) trials.set(i, true);
  if (!lines.empty()) trials.found.all = trials.measure();
  trials.found.rows = rows;
  trials.found.left_out = left_out;
  std::stable_sort(lines.begin(), lines.end(), [&](const HalfLine& a, const HalfLine& b) {
    if (a.file != b.file) return a.file == main_file || (b.file != main_file && a.file < b.file);
    return a.line < b.line;
  });
  return std::move(trials.found);
}

}  // namespace twinshade

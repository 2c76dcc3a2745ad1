#include "check/half_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/endless_loop_error.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

class HalfTrials {
 public:
  HalfTrials(Evaluator& evaluator, ShaderSource shader, Cases cases, const EvaluationTarget& target)
      : evaluator_(evaluator), shader_(std::move(shader)), cases_(std::move(cases)), target_(target) {}

  // What float gives: which rows are kept, what is judged.
  void run_float(const std::string& cases_file) {
    const EvaluatedRows rows = evaluator_.run(shader_, cases_.table, target_);
    check_expected(cases_, rows.outputs, cases_file);
    if (const auto failures = compare_outputs(cases_, rows).failures; !failures.empty())
      throw UserError(cases_file + ": row " + std::to_string(failures[0].row) +
                      " is beyond the tolerance in float already: twinshade eval shows it");
    find_unjudged(rows);
    kept_ = rows.kept;
  }

  void switch_by_line() {
    shader_.precision = Precision::by_line;
    half_.name = kHalfLines;
    const auto& lines = evaluator_.reflection(shader_).half_lines;
    half_.type = {Scalar::u32, 1, 1, std::uint32_t(lines.size())};
    half_.bits.assign(lines.size(), 0);
    for (const auto& [file, line] : lines)
      found.lines.push_back({with_real_names(shader_.files, file), line, {}, false});
  }

  HalfResult as_declared() {
    shader_.precision = Precision::mediump;
    return run(cases_.table);
  }

  void set(std::size_t line, bool half) { half_.bits[line] = half; }

  // With the lines that are set.
  HalfResult measure() {
    ++runs_;
    if (done) done(runs_, 2 * found.lines.size() + 1);
    ValueTable table = cases_.table;
    table.uniforms.push_back(half_);
    return run(table);
  }

  HalfLines found;
  std::function<void(std::size_t, std::size_t)> done;

 private:
  HalfResult run(const ValueTable& table) {
    HalfResult result;
    try {
      const EvaluatedRows rows = evaluator_.run(shader_, table, target_);
      const auto [half, full] = std::mismatch(rows.kept.begin(), rows.kept.end(), kept_.begin());
      if (half != rows.kept.end()) {
        result.off = HUGE_VAL;
        result.other = (*half ? "keeps row " : "discards row ") + std::to_string(half - rows.kept.begin());
        return result;
      }
      OutputComparison comparison = compare_outputs(cases_, rows);
      result.off = comparison.times_allowed;
      result.worst = comparison.furthest;
    } catch (const EndlessLoopError&) {
      result.off = HUGE_VAL;
      result.other = "does not end";
    }
    return result;
  }

  bool expects(const ExpectedOutput& output, std::size_t row, std::uint32_t component) const {
    return output.has_value[row] != 0 &&
           (output.left_out.empty() || output.left_out[row * output.values.type.components() + component] == 0);
  }

  void find_unjudged(const EvaluatedRows& rows) {
    found.rows = cases_.table.rows;
    std::vector<bool> judged(found.rows);
    std::size_t components = 0;
    for (const Values& output : rows.outputs) {
      const auto expected = std::find_if(cases_.expected.begin(), cases_.expected.end(),
                                         [&](const ExpectedOutput& e) { return e.values.name == output.name; });
      for (std::uint32_t c = 0; c < output.type.components(); ++c, ++components) {
        bool ever = false;
        for (std::size_t row = 0; expected != cases_.expected.end() && row < found.rows; ++row)
          if (expects(*expected, row, c)) judged[row] = ever = true;
        if (!ever) found.unjudged.push_back(component_name(output.name, output.type, c));
      }
    }
    found.left_out = std::size_t(std::count(judged.begin(), judged.end(), false));
    if (found.unjudged.size() == components)
      throw UserError(
          (shader_.files.empty() ? shader_.name : shader_.files[0]) +
          ": there is no value to judge by: all rows are discarded or not finite in float, the cases expect "
          "nothing, or the shader has no outputs");
  }

  Evaluator& evaluator_;
  ShaderSource shader_;
  const Cases cases_;
  const EvaluationTarget target_;
  std::vector<std::uint8_t> kept_;
  Values half_;
  std::size_t runs_ = 0;
};

}  // namespace

Cases cases_of_float(Evaluator& evaluator, const ShaderSource& shader, const ValueTable& table,
                     const EvaluationTarget& target, const Tolerance& tolerance) {
  const EvaluatedRows rows = evaluator.run(shader, table, target);
  Cases cases{table, {}, tolerance};
  for (const Values& output : rows.outputs) {
    const std::uint32_t components = output.type.components();
    ExpectedOutput expected{output, rows.kept, std::vector<std::uint8_t>(output.bits.size())};
    for (std::size_t at = 0; at < output.bits.size(); ++at)
      expected.left_out[at] = !std::isfinite(value_at(output, at / components, std::uint32_t(at % components)));
    cases.expected.push_back(std::move(expected));
  }
  return cases;
}

HalfLines find_half_lines(Evaluator& evaluator, ShaderSource shader, Cases cases, const EvaluationTarget& target,
                          const std::string& cases_file, const std::function<void(std::size_t, std::size_t)>& done) {
  const std::string main_file = shader.files.empty() ? "" : shader.files[0];
  const bool has_precision = shader.es;
  HalfTrials trials(evaluator, std::move(shader), std::move(cases), target);
  trials.done = done;
  trials.run_float(cases_file);
  if (has_precision) trials.found.declared = trials.as_declared();
  trials.switch_by_line();
  std::vector<HalfLine>& lines = trials.found.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    trials.set(i, true);
    lines[i].alone = trials.measure();
    trials.set(i, false);
  }
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lines[a].alone.off < lines[b].alone.off; });
  for (const std::size_t i : order) {
    if (lines[i].alone.off > 1) break;
    trials.set(i, true);
    HalfResult together = trials.measure();
    lines[i].together = together.off <= 1;
    if (lines[i].together)
      trials.found.together = std::move(together);
    else
      trials.set(i, false);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) trials.set(i, true);
  if (!lines.empty()) trials.found.all = trials.measure();
  std::stable_sort(lines.begin(), lines.end(), [&](const HalfLine& a, const HalfLine& b) {
    if (a.file != b.file) return a.file == main_file || (b.file != main_file && a.file < b.file);
    return a.line < b.line;
  });
  return std::move(trials.found);
}

}  // namespace twinshade

// mediump: which lines of a shader could be computed in 16 bits, as mobile GPUs compute what is mediump.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/table.h"
#include "base/error.h"
#include "base/file.h"
#include "check/generate_rows.h"
#include "check/half_lines.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/translate/source_lines.h"
#include "golden/content_hashes.h"

namespace twinshade {
namespace {

double parse_distance(const std::string& option, const std::string& text) {
  double value = 0;
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stopped != text.data() + text.size() || !std::isfinite(value) || value < 0)
    throw UserError(fmt::format("{} {}: must be a number, 0 or more: 0.002", option, text));
  return value;
}

constexpr std::uint64_t kMostCasesBytes = std::uint64_t{256} << 20;

struct MediumpVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SourceOptions source;
  std::string shader, cases_file, inputs_file;
  Tolerance tolerance{0, 1.0 / 510, 0};
  GenerateOptions generate;

  int run() const {
    apply(common);
    const Output output(common);
    output.require_not_read(files_read());
    const ShaderSource loaded = load_fragment_shader(shader, source);
    Evaluator evaluator;
    const EvaluationTarget target{Backend::cpu, natural_number(machine_isa()), {}};
    const Cases cases = cases_file.empty() ? generated(evaluator, loaded, target)
                                           : parse_cases(read_file(cases_file, kMostCasesBytes), cases_file);
    const HalfLines found =
        find_half_lines(evaluator, loaded, cases, target, cases_file, [&](std::size_t done, std::size_t all) {
          output.progress(fmt::format("trying lines: {} of {} at most", done, all));
        });
    Provenance provenance(common);
    provenance.add_shader(shader, content_hash(loaded));
    output.json(json_of(found, SourceLines(loaded), cases.tolerance, provenance.json()));
    if (!found.lines.empty()) output.text(table_of(found, SourceLines(loaded)) + "\n");
    output.text(summary(found));
    return 0;
  }

 private:
  std::vector<std::string> files_read() const {
    std::vector<std::string> files = files_of_shader(shader, source);
    for (const std::string& file : {cases_file, inputs_file, shader + ".inputs"})
      if (!file.empty()) files.push_back(file);
    return files;
  }

  Cases generated(Evaluator& evaluator, const ShaderSource& loaded, const EvaluationTarget& target) const {
    GenerateOptions options = generate;
    options.seed = common.seed;
    const Reflection& reflection = evaluator.reflection(loaded);
    std::vector<InputRange> ranges = all_ranges(loaded, shader, inputs_file);
    use_block_names(reflection, ranges);
    return cases_of_float(evaluator, loaded, generate_rows(reflection, ranges, options), target, tolerance);
  }

  // Of what is allowed.
  static std::string part(double off) {
    if (!std::isfinite(off)) return "no number";
    return off < 99.5 ? fmt::format("{:.2g}", off) : fmt::format("{:.0f}", off);
  }

  static std::string verdict(const HalfLine& line) {
    return line.together ? "mediump" : line.alone <= 1 ? "by itself" : "highp";
  }

  // Lines of several files say which.
  static std::string table_of(const HalfLines& found, const SourceLines& text) {
    Table table;
    table.column("line", Table::Align::right);
    table.column("may be");
    table.column("alone", Table::Align::right);
    table.column("");
    for (const HalfLine& line : found.lines)
      table.row(
          {line.file == found.lines[0].file ? std::to_string(line.line) : fmt::format("{}:{}", line.file, line.line),
           verdict(line), part(line.alone), text.text(line_name(line.file), line.line)});
    return table.text();
  }

  static std::string summary(const HalfLines& found) {
    if (found.lines.empty()) return "no line computes floats\n";
    std::size_t together = 0, alone = 0;
    for (const HalfLine& line : found.lines) together += line.together, alone += !line.together && line.alone <= 1;
    std::string text =
        fmt::format("{} of {} lines may be mediump at once: the worst value is then {} of what is allowed off",
                    together, found.lines.size(), part(found.together));
    if (together < found.lines.size()) text += fmt::format(", with every line {}", part(found.all));
    text += "\n";
    if (alone > 0) text += fmt::format("{} more by themselves, but not beside these\n", alone);
    if (found.left_out > 0)
      text += fmt::format("{} of {} rows are left out: they are discarded, or float itself gives no finite value\n",
                          found.left_out, found.rows);
    return text;
  }

  static Json number(double off) { return std::isfinite(off) ? Json(off) : Json(nullptr); }

  static Json json_of(const HalfLines& found, const SourceLines& text, const Tolerance& tolerance,
                      const Json& provenance) {
    Json lines = Json::array();
    for (const HalfLine& line : found.lines)
      lines.push_back({{"file", line.file},
                       {"line", line.line},
                       {"may_be", verdict(line)},
                       {"off_alone", number(line.alone)},
                       {"text", text.text(line_name(line.file), line.line)}});
    return {{"provenance", provenance},
            {"rows", found.rows},
            {"left_out", found.left_out},
            {"tolerance", {{"ulp", tolerance.ulp}, {"abs", tolerance.abs}, {"rel", tolerance.rel}}},
            {"off_together", number(found.together)},
            {"off_all", number(found.all)},
            {"lines", lines}};
  }
};

}  // namespace

Verb add_mediump(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mediump", "which lines of a shader may be computed in 16 bits");
  const auto verb = std::make_shared<MediumpVerb>();
  verb->command = command;
  command->add_option("shader", verb->shader, "fragment shader file")->type_name("SHADER")->required();
  CLI::Option* cases =
      command->add_option("--cases", verb->cases_file, "inputs, expected outputs and tolerance (docs/eval.md)")
          ->type_name("F.json");
  const auto add_distance = [&](const char* name, double& value, const char* description) {
    command
        ->add_option_function<std::string>(
            name, [&value, name = std::string(name)](const std::string& text) { value = parse_distance(name, text); },
            description)
        ->type_name("E")
        ->excludes(cases);
  };
  add_distance("--abs", verb->tolerance.abs,
               "how far off an output may be (default: 1/510, half a step of 8 bits; beside --rel, too)");
  add_distance("--rel", verb->tolerance.rel, "... as a part of its value; either is enough (default: 0)");
  add_whole_option(*command, "--rows", "rows of generated inputs (default: 2048)", 1, kMostTableRows,
                   [verb = verb.get()](std::uint64_t rows) { verb->generate.rows = std::size_t(rows); });
  command->get_option("--rows")->excludes(cases);
  command->add_option("--inputs", verb->inputs_file, "ranges of inputs (default: SHADER.inputs, where there is one)")
      ->type_name("FILE")
      ->excludes(cases);
  add_source_options(*command, verb->source);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

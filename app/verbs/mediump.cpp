// mediump: which lines of a shader could be computed in 16 bits, as mobile GPUs compute what is mediump.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/statement_text.h"
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
  const double value = parse_real(option, text);
  if (value < 0) throw UserError(fmt::format("{} {}: must be a number, 0 or more: 0.002", option, text));
  return value;
}

constexpr std::uint64_t kMostCasesBytes = std::uint64_t{256} << 20;

struct MediumpVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SourceOptions source;
  std::string shader, cases_file, inputs_file;
  Tolerance tolerance{0, 1.0 / 510, 0};
  GenerateOptions generate{16384, 1, 64};

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
    output.json(json_of(found, cases, SourceLines(loaded), provenance.json()));
    if (!found.lines.empty()) output.text(table_of(found, cases, SourceLines(loaded)) + "\n");
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
    if (!std::isfinite(off)) return "inf";
    return off < 999.5 ? fmt::format("{:.3g}", off) : fmt::format("{:.0f}", off);
  }

  static std::string worst(const HalfResult& result, const Cases& cases) {
    if (!result.worst) return result.other;
    const Values& output = cases.expected[result.worst->output].values;
    return fmt::format("{} {:.4g}, not {:.4g}", component_name(output.name, output.type, result.worst->component),
                       result.worst->got, result.worst->expected);
  }

  static std::string verdict(const HalfLine& line) {
    return line.together ? "mediump" : line.alone.off <= 1 ? "by itself" : "highp";
  }

  // Lines of several files say which.
  static std::string table_of(const HalfLines& found, const Cases& cases, const SourceLines& text) {
    Table table;
    table.column("line", Table::Align::right);
    table.column("may be");
    table.column("alone", Table::Align::right);
    table.column("worst");
    table.column("");
    for (const HalfLine& line : found.lines)
      table.row(
          {line.file == found.lines[0].file ? std::to_string(line.line) : fmt::format("{}:{}", line.file, line.line),
           verdict(line), part(line.alone.off), worst(line.alone, cases),
           statement_text(text, line_name(line.file), line.line)});
    return table.text();
  }

  std::string summary(const HalfLines& found) const {
    if (found.lines.empty()) return "no line computes floats\n";
    std::size_t together = 0, alone = 0;
    for (const HalfLine& line : found.lines) together += line.together, alone += !line.together && line.alone.off <= 1;
    std::string text =
        fmt::format("{} of {} lines may be mediump at once: the worst value is then {} of what is allowed off",
                    together, found.lines.size(), part(found.together.off));
    if (together < found.lines.size()) text += fmt::format(", with every line {}", part(found.all.off));
    if (found.declared) text += fmt::format(", as its qualifiers have it {}", part(found.declared->off));
    text += "\n";
    if (alone > 0) text += fmt::format("{} more by themselves, but not beside these\n", alone);
    if (!found.unjudged.empty())
      text += fmt::format("not judged, since {} in any row: {}\n",
                          cases_file.empty() ? "float gives no finite value" : "the cases expect nothing of it",
                          fmt::join(found.unjudged, ", "));
    if (found.left_out > 0)
      text += fmt::format("{} of {} rows are left out: {}\n", found.left_out, found.rows,
                          cases_file.empty() ? "they are discarded, or float itself gives no finite value"
                                             : "the cases expect nothing of them");
    return text;
  }

  // With the inputs and uniforms of the worst row.
  static Json result_json(const HalfResult& result, const Cases& cases) {
    Json json{{"off", std::isfinite(result.off) ? Json(result.off) : Json(nullptr)}};
    if (!result.other.empty()) json["other"] = result.other;
    if (!result.worst) return json;
    const OutputDifference& worst = *result.worst;
    const Values& output = cases.expected[worst.output].values;
    json["output"] = component_name(output.name, output.type, worst.component);
    json["row"] = worst.row;
    json["float"] = worst.expected;
    json["half"] = std::isfinite(worst.got) ? Json(worst.got) : Json(nullptr);
    Json values = Json::object();
    for (const auto* list : {&cases.table.inputs, &cases.table.uniforms})
      for (const Values& value : *list) {
        const std::size_t row = value.row_count() == 1 ? 0 : worst.row;
        for (std::uint32_t c = 0; c < value.type.components(); ++c) {
          const double x = value_at(value, row, c);
          values[component_name(value.name, value.type, c)] = std::isfinite(x) ? Json(x) : Json(nullptr);
        }
      }
    json["values"] = values;
    return json;
  }

  static Json json_of(const HalfLines& found, const Cases& cases, const SourceLines& text, const Json& provenance) {
    Json lines = Json::array();
    for (const HalfLine& line : found.lines)
      lines.push_back({{"file", line.file},
                       {"line", line.line},
                       {"may_be", verdict(line)},
                       {"alone", result_json(line.alone, cases)},
                       {"text", statement_text(text, line_name(line.file), line.line)}});
    const Tolerance& tolerance = cases.tolerance;
    return {{"provenance", provenance},
            {"rows", found.rows},
            {"left_out", found.left_out},
            {"not_judged", found.unjudged},
            {"tolerance", {{"ulp", tolerance.ulp}, {"abs", tolerance.abs}, {"rel", tolerance.rel}}},
            {"together", result_json(found.together, cases)},
            {"all", result_json(found.all, cases)},
            {"as_declared", found.declared ? result_json(*found.declared, cases) : Json(nullptr)},
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
  add_whole_option(*command, "--rows", "rows of generated inputs (default: 16384)", 1, kMostTableRows,
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

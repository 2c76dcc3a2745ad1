// eval: shaders over tables of inputs, against the outputs that are expected.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/eval_report.h"
#include "app/report/junit.h"
#include "app/report/reports.h"
#include "base/error.h"
#include "base/file.h"
#include "base/names.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/source/line_names.h"
#include "golden/content_hashes.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMostCasesBytes = std::uint64_t{256} << 20;

// A shader and its cases, both files.
struct CasePaths {
  std::string shader, cases;
  std::string missing = {};  // what to say where one of the two is not there
};

// NAME.frag with NAME.json, by name. UserError for an empty folder, and for one that cannot be read.
std::vector<CasePaths> pairs_in(const std::string& folder) {
  std::vector<CasePaths> pairs;
  std::error_code code;
  for (auto at = fs::directory_iterator(folder, code); !code && at != fs::end(at); at.increment(code)) {
    const fs::path path = at->path();
    const bool shader = path.extension() == ".frag";
    if (!shader && path.extension() != ".json") continue;
    const fs::path partner = fs::path(path).replace_extension(shader ? ".json" : ".frag");
    std::error_code missing;
    const bool paired = fs::exists(fs::symlink_status(partner, missing));  // where a link leads is seen when it is read
    if (paired && !shader) continue;
    pairs.push_back({path.string(), partner.string()});
    if (!paired)
      pairs.back().missing = path.string() + " has no " + partner.filename().string() +
                             " beside it: add it, or move the file to another folder";
    if (!shader) std::swap(pairs.back().shader, pairs.back().cases);
  }
  if (code) throw UserError(folder + ": cannot be read: " + code.message());
  if (pairs.empty()) throw UserError(folder + ": no shaders in it: it needs pairs NAME.frag and NAME.json");
  std::sort(pairs.begin(), pairs.end(), [](const CasePaths& a, const CasePaths& b) { return a.shader < b.shader; });
  return pairs;
}

// "lanes" is what shading has registers for; "double" and "float" are what people call float64 and scalar.
constexpr const char* kEvalNumbers[] = {"lanes4", "lanes8", "lanes16", "lanes",   "scalar",
                                        "float",  "double", "float64", "mediump", "float16"};

// Of names that are not of a precision (parse_precision).
Number number_named(const std::string& name) {
  if (name == "lanes") return natural_number(machine_isa());
  if (name == "double") return Number::float64;
  if (name == "float") return Number::scalar;
  const std::vector<std::string> names(std::begin(kEvalNumbers), std::end(kEvalNumbers));
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UserError(unknown_name_message("number type", name, names));
  return parse_number(name);
}

struct EvalVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  std::string shader, cases_file;
  ReportOptions reports;
  SourceOptions source;
  std::vector<std::string> backends{"cpu", "egl"};
  std::optional<Number> number;  // none: lanes
  Precision precision = Precision::full;
  EvaluatorOptions options;

  int run() const {
    apply(common);
    const Output output(common, reports);
    require_backends(backends);
    require_machine_options(*command, backends);
    const std::vector<EvaluationTarget> targets = named_targets();
    std::error_code code;
    const bool many = fs::is_directory(shader, code);
    if (many && !cases_file.empty())
      throw UserError("--cases: " + shader + " is a folder, whose shaders NAME.frag have their cases in NAME.json");
    if (!many && cases_file.empty()) {
      const bool exists = fs::exists(shader, code);
      if (code) throw UserError(shader + ": cannot be read: " + code.message());
      if (!exists) throw UserError(shader + ": there is no such file or folder");
      throw UserError("--cases is missing: a JSON file with the inputs of " + shader +
                      " and the outputs that are expected");
    }
    if (many) output.require_not_taken(shader, ".json", "cases");
    const std::vector<CasePaths> paths = many ? pairs_in(shader) : std::vector<CasePaths>{{shader, cases_file, ""}};

    output.require_not_read(files_read(paths));

    std::vector<ShaderSource> sources(paths.size());
    std::vector<EvaluatedCase> cases(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      cases[i].name = fs::path(paths[i].shader).stem().string();
      cases[i].file = paths[i].shader;
      cases[i].cases_file = paths[i].cases;
      guarded(cases[i], many, output, [&] {
        if (!paths[i].missing.empty()) throw UserError(paths[i].missing);
        sources[i] = load_fragment_shader(paths[i].shader, source);
        cases[i].hash = content_hash(sources[i]);
        sources[i].precision = precision;
        note_precision(output, sources[i], precision);
        cases[i].cases = parse_cases(read_file(paths[i].cases, kMostCasesBytes), paths[i].cases);
      });
    }
    evaluate(sources, paths, targets, many, cases, output);
    return report(cases, many, output);
  }

  std::vector<std::string> files_read(const std::vector<CasePaths>& paths) const {
    std::vector<std::string> files;
    for (const CasePaths& pair : paths) {
      files.push_back(pair.cases);
      for (std::string& file : files_of_shader(pair.shader, source)) files.push_back(std::move(file));
    }
    return files;
  }

  std::vector<EvaluationTarget> named_targets() const {
    std::vector<EvaluationTarget> targets;
    for (const std::string& name : backends)
      targets.push_back({backend_named(name), number.value_or(natural_number(machine_isa())), {}});
    return targets;
  }

  // What is wrong with one of many shaders is its own result; with the only one it ends the run.
  template <class Action>
  void guarded(EvaluatedCase& c, bool many, const Output& output, Action action) const {
    try {
      action();
    } catch (const std::bad_alloc&) {  // the others would not have memory either
      throw;
    } catch (const std::exception& error) {  // a UserError, or our own mistake
      c.error = error.what();
      c.backends.clear();
      if (many) return;
      write_files({c}, output);
      annotate_failures({c}, output);
      throw;
    }
  }

  void evaluate(const std::vector<ShaderSource>& sources, const std::vector<CasePaths>& paths,
                const std::vector<EvaluationTarget>& targets, bool many, std::vector<EvaluatedCase>& cases,
                const Output& output) const {
    std::vector<ShaderSource> good;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (cases[i].error.empty()) good.push_back(sources[i]);
    Evaluator evaluator(options);
    evaluator.prepare(good, targets, [&](const std::string& stage, std::size_t done, std::size_t all) {
      output.progress(fmt::format("{} shaders: {} of {}", stage, done, all));
    });
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!cases[i].error.empty()) continue;
      output.progress(fmt::format("running shaders: {} of {}", i + 1, cases.size()));
      guarded(cases[i], many, output, [&] {
        std::size_t refused = 0;
        for (const EvaluationTarget& target : targets)
          refused += run_one(evaluator, sources[i], paths[i], target, cases[i]) ? 0 : 1;
        // What every backend refuses is wrong with the shader or its cases, not with a backend.
        if (refused == targets.size()) throw UserError(cases[i].backends[0].error);
      });
    }
  }

  // False where the backend refuses the shader or the table.
  static bool run_one(Evaluator& evaluator, const ShaderSource& source, const CasePaths& paths,
                      const EvaluationTarget& target, EvaluatedCase& c) {
    EvaluatedBackend backend;
    backend.name = backend_name(target.backend);
    bool refused = false;
    const auto start = Clock::now();
    try {
      backend.rows = evaluator.run(source, c.cases.table, target);
      if (target.backend == Backend::cpu && source.precision != Precision::full)
        backend.rows.provenance.emplace_back("precision", precision_names()[source.precision == Precision::half]);
    } catch (const BackendError& error) {
      backend.error = with_real_names(source.files, error.what());
    } catch (const UserError& error) {
      backend.error = with_real_names(source.files, error.what());
      refused = true;
    }
    backend.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (backend.error.empty()) {
      check_expected(c.cases, backend.rows.outputs, paths.cases);
      backend.comparison = compare_outputs(c.cases, backend.rows);
    }
    c.backends.push_back(std::move(backend));
    return !refused;
  }

  void annotate_failures(const std::vector<EvaluatedCase>& cases, const Output& output) const {
    if (!reports.annotate.empty()) output.text(github_annotations(eval_results(cases)));
  }

  void write_files(const std::vector<EvaluatedCase>& cases, const Output& output) const {
    Provenance provenance(common);
    for (const EvaluatedCase& c : cases) {
      if (!c.hash.empty()) provenance.add_shader(c.file, c.hash);
      for (const EvaluatedBackend& backend : c.backends)
        if (backend.error.empty()) provenance.add(backend.name, backend.rows.provenance);
    }
    output.json({{"provenance", provenance.json()}, {"cases", eval_json(cases)}});
    write_reports(output, {"twinshade eval", "", eval_results(cases), provenance.json()});
  }

  int report(const std::vector<EvaluatedCase>& cases, bool many, const Output& output) const {
    write_files(cases, output);
    output.text(eval_text(cases, many));
    annotate_failures(cases, output);
    const auto has_error = [](const EvaluatedCase& c) { return c.has_error(); };
    if (std::any_of(cases.begin(), cases.end(), has_error)) return 2;
    return std::all_of(cases.begin(), cases.end(), [](const EvaluatedCase& c) { return c.pass(); }) ? 0 : 1;
  }
};

}  // namespace

Verb add_eval(CLI::App& app) {
  CLI::App* command = app.add_subcommand("eval", "shaders over tables of inputs, against expected outputs");
  const auto verb = std::make_shared<EvalVerb>();
  verb->command = command;
  command->add_option("shader", verb->shader, "fragment shader, or a folder of NAME.frag and NAME.json")
      ->type_name("SHADER or DIR")
      ->required();
  command->add_option("--cases", verb->cases_file, "inputs and expected outputs of the shader (docs/eval.md)")
      ->type_name("F.json");
  command->add_option("--on", verb->backends, "backends of cpu, egl, osmesa, softpipe, gpu (default: cpu,egl)")
      ->delimiter(',')
      ->type_name("A,B,...");
  command
      ->add_option_function<std::string>(
          "--number",
          [verb = verb.get()](const std::string& name) {
            if (const std::optional<Precision> emulated = parse_precision(name))
              verb->precision = *emulated;
            else
              verb->number = number_named(name);
          },
          "number type of the CPU (default: lanes, as many as registers hold)")
      ->type_name(fmt::format("{}", fmt::join(kEvalNumbers, "|")));
  add_source_options(*command, verb->source);
  add_report_options(*command, verb->reports);
  add_fma_option(*command, verb->options.host_fma);
  add_time_limit_option(*command, verb->options.time_limit_seconds);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

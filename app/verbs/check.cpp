// check: anyone's GLSL on every machine, over generated inputs.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/check_report.h"
#include "app/report/junit.h"
#include "app/report/reports.h"
#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/machine.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostUlp = UINT32_MAX;  // there are no more floats

struct CheckVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  CpuOptions cpu;
  CheckOptions options;
  EvaluatorOptions evaluator_options;
  std::vector<std::string> shaders;
  std::vector<std::string> on{"cpu", "egl", "osmesa", "softpipe"};
  CLI::Option* on_given = nullptr;
  ReportOptions reports;
  bool watch = false, no_timing = false;

  int run() {
    apply(common);
    const Output output(common, reports);
    require_backends(on);
    require_machine_options(*command, on);
    if (on.size() < 2) throw UserError("--on " + on[0] + ": name at least two backends to compare");
    options.on.clear();
    for (const std::string& name : on) {
      EvaluationTarget target;
      target.backend = backend_named(name);
      target.number = cpu.number.value_or(natural_number(cpu.isa.value_or(machine_isa())));
      target.isa = cpu.isa;
      if (target.number == Number::float64) throw UserError("--number float64: doubles are never the bits of floats");
      options.on.push_back(target);
    }
    options.generate.seed = common.seed;
    options.timing = !no_timing;
    evaluator_options.written_out = options.make_exact;
    output.require_not_read(files_read());
    const int code = once(output, shaders);
    return watch ? watch_forever(output) : code;
  }

  std::vector<std::string> files_read() const {
    std::vector<std::string> files;
    if (!options.inputs_file.empty()) files.push_back(options.inputs_file);
    for (const std::string& shader : shaders) {
      files.push_back(shader + ".inputs");
      for (std::string& file : files_of_shader(shader, options.source)) files.push_back(std::move(file));
    }
    return files;
  }

  int once(const Output& output, const std::vector<std::string>& paths) {
    if (watch)  // before they are read: what is saved while the check runs is another change
      for (const std::string& file : files_read()) remember(file);
    Evaluator evaluator(evaluator_options);
    const std::vector<CheckedShader> results = check_shaders(evaluator, paths, options, [&](std::size_t index) {
      output.progress(fmt::format("{} ({} of {})", paths[index], index + 1, paths.size()));
    });
    Json list = Json::array();
    std::vector<CaseResult> cases;
    Provenance provenance(common);
    for (const CheckedShader& shader : results) {
      if (!shader.hash.empty()) provenance.add_shader(shader.path, shader.hash);
      for (const BackendCheck& check : shader.backends)
        if (check.not_run.empty()) provenance.add(backend_name(check.target.backend), check.provenance);
      list.push_back(check_json(shader, options.make_exact));
      cases.push_back(check_result(shader, options.make_exact));
    }
    output.json({{"provenance", provenance.json()},
                 {"rows", options.generate.rows},
                 {"make_exact", options.make_exact},
                 {"shaders", list}});
    write_reports(output, {"twinshade check", "", cases, provenance.json()});
    output.text(check_table(results));
    for (const CheckedShader& shader : results)
      if (const std::string text = describe_check(shader, options.make_exact); !text.empty()) output.text("\n" + text);
    if (!reports.annotate.empty()) output.text(github_annotations(cases));
    return exit_code(results);
  }

  int exit_code(const std::vector<CheckedShader>& results) const {
    int code = 0;
    for (const CheckedShader& shader : results) {
      if (shader.verdict == Verdict::refused || shader.verdict == Verdict::not_run) code = 2;
      if (shader.verdict == Verdict::differs) code = std::max(code, 1);
      for (const BackendCheck& check : shader.backends)
        if (!check.not_run.empty() && on_given->count() > 0) code = 2;  // asked for by name
    }
    return code;
  }

  // A file that does not exist yet, too: it may come to be.
  void remember(const std::string& file) {
    std::error_code code;
    times_[file] = fs::last_write_time(file, code);
  }

  // Until it is interrupted. Files that are gone for a moment, as editors write them, are waited for.
  int watch_forever(const Output& output) {
    for (;;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      bool changed = false;
      for (const auto& [file, time] : times_) {
        std::error_code code;
        const fs::file_time_type now = fs::last_write_time(file, code);
        changed |= !code && now != time;
      }
      if (!changed) continue;
      output.text("\n");
      times_.clear();
      once(output, shaders);
    }
  }

  std::map<std::string, fs::file_time_type> times_;
};

}  // namespace

Verb add_check(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("check", "your GLSL on every machine over generated inputs, compared bit by bit");
  const auto verb = std::make_shared<CheckVerb>();
  verb->command = command;
  command->add_option("shaders", verb->shaders, "fragment shader files")->type_name("SHADER...")->required();
  verb->on_given = command
                       ->add_option("--on", verb->on,
                                    "backends; the first is what the others are compared with (default: all that work)")
                       ->delimiter(',')
                       ->type_name("B,...");
  add_whole_option(*command, "--rows", "rows of generated inputs (default: 2048)", 1, kMostTableRows,
                   [verb = verb.get()](std::uint64_t rows) { verb->options.generate.rows = std::size_t(rows); });
  command
      ->add_option("--inputs", verb->options.inputs_file,
                   "ranges of inputs (default: SHADER.inputs, where there is one)")
      ->type_name("FILE");
  add_source_options(*command, verb->options.source);
  command->add_flag("--make-exact", verb->options.make_exact, "compare the shader brought into the exact dialect");
  add_whole_option(*command, "--ulp",
                   "largest distance that is called the same, +0 and -0 being 0 apart (default: every bit has to be)",
                   0, kMostUlp, [verb = verb.get()](std::uint64_t ulp) { verb->options.ulp = ulp; });
  add_report_options(*command, verb->reports);
  command->add_flag("--no-timing", verb->no_timing, "do not measure nanoseconds");
  command->add_flag("--watch", verb->watch, "check again whenever a file is saved");
  add_number_options(*command, verb->cpu);
  add_fma_option(*command, verb->evaluator_options.host_fma);
  add_time_limit_option(*command, verb->evaluator_options.time_limit_seconds);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

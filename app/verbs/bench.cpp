// bench: what a frame costs, ours against llvmpipe's in the same run.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "app/bench/report.h"
#include "app/bench/scaling.h"
#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/rows_output.h"
#include "app/subject.h"
#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/machine.h"
#include "lighting/driver_source.h"
#include "scenes/model_file.h"

namespace twinshade {
namespace {

using namespace bench;

// What --scaling decides itself, and what only techniques other than bases have.
constexpr const char* kNotWithScaling[] = {"--attributes",
                                           "--light",
                                           "--map",
                                           "--shader",
                                           "--map-width",
                                           "--order",
                                           "--pca-metric",
                                           "--visibility-rays",
                                           "--visibility-storage",
                                           "--visibility-packing"};

// What only some axes of --scaling read: the others draw a square of their own, sizes of their own, techniques of their
// own. All else is read by all.
struct ReadByAxes {
  const char* option;
  std::vector<std::string> axes;
};
const std::vector<ReadByAxes> kReadByAxes{{"scene", {"pixels", "threads", "coefficients"}},
                                          {"--triangles", {"pixels", "threads", "coefficients"}},
                                          {"--camera", {"pixels", "threads", "coefficients"}},
                                          {"--albedo", {"pixels", "threads", "coefficients"}},
                                          {"--normal-map", {"pixels", "threads", "coefficients"}},
                                          {"--size", {"threads", "coefficients"}},
                                          {"--volume", {"coefficients"}},
                                          {"--probe-rays", {"coefficients"}},
                                          {"--technique", {"pixels", "triangles", "overdraw", "threads"}}};

struct BenchVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  int rounds = 5, repeat = 3;
  bool host_fma = true;
  std::vector<AttributeMode> attributes{AttributeMode::exact, AttributeMode::native};
  std::vector<std::string> axes;  // of scaling; none: every technique is timed
  std::string folder;

  int run() const;

 private:
  std::vector<std::string> files_written() const;  // into the folder
  // The rows measured so far, into `name` in the folder and to where --json says, before what comes next is measured.
  void write_so_far(const Output& output, const std::string& name, const std::string& csv, const Json& json) const;
  void require_meaning_with_scaling() const;
  int time_techniques(const Output& output) const;
  int time_scaling(const Output& output) const;
};

// As OpenGL is timed with it: techniques with the driver's own filter, a user's shader as it is.
ShaderSource source_for_driver(const Shading& shading) {
  if (shading.light.empty()) return shading.source;
  const SphereMapInfo& map = shading.map.empty() ? sphere_maps().front() : find_sphere_map(shading.map);
  for (const CoefficientStorage storage :
       {CoefficientStorage::lightmap, CoefficientStorage::vertex, CoefficientStorage::volume})
    if (shading.light == storage_name(storage)) return driver_source(find_technique(shading.technique), storage, map);
  return shading.source;
}

int BenchVerb::run() const {
  apply(common);
  Output output(common, {}, folder);
  if (cpu.isa) require_isa(*cpu.isa);
  require_processor_for_each_thread();
  if (!folder.empty()) output.claim(files_written());
  output.require_not_read(files_read(subject, shading));
  if (!folder.empty()) {
    require_writable_folder(folder);
    if (std::filesystem::is_directory(folder))
      for (const std::string& name : files_written()) require_writable_file(output.claimed(name));
  }
  return axes.empty() ? time_techniques(output) : time_scaling(output);
}

std::vector<std::string> BenchVerb::files_written() const {
  std::vector<std::string> names{axes.empty() ? "bench.csv" : "scaling.csv"};
  for (const std::string& picture : axes.empty() ? Report::picture_names() : scaling_pictures(axes))
    for (const std::string& name : picture_files(picture)) names.push_back(name);
  return names;
}

void BenchVerb::write_so_far(const Output& output, const std::string& name, const std::string& csv,
                             const Json& json) const {
  if (!folder.empty()) {
    make_folder(folder);
    if (const std::string path = output.claimed(name); is_replaced_by_writing(path)) write_file(path, csv);
  }
  output.json_so_far(json);
}

void BenchVerb::require_meaning_with_scaling() const {
  for (const char* option : kNotWithScaling)
    if (command->get_option(option)->count() > 0)
      throw UserError(
          fmt::format("{} has no meaning with --scaling, which draws a basis with exact attributes from the "
                      "lightmaps and volumes of its axes: leave it out",
                      option));
  require_axes(axes);
  for (const ReadByAxes& read : kReadByAxes)
    if (command->get_option(read.option)->count() > 0 &&
        std::none_of(read.axes.begin(), read.axes.end(), [&](const std::string& axis) { return has_axis(axes, axis); }))
      throw UserError(fmt::format(
          "{} has no meaning with --scaling {}: of the axes {} it; leave it out",
          read.option == std::string("scene") ? subject.scene : read.option, fmt::join(axes, ","),
          read.axes.size() == 1 ? read.axes[0] + " alone reads" : fmt::format("{} read", fmt::join(read.axes, ", "))));
}

int BenchVerb::time_scaling(const Output& output) const {
  require_meaning_with_scaling();
  std::error_code code;
  if (std::filesystem::is_regular_file(subject.scene, code) && model_file_ending(subject.scene).empty())
    throw UserError(subject.scene +
                    ": --scaling bakes what it draws: name a built-in scene or a model (.gltf, .glb or "
                    ".obj), not a bundle");
  ScalingOptions options;
  options.axes = axes;
  options.subject = subject;
  options.cpu = cpu;
  options.host_fma = host_fma;
  options.rounds = Rounds{rounds, repeat};
  if (command->get_option("--technique")->count() > 0) {
    if (shading.techniques.size() != 1 || shading.techniques.front() == "all")
      throw UserError("--scaling draws with one technique: name one by --technique");
    options.technique = shading.techniques.front();
  }
  Provenance provenance(common);
  options.rounds.drawn = [&](const Way& way, const Frame& frame) { provenance.add(way.machine(), frame); };
  const auto json = [&](const Rows& rows, const std::vector<std::string>& notes, bool complete) -> Json {
    return {{"provenance", provenance.json()}, {"complete", complete}, {"rows", json_rows(rows)}, {"notes", notes}};
  };
  options.measured = [&](const Rows& rows, const std::vector<std::string>& notes) {
    write_so_far(output, "scaling.csv", rows.csv(), json(rows, notes, false));
  };
  const ScalingResult result = run_scaling(options, common, output);
  output.text(table_text(result.rows));
  for (const std::string& note : result.notes) output.note(note);
  if (!folder.empty()) {
    make_folder(folder);
    write_file(output.claimed("scaling.csv"), result.rows.csv());
    write_pictures(folder, result.pictures, output);
  }
  output.json(json(result.rows, result.notes, true));
  return result.failed ? 2 : 0;
}

int BenchVerb::time_techniques(const Output& output) const {
  Provenance provenance(common);
  const Subject subject_ready = load_subject(subject, shading, common, output);
  provenance.add(subject_ready);

  const std::vector<Way> ways = all_ways(cpu, attributes, host_fma);
  const std::vector<Shading> shadings = load_shadings(shading, subject_ready);
  std::vector<std::vector<Way>> ways_of;  // each shading
  std::set<Isa> isas;                     // that run
  for (const Shading& shader : shadings) {
    ways_of.push_back(distinct_ways(ways, shader.source, cpu.isa));
    for (const Way& way : ways_of.back())
      if (way.is_cpu()) isas.insert(*way.cpu.isa);
  }
  output.progress("measuring the machine's limits");
  std::vector<Limits> limits;
  for (const Isa isa : isas) limits.push_back(measure_limits(isa));
  Report report(limits);
  const auto json = [&](bool complete) -> Json {
    return {{"provenance", provenance.json()},
            {"complete", complete},
            {"limits", report.limits_json()},
            {"rows", report.rows_json()},
            {"summary", report.summary_json()}};
  };
  std::string skipped;
  for (const auto& [technique, reason] : subject_ready.skipped)
    skipped += fmt::format("skipped {}: {}\n", technique, reason);
  for (std::size_t i = 0; i < shadings.size(); ++i) {
    const Shading& shader = shadings[i];
    Rounds turns{rounds, repeat};
    turns.progress = [&](int round) {
      output.progress(fmt::format("{}: round {} of {}", shader.label(), round + 1, rounds));
    };
    turns.drawn = [&](const Way& way, const Frame& frame) { provenance.add(way.machine(), frame); };
    try {
      provenance.add(shader);
      report.add(shader, shader_cost(shader.source),
                 race(ways_of[i], subject_ready.bundle, shader.source, source_for_driver(shader), turns));
    } catch (const UserError& error) {
      if (!wants_all(shading)) throw;
      skipped += fmt::format("skipped {}: {}\n", shader.label(), error.what());
      continue;
    }
    write_so_far(output, "bench.csv", report.csv(), json(false));
  }
  output.text(report.text() + skipped);
  if (!folder.empty()) {
    make_folder(folder);
    write_file(output.claimed("bench.csv"), report.csv());
    write_pictures(folder, report.pictures(), output);
  }
  output.json(json(true));
  return report.failed() ? 2 : 0;
}

}  // namespace

Verb add_bench(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bench", "what a frame costs, ours against llvmpipe's in the same run");
  const auto verb = std::make_shared<BenchVerb>();
  verb->command = command;
  add_subject_options(*command, verb->subject);
  add_shading_options(*command, verb->shading, "all");
  add_count_option(*command, "--rounds", verb->rounds, "rounds in which every machine takes its turn");
  add_count_option(*command, "--repeat", verb->repeat, "frames of a turn, whose median counts");
  add_attribute_modes_option(*command, verb->attributes);
  command
      ->add_option(
          "--scaling", verb->axes,
          "cost against pixels, triangles, overdraw, threads, coefficients, or all, of one technique (default: sh3)")
      ->delimiter(',')
      ->type_name("AXIS,...");
  command
      ->add_option(
          "-o,--output", verb->folder,
          "write bench.csv, bench.svg, bench.png and the stages into this folder; with --scaling, scaling.csv "
          "and a chart of each axis. The CSV, and --json's file, are written anew after each technique or point "
          "measured: a run that is stopped leaves what it had")
      ->type_name("DIR");
  add_cpu_options(*command, verb->cpu, "each that there is; with --scaling the best");
  add_fma_option(*command, verb->host_fma);
  add_common_options(*command, verb->common);
  require_one_shader(*command);
  require_second_environment(*command);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

// experiment: what a basis or map costs in accuracy, as table, CSV, JSON and pictures.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/rows_output.h"
#include "app/subject.h"
#include "base/error.h"
#include "base/file.h"
#include "experiments/experiment.h"
#include "scenes/environment.h"

namespace twinshade {
namespace {

struct ExperimentVerb {
  CommonOptions common;
  ExperimentOptions options;
  std::string name, folder;
  bool csv = false;
  std::vector<const CLI::Option*> choosing;  // options that not every experiment takes

  int run();
  void require_taken(const ExperimentInfo& experiment) const;
  std::vector<std::string> files_written(const ExperimentInfo& experiment) const;
};

void ExperimentVerb::require_taken(const ExperimentInfo& experiment) const {
  if (!options.probes.empty() && !experiment.takes_probes)
    throw UserError("experiment " + name + " takes no probe, but '" + options.probes.front() + "' is given");
  std::string taken;
  for (const std::string_view option : experiment.options)
    if (!option.empty()) taken += (taken.empty() ? "" : ", ") + std::string(option);
  for (const CLI::Option* option : choosing)
    if (option->count() > 0 && std::find(experiment.options.begin(), experiment.options.end(),
                                         "--" + option->get_lnames().front()) == experiment.options.end())
      throw UserError(fmt::format("experiment {} takes no --{}: leave it out; of such options it takes {}", name,
                                  option->get_lnames().front(), taken));
}

std::vector<std::string> ExperimentVerb::files_written(const ExperimentInfo& experiment) const {
  std::vector<std::string> files{name + ".csv"};
  for (const std::string& picture : experiment.pictures(options))
    for (std::string& file : picture_files(picture)) files.push_back(std::move(file));
  return files;
}

int ExperimentVerb::run() {
  const ExperimentInfo& experiment = find_experiment(name);
  require_taken(experiment);
  apply(common);
  Output output(common, {}, folder);
  if (!folder.empty()) output.claim(files_written(experiment));
  output.require_not_read(files_among(options.probes, environment_names()));
  if (!folder.empty()) require_writable_folder(folder);
  options.seed = common.seed;
  options.pictures = !folder.empty();
  if (!options.on.empty()) require_backends(options.on);
  if (options.driver_filters && options.on.empty())
    throw UserError("--driver-filters: name the machines that read with --on, as --on cpu,egl");
  Provenance provenance(common);
  Machines machines(CpuOptions(), true);
  options.draw = [&](const std::string& machine, const Bundle& bundle, const ShaderSource& source) {
    DrawOptions with_attributes;
    with_attributes.capture_attributes = true;
    const Frame covered =  // by the cpu, for softpipe to shade
        machine == "softpipe" ? machines.draw("cpu", bundle, source, with_attributes) : Frame();
    Frame frame = machines.draw(machine, bundle, source, DrawOptions(), &covered);
    provenance.add(machine, frame);
    return frame;
  };
  options.progress = [&](const std::string& line) { output.progress(name + ": " + line); };
  const ExperimentResult result = experiment.run(options);

  output.text(csv ? result.rows.csv() : table_text(result.rows));
  for (const std::string& note : result.notes) output.note(note);
  if (!folder.empty()) {
    make_folder(folder);
    write_file(output.claimed(name + ".csv"), result.rows.csv());
    for (const Picture& picture : result.pictures)
      for (const std::string& file : picture_files(picture.name)) output.claimed(file);  // ends what claimed too little
    write_pictures(folder, result.pictures, output);
  }
  output.json({{"experiment", name},
               {"provenance", provenance.json()},
               {"rows", json_rows(result.rows)},
               {"notes", result.notes}});
  return 0;
}

}  // namespace

Verb add_experiment(CLI::App& app) {
  CLI::App* command = app.add_subcommand("experiment", "how far off bases and maps are: table, CSV, chart");
  const auto verb = std::make_shared<ExperimentVerb>();
  std::string names;
  for (const ExperimentInfo& experiment : experiments())
    names += fmt::format("\n  {}: {}", experiment.name, experiment.description);
  command->add_option("name", verb->name, "which one:" + names)->required()->type_name("NAME");
  command
      ->add_option("probe", verb->options.probes,
                   "environments or lat-long .hdr/.exr files to measure on (default: the built-in ones)")
      ->type_name("PROBE");
  command->add_option("--basis,--technique", verb->options.bases, "only these bases")
      ->delimiter(',')
      ->type_name("B,...");
  command->add_option("--map", verb->options.maps, "only these sphere maps")->delimiter(',')->type_name("M,...");
  command->add_option("--map-width", verb->options.widths, "only these widths")->delimiter(',')->type_name("W,...");
  command->add_option("--order", verb->options.orders, "only these orders of spherical harmonics")
      ->delimiter(',')
      ->type_name("N,...");
  command
      ->add_option("--on", verb->options.on,
                   "sphere-map-mse: read the maps on these machines, by the shader itself, and compare the bits")
      ->delimiter(',')
      ->type_name("M,...");
  command->add_flag("--driver-filters", verb->options.driver_filters,
                    "with --on: read the maps by the drivers' own filters as well, cubes with seams and without");
  add_whole_option(*command, "--samples", "random signals or points (default: as many as the published figures need)",
                   1, 100000000, [verb = verb.get()](std::uint64_t samples) { verb->options.samples = int(samples); });
  command->add_flag("--relative", verb->options.relative, "errors relative to the signal as well");
  command->add_flag("--clamp-radiance", verb->options.clamp_radiance,
                    "accept probes with NaN, infinite, negative or too large (1e30) radiance");
  for (const char* option : {"--basis", "--map", "--map-width", "--order", "--on", "--driver-filters", "--samples",
                             "--relative", "--clamp-radiance"})
    verb->choosing.push_back(command->get_option(option));
  command->add_flag("--csv", verb->csv, "print comma-separated values instead of a table");
  command
      ->add_option("-o,--output", verb->folder,
                   "write NAME.csv, NAME.svg, NAME.png and further pictures into this folder")
      ->type_name("DIR");
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

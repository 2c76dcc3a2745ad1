// frontier: accuracy against speed. What shading by each technique costs, and how far its frame is off what rays find.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/candidate.h"
#include "app/frame_truth.h"
#include "app/machines.h"
#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/rows_output.h"
#include "app/report/table.h"
#include "base/file.h"
#include "cpu_shaders/machine.h"
#include "experiments/chart.h"
#include "experiments/pareto.h"
#include "experiments/reference_frame.h"

namespace twinshade {
namespace {

struct Compared : Candidate {
  const Bundle* bundle;
  double arithmetic = std::nan("");  // of float, over the frame shaded in double

  int stored() const { return technique ? technique->count * (bounced() ? 3 : 1) : 0; }  // 0: not known
};

struct FrontierVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  TruthOptions truth;
  Turns turns;
  bool arithmetic = false;
  std::string folder;

  int run() const;

 private:
  static std::vector<std::string> files_written();
  // --shader is drawn beside techniques, not instead of them.
  ShadingOptions techniques() const {
    ShadingOptions options = shading;
    options.shader.clear();
    return options;
  }
  void measure(std::vector<Compared>& list, const Truths& truths, const Output& output, Provenance& provenance) const;
  double arithmetic_error(const Compared& candidate, const Frame& frame, const Truth& at) const;
};

std::vector<std::string> FrontierVerb::files_written() {
  std::vector<std::string> names{"frontier.csv"};
  for (const char* picture : {"frontier", "frontier-storage"})
    for (const std::string& name : picture_files(picture)) names.push_back(name);
  return names;
}

double FrontierVerb::arithmetic_error(const Compared& candidate, const Frame& frame, const Truth& at) const {
  CpuOptions exact = cpu;
  exact.isa.reset();
  exact.number = Number::float64;
  const Frame shaded = Machines(exact, true).draw("cpu", *candidate.bundle, candidate.shading.source, DrawOptions());
  Truth in_double;
  in_double.pixels = at.pixels;
  for (const std::size_t pixel : at.pixels)
    for (auto& estimate : in_double.radiance)
      estimate.push_back({shaded.color[pixel * 4], shaded.color[pixel * 4 + 1], shaded.color[pixel * 4 + 2]});
  return frame_error(frame, in_double).rms;
}

void FrontierVerb::measure(std::vector<Compared>& list, const Truths& truths, const Output& output,
                           Provenance& provenance) const {
  std::vector<Candidate*> candidates;
  for (Compared& compared : list) {
    candidates.push_back(&compared);
    provenance.add(compared.shading);
  }
  Turns measured = turns;
  measured.bundle = [&](std::size_t i) -> const Bundle& { return *list[i].bundle; };
  measured.drawn = [&](std::size_t i, int round, const Frame& frame) {
    if (round > 0) return;
    Compared& compared = list[i];
    provenance.add(compared.timing.way.machine(), frame);
    const Truth& at = compared.technique ? truths.of(*compared.technique) : truths.bounced;
    compared.error = frame_error(frame, at);
    if (!arithmetic) return;
    output.progress(compared.shading.label() + " in double");
    compared.arithmetic = arithmetic_error(compared, frame, at);
  };
  take_turns(candidates, measured, cpu, output);
}

// What is compared: the lowest error for what it costs, and for what it stores.
struct Frontiers {
  std::vector<std::size_t> speed, storage;
};

Frontiers frontiers(const std::vector<Compared>& list) {
  std::vector<double> shade, stored, error;
  for (const Compared& candidate : list) {
    shade.push_back(candidate.shade_ns());
    stored.push_back(candidate.stored() > 0 ? candidate.stored() : std::nan(""));
    error.push_back(candidate.error.rms);
  }
  return {pareto_frontier(shade, error), pareto_frontier(stored, error)};
}

bool contains(const std::vector<std::size_t>& list, std::size_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

Rows rows_of(const std::vector<Compared>& list, const Frontiers& best) {
  Rows rows({"technique", "light", "map", "truth", "stored", "ms", "ms_q1", "ms_q3", "ns_per_pixel",
             "shade_ns_per_pixel", "error", "bias", "worst", "arithmetic_error", "on_frontier", "on_storage_frontier"});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Compared& candidate = list[i];
    const Quartiles ms = quartiles(candidate.timing.milliseconds);
    const Shading& shader = candidate.shading;
    rows.add({Cell(shader.technique), shader.light.empty() ? Cell() : Cell(shader.light),
              shader.map.empty() ? Cell() : Cell(shader.map),
              Cell(std::string(candidate.bounced() ? "bounced" : "direct")),
              candidate.stored() > 0 ? Cell(std::int64_t(candidate.stored())) : Cell(), Cell(ms.median), Cell(ms.q1),
              Cell(ms.q3), Cell(candidate.timing.ns_per_pixel()), Cell(candidate.shade_ns()),
              number_cell(candidate.error.rms), number_cell(candidate.error.bias), number_cell(candidate.error.worst),
              number_cell(candidate.arithmetic), Cell(std::int64_t(contains(best.speed, i))),
              Cell(std::int64_t(contains(best.storage, i)))});
  }
  return rows;
}

std::string percent(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", 100 * value) : "-"; }

// Fastest first.
std::string table_of(const std::vector<Compared>& list, const Frontiers& best, bool arithmetic) {
  Table table;
  for (const char* heading : {"technique", "light", "map", "frontier"}) table.column(heading);
  for (const char* heading : {"shade ns", "frame ns", "ms", "stored", "error %", "bias %", "worst %"})
    table.column(heading, Table::Align::right);
  if (arithmetic) table.column("float error", Table::Align::right);
  std::vector<std::size_t> order(list.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return list[a].shade_ns() < list[b].shade_ns(); });
  for (const std::size_t i : order) {
    const Compared& candidate = list[i];
    const bool speed = contains(best.speed, i), storage = contains(best.storage, i);
    std::vector<std::string> cells{candidate.shading.technique,
                                   candidate.technique ? candidate.shading.light : "-",
                                   candidate.shading.map.empty() ? "-" : candidate.shading.map,
                                   speed && storage ? "speed, storage"
                                   : speed          ? "speed"
                                   : storage        ? "storage"
                                                    : "",
                                   fmt::format("{:.2f}", candidate.shade_ns()),
                                   fmt::format("{:.2f}", candidate.timing.ns_per_pixel()),
                                   fmt::format("{:.2f}", candidate.timing.median()),
                                   candidate.stored() > 0 ? std::to_string(candidate.stored()) : "-",
                                   percent(candidate.error.rms),
                                   percent(candidate.error.bias),
                                   percent(candidate.error.worst)};
    if (arithmetic)
      cells.push_back(std::isfinite(candidate.arithmetic) ? fmt::format("{:.1e}", candidate.arithmetic) : "-");
    table.row(std::move(cells));
  }
  return table.text();
}

std::vector<Picture> pictures_of(const std::vector<Compared>& list, const Frontiers& best, const std::string& what) {
  ScatterChart speed;
  speed.title = "Accuracy against speed";
  speed.subtitle = what;
  speed.x = {"shading, ns a pixel", true, {}, {}, {}, false};
  speed.y = {"error: RMS of the difference to traced light, % of its RMS", true, {}, {}, {}, false};
  speed.line = "frontier: nothing is both faster and closer";
  speed.on_line = best.speed;
  ScatterChart storage = speed;
  storage.title = "Accuracy against storage";
  storage.x.title = "numbers stored a texel, vertex or probe";
  storage.line = "frontier: nothing is both smaller and closer";
  storage.on_line = best.storage;
  std::vector<std::string> groups;
  bool several_maps = false;
  std::string map;
  for (const Compared& candidate : list) {
    several_maps = several_maps || (!map.empty() && !candidate.shading.map.empty() && map != candidate.shading.map);
    if (!candidate.shading.map.empty()) map = candidate.shading.map;
  }
  for (const Compared& candidate : list) {
    const std::string group = !candidate.technique  ? "own shader"
                              : candidate.bounced() ? candidate.shading.light
                                                    : "visibility, " + candidate.shading.light;
    const std::size_t place = std::size_t(std::find(groups.begin(), groups.end(), group) - groups.begin());
    if (place == groups.size()) groups.push_back(group);
    std::string name = candidate.technique ? candidate.shading.technique
                                           : std::filesystem::path(candidate.shading.technique).filename().string();
    if (several_maps && !candidate.shading.map.empty()) name += " " + candidate.shading.map;
    const double error = 100 * candidate.error.rms;
    speed.points.push_back({name, candidate.shade_ns(), error, place});
    storage.points.push_back({name, candidate.stored() > 0 ? double(candidate.stored()) : std::nan(""), error, place});
  }
  speed.groups = storage.groups = groups;
  return {{"frontier", draw(speed)}, {"frontier-storage", draw(storage)}};
}

int FrontierVerb::run() const {
  apply(common);
  Output output(common, {}, folder);
  if (cpu.isa) require_isa(*cpu.isa);
  bench::require_processor_for_each_thread();
  if (!folder.empty()) output.claim(files_written());
  output.require_not_read(files_read(subject, shading));
  if (!folder.empty()) require_writable_folder(folder);
  require_traceable(subject.scene, "frontier");
  require_known(shading);
  if (!shading.shader.empty()) {
    require_known(techniques());
    Machines(cpu, true).outputs(load_fragment_shader(shading.shader, shading.source));  // wrong GLSL: before any light
  }

  Provenance provenance(common);
  const LitScene lit = load_lit_scene(subject, output);
  require_world_surfaces(lit.scene);
  std::string skipped;
  for (const LitTechnique& at : plan_subject(lit, subject, techniques()).drawn)
    shows_light(*at.technique, techniques(), skipped);
  const VisiblePoints visible = visible_points(lit, subject, cpu, output);
  Subject own;
  if (!shading.shader.empty()) own = light_subject(lit, subject, shading, common, output);
  Subject ready = light_subject(lit, subject, techniques(), common, output);
  ready.hash = bundle_hash(ready.bundle);
  provenance.add(ready);
  for (const auto& [technique, reason] : ready.skipped) skipped += fmt::format("skipped {}: {}\n", technique, reason);
  std::vector<Compared> list;
  for (Candidate& candidate : light_candidates(techniques(), ready, skipped))
    list.push_back({std::move(candidate), &ready.bundle});
  if (!shading.shader.empty()) list.push_back({{load_shadings(shading, own).front(), nullptr}, &own.bundle});
  const Truths truths = trace_truths(lit, visible, subject, truth, common);
  measure(list, truths, output, provenance);

  const std::string what = truth_line(subject, truth, truths);
  std::vector<std::string> notes{what};
  for (const Compared& candidate : list)
    if (!candidate.error.finite)
      notes.push_back(candidate.shading.label() + ": some pixels are NaN or infinite, so it has no error");
  const Frontiers best = frontiers(list);
  const Rows rows = rows_of(list, best);
  output.text(table_of(list, best, arithmetic) + skipped);
  for (const std::string& note : notes) output.note(note);
  if (!folder.empty()) {
    make_folder(folder);
    write_file(output.claimed("frontier.csv"), rows.csv());
    write_pictures(folder, pictures_of(list, best, what), output);
  }
  Json json = json_rows(rows);
  for (Json& row : json)
    for (const char* flag : {"on_frontier", "on_storage_frontier"}) row[flag] = row[flag] == 1;
  output.json(
      {{"provenance", provenance.json()}, {"truth", truth_json(truth, truths)}, {"rows", json}, {"notes", notes}});
  return 0;
}

}  // namespace

Verb add_frontier(CLI::App& app) {
  CLI::App* command = app.add_subcommand("frontier", "accuracy against speed, over techniques: table, CSV, charts");
  const auto verb = std::make_shared<FrontierVerb>();
  verb->command = command;
  add_subject_options(*command, verb->subject);
  require_second_environment(*command);
  add_shading_options(*command, verb->shading, "all");
  command->get_option("--shader")->description("a fragment shader of your own, measured beside the techniques");
  add_truth_options(*command, verb->truth);
  command->add_flag("--arithmetic", verb->arithmetic,
                    "also shade in double, and say how far float is off: what arithmetic alone does");
  add_turn_options(*command, verb->turns);
  command
      ->add_option("-o,--output", verb->folder,
                   "write frontier.csv and charts of error against speed and against storage into this folder")
      ->type_name("DIR");
  add_cpu_options(*command, verb->cpu);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

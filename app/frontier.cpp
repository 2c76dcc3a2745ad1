// frontier: accuracy against speed. What shading by each technique costs, and how far its frame is off what rays find.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/bench/race.h"
#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/rows_output.h"
#include "app/subject.h"
#include "app/table.h"
#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/machine.h"
#include "experiments/chart.h"
#include "experiments/frame_error.h"
#include "experiments/pareto.h"
#include "experiments/reference_frame.h"
#include "scenes/model_file.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

using bench::Rounds;
using bench::Stage;
using bench::Timing;
using bench::Way;

// What a technique's light is compared with: visibility lets the environment's light through, nothing else.
struct Truths {
  Truth direct, bounced;
  double noise = 0;  // of the second
};

struct Candidate {
  Shading shading;
  const TechniqueInfo* technique;  // null: a user's shader, which can read baked light alone
  const Bundle* bundle;
  Timing timing;
  FrameError error{};
  double arithmetic = std::nan("");  // of float, over the frame shaded in double

  bool bounced() const { return !technique || technique->weights == VisibilityWeights::none; }
  int stored() const { return technique ? technique->count * (bounced() ? 3 : 1) : 0; }  // 0: not known
  double shade_ns() const { return timing.stage(Stage::shade) * 1e6 / double(timing.shaded_pixels); }
};

struct FrontierVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  int rounds = 3, repeat = 3;
  std::uint64_t pixels = 16384, rays = 512;
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
  void require_traceable() const;
  Truths trace(const Output& output) const;
  std::vector<Candidate> candidates(const Subject& ready, std::string& skipped) const;
  void measure(std::vector<Candidate>& list, const Truths& truths, const Output& output, Provenance& provenance) const;
  double arithmetic_error(const Candidate& candidate, const Frame& frame, const Truth& at) const;
  Way way() const;
};

std::vector<std::string> FrontierVerb::files_written() {
  std::vector<std::string> names{"frontier.csv"};
  for (const char* picture : {"frontier", "frontier-storage"})
    for (const std::string& name : picture_files(picture)) names.push_back(name);
  return names;
}

void FrontierVerb::require_traceable() const {
  std::error_code code;
  if (std::filesystem::is_regular_file(subject.scene, code) && model_file_ending(subject.scene).empty())
    throw UserError(subject.scene +
                    ": frontier traces rays through a scene, which a bundle has not: name a built-in scene or a model "
                    "(.gltf, .glb or .obj)");
}

// The best code that there is, or what was asked for.
Way FrontierVerb::way() const {
  Way way;
  way.renderer = "cpu";
  way.cpu = cpu;
  way.cpu.isa = cpu.isa.value_or(machine_isa());
  way.cpu.number = cpu.number.value_or(natural_number(*way.cpu.isa));
  way.attributes = AttributeMode::exact;
  way.machines = std::make_shared<Machines>(way.cpu, true);
  return way;
}

Truths FrontierVerb::trace(const Output& output) const {
  const Scene scene = load_scene(subject.scene, subject.triangles, !subject.camera);
  const Environment environment = load_light(subject);
  Machines machines(cpu, true);
  output.progress("drawing what is visible");
  const VisiblePoints visible =
      draw_visible_points(scene, frame_options(subject, scene),
                          [&](const std::string& machine, const Bundle& bundle, const ShaderSource& source) {
                            return machines.draw(machine, bundle, source, DrawOptions());
                          });
  if (visible.points.empty())
    throw UserError(subject.scene +
                    ": the camera sees no surface, so there is no light to compare; give another --camera");

  Truths truths;
  std::vector<ShadedPoint> points;
  for (const std::size_t place : stratified_places(visible.points.size(), pixels, common.seed)) {
    points.push_back(visible.points[place]);
    truths.direct.pixels.push_back(visible.pixels[place]);
  }
  truths.bounced.pixels = truths.direct.pixels;
  BakeOptions surfaces;
  surfaces.lightmap_size = subject.lightmap_size;
  surfaces.rays = subject.rays;
  surfaces.seed = common.seed;
  ReferenceOptions options;
  options.rays = std::uint32_t(rays);
  options.seed = common.seed;
  options.show_progress = !common.quiet;
  const auto halves = reference_light(scene, environment, points, surfaces, options);
  for (std::size_t half = 0; half < 2; ++half)
    for (const ReflectedLight& light : halves[half]) {
      truths.direct.radiance[half].push_back(light.direct);
      truths.bounced.radiance[half].push_back(light.direct + light.bounced);
    }
  truths.noise = truth_noise(truths.bounced);
  return truths;
}

std::vector<Candidate> FrontierVerb::candidates(const Subject& ready, std::string& skipped) const {
  std::vector<Candidate> list;
  std::string said;
  for (Shading& shader : load_shadings(techniques(), ready)) {
    const TechniqueInfo& technique = find_technique(shader.technique);
    if (technique.shows == Shows::light) {
      list.push_back({std::move(shader), &technique, &ready.bundle, {}});
      continue;
    }
    const std::string reason = "it shows what the rasterizer can do: there is no light to compare";
    if (!wants_all(techniques())) throw UserError(fmt::format("technique {}: {}", technique.name, reason));
    if (said != technique.name) skipped += fmt::format("skipped {}: {}\n", technique.name, reason);
    said = technique.name;
  }
  return list;
}

double FrontierVerb::arithmetic_error(const Candidate& candidate, const Frame& frame, const Truth& at) const {
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

// Techniques take turns within a round, in reversed order every other round: it is they that are compared.
void FrontierVerb::measure(std::vector<Candidate>& list, const Truths& truths, const Output& output,
                           Provenance& provenance) const {
  const Way best = way();
  for (Candidate& candidate : list) {
    candidate.timing.way = bench::distinct_ways({best}, candidate.shading.source, cpu.isa).front();
    provenance.add(candidate.shading);
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < list.size(); ++i) {
      Candidate& candidate = list[round % 2 == 0 ? i : list.size() - 1 - i];
      output.progress(fmt::format("round {} of {}: {}", round + 1, rounds, candidate.shading.label()));
      Rounds once{1, repeat};
      once.drawn = [&](const Way& drawn, const Frame& frame) {
        if (round > 0) return;
        provenance.add(drawn.machine(), frame);
        const Truth& truth = candidate.bounced() ? truths.bounced : truths.direct;
        candidate.error = frame_error(frame, truth);
        if (!arithmetic) return;
        output.progress(candidate.shading.label() + " in double");
        candidate.arithmetic = arithmetic_error(candidate, frame, truth);
      };
      const Timing timing = bench::race({candidate.timing.way}, *candidate.bundle, candidate.shading.source,
                                        candidate.shading.source, once)
                                .front();
      if (!timing.failure.empty()) throw UserError(candidate.shading.label() + ": " + timing.failure);
      candidate.timing.shaded_pixels = timing.shaded_pixels;
      candidate.timing.milliseconds.push_back(timing.milliseconds.front());
      for (std::size_t s = 0; s < bench::kStageCount; ++s)
        candidate.timing.stages[s].insert(candidate.timing.stages[s].end(), timing.stages[s].begin(),
                                          timing.stages[s].end());
    }
}

// What is compared: the lowest error for what it costs, and for what it stores.
struct Frontiers {
  std::vector<std::size_t> speed, storage;
};

Frontiers frontiers(const std::vector<Candidate>& list) {
  std::vector<double> shade, stored, error;
  for (const Candidate& candidate : list) {
    shade.push_back(candidate.shade_ns());
    stored.push_back(candidate.stored() > 0 ? candidate.stored() : std::nan(""));
    error.push_back(candidate.error.rms);
  }
  return {pareto_frontier(shade, error), pareto_frontier(stored, error)};
}

bool contains(const std::vector<std::size_t>& list, std::size_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

Rows rows_of(const std::vector<Candidate>& list, const Frontiers& best) {
  Rows rows({"technique", "light", "map", "truth", "stored", "ms", "ms_q1", "ms_q3", "ns_per_pixel",
             "shade_ns_per_pixel", "error", "bias", "worst", "arithmetic_error", "on_frontier", "on_storage_frontier"});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Candidate& candidate = list[i];
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
std::string table_of(const std::vector<Candidate>& list, const Frontiers& best, bool arithmetic) {
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
    const Candidate& candidate = list[i];
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

std::vector<Picture> pictures_of(const std::vector<Candidate>& list, const Frontiers& best, const std::string& what) {
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
  for (const Candidate& candidate : list) {
    several_maps = several_maps || (!map.empty() && !candidate.shading.map.empty() && map != candidate.shading.map);
    if (!candidate.shading.map.empty()) map = candidate.shading.map;
  }
  for (const Candidate& candidate : list) {
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
  require_traceable();

  Provenance provenance(common);
  Subject own;
  if (!shading.shader.empty()) own = load_subject(subject, shading, common, output);
  const Subject ready = load_subject(subject, techniques(), common, output);
  provenance.add(ready);
  std::string skipped;
  for (const auto& [technique, reason] : ready.skipped)
    if (technique != kReferenceTechnique) skipped += fmt::format("skipped {}: {}\n", technique, reason);
  std::vector<Candidate> list = candidates(ready, skipped);
  if (!shading.shader.empty()) list.push_back({load_shadings(shading, own).front(), nullptr, &own.bundle, {}, {}});
  const Truths truths = trace(output);
  measure(list, truths, output, provenance);

  const std::size_t traced = truths.direct.pixels.size();
  const std::string what =
      fmt::format("{} under {}, {} x {}; light traced for {} pixels by {} rays, its own noise {:.2g} %", subject.scene,
                  subject.environment, subject.width, subject.height, traced, rays, 100 * truths.noise);
  std::vector<std::string> notes{what};
  for (const Candidate& candidate : list)
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
  output.json({{"provenance", provenance.json()},
               {"truth",
                {{"pixels", traced},
                 {"rays", rays},
                 {"noise", std::isfinite(truths.noise) ? Json(truths.noise) : Json(nullptr)}}},
               {"rows", json},
               {"notes", notes}});
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
  add_whole_option(*command, "--pixels", "pixels whose light is traced (default: 16384)", 1, 1u << 24,
                   [v = verb.get()](std::uint64_t value) { v->pixels = value; });
  add_whole_option(*command, "--reference-rays", "rays that light is traced by, for each of them (default: 512)", 2,
                   65536, [v = verb.get()](std::uint64_t value) { v->rays = value; });
  command->add_flag("--arithmetic", verb->arithmetic,
                    "also shade in double, and say how far float is off: what arithmetic alone does");
  add_count_option(*command, "--rounds", verb->rounds, "rounds in which every technique takes its turn");
  add_count_option(*command, "--repeat", verb->repeat, "frames of a turn, whose median counts");
  command
      ->add_option("-o,--output", verb->folder,
                   "write frontier.csv and charts of error against speed and against storage into this folder")
      ->type_name("DIR");
  add_cpu_options(*command, verb->cpu);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

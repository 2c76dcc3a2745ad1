// choose: the least that one must store, or the fastest that one can shade by, for a frame within an error.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/choice_report.h"
#include "app/report/rows_output.h"
#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/machine.h"

namespace twinshade {
namespace {

// Options that render has too, and that the choice does not set: repeated in the command that draws it.
constexpr const char* kOfRender[] = {
    "--env",  "--env-rotation", "--clamp-radiance",  "--camera", "--triangles",  "--rays", "--probe-rays",
    "--env2", "--blend",        "--visibility-rays", "--albedo", "--normal-map", "--seed"};
constexpr const char* kOfComponents[] = {"--order", "--pca-metric"};

struct ChooseVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  TruthOptions truth;
  Turns turns;
  double max_error = 0.2;
  std::vector<TexelStorage> storages{TexelStorage::float32, TexelStorage::half, TexelStorage::unorm8};
  Cost by = Cost::memory;
  std::string folder;

  int run() const;

 private:
  void time(SearchResult& found, const LitScene& lit, Provenance& provenance, const Output& output) const;
  std::string command_of(const Choice& choice) const;
  Json json_of(const Choice& choice) const;
};

std::vector<std::string> choose_files() {
  std::vector<std::string> names = picture_files("choose");
  names.emplace_back("choose.csv");
  return names;
}

// As a shell reads it.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

double parse_error(const std::string& text) {
  const bool percent = text.ends_with('%');
  const char* end = text.data() + text.size() - (percent ? 1 : 0);
  double value = 0;
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (percent) value /= 100;
  if (error != std::errc() || stopped != end || !(value > 0 && value <= 1))
    throw UserError(
        fmt::format("--max-error {}: must be a fraction or percentage above 0, at most 1: 0.05 or 5%", text));
  return value;
}

std::vector<TexelStorage> parse_storages(const std::vector<std::string>& names) {
  std::vector<TexelStorage> storages;
  for (const std::string& name : names) storages.push_back(find_texel_storage(name));
  std::sort(storages.begin(), storages.end());  // the most precise first
  storages.erase(std::unique(storages.begin(), storages.end()), storages.end());
  return storages;
}

void ChooseVerb::time(SearchResult& found, const LitScene& lit, Provenance& provenance, const Output& output) const {
  RelitBundle bundle(make_bundle(lit.scene, std::span<const LightBake>(), std::vector<LitTechnique>(),
                                 frame_options(subject, lit.scene)));
  std::vector<Candidate*> candidates;
  for (Choice& choice : found.best) {
    candidates.push_back(&choice);
    provenance.add(choice.shading);
  }
  Turns timed = turns;
  timed.bundle = [&](std::size_t i) -> const Bundle& { return bundle.lit_by(found.lights[i]); };
  timed.drawn = [&](std::size_t i, int, const Frame& frame) {
    provenance.add(found.best[i].timing.way.machine(), frame);
  };
  take_turns(candidates, timed, cpu, output);
}

// What draws it, but for its storage: that is float32, or of visibility's weights as chosen.
std::string ChooseVerb::command_of(const Choice& choice) const {
  std::string line = "twinshade render " + quoted(subject.scene);
  const auto repeat = [&](const char* name) {
    const CLI::Option* option = command->get_option(name);
    if (option->count() == 0) return;
    line += fmt::format(" {}", name);
    if (option->get_items_expected_max() > 0) line += " " + quoted(option->results().back());
  };
  for (const char* name : kOfRender) repeat(name);
  line += fmt::format(" --size {}x{} --technique {} --light {}", subject.width, subject.height,
                      choice.shading.technique, choice.shading.light);
  if (choice.lightmap > 0) line += fmt::format(" --lightmap {}", choice.lightmap);
  if (choice.volume.x > 0) line += " --volume " + choice.size();
  if (choice.map_width > 0) line += fmt::format(" --map {} --map-width {}", choice.shading.map, choice.map_width);
  if (choice.technique->weights == VisibilityWeights::pca)
    for (const char* name : kOfComponents) repeat(name);
  if (choice.technique->weights != VisibilityWeights::none && choice.storage != TexelStorage::float32)
    line += fmt::format(" --visibility-storage {}", texel_storage_name(choice.storage));
  return line;
}

Json ChooseVerb::json_of(const Choice& choice) const {
  return {{"technique", choice.shading.technique},
          {"light", choice.shading.light},
          {"size", choice.size() == "-" ? Json(nullptr) : Json(choice.size())},
          {"map", choice.map_width > 0 ? Json(choice.shading.map) : Json(nullptr)},
          {"map_width", choice.map_width > 0 ? Json(choice.map_width) : Json(nullptr)},
          {"storage", texel_storage_name(choice.storage)},
          {"bytes", choice.bytes},
          {"shade_ns_per_pixel", choice.timing.shaded_pixels > 0 ? Json(choice.shade_ns()) : Json(nullptr)},
          {"error", choice.error.rms},
          {"command", command_of(choice)}};
}

int ChooseVerb::run() const {
  apply(common);
  Output output(common, {}, folder);
  if (cpu.isa) require_isa(*cpu.isa);
  bench::require_processor_for_each_thread();
  if (!folder.empty()) output.claim(choose_files());
  output.require_not_read(files_read(subject, shading));
  if (!folder.empty()) require_writable_folder(folder);
  require_traceable(subject.scene, "choose");
  require_known(shading);

  Provenance provenance(common);
  const LitScene lit = load_lit_scene(subject, output);
  const Subject plan = plan_subject(lit, subject, shading);
  std::string skipped;
  for (const auto& [technique, reason] : plan.skipped) skipped += fmt::format("skipped {}: {}\n", technique, reason);
  std::vector<LitTechnique> wanted = plan.drawn;
  std::erase_if(wanted, [&](const LitTechnique& at) { return !shows_light(*at.technique, shading, skipped); });
  if (wanted.empty())
    throw UserError(fmt::format("{}: no technique can be lit so: {}", subject.scene,
                                plan.skipped.empty() ? "none shows light" : plan.skipped.front().second));

  const Truths truths = trace_truths(lit, visible_points(lit, subject, cpu, output), subject, truth, common);
  ChoiceSearch search(lit, subject, shading, common, cpu, truths, output);
  SearchResult found = search.run(wanted, {max_error, storages});
  time(found, lit, provenance, output);

  const std::string what = truth_line(subject, truth, truths);
  std::vector<std::string> notes{what};
  if (truths.noise > max_error / 2)
    notes.push_back(
        fmt::format("the truth's own noise is {} % where {:g} % are asked for: give more "
                    "--reference-rays (now {}), four times as many for half of it",
                    noise_percent(truths), 100 * max_error, truth.rays));
  const Ranking ranking = rank(found, by);
  const std::optional<std::size_t> nearest = closest(found);
  const Choice* chosen = found.best.empty() ? nullptr : &found.best[ranking.order.front()];
  if (chosen) {
    output.text(within_table(found, ranking) + skipped + "\n" + command_of(*chosen) + "\n");
    if (chosen->storage != TexelStorage::float32)
      notes.push_back(fmt::format("the command draws {} of float32: storing them as {} was tried here alone",
                                  chosen->technique->weights == VisibilityWeights::none ? "coefficients" : "tables",
                                  texel_storage_name(chosen->storage)));
  } else if (nearest) {
    const Choice& choice = found.tried[*nearest];
    output.text(closest_table(found) + skipped +
                fmt::format("\nnothing is within {:g} %: {} comes closest, with {:.3g} %\n", 100 * max_error,
                            words(choice), 100 * choice.error.rms));
    notes.push_back("finer light may come closer: a larger --lightmap, a finer --volume, more --rays");
  } else {
    output.text(skipped + "nothing that was tried has an error: every frame has NaN or infinite pixels, or no light\n");
  }
  for (const std::string& note : notes) output.note(note);
  const Rows rows = choice_rows(found, ranking, max_error);
  if (!folder.empty()) {
    make_folder(folder);
    write_file(output.claimed("choose.csv"), rows.csv());
    write_pictures(folder, choice_pictures(found, max_error, what), output);
  }
  Json json = json_rows(rows);
  for (Json& row : json)
    for (const char* flag : {"within", "best", "on_frontier", "chosen"}) row[flag] = row[flag] == 1;
  output.json({{"provenance", provenance.json()},
               {"truth", truth_json(truth, truths)},
               {"max_error", max_error},
               {"by", by == Cost::memory ? "memory" : "speed"},
               {"chosen", chosen ? json_of(*chosen) : Json(nullptr)},
               {"closest", nearest ? json_of(found.tried[*nearest]) : Json(nullptr)},
               {"rows", json},
               {"notes", notes}});
  return chosen ? 0 : 1;
}

}  // namespace

Verb add_choose(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("choose", "the cheapest technique, map size and storage within an error of traced light");
  const auto verb = std::make_shared<ChooseVerb>();
  verb->command = command;
  verb->subject.width = 640, verb->subject.height = 400;
  verb->shading.light = LightSource::all;
  add_subject_options(*command, verb->subject);
  require_second_environment(*command);
  // Formats are what is chosen, and how texels are packed does not change what they hold.
  for (const char* name : {"--visibility-storage", "--visibility-packing"})
    command->remove_option(command->get_option(name));
  command->get_option("--size")->description("size of the frame (default: 640x400)");
  command->get_option("--lightmap")->description("lightmap texels each way, the most to try (default: 512)");
  command->get_option("--volume")->description("probes of the irradiance volume, the most to try (default: 16x8x16)");
  command->get_option("--map-width")
      ->description(
          "texels across a layer of the tables' sphere map, the most to try (default: 32, of octahedral maps 33)");
  add_technique_option(*command, verb->shading, "all");
  add_light_option(*command, verb->shading);
  command->get_option("--light")->description("where techniques may read their light from (default: all)");
  command
      ->add_option_function<std::string>(
          "--max-error", [v = verb.get()](const std::string& text) { v->max_error = parse_error(text); },
          "RMS of the difference to traced light over its RMS, at most: 0.05 or 5% (default: 20%)")
      ->type_name("E");
  command
      ->add_option_function<std::vector<std::string>>(
          "--storage", [v = verb.get()](const std::vector<std::string>& names) { v->storages = parse_storages(names); },
          "what coefficients, weights and tables may be kept as (default: float32,half,unorm8)")
      ->delimiter(',')
      ->type_name("S,...");
  command
      ->add_option_function<std::string>(
          "--by",
          [v = verb.get()](const std::string& text) {
            if (text != "memory" && text != "speed") throw UserError("--by " + text + ": must be memory or speed");
            v->by = text == "speed" ? Cost::speed : Cost::memory;
          },
          "what is cheap: few bytes, or fast shading (default: memory)")
      ->type_name("memory|speed");
  add_truth_options(*command, verb->truth);
  add_turn_options(*command, verb->turns);
  command
      ->add_option("-o,--output", verb->folder, "write choose.csv and a chart of error against memory into this folder")
      ->type_name("DIR");
  add_cpu_options(*command, verb->cpu);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

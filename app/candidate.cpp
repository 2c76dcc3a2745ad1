#include "app/candidate.h"

#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "cpu_shaders/machine.h"

namespace twinshade {
namespace {

bench::Way best_way(const CpuOptions& cpu) {
  bench::Way way;
  way.renderer = "cpu";
  way.cpu = cpu;
  way.cpu.isa = cpu.isa.value_or(machine_isa());
  way.cpu.number = cpu.number.value_or(natural_number(*way.cpu.isa));
  way.attributes = AttributeMode::exact;
  way.machines = std::make_shared<Machines>(way.cpu, true);
  return way;
}

}  // namespace

bool shows_light(const TechniqueInfo& technique, const ShadingOptions& options, std::string& skipped) {
  if (technique.shows == Shows::light) return true;
  const std::string reason = "it shows what the rasterizer can do: there is no light to compare";
  if (!wants_all(options)) throw UserError(fmt::format("technique {}: {}", technique.name, reason));
  const std::string line = fmt::format("skipped {}: {}\n", technique.name, reason);
  if (skipped.find(line) == std::string::npos) skipped += line;
  return false;
}

std::vector<Candidate> light_candidates(const ShadingOptions& options, const Subject& subject, std::string& skipped) {
  std::vector<Candidate> list;
  for (Shading& shader : load_shadings(options, subject)) {
    const TechniqueInfo& technique = find_technique(shader.technique);
    if (shows_light(technique, options, skipped)) list.push_back({std::move(shader), &technique});
  }
  return list;
}

void add_turn_options(CLI::App& command, Turns& turns) {
  add_count_option(command, "--rounds", turns.rounds, "rounds in which every technique takes its turn");
  add_count_option(command, "--repeat", turns.repeat, "frames of a turn, whose median counts");
}

void take_turns(const std::vector<Candidate*>& candidates, const Turns& turns, const CpuOptions& cpu,
                const Output& output) {
  const bench::Way best = best_way(cpu);
  for (Candidate* candidate : candidates) {
    candidate->timing = {};
    candidate->timing.way = bench::distinct_ways({best}, candidate->shading.source, cpu.isa).front();
  }
  for (int round = 0; round < turns.rounds; ++round)
    for (std::size_t turn = 0; turn < candidates.size(); ++turn) {
      const std::size_t i = round % 2 == 0 ? turn : candidates.size() - 1 - turn;
      const Shading& shading = candidates[i]->shading;
      bench::Timing& timing = candidates[i]->timing;
      output.progress(fmt::format("round {} of {}: {}", round + 1, turns.rounds, shading.label()));
      bench::Rounds once{1, turns.repeat};
      once.drawn = [&](const bench::Way&, const Frame& frame) { turns.drawn(i, round, frame); };
      const bench::Timing now =
          bench::race({timing.way}, turns.bundle(i), shading.source, shading.source, once).front();
      if (!now.failure.empty()) throw UserError(shading.label() + ": " + now.failure);
      timing.shaded_pixels = now.shaded_pixels;
      timing.milliseconds.push_back(now.milliseconds.front());
      for (std::size_t s = 0; s < bench::kStageCount; ++s)
        timing.stages[s].insert(timing.stages[s].end(), now.stages[s].begin(), now.stages[s].end());
    }
}

}  // namespace twinshade

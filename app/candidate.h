// Techniques that are measured side by side: how far off their light is, and how long shading takes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench/race.h"
#include "app/subject.h"
#include "experiments/frame_error.h"

namespace twinshade {

struct Candidate {
  Shading shading;
  const TechniqueInfo* technique;  // null: a user's shader, which can read baked light alone
  bench::Timing timing{};
  FrameError error{};

  bool bounced() const { return !technique || technique->weights == VisibilityWeights::none; }
  double shade_ns() const { return timing.stage(bench::Stage::shade) * 1e6 / double(timing.shaded_pixels); }
};

// Whether a technique's picture is of light, which can be compared. Where it is not, `skipped` says so in a line, once;
// UserError where it was named.
bool shows_light(const TechniqueInfo& technique, const ShadingOptions& options, std::string& skipped);

// What to draw `subject` with, without those that shows_light refuses.
std::vector<Candidate> light_candidates(const ShadingOptions& options, const Subject& subject, std::string& skipped);

struct Turns {
  int rounds = 3, repeat = 3;
  // What to draw a candidate from: asked for before each of its turns, and used before the next.
  std::function<const Bundle&(std::size_t candidate)> bundle;
  // Called with the frame of each turn.
  std::function<void(std::size_t candidate, int round, const Frame&)> drawn = [](std::size_t, int, const Frame&) {};
};

// --rounds and --repeat.
void add_turn_options(CLI::App& command, Turns& turns);

// Fills `timing`: the CPU's, with exact attributes, by the best code that there is or what `cpu` asks for. Candidates
// take turns within a round, in reversed order every other round: it is they that are compared.
void take_turns(const std::vector<Candidate*>& candidates, const Turns& turns, const CpuOptions& cpu,
                const Output& output);

}  // namespace twinshade

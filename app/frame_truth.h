// The light that techniques are held to: what rays find at pixels of the frame.
#pragma once

#include "app/subject.h"
#include "experiments/frame_error.h"
#include "experiments/reference_frame.h"

namespace twinshade {

struct TruthOptions {
  std::uint64_t pixels = 16384, rays = 512;  // rays of each
};

// --pixels and --reference-rays.
void add_truth_options(CLI::App& command, TruthOptions& options);

// What a technique's light is compared with: visibility lets the environment's light through, nothing else.
struct Truths {
  Truth direct, bounced;
  double noise = 0;  // of the second

  const Truth& of(const TechniqueInfo& technique) const {
    return technique.weights == VisibilityWeights::none ? bounced : direct;
  }
};

// UserError where `scene` is a bundle's file: rays need a scene. verb: who traces.
void require_traceable(const std::string& scene, const std::string& verb);

// What light can be compared at, which `cpu` says how to draw. UserError where the camera sees nothing: ask before
// light is baked, which takes longer.
VisiblePoints visible_points(const LitScene& lit, const SubjectOptions& subject, const CpuOptions& cpu,
                             const Output& output);

// Pixels are drawn at random from `visible`, which is not empty.
Truths trace_truths(const LitScene& lit, const VisiblePoints& visible, const SubjectOptions& subject,
                    const TruthOptions& options, const CommonOptions& common);

// The truth's own noise, without its sign %: two digits, or whole from 100 on.
std::string noise_percent(const Truths& truths);
// What was compared, in a line.
std::string truth_line(const SubjectOptions& subject, const TruthOptions& options, const Truths& truths);
Json truth_json(const TruthOptions& options, const Truths& truths);

}  // namespace twinshade

// How the cost of a frame grows: with its pixels, its triangles, its overdraw, the threads and the coefficients that a
// shader reads.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench/race.h"
#include "app/options.h"
#include "app/output.h"
#include "experiments/experiment.h"

namespace twinshade::bench {

struct ScalingOptions {
  std::vector<std::string> axes;  // names, or "all"
  SubjectOptions subject;         // scene, environment, size and bake of the axes that do not vary them
  std::string technique = "sh3";  // a basis that is read from lightmaps
  CpuOptions cpu;
  bool host_fma = true;
  Rounds rounds;
  // Called after each point with all that was measured so far, a row at least.
  std::function<void(const Rows&, const std::vector<std::string>& notes)> measured =
      [](const Rows&, const std::vector<std::string>&) {};
};

// In the order in which they are measured.
const std::vector<std::string>& scaling_axes();
// UserError, with the nearest names, where one of these is neither an axis nor "all".
void require_axes(const std::vector<std::string>& axes);
// Whether these, names or "all", have that axis.
bool has_axis(const std::vector<std::string>& axes, const std::string& axis);
// Names of the pictures that these axes may give, without endings. axes: names, or "all".
std::vector<std::string> scaling_pictures(const std::vector<std::string>& axes);

struct ScalingResult : ExperimentResult {
  bool failed = false;  // some machine could not draw some point: the notes say which, and why
};

// A row for each machine at each point of each axis; pictures: milliseconds, or nanoseconds a pixel, against each axis,
// and memory against each but coefficients. UserError for axes that do not exist and for other techniques.
ScalingResult run_scaling(const ScalingOptions& options, const CommonOptions& common, const Output& output);

}  // namespace twinshade::bench

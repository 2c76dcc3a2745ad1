// Ways of drawing one frame, timed side by side.
//
// Processors drift by more than the differences that matter, so the ways take turns within each round, the order is
// reversed every other round, and ratios are taken round by round before their median.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/machines.h"
#include "app/report/quartiles.h"
#include "bundle/bundle.h"
#include "raster/tiled/stages.h"

namespace twinshade::bench {

using tiled::kStageCount;
using tiled::kStageNames;
using tiled::Stage;

// One way to draw a frame.
struct Way {
  std::string renderer;  // "cpu" or "egl"
  CpuOptions cpu;        // isa and number set where renderer is "cpu"
  AttributeMode attributes = AttributeMode::native;
  bool depth_prepass = false;
  std::shared_ptr<Machines> machines;

  bool is_cpu() const { return renderer == "cpu"; }
  // Under which provenance has what the renderer says about itself, one a machine: "cpu avx2 lanes8", "egl".
  std::string machine() const;
  std::string name() const { return depth_prepass ? renderer + ", depth first" : renderer; }
};

// UserError where --threads is more than the processors that this process may use: the scheduler would be timed.
void require_processor_for_each_thread();

// The CPU, once for each instruction set that `cpu` admits and each of the attribute modes, then llvmpipe through EGL
// with ordinary varyings, with and without filling depth first.
std::vector<Way> all_ways(const CpuOptions& cpu, const std::vector<AttributeMode>& modes, bool host_fma);

// Those of `ways` that run different code of this shader, each with the instruction set and the number type of its
// code: of 4 lanes there may be code for the baseline alone, whatever instruction set is asked for. A way that has no
// code at all is kept as it is; drawing says why. named: the instruction set that the user named; UserError where the
// shader's code for the number type is another's.
std::vector<Way> distinct_ways(const std::vector<Way>& ways, const ShaderSource& source, std::optional<Isa> named);

// What drawing a way took.
struct Timing {
  Way way;
  std::vector<double> milliseconds;         // of each round
  std::vector<double> stages[kStageCount];  // the same; empty where the renderer does not know
  std::uint64_t shaded_pixels = 0;
  std::uint64_t peak_memory = 0;  // bytes that this process held while drawing; workers not counted
  std::string failure;            // why the backend could not draw
  bool impossible = false;        // nothing that this shader can be drawn by: a depth prepass, if it discards

  bool drawn() const { return !milliseconds.empty() && failure.empty(); }
  double median() const { return quartiles(milliseconds).median; }
  double stage(Stage s) const { return stage(std::size_t(s)); }
  double stage(std::size_t s) const { return stages[s].empty() ? 0 : quartiles(stages[s]).median; }
  double ns_per_pixel() const { return shaded_pixels == 0 ? 0 : median() * 1e6 / double(shaded_pixels); }
};

// What each round is: every way draws the frame once to warm up, then `repeat` times, of which the median counts.
struct Rounds {
  int rounds = 5, repeat = 3;
  std::function<void(int round)> progress = [](int) {};
  std::function<void(const Way&, const Frame&)> drawn = [](const Way&, const Frame&) {};
};

// cpu, gl: the same shader as either machine is given it. UserError where the CPU cannot draw it.
std::vector<Timing> race(const std::vector<Way>& ways, const Bundle& bundle, const ShaderSource& cpu,
                         const ShaderSource& gl, const Rounds& rounds);

// llvmpipe's better way: drawing depth first helps it or does not, by the shader. Null where it drew nothing.
const Timing* faster_llvmpipe(const std::vector<Timing>& timings);

// How many times longer `other` took than `timing`, round by round.
Quartiles ratio(const Timing& other, const Timing& timing);

}  // namespace twinshade::bench

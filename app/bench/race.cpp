#include "app/bench/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/processors.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/machine.h"
#include "raster/tiled/entry.h"

namespace twinshade::bench {
namespace {

// Every renderer times the whole draw under this name, stages apart.
double milliseconds_of(const Frame& frame, const std::string& name) {
  for (const auto& [stage, ms] : frame.milliseconds)
    if (stage == name) return ms;
  return -1;
}

void draw(Timing& timing, const Bundle& bundle, const ShaderSource& source, const Rounds& rounds) {
  const Way& way = timing.way;
  DrawOptions options;
  options.attributes = way.attributes;
  options.depth_prepass = way.depth_prepass;
  options.warmup = 1;
  options.time_limit_seconds = 600;
  options.repeat = rounds.repeat;
  options.visibility = false;  // OpenGL's frame has no such thing while it is timed
  try {
    restart_peak_memory();
    const Frame frame = way.machines->draw(way.renderer, bundle, source, options);
    timing.peak_memory = std::max(timing.peak_memory, peak_memory());
    const double whole = milliseconds_of(frame, "draw");
    if (whole < 0) throw BackendError("the renderer did not time its draw");
    if (way.is_cpu())  // rows are labelled by it
      for (const auto& [key, value] : frame.provenance)
        if (key == "isa") TWINSHADE_CHECK_EQ(value, std::string(isa_name(*way.cpu.isa)));
    timing.milliseconds.push_back(whole);
    for (std::size_t s = 0; s < kStageCount; ++s)
      if (const double ms = milliseconds_of(frame, kStageNames[s]); ms >= 0) timing.stages[s].push_back(ms);
    timing.shaded_pixels =
        std::uint64_t(std::count_if(frame.depth.begin(), frame.depth.end(), [](float depth) { return depth < 1; }));
    rounds.drawn(way, frame);
  } catch (const BackendError& error) {
    timing.failure = error.what();
  } catch (const UserError&) {
    if (!way.depth_prepass) throw;
    timing.impossible = true;
  }
}

// What the renderer runs for these options; null where there is nothing.
const ShaderEntry* find_code(const CpuOptions& cpu, const ShaderSource& source) {
  try {
    return &tiled::choose_entry(load_module(source, *cpu.number, cpu.isa), *cpu.number, cpu.isa);
  } catch (const UserError&) {
    return nullptr;
  }
}

}  // namespace

std::string Way::machine() const {
  return is_cpu() ? fmt::format("cpu {} {}", isa_name(*cpu.isa), number_name(*cpu.number)) : renderer;
}

void require_processor_for_each_thread() {
  if (thread_count() > processor_count())
    throw UserError(
        fmt::format("--threads {}: timings need a processor for each, and this process may use {} processors",
                    thread_count(), processor_count()));
}

std::vector<Way> all_ways(const CpuOptions& cpu, const std::vector<AttributeMode>& modes, bool host_fma) {
  std::vector<Way> ways;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (cpu.isa ? isa != *cpu.isa : isa > machine_isa()) continue;
    for (const AttributeMode mode : modes) {
      Way way;
      way.renderer = "cpu";
      way.cpu = cpu;
      way.cpu.isa = isa;
      way.cpu.number = cpu.number.value_or(natural_number(isa));
      way.attributes = mode;
      ways.push_back(std::move(way));
    }
  }
  for (Way& way : ways) way.machines = std::make_shared<Machines>(way.cpu, host_fma);
  const auto egl = std::make_shared<Machines>(cpu, host_fma);  // one worker, which is given the bundle once
  for (const bool depth_prepass : {false, true}) {
    Way way;
    way.renderer = "egl";
    way.depth_prepass = depth_prepass;
    way.machines = egl;
    ways.push_back(std::move(way));
  }
  return ways;
}

std::vector<Way> distinct_ways(const std::vector<Way>& ways, const ShaderSource& source, std::optional<Isa> named) {
  std::vector<Way> distinct;
  for (Way way : ways) {
    const ShaderEntry* entry = way.is_cpu() ? find_code(way.cpu, source) : nullptr;
    if (entry) {
      if (named && entry->isa != *named)
        throw UserError(fmt::format("--isa {}: {} runs on code for {} here; name that, or another --number",
                                    isa_name(*named), number_name(*way.cpu.number), isa_name(entry->isa)));
      way.cpu.isa = entry->isa;
      way.cpu.number = entry->number;
    }
    const auto same = [&](const Way& other) {
      return other.is_cpu() && other.cpu.isa == way.cpu.isa && other.cpu.number == way.cpu.number &&
             other.attributes == way.attributes;
    };
    if (!entry || std::none_of(distinct.begin(), distinct.end(), same)) distinct.push_back(std::move(way));
  }
  return distinct;
}

std::vector<Timing> race(const std::vector<Way>& ways, const Bundle& bundle, const ShaderSource& cpu,
                         const ShaderSource& gl, const Rounds& rounds) {
  std::vector<Timing> timings;
  for (const Way& way : ways) timings.emplace_back().way = way;
  for (int round = 0; round < rounds.rounds; ++round) {
    rounds.progress(round);
    for (std::size_t i = 0; i < timings.size(); ++i) {
      Timing& timing = timings[round % 2 == 0 ? i : timings.size() - 1 - i];
      if (timing.failure.empty() && !timing.impossible) draw(timing, bundle, timing.way.is_cpu() ? cpu : gl, rounds);
    }
  }
  return timings;
}

const Timing* faster_llvmpipe(const std::vector<Timing>& timings) {
  const Timing* best = nullptr;
  for (const Timing& timing : timings)
    if (!timing.way.is_cpu() && timing.drawn() && (!best || timing.median() < best->median())) best = &timing;
  return best;
}

Quartiles ratio(const Timing& other, const Timing& timing) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(other.milliseconds.size(), timing.milliseconds.size()); ++i)
    ratios.push_back(other.milliseconds[i] / timing.milliseconds[i]);
  return quartiles(ratios);
}

}  // namespace twinshade::bench

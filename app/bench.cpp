// bench: what a frame costs, ours against llvmpipe's in the same run.
//
// Processors drift by more than the differences that matter, so the machines take turns within each round, the order is
// reversed every other round, and ratios are taken round by round before their median.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/quartiles.h"
#include "app/subject.h"
#include "app/table.h"
#include "base/error.h"
#include "cpu_shaders/runtime/machine.h"

namespace twinshade {
namespace {

struct BenchVerb {
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  int rounds = 7, repeat = 5;
  bool host_fma = true;

  int run() const;
};

// One way to draw a frame.
struct Way {
  std::string renderer;
  CpuOptions cpu;  // isa set where renderer is "cpu"
  AttributeMode attributes = AttributeMode::native;
  bool depth_prepass = false;
  std::shared_ptr<Machines> machines;

  // Filled by the rounds.
  std::vector<double> milliseconds;  // of each round
  std::uint64_t shaded_pixels = 0;
  std::string failure;
};

// Every renderer times the whole draw under this name, stages apart.
double draw_milliseconds(const Frame& frame) {
  for (const auto& [stage, ms] : frame.milliseconds)
    if (stage == "draw") return ms;
  throw BackendError("the renderer did not time its draw");
}

class BenchRun {
 public:
  BenchRun(const BenchVerb& verb, const Output& output)
      : verb_(verb),
        output_(output),
        provenance_(verb.common),
        subject_(load_subject(verb.subject, verb.shading, verb.common, output)) {
    provenance_.add(subject_);
    table_.column("technique");
    table_.column("light");
    table_.column("map");
    table_.column("renderer");
    table_.column("isa");
    table_.column("attributes");
    for (const char* heading : {"ms", "q1", "q3", "ns/pixel", "x llvmpipe"})
      table_.column(heading, Table::Align::right);
  }

  int run() {
    std::string skipped;
    for (const auto& [technique, reason] : subject_.skipped)
      skipped += fmt::format("skipped {}: {}\n", technique, reason);
    for (const Shading& shader : load_shadings(verb_.shading, subject_)) {
      try {
        measure(shader);
      } catch (const UserError& error) {
        if (!wants_all(verb_.shading)) throw;
        skipped += fmt::format("skipped {}: {}\n", shader.technique, error.what());
      }
    }
    output_.text(table_.text() + skipped + failures_);
    output_.json({{"provenance", provenance_.json()}, {"rows", rows_}});
    return failures_.empty() ? 0 : 2;
  }

 private:
  std::vector<Way> ways() const {
    std::vector<Way> ways;
    for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      if (verb_.cpu.isa ? isa != *verb_.cpu.isa : isa > machine_isa()) continue;
      for (const AttributeMode attributes : {AttributeMode::exact, AttributeMode::native}) {
        Way way;
        way.renderer = "cpu";
        way.cpu = verb_.cpu;
        way.cpu.isa = isa;
        way.cpu.number = verb_.cpu.number.value_or(natural_number(isa));
        way.attributes = attributes;
        ways.push_back(std::move(way));
      }
    }
    for (const bool depth_prepass : {false, true}) {
      Way way;
      way.renderer = "egl";
      way.depth_prepass = depth_prepass;
      ways.push_back(std::move(way));
    }
    for (Way& way : ways) way.machines = std::make_shared<Machines>(way.cpu, verb_.host_fma);
    return ways;
  }

  void measure(const Shading& shader) {
    provenance_.add(shader);
    std::vector<Way> all = ways();
    for (int round = 0; round < verb_.rounds; ++round) {
      output_.progress(fmt::format("{}: round {} of {}", shader.label(), round + 1, verb_.rounds));
      for (Way& way : all) draw(way, shader);
      std::reverse(all.begin(), all.end());
    }
    if (verb_.rounds % 2 == 1) std::reverse(all.begin(), all.end());
    report(shader, all);
  }

  void draw(Way& way, const Shading& shader) {
    if (!way.failure.empty()) return;
    DrawOptions options;
    options.attributes = way.attributes;
    options.depth_prepass = way.depth_prepass;
    options.warmup = 1;
    options.repeat = verb_.repeat;
    try {
      const Frame frame = way.machines->draw(way.renderer, subject_.bundle, shader.source, options);
      way.milliseconds.push_back(draw_milliseconds(frame));
      way.shaded_pixels = std::uint64_t(std::count(frame.coverage.begin(), frame.coverage.end(), 1));
      provenance_.add(way.renderer, frame);
    } catch (const BackendError& error) {
      way.failure = error.what();
    }
  }

  // llvmpipe's better way: drawing depth first helps it or does not, by the shader.
  static const Way* counted_llvmpipe(const std::vector<Way>& all) {
    const Way* best = nullptr;
    for (const Way& way : all) {
      if (way.renderer != "egl" || way.milliseconds.empty()) continue;
      if (!best || quartiles(way.milliseconds).median < quartiles(best->milliseconds).median) best = &way;
    }
    return best;
  }

  void report(const Shading& shader, const std::vector<Way>& all) {
    const Way* llvmpipe = counted_llvmpipe(all);
    const Json light = shader.light.empty() ? Json(nullptr) : Json(shader.light);
    for (const Way& way : all) {
      const std::string isa = way.renderer == "cpu" ? isa_name(*way.cpu.isa) : "";
      const std::string renderer = way.depth_prepass ? "egl, depth first" : way.renderer;
      const std::string attributes = attribute_mode_name(way.attributes);
      if (!way.failure.empty()) {
        failures_ += fmt::format("failed {} on {}: {}\n", shader.technique, renderer, way.failure);
        rows_.push_back({{"technique", shader.technique},
                         {"light", light},
                         {"map", shader.map.empty() ? Json(nullptr) : Json(shader.map)},
                         {"renderer", way.renderer},
                         {"depth_prepass", way.depth_prepass},
                         {"error", way.failure}});
        continue;
      }
      const Quartiles ms = quartiles(way.milliseconds);
      const double ns_per_pixel = way.shaded_pixels == 0 ? 0 : ms.median * 1e6 / double(way.shaded_pixels);
      Json row{{"technique", shader.technique},
               {"light", light},
               {"map", shader.map.empty() ? Json(nullptr) : Json(shader.map)},
               {"renderer", way.renderer},
               {"isa", isa.empty() ? Json(nullptr) : Json(isa)},
               {"number", isa.empty() ? Json(nullptr) : Json(number_name(*way.cpu.number))},
               {"attributes", attributes},
               {"depth_prepass", way.depth_prepass},
               {"ms", ms.median},
               {"ms_q1", ms.q1},
               {"ms_q3", ms.q3},
               {"ns_per_pixel", ns_per_pixel},
               {"ratio_to_llvmpipe", nullptr}};
      std::string ratio_text = "-";
      if (llvmpipe) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < way.milliseconds.size(); ++i)
          ratios.push_back(llvmpipe->milliseconds[i] / way.milliseconds[i]);
        const double ratio = quartiles(ratios).median;
        row["ratio_to_llvmpipe"] = ratio;
        ratio_text = fmt::format("{:.2f}", ratio);
      }
      rows_.push_back(std::move(row));
      table_.row({shader.technique, shader.light.empty() ? "-" : shader.light, shader.map.empty() ? "-" : shader.map,
                  renderer, isa, attributes, fmt::format("{:.2f}", ms.median), fmt::format("{:.2f}", ms.q1),
                  fmt::format("{:.2f}", ms.q3), fmt::format("{:.2f}", ns_per_pixel), ratio_text});
    }
  }

  const BenchVerb& verb_;
  const Output& output_;
  Provenance provenance_;
  const Subject subject_;
  Table table_;
  Json rows_ = Json::array();
  std::string failures_;
};

int BenchVerb::run() const {
  apply(common);
  const Output output(common);
  if (cpu.isa && *cpu.isa > machine_isa())
    throw UserError(fmt::format("--isa {}: this processor has only {}", isa_name(*cpu.isa), isa_name(machine_isa())));
  return BenchRun(*this, output).run();
}

}  // namespace

Verb add_bench(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bench", "what a frame costs, ours against llvmpipe's in the same run");
  const auto verb = std::make_shared<BenchVerb>();
  add_subject_options(*command, verb->subject);
  add_shading_options(*command, verb->shading, "all");
  add_count_option(*command, "--rounds", verb->rounds, "rounds in which every machine takes its turn");
  add_count_option(*command, "--repeat", verb->repeat, "frames of a turn, whose median counts");
  add_cpu_options(*command, verb->cpu);
  add_fma_option(*command, verb->host_fma);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

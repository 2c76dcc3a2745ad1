// profile: which lines of a shader the CPU's shading spends its time on.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "app/machines.h"
#include "app/memory_needed.h"
#include "app/option_rules.h"
#include "app/output.h"
#include "app/profile/code_lines.h"
#include "app/profile/pc_sampler.h"
#include "app/provenance.h"
#include "app/report/statement_text.h"
#include "app/report/table.h"
#include "app/subject.h"
#include "base/error.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/translate/source_lines.h"
#include "cpu_shaders/translate/translate.h"
#include "raster/tiled/tiled_renderer.h"

namespace twinshade {
namespace {

constexpr std::size_t kMostSamples = 1 << 18, kMostRows = 30;

struct LineShare {
  GlslLine at;
  std::size_t samples = 0;
};

struct Profile {
  std::vector<LineShare> lines;  // the most first
  std::size_t samples = 0, in_shader = 0, without_line = 0;
  std::size_t shaded_pixels = 0;
  double shade_ms = 0, frame_ms = 0;  // means over frames
  int frames = 0;
  std::string hash;  // of the frame
};

struct ProfileVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  double seconds = 5;

  int run() const {
    apply(common);
    const Output output(common);
    require_one_shading(shading, "profile looks into one");
    if (cpu.isa) require_isa(*cpu.isa);
    output.require_not_read(files_read(subject, shading));
    require_known(shading);
    const Subject ready = load_subject(subject, shading, common, output);
    const Shading shader = load_shadings(shading, ready).front();
    require_frame_memory(ready.bundle.width, ready.bundle.height, "cpu");

    Provenance provenance(common);
    provenance.add(ready);
    provenance.add(shader);
    const Profile found = measure(ready.bundle, shader.source, output, provenance);
    const SourceLines text(shader.source);
    output.text(table_of(found, shader.source, text));
    output.text(summary(found, shader));
    output.json(json_of(found, shader, text, provenance.json()));
    return 0;
  }

 private:
  Profile measure(const Bundle& bundle, const ShaderSource& source, const Output& output,
                  Provenance& provenance) const {
    const ShaderModule* module = nullptr;
    const auto renderer =
        make_tiled_renderer([&](const ShaderSource& shader, Number number, std::optional<Isa> isa) -> const auto& {
          if (!module) module = &load_module_with_lines(shader, number, isa);
          return *module;
        });
    DrawOptions options;
    options.tile_size = cpu.tile_size;
    options.isa = cpu.isa;
    options.number = cpu.number.value_or(natural_number(cpu.isa.value_or(machine_isa())));
    output.progress("compiling the shader with its lines");
    const Frame first = renderer->draw(bundle, source, options);
    provenance.add("cpu", first);

    Profile found;
    found.hash = frame_hash(first);
    found.shaded_pixels = std::size_t(std::count(first.coverage.begin(), first.coverage.end(), 1));
    options.repeat = 4;
    PcSampler sampler(kMostSamples);
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    sampler.start();
    do {
      output.progress(fmt::format("drawing frame {}", found.frames + 1));
      const Frame frame = renderer->draw(bundle, source, options);
      for (const auto& [stage, ms] : frame.milliseconds) {
        if (stage == "shade") found.shade_ms += ms;
        if (stage == "draw") found.frame_ms += ms;
      }
      ++found.frames;
    } while (std::chrono::steady_clock::now() < end);
    sampler.stop();
    found.shade_ms /= found.frames, found.frame_ms /= found.frames;
    found.samples = sampler.samples().size();
    attribute(sampler.samples(), module->entries[0].shade, source, found);
    return found;
  }

  // C++ that has no line of its own, such as a call of the runtime, is told as the lines behind the last that has one.
  static GlslLine with_text(GlslLine at, const SourceLines& text) {
    const auto says_nothing = [&] {
      return text.text(line_name(at.file), at.line).find_first_not_of("{}; ") == std::string::npos;
    };
    while (at.line > 1 && says_nothing()) --at.line;
    return at;
  }

  // The innermost line of GLSL counts: an instruction's own, or that of the call which led to it.
  static void attribute(const std::vector<PcSample>& samples, ShadeFunction entry, const ShaderSource& source,
                        Profile& found) {
    std::vector<std::vector<std::uintptr_t>> within;  // of each sample that the shader has a part in
    std::vector<std::uintptr_t> all;
    for (const PcSample& sample : samples) {
      std::vector<std::uintptr_t> addresses;
      for (std::size_t depth = 0; depth < sample.size() && sample[depth] != 0; ++depth) {
        const std::uintptr_t address = sample[depth] - (depth > 0);  // the call, not what follows it
        if (is_within(address, entry)) addresses.push_back(address);
      }
      if (addresses.empty()) continue;
      all.insert(all.end(), addresses.begin(), addresses.end());
      within.push_back(std::move(addresses));
    }
    found.in_shader = within.size();
    const auto line_of = glsl_lines(all, entry, source.files);
    std::map<GlslLine, std::size_t> counts;
    const SourceLines text(source);
    for (const std::vector<std::uintptr_t>& addresses : within) {
      const auto known =
          std::find_if(addresses.begin(), addresses.end(), [&](auto address) { return line_of.contains(address); });
      if (known != addresses.end())
        ++counts[with_text(line_of.at(*known), text)];
      else
        ++found.without_line;
    }
    for (const auto& [line, count] : counts) found.lines.push_back({line, count});
    std::stable_sort(found.lines.begin(), found.lines.end(),
                     [](const LineShare& a, const LineShare& b) { return a.samples > b.samples; });
  }

  static double percent(std::size_t samples, std::size_t of) {
    return of == 0 ? 0 : 100 * double(samples) / double(of);
  }

  static std::string table_of(const Profile& found, const ShaderSource& source, const SourceLines& text) {
    Table table;
    table.column("%", Table::Align::right);
    table.column("line");
    table.column("");
    std::size_t told = 0;
    for (const LineShare& line : found.lines) {
      if (told == kMostRows) break;
      ++told;
      table.row({fmt::format("{:.1f}", percent(line.samples, found.in_shader)),
                 line.at.file == source.files[0] ? std::to_string(line.at.line)
                                                 : fmt::format("{}:{}", line.at.file, line.at.line),
                 statement_text(text, line_name(line.at.file), line.at.line)});
    }
    std::size_t rest = 0;
    for (std::size_t i = told; i < found.lines.size(); ++i) rest += found.lines[i].samples;
    if (rest > 0)
      table.row({fmt::format("{:.1f}", percent(rest, found.in_shader)), "",
                 fmt::format("({} more lines)", found.lines.size() - told)});
    table.row({fmt::format("{:.1f}", percent(found.without_line, found.in_shader)), "",
               "(no line: inputs, outputs, addresses)"});
    return table.text();
  }

  std::string summary(const Profile& found, const Shading& shader) const {
    return fmt::format(
        "\n{}: shading takes {:.2f} ms of a frame's {:.2f}, {:.2f} ns a pixel; {} samples in the shader, {} elsewhere, "
        "{} frames\n",
        shader.label(), found.shade_ms, found.frame_ms,
        found.shaded_pixels == 0 ? 0 : 1e6 * found.shade_ms / double(found.shaded_pixels), found.in_shader,
        found.samples - found.in_shader, found.frames * 4);
  }

  static Json json_of(const Profile& found, const Shading& shader, const SourceLines& text, const Json& provenance) {
    Json lines = Json::array();
    for (const LineShare& line : found.lines)
      lines.push_back({{"file", line.at.file},
                       {"line", line.at.line},
                       {"samples", line.samples},
                       {"share", percent(line.samples, found.in_shader) / 100},
                       {"text", statement_text(text, line_name(line.at.file), line.at.line)}});
    return {{"provenance", provenance},
            {"technique", shader.technique},
            {"frame", found.hash},
            {"samples", found.samples},
            {"samples_in_shader", found.in_shader},
            {"samples_without_line", found.without_line},
            {"shaded_pixels", found.shaded_pixels},
            {"shade_ms", found.shade_ms},
            {"frame_ms", found.frame_ms},
            {"frames", found.frames * 4},
            {"lines", lines}};
  }
};

}  // namespace

Verb add_profile(CLI::App& app) {
  CLI::App* command = app.add_subcommand("profile", "which lines of a shader the CPU's time goes to");
  const auto verb = std::make_shared<ProfileVerb>();
  verb->command = command;
  add_subject_options(*command, verb->subject);
  require_second_environment(*command);
  add_shading_options(*command, verb->shading, "h4");
  require_one_shader(*command);
  command
      ->add_option_function<std::string>(
          "--seconds",
          [verb = verb.get()](const std::string& text) {
            verb->seconds = parse_real("--seconds", text);
            if (!(verb->seconds > 0 && verb->seconds <= 3600))
              throw UserError("--seconds " + text + ": must be a number above 0, at most 3600");
          },
          "how long to draw: a second gives 100 to 1000 samples (default: 5)")
      ->type_name("S");
  add_cpu_options(*command, verb->cpu);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

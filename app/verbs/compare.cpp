// compare: the same bundle and the same shader on several machines, bit by bit.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/first_line_search.h"
#include "app/machines.h"
#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/compare_report.h"
#include "app/report/dialect.h"
#include "app/report/first_line_report.h"
#include "app/report/junit.h"
#include "app/report/mismatch.h"
#include "app/report/reports.h"
#include "app/report/table.h"
#include "app/subject.h"
#include "base/error.h"
#include "cpu_shaders/machine.h"
#include "golden/compare_frames.h"
#include "golden/pictures.h"

namespace twinshade {
namespace {

struct CompareVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  PictureOptions picture;
  ReportOptions reports;
  AttributeMode attributes = AttributeMode::exact;
  std::vector<std::string> backends{"cpu", "egl", "osmesa"};
  std::string folder;
  bool host_fma = true;
  double time_limit_seconds = DrawOptions().time_limit_seconds;

  int run() const;
  // Of all pictures that may be written, whichever of them the scene can be drawn with.
  std::vector<std::string> picture_names() const;
};

// a: the reference, as the table has it.
std::string difference_name(const std::string& shader, const std::string& a, const std::string& b) {
  return shader + "." + a + "-" + b + ".difference.png";
}

std::string frame_name(const std::string& shader, const std::string& backend) {
  return shader + "." + backend + ".png";
}

// softpipe shades what the CPU covered, from the CPU's attributes, so it is the CPU that it is compared with.
std::string reference_of(const std::string& backend, const std::string& first) {
  return backend == "softpipe" ? "cpu" : first;
}

class CompareRun {
 public:
  CompareRun(const CompareVerb& verb, const Output& output)
      : verb_(verb),
        output_(output),
        provenance_(verb.common),
        subject_(load_subject(verb.subject, verb.shading, verb.common, output)),
        machines_(verb.cpu, verb.host_fma) {
    provenance_.add(subject_);
  }

  int run() {
    skipped_ = subject_.skipped;
    const std::vector<Shading> shadings = load_shadings(verb_.shading, subject_);
    for (const Shading& shader : shadings) {
      const std::vector<FrameOutput> outputs = outputs_of(shader);
      if (&shader == &shadings.front()) begin_table(shadings, outputs);  // a shader with several is the only one
      for (const FrameOutput& output : outputs) compare(shader, output);
    }
    if (rows_.empty()) {
      std::string reasons;
      for (const auto& [technique, reason] : skipped_)
        reasons += (reasons.empty() ? "" : "; ") + technique + ": " + reason;
      throw UserError(verb_.subject.scene + ": no technique can be drawn: " + reasons);
    }
    report();
    if (unwritten_ > 0)
      throw UserError(
          write_error_ +
          (unwritten_ > 1 ? fmt::format(" (and {} more picture{})", unwritten_ - 1, unwritten_ > 2 ? "s" : "") : ""));
    return exit_code();
  }

 private:
  // A frame holds one output: a shader with several is drawn for each. Techniques have one.
  std::vector<FrameOutput> outputs_of(const Shading& shader) {
    std::vector<FrameOutput> outputs;
    if (!verb_.shading.shader.empty()) outputs = machines_.outputs(shader.source);
    if (outputs.empty()) outputs.emplace_back();
    several_outputs_ = outputs.size() > 1;
    first_location_ = outputs.front().location;
    return outputs;
  }

  DrawOptions draw_options(bool capture) const {
    DrawOptions options;
    options.output = output_at_.location;
    options.attributes = verb_.attributes;
    options.capture_attributes = capture;
    options.time_limit_seconds = verb_.time_limit_seconds;
    return options;
  }

  Frame draw(const std::string& backend, const Shading& shader, bool capture, const Frame* cpu_frame = nullptr) {
    output_.progress(fmt::format("drawing {} on {}", shader.label(), backend));
    Frame frame = machines_.draw(backend, subject_.bundle, shader.source, draw_options(capture), cpu_frame);
    provenance_.add(backend, frame);
    return frame;
  }

  void compare(const Shading& shader, const FrameOutput& output) {
    output_at_ = output;
    if (pictured()) provenance_.add(shader);
    const std::string& a = verb_.backends.front();
    const bool native = verb_.attributes == AttributeMode::native;
    const bool on_softpipe =
        std::find(verb_.backends.begin(), verb_.backends.end(), "softpipe") != verb_.backends.end();

    Frame reference;
    try {
      reference = draw(a, shader, native || (on_softpipe && a == "cpu"));
    } catch (const UserError& error) {
      if (!wants_all(verb_.shading)) throw;
      skip(shader, error.what());
      return;
    } catch (const BackendError& error) {
      for (std::size_t i = 1; i < verb_.backends.size(); ++i) fail(shader, a, verb_.backends[i], error.what());
      return;
    }
    if (!verb_.folder.empty() && pictured()) write_picture_of(shader, a, reference);
    for (std::size_t i = 1; i < verb_.backends.size(); ++i) {
      const std::string& b = verb_.backends[i];
      written([&] { remove_difference_picture(shader, reference_of(b, a), b); });
      try {
        if (b == "softpipe")
          compare_on_softpipe(shader, a, reference);
        else
          compare_with(shader, a, reference, b, draw(b, shader, native), CompareScope::all);
      } catch (const std::runtime_error& error) {  // UserError, BackendError: the others go on
        fail(shader, a, b, error.what());
      }
    }
  }

  void compare_on_softpipe(const Shading& shader, const std::string& a, const Frame& reference) {
    if (machines_.uses_derivatives(shader.source)) {
      skip(shader, "softpipe: the shader takes derivatives, whose neighbours there are of other triangles");
      return;
    }
    const Frame drawn = a == "cpu" ? Frame() : draw("cpu", shader, true);
    const Frame& cpu_frame = a == "cpu" ? reference : drawn;
    compare_with(shader, "cpu", cpu_frame, "softpipe", draw("softpipe", shader, false, &cpu_frame),
                 CompareScope::shaded_by_a);
  }

  void compare_with(const Shading& shader, const std::string& a, const Frame& frame_a, const std::string& b,
                    const Frame& frame_b, CompareScope scope) {
    ComparedShader row = row_of(shader, a, b);
    row.comparison = compare_frames(frame_a, frame_b, scope);
    row.hash_a = frame_hash(frame_a), row.hash_b = frame_hash(frame_b);
    const bool whole = scope == CompareScope::all;
    const Frame merged = whole ? Frame() : with_colors_where_covered(frame_a, frame_b);
    show(shader, row, frame_a, whole ? frame_b : merged);
    if (!row.comparison.equal()) explain(shader, row, frame_a, frame_b, scope);
    add(std::move(row));
  }

  // Pictures of b and, where they differ, of that.
  void show(const Shading& shader, ComparedShader& row, const Frame& frame_a, const Frame& frame_b) {
    const bool in_folder = !verb_.folder.empty() && pictured();
    if (in_folder) write_picture_of(shader, row.b, frame_b);
    if (row.comparison.equal()) return;
    if (in_folder)
      written([&] {
        write_difference_picture(output_.claimed(difference_name(picture_of(shader), row.a, row.b)), frame_a, frame_b);
      });
    if (!verb_.reports.html.empty() && shown_++ < kMostPictured)
      written([&] {
        row.pictures = mismatch_pictures(row.a, frame_a, row.b, frame_b, row.comparison.first, verb_.picture);
      });
  }

  // What only shades, as a frame: all else is as in the frame that it was given.
  static Frame with_colors_where_covered(Frame frame, const Frame& shaded) {
    for (std::size_t i = 0; i < frame.coverage.size(); ++i)
      if (frame.coverage[i])
        std::copy_n(shaded.color.begin() + std::ptrdiff_t(i * 4), 4, frame.color.begin() + std::ptrdiff_t(i * 4));
    return frame;
  }

  // An earlier run's would stay beside frames that are equal now.
  void remove_difference_picture(const Shading& shader, const std::string& a, const std::string& b) const {
    if (verb_.folder.empty() || !pictured()) return;
    const std::string path = output_.claimed(difference_name(picture_of(shader), a, b));
    std::error_code code;
    std::filesystem::remove(path, code);
    if (code) throw UserError(path + ": cannot be removed: " + code.message());
  }

  // Draws again with the attributes captured, so that the first layer can be told and the inputs named. The counts of
  // the row stay those of the frames as first drawn, but for the attributes, which those did not have.
  void explain(const Shading& shader, ComparedShader& row, const Frame& frame_a, const Frame& frame_b,
               CompareScope scope) {
    const bool captured_b = !frame_b.attribute_names.empty() || scope == CompareScope::shaded_by_a;
    Frame again_a, again_b;
    const Frame* a = &frame_a;
    const Frame* b = &frame_b;
    try {
      if (frame_a.attribute_names.empty()) a = &(again_a = draw(row.a, shader, true));
      if (!captured_b) b = &(again_b = draw(row.b, shader, true));
    } catch (const BackendError& error) {
      output_.note(fmt::format("{}: inputs of the shader are not known: {}", shader.technique, error.what()));
    }
    Comparison again = compare_frames(*a, *b, scope);
    if (!again.first) {  // capturing made the difference vanish: the inputs are still those of the pixel
      again = compare_frames(*a, frame_b, scope);
      if (!again.first) again = row.comparison;
    }
    row.comparison.attributes_differ = again.attributes_differ;
    row.findings = findings_of(shader.source);
    row.first_difference = difference_json(again.first, *a);
    row.description = describe_mismatch(row.name(), row.a, row.b, again, *a);
    if (again.first && again.first->layer == "color" && row.is_mismatch()) {
      row.first_line = look_inside(shader, row, *a, *again.first);
      row.description += first_line_text(*row.first_line, row.a, row.b, row.findings);
    }
    row.description += describe_findings(row.findings);
  }

  FirstLine look_inside(const Shading& shader, const ComparedShader& row, const Frame& frame, const Difference& at) {
    output_.progress(fmt::format("looking for the first line of {} that differs", shader.label()));
    return first_line_at(shader.source, subject_.bundle, frame, at, row.a, row.b,
                         {verb_.cpu, verb_.host_fma, verb_.time_limit_seconds});
  }

  ComparedShader row_of(const Shading& shader, const std::string& a, const std::string& b) const {
    ComparedShader row;
    row.attributes = verb_.attributes, row.technique = shader.technique, row.light = shader.light, row.map = shader.map,
    row.a = a, row.b = b;
    if (several_outputs_) row.output = output_at_.name;
    return row;
  }

  // Pictures are of the first output.
  bool pictured() const { return !several_outputs_ || output_at_.location == first_location_; }

  // Once, though each output and each way to read the light may meet it.
  void skip(const Shading& shader, const std::string& reason) {
    const std::pair<std::string, std::string> skipped(shader.technique, reason);
    if (std::find(skipped_.begin(), skipped_.end(), skipped) == skipped_.end()) skipped_.push_back(skipped);
  }

  void fail(const Shading& shader, const std::string& a, const std::string& b, const std::string& reason) {
    ComparedShader row = row_of(shader, a, b);
    row.failure = reason;
    add(std::move(row));
  }

  // Rows are written as they are known, so columns are as wide as what they may come to hold.
  void begin_table(const std::vector<Shading>& shadings, const std::vector<FrameOutput>& outputs) {
    std::size_t name = 0, light = 0, map = 0, backend = 0;
    for (const Shading& shader : shadings) {
      light = std::max(light, shader.light.size()), map = std::max(map, shader.map.size());
      for (const FrameOutput& output : outputs) {
        output_at_ = output;
        name = std::max(name, row_of(shader, "", "").name().size());
      }
    }
    for (const std::string& each : verb_.backends) backend = std::max(backend, each.size());
    const std::size_t count = std::to_string(std::uint64_t{subject_.bundle.width} * subject_.bundle.height).size();
    table_.column("technique", Table::Align::left, name);
    table_.column("light", Table::Align::left, light);
    table_.column("map", Table::Align::left, map);
    for (const char* heading : {"a", "b"}) table_.column(heading, Table::Align::left, backend);
    for (const char* heading : {"shaded", "coverage", "id", "depth", "attributes", "pixels", "denormal"})
      table_.column(heading, Table::Align::right, count);
    table_.column("max ULP", Table::Align::right, std::to_string(UINT32_MAX).size());
    table_.column("verdict");
  }

  void add(ComparedShader row) {
    output_.text((rows_.empty() ? table_.headings() : "") + table_.line(compared_cells(row)));
    rows_.push_back(std::move(row));
  }

  // The shader's part of its pictures' names.
  std::string picture_of(const Shading& shader) const {
    const bool by_light = verb_.shading.light == LightSource::all;
    const bool by_name = !verb_.shading.shader.empty() || by_light || !shader.map.empty();
    return by_name ? shader.source.name : shader.technique;
  }

  void write_picture_of(const Shading& shader, const std::string& backend, const Frame& frame) {
    written([&] {
      make_folder(verb_.folder);
      write_picture(output_.claimed(frame_name(picture_of(shader), backend)), frame, verb_.picture);
    });
  }

  // The frames are drawn and are compared all the same: that a picture cannot be written is told last.
  template <class Write>
  void written(const Write& write) {
    try {
      write();
    } catch (const UserError& error) {
      if (unwritten_++ == 0) write_error_ = error.what();
    }
  }

  int exit_code() const {
    int code = 0;
    for (const ComparedShader& row : rows_) {
      if (!row.failure.empty()) return 2;
      if (row.is_mismatch()) code = 1;
    }
    return code;
  }

  void report() const {
    Json results = Json::array();
    for (const ComparedShader& row : rows_) results.push_back(compared_json(row));
    std::string text;
    for (const auto& [technique, reason] : skipped_) text += fmt::format("skipped {}: {}\n", technique, reason);
    for (const ComparedShader& row : rows_)
      if (!row.failure.empty()) text += fmt::format("failed {} on {}: {}\n", row.name(), row.b, row.failure);
    for (const ComparedShader& row : rows_)
      if (row.is_mismatch()) text += row.description;
    output_.text(text);
    const std::vector<CaseResult> cases = compared_results(rows_, verb_.shading.shader);
    if (!verb_.reports.annotate.empty()) output_.text(github_annotations(cases));

    Json skipped = Json::array();
    for (const auto& [technique, reason] : skipped_) skipped.push_back({{"technique", technique}, {"reason", reason}});
    output_.json({{"provenance", provenance_.json()}, {"results", results}, {"skipped", skipped}});
    write_reports(output_, {"twinshade compare",
                            fmt::format("{}, {} x {} pixels, {} attributes", verb_.subject.scene, subject_.bundle.width,
                                        subject_.bundle.height, attribute_mode_name(verb_.attributes)),
                            cases, provenance_.json()});
  }

  const CompareVerb& verb_;
  const Output& output_;
  Provenance provenance_;
  const Subject subject_;
  Machines machines_;
  FrameOutput output_at_;  // that is drawn
  bool several_outputs_ = false;
  std::uint32_t first_location_ = 0;
  Table table_;  // its columns: rows are not kept
  std::vector<ComparedShader> rows_;
  std::size_t shown_ = 0;      // in the report
  std::size_t unwritten_ = 0;  // pictures
  std::string write_error_;    // of the first
  std::vector<std::pair<std::string, std::string>> skipped_;
};

std::vector<std::string> CompareVerb::picture_names() const {
  std::vector<std::string> shaders;
  if (!shading.shader.empty()) {
    shaders.push_back(load_fragment_shader(shading.shader, shading.source).name);
  } else {
    for (const TechniqueInfo* technique : chosen_techniques(shading)) {
      const std::string name(technique->name);
      std::vector<std::string> mapped{name};
      for (const SphereMapInfo& map : sphere_maps()) mapped.push_back(name + "_" + std::string(map.name));
      for (const std::string& with_map : mapped)
        for (const char* light : {"", "_vertex", "_volume"})
          for (const char* packing : {"", "_packed"}) shaders.push_back(with_map + light + packing);
    }
  }
  std::vector<std::string> names;
  for (const std::string& shader : shaders)
    for (const std::string& backend : backends) {
      names.push_back(frame_name(shader, backend));
      names.push_back(difference_name(shader, reference_of(backend, backends.front()), backend));
    }
  return names;
}

int CompareVerb::run() const {
  apply(common);
  Output output(common, reports, folder);
  require_backends(backends);
  require_machine_options(*command, backends);
  if (backends.size() < 2) throw UserError("--on: name at least two backends to compare, as cpu,egl");
  const bool only_softpipe = std::all_of(backends.begin() + 1, backends.end(), [](auto& b) { return b == "softpipe"; });
  if (backends.front() == "softpipe" || (backends.front() != "cpu" && only_softpipe))
    throw UserError(
        "--on: softpipe shades what the CPU covered and is compared with it; name cpu first, as cpu,softpipe");
  if (cpu.number == Number::float64)
    throw UserError("--number float64: frames in double have other bits by design; twinshade render draws them");
  if (!folder.empty()) output.claim(picture_names());
  output.require_not_read(files_read(subject, shading));
  if (!folder.empty()) require_writable_folder(folder);
  return CompareRun(*this, output).run();
}

}  // namespace

Verb add_compare(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "draw on several machines and compare the frames bit by bit");
  const auto verb = std::make_shared<CompareVerb>();
  verb->command = command;
  add_subject_options(*command, verb->subject);
  add_shading_options(*command, verb->shading, "all");
  require_one_shader(*command);
  require_second_environment(*command);
  command
      ->add_option("--on", verb->backends,
                   "backends of cpu, egl, osmesa, softpipe, gpu; the first is the reference (default: cpu,egl,osmesa)")
      ->delimiter(',')
      ->type_name("A,B,...");
  add_attribute_option(*command, verb->attributes);
  command->add_option("-o,--output", verb->folder, "folder for pictures of the frames and their differences")
      ->type_name("DIR");
  add_report_options(*command, verb->reports);
  add_time_limit_option(*command, verb->time_limit_seconds);
  add_cpu_options(*command, verb->cpu);
  add_fma_option(*command, verb->host_fma);
  add_picture_options(*command, verb->picture);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

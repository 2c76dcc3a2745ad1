// golden check: draws the entries of manifests again, and holds each frame to its image bit by bit.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

#include "app/first_line_search.h"
#include "app/golden/drawing.h"
#include "app/golden/report.h"
#include "app/golden/scene.h"
#include "app/golden/verbs.h"
#include "app/provenance.h"
#include "app/report/dialect.h"
#include "app/report/junit.h"
#include "app/report/mismatch.h"
#include "app/report/reports.h"
#include "base/error.h"
#include "base/names.h"
#include "cpu_shaders/machine.h"
#include "golden/frame_file.h"
#include "golden/pictures.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct GoldenCheckVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  CpuOptions cpu;
  std::vector<std::string> folders, backends{"cpu"};
  std::string only, pictures;
  ReportOptions reports;
  std::uint64_t ulp = 0;
  bool host_fma = true;
  double time_limit_seconds = DrawOptions().time_limit_seconds;

  int run() const;
};

// Of an entry and a backend: the image and the frame to look at, where they differ, and the frame as a golden image.
struct PictureNames {
  std::string image, frame, difference, kept;
  PictureNames(const std::string& name, const std::string& on)
      : image(name + ".golden.png"),
        frame(name + "." + on + ".png"),
        difference(name + "." + on + ".difference.png"),
        kept(name + "." + on + ".exr") {}
  std::vector<std::string> all() const { return {image, frame, difference, kept}; }
};

class GoldenCheckRun {
 public:
  GoldenCheckRun(const GoldenCheckVerb& verb, Output& output)
      : verb_(verb),
        output_(output),
        silent_options_(without_results(verb.common)),
        silent_(silent_options_),
        machines_(verb.cpu, verb.host_fma),
        provenance_(verb.common) {}

  int run() {
    for (const std::string& folder : verb_.folders) {
      require_other(folder);
      for (const GoldenEntry& entry : chosen(folder)) entries_.emplace_back(folder, entry);
    }
    require_entries();
    protect_files();
    std::vector<std::string> names;
    for (const auto& [folder, entry] : entries_) names.push_back(entry.name);
    table_ = check_table(names, verb_.backends);
    for (const auto& [folder, entry] : entries_) check(folder, entry);
    return report();
  }

 private:
  void require_other(const std::string& folder) const {
    std::error_code code;
    for (const std::string& other : verb_.folders)
      if (&other < &folder && fs::equivalent(other, folder, code)) throw UserError(folder + ": is named twice");
  }

  std::vector<GoldenEntry> chosen(const std::string& folder) {
    require_manifest(folder);
    const GoldenManifest manifest = read_manifest(folder);
    for (const GoldenEntry& entry : manifest.entries) known_.push_back(entry.name);
    if (verb_.only.empty())
      for (const std::string& path : stray_images(manifest))
        output_.note(path + ": belongs to no entry of the manifest");
    return chosen_entries(manifest, verb_.only, false);
  }

  void require_entries() const {
    if (!entries_.empty()) return;
    if (known_.empty()) throw UserError(manifest_path(verb_.folders.front()) + ": it has no entries");
    throw UserError("--only: " + unknown_name_message("entry", verb_.only, known_));
  }

  // What is read stays as it is.
  void protect_files() {
    std::vector<std::string> read;
    std::vector<std::string> written;
    std::set<std::string> names;
    for (const auto& [folder, entry] : entries_) {
      if (!verb_.pictures.empty() && !names.insert(entry.name).second)
        throw UserError("-o " + verb_.pictures + ": two folders have an entry " + entry.name +
                        ", whose pictures would have one name: check one folder at a time");
      read.push_back(manifest_path(folder));
      read.push_back(golden_image_path(folder, entry.name));
      if (const std::string shader = shader_path(entry.drawing, folder); !shader.empty()) read.push_back(shader);
      for (const std::string& on : verb_.backends)
        for (std::string& name : PictureNames(entry.name, on).all()) written.push_back(std::move(name));
    }
    if (!verb_.pictures.empty()) output_.claim(std::move(written));
    output_.require_not_read(read);
    if (!verb_.pictures.empty()) require_writable_folder(verb_.pictures);
  }

  void check(const std::string& folder, const GoldenEntry& entry) {
    auto begin = Clock::now();  // the first backend's time has the scene's in it
    output_.progress(fmt::format("drawing {} ({} of {})", entry.name, ++drawn_, entries_.size()));
    const GoldenImage image = read_golden_image(folder, entry);
    std::optional<GoldenScene> scene;
    FrameOutput output;
    std::string failure;
    try {
      scene = load_golden_scene(entry.drawing, folder, verb_.common, silent_, machines_, last_);
      output = find_output(*scene, entry);
      provenance_.add_shader(entry.name, scene->shader_hash);
    } catch (const UserError& error) {
      failure = error.what();
    }
    if (scene) output_.require_not_read(scene->files);
    remove_pictures(entry.name);
    std::vector<GoldenRow> rows;
    for (const std::string& on : verb_.backends) {
      GoldenRow row;
      row.folder = folder, row.name = entry.name, row.on = on, row.golden_frame = entry.frame;
      row.ulp = verb_.ulp;
      row.shader_file = shader_path(entry.drawing, folder);
      if (failure.empty()) {
        row.changes.bundle = scene->bundle_hash != entry.bundle;
        row.changes.shader = scene->shader_hash != entry.shader;
        hold(row, *scene, output, image, rows);
      } else {
        row.result = GoldenResult::failed;
        row.error = failure;
      }
      row.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      begin = Clock::now();
      print(row);
      rows.push_back(std::move(row));
    }
    std::move(rows.begin(), rows.end(), std::back_inserter(rows_));
  }

  Frame draw(const std::string& on, const GoldenScene& scene, const FrameOutput& output, bool capture) {
    DrawOptions options;
    options.output = output.location;
    options.capture_attributes = capture;
    options.time_limit_seconds = verb_.time_limit_seconds;
    Frame frame = machines_.draw(on, scene.subject.bundle, scene.shading.source, options);
    provenance_.add(on, frame);
    return frame;
  }

  // before: the same entry on other backends.
  void hold(GoldenRow& row, const GoldenScene& scene, const FrameOutput& output, const GoldenImage& image,
            const std::vector<GoldenRow>& before) {
    Frame frame;
    try {
      frame = draw(row.on, scene, output, false);
    } catch (const BackendError& error) {
      row.result = GoldenResult::no_backend;
      row.error = error.what();
      return;
    } catch (const UserError& error) {
      row.result = GoldenResult::failed;
      row.error = error.what();
      return;
    }
    row.frame = frame_hash(frame);
    if (!image.frame) {
      row.result = image.trouble;
      row.error = image.reason + "; the frame drawn " + says_of_trouble(row, image);
      return;
    }
    const auto alike =
        std::find_if(before.begin(), before.end(), [&](const auto& other) { return other.frame == row.frame; });
    const bool told = alike != before.end();  // what differs, by another backend
    const auto captured = [&] { return told ? Frame() : draw_with_inputs(row, scene, output); };
    hold_to_image(row, *image.frame, frame, verb_.ulp, captured);
    if (row.passes()) return;
    if (told) row.description = fmt::format("\n{}: {} draws the same bits as {}\n", row.name, row.on, alike->on);
    if (!told) {
      row.findings = findings_of(scene.shading.source);
      look_inside(row, scene, output, before);
    }
    try {
      if (!verb_.reports.html.empty() && row.comparison && pictured_++ < kMostPictured)
        row.pictures = mismatch_pictures("golden", *image.frame, row.on, frame, row.comparison->first);
      write_pictures(row, *image.frame, frame);
    } catch (const UserError& error) {  // told last: the frames are drawn and are held to their images all the same
      if (write_error_.empty()) write_error_ = error.what();
    }
  }

  // What the frame says where the image is none, and what helps.
  static std::string says_of_trouble(const GoldenRow& row, const GoldenImage& image) {
    const std::string update = "twinshade golden update " + row.folder + " --only " + row.name;
    if (row.frame == row.golden_frame) return "is the one of the manifest: " + update + " makes the image anew";
    if (row.frame == image.other_frame) return "is the image: " + update + " makes the manifest say so";
    return "is not the one of the manifest either: restore both from version control, or " + update + " accepts it";
  }

  Frame draw_with_inputs(const GoldenRow& row, const GoldenScene& scene, const FrameOutput& output) {
    try {
      return draw(row.on, scene, output, true);
    } catch (const BackendError& error) {
      output_.note(fmt::format("{} on {}: inputs of the shader are not known: {}", row.name, row.on, error.what()));
      return {};
    }
  }

  // Where the CPU still draws the image it is the backend that computes something else: on which line. Once for each
  // shader, which takes seconds.
  void look_inside(GoldenRow& row, const GoldenScene& scene, const FrameOutput& output,
                   const std::vector<GoldenRow>& before) {
    if (row.on == "cpu" || !row.comparison || !row.comparison->first || row.comparison->first->layer != "color") return;
    const auto cpu = std::find_if(before.begin(), before.end(), [](const auto& other) { return other.on == "cpu"; });
    if (cpu != before.end() && cpu->frame != row.golden_frame) return;
    if (!looked_into_.insert({scene.shader_hash, row.on}).second) return;
    Frame inputs;
    try {
      inputs = draw("cpu", scene, output, true);
    } catch (const std::runtime_error&) {  // UserError, BackendError: what the CPU cannot draw it draws no longer
      return;
    }
    if (cpu == before.end() && frame_hash(inputs) != row.golden_frame) return;
    output_.progress(fmt::format("looking for the first line of {} that differs on {}", row.name, row.on));
    row.first_line = first_line_at(scene.shading.source, scene.subject.bundle, inputs, *row.comparison->first, "cpu",
                                   row.on, {verb_.cpu, verb_.host_fma, verb_.time_limit_seconds});
  }

  // An earlier run's would stay beside frames that are the same now.
  void remove_pictures(const std::string& entry) const {
    if (verb_.pictures.empty()) return;
    for (const std::string& on : verb_.backends)
      for (const std::string& name : PictureNames(entry, on).all()) {
        std::error_code code;
        fs::remove(output_.claimed(name), code);
        if (code) throw UserError(output_.claimed(name) + ": cannot be removed: " + code.message());
      }
  }

  void write_pictures(const GoldenRow& row, const Frame& image, const Frame& frame) const {
    if (verb_.pictures.empty()) return;
    const PictureNames names(row.name, row.on);
    make_folder(verb_.pictures);
    write_picture(output_.claimed(names.image), image);
    write_picture(output_.claimed(names.frame), frame);
    if (row.comparison) write_difference_picture(output_.claimed(names.difference), image, frame);
    write_frame_file(output_.claimed(names.kept), frame);
  }

  void print(const GoldenRow& row) {
    if (verb_.common.quiet && row.passes()) return;
    output_.text((headed_ ? "" : table_.headings()) + table_.line(check_cells(row)));
    headed_ = true;
  }

  int report() const {
    Json results = Json::array();
    std::string failures;
    for (const GoldenRow& row : rows_) {
      results.push_back(golden_json(row));
      failures += failure_text(row);
    }
    output_.text(failures + check_summary(rows_, verb_.ulp));  // first: files may be refused by a full disk
    const std::vector<CaseResult> cases = golden_results(rows_);
    if (!verb_.reports.annotate.empty()) output_.text(github_annotations(cases));
    output_.json({{"provenance", provenance_.json()}, {"results", results}});
    write_reports(output_, {"twinshade golden check", check_summary(rows_, verb_.ulp), cases, provenance_.json()});
    if (!write_error_.empty()) throw UserError(write_error_);
    int code = 0;
    for (const GoldenRow& row : rows_) {
      if (row.result == GoldenResult::no_backend) return 2;
      if (!row.passes()) code = 1;
    }
    return code;
  }

  const GoldenCheckVerb& verb_;
  Output& output_;
  const CommonOptions silent_options_;
  const Output silent_;
  Machines machines_;
  LastLitScene last_;
  Provenance provenance_;
  std::vector<std::string> known_;                            // names of all entries
  std::vector<std::pair<std::string, GoldenEntry>> entries_;  // of a folder
  Table table_;                                               // its columns: rows are not kept
  std::vector<GoldenRow> rows_;
  std::set<std::pair<std::string, std::string>> looked_into_;  // shaders by hash, and backends
  std::size_t drawn_ = 0, pictured_ = 0;
  bool headed_ = false;
  std::string write_error_;  // of the first picture that could not be written
};

int GoldenCheckVerb::run() const {
  apply(common);
  Output output(common, reports, pictures);
  require_backends(backends);
  require_machine_options(*command, backends);
  if (std::find(backends.begin(), backends.end(), "softpipe") != backends.end())
    throw UserError(
        "--on: softpipe draws no frame of its own: it shades what the CPU covered (twinshade compare --on "
        "cpu,softpipe)");
  if (cpu.number == Number::float64)
    throw UserError("--number float64: frames in double have other bits by design; twinshade render draws them");
  if (cpu.isa) require_isa(*cpu.isa);
  for (const std::string& folder : folders) require_folder_name(folder);
  if (command->get_option("--only")->count() > 0 && only.empty()) throw UserError("--only '': the pattern is empty");
  if (command->get_option("--seed")->count() > 0)
    throw UserError("--seed: each entry keeps the one that it was drawn with: leave it out");
  return GoldenCheckRun(*this, output).run();
}

}  // namespace

Verb add_golden_check(CLI::App& golden) {
  CLI::App* command = golden.add_subcommand("check", "draw again what manifests say, and hold it to the golden images");
  const auto verb = std::make_shared<GoldenCheckVerb>();
  verb->command = command;
  command->add_option("folder", verb->folders, "folders of a golden.json and its images")
      ->required()
      ->type_name("DIR...");
  command->add_option("--on", verb->backends, "backends of cpu, egl, osmesa, gpu (default: cpu)")
      ->delimiter(',')
      ->type_name("A,B,...");
  command->add_option("--only", verb->only, "only entries whose names are like this: * any text, ? any one")
      ->type_name("PATTERN");
  add_whole_option(*command, "--ulp",
                   "let depths and colours pass that are at most so many ULP off, for graphics cards (default: 0)", 0,
                   UINT32_MAX, [v = verb.get()](std::uint64_t value) { v->ulp = value; });
  command
      ->add_option("-o,--output", verb->pictures,
                   "folder for what differs: pictures of image, frame and difference, and the frame itself")
      ->type_name("DIR");
  add_report_options(*command, verb->reports);
  add_time_limit_option(*command, verb->time_limit_seconds);
  add_cpu_options(*command, verb->cpu);
  add_fma_option(*command, verb->host_fma);
  add_common_options(*command, verb->common);
  command->get_option("--quiet")->description("no progress and no notes; of the table only what does not pass");
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

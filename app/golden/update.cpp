// golden update: draws images that others are held to, and writes them and their manifest.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/golden/drawing.h"
#include "app/golden/report.h"
#include "app/golden/scene.h"
#include "app/golden/verbs.h"
#include "app/provenance.h"
#include "app/report/dialect.h"
#include "base/error.h"
#include "base/folder_lock.h"
#include "golden/frame_file.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

struct GoldenUpdateVerb {
  CLI::App* command = nullptr;
  DrawingOptions options;
  std::string folder, name, only;

  int run() const;
};

// One drawing of the command line, or an entry that is drawn again.
struct GoldenJob {
  GoldenDrawing drawing;
  std::optional<GoldenEntry> entry = {};
};

class GoldenUpdateRun {
 public:
  GoldenUpdateRun(const GoldenUpdateVerb& verb, Output& output)
      : verb_(verb),
        output_(output),
        silent_options_(without_results(verb.options.common)),
        silent_(silent_options_),
        machines_(CpuOptions(), true),
        provenance_(verb.options.common) {}

  int run() {
    jobs_ = jobs();
    claim();
    for (const GoldenJob& job : jobs_) {
      output_.progress(fmt::format("drawing {} of {}", &job - jobs_.data() + 1, jobs_.size()));
      std::vector<Drawn> drawn;
      try {
        drawn = draw(job);
      } catch (const std::runtime_error& error) {  // UserError, BackendError: the others go on
        fail(job, error.what());
      }
      for (Drawn& each : drawn) keep(std::move(each));
    }
    report();
    const auto failed = [](const GoldenRow& row) { return row.result == GoldenResult::failed; };
    return std::any_of(rows_.begin(), rows_.end(), failed) ? 1 : 0;
  }

 private:
  struct Drawn {
    GoldenEntry entry;
    Frame frame;
    std::vector<std::string> files;  // that it was drawn from
  };

  std::vector<GoldenJob> jobs() {
    std::error_code code;
    const bool there = fs::exists(manifest_path(verb_.folder), code);
    const GoldenDrawing given = given_drawing(*verb_.command, verb_.folder);
    const bool again = given.empty() && verb_.command->get_option("--name")->count() == 0;
    if (again) require_manifest(verb_.folder);
    if (!again && !verb_.only.empty())
      throw UserError("--only: chooses among the entries that are drawn again: leave it out, or what is to be drawn");
    require_writable_folder(verb_.folder);
    manifest_.folder = verb_.folder;
    if (there) manifest_ = read_manifest(verb_.folder);

    std::vector<GoldenJob> list;
    if (again) {
      for (const GoldenEntry& entry : chosen_entries(manifest_, verb_.only)) list.push_back({entry.drawing, entry});
      return list;
    }
    if (verb_.command->get_option("--name")->count() > 0 && !is_golden_name(verb_.name))
      throw UserError("--name '" + verb_.name +
                      "': a name is made of letters, digits and ._+- and begins with none of .+-, at most 200 long");
    for (GoldenDrawing& single : single_drawings(given, verb_.options.shading)) list.push_back({std::move(single)});
    return list;
  }

  // What is there already; images of new entries are seen to one by one.
  void claim() {
    std::vector<std::string> names{kManifestName}, read{manifest_path(verb_.folder)};
    for (const GoldenEntry& entry : manifest_.entries) {
      names.push_back(entry.name + ".exr");
      read.push_back(golden_image_path(verb_.folder, entry.name));
    }
    output_.require_not_read(read);
    output_.require_not_taken(verb_.folder, ".exr", "a golden image");
    output_.claim(std::move(names));
  }

  std::vector<Drawn> draw(const GoldenJob& job) {
    // What is said of a scene is said once; of an entry, when it was added.
    const Output& of_scene = &job == &jobs_.front() && !job.entry ? output_ : silent_;
    const GoldenScene scene =
        load_golden_scene(job.drawing, verb_.folder, verb_.options.common, of_scene, machines_, last_);
    provenance_.add(scene.shading);
    if (!job.entry) note_dialect(scene);
    std::vector<Drawn> drawn;
    for (const FrameOutput& output :
         job.entry ? std::vector<FrameOutput>{find_output(scene, *job.entry)} : scene.outputs) {
      GoldenEntry entry;
      if (job.entry) {
        entry = *job.entry;
      } else {
        entry.name = name_of(scene, output);
        entry.drawing = job.drawing;
        if (scene.outputs.size() > 1) entry.output = output.name;
      }
      DrawOptions options;
      options.output = output.location;
      Frame frame = machines_.draw("cpu", scene.subject.bundle, scene.shading.source, options);
      provenance_.add("cpu", frame);
      entry.width = frame.width, entry.height = frame.height;
      entry.frame = frame_hash(frame);
      entry.bundle = scene.bundle_hash, entry.shader = scene.shader_hash;
      drawn.push_back({std::move(entry), std::move(frame), scene.files});
    }
    return drawn;
  }

  void note_dialect(const GoldenScene& scene) {
    if (scene.shader_file.empty()) return;
    const std::vector<LintFinding> findings = findings_of(scene.shading.source);
    if (findings.empty()) return;
    output_.note(
        fmt::format("{}: outside of the exact dialect in {} place{}, so other machines may draw other bits: {}",
                    scene.shader_file, findings.size(), findings.size() > 1 ? "s" : "", describe(findings.front())));
  }

  std::string name_of(const GoldenScene& scene, const FrameOutput& output) const {
    const bool one = jobs_.size() == 1;
    std::string name = verb_.name.empty() ? fs::path(verb_.options.subject.scene).stem().string() : verb_.name;
    if (!one || verb_.name.empty()) name += "." + scene.shading.source.name;
    if (scene.outputs.size() > 1) name += "." + output.name;
    return golden_name(name);
  }

  // Writes the image and the manifest where they are not what they were.
  void keep(Drawn drawn) {
    output_.require_not_read(drawn.files);
    GoldenEntry& entry = drawn.entry;
    GoldenRow row;
    row.folder = verb_.folder, row.name = entry.name, row.frame = entry.frame;
    for (const GoldenRow& other : rows_)
      if (other.name == row.name) throw UserError("two frames would be named " + row.name + ": draw them one by one");
    row.result = GoldenResult::added;
    const std::string path = golden_image_path(verb_.folder, entry.name);
    // Others may have added entries since the manifest was read, or do now.
    make_folder(verb_.folder);
    const FolderLock lock(verb_.folder);
    if (std::error_code code; fs::exists(manifest_path(verb_.folder), code)) manifest_ = read_manifest(verb_.folder);
    if (const GoldenEntry* before = manifest_.find(entry.name))
      compare_with(row, *before, entry, drawn.frame);
    else
      require_no_other_file(path);
    if (row.result != GoldenResult::same) {
      write_frame_file(path, drawn.frame);
      row.written = path;
    }
    rows_.push_back(std::move(row));
    manifest_.put(std::move(entry));
    write_manifest(manifest_);  // each time: a run that is stopped leaves images and a manifest that are of each other
  }

  static void compare_with(GoldenRow& row, const GoldenEntry& before, const GoldenEntry& now, const Frame& frame) {
    row.golden_frame = before.frame;
    row.changes.drawing = !same_drawing(before.drawing, now.drawing) || before.output != now.output;
    row.changes.bundle = before.bundle != now.bundle;
    row.changes.shader = before.shader != now.shader;
    const GoldenImage image = read_golden_image(row.folder, before);
    if (!image.frame) {
      row.result = GoldenResult::restored;
      return;
    }
    hold_to_image(row, *image.frame, frame, 0, nullptr);
    if (row.result == GoldenResult::differs) row.result = GoldenResult::changed;
  }

  // A folder may have other pictures.
  static void require_no_other_file(const std::string& path) {
    std::error_code code;
    if (!fs::exists(path, code)) return;
    try {
      read_frame_file(path);
    } catch (const UserError&) {
      throw UserError(path + ": is there already, and is no golden image: name the entry otherwise (--name)");
    }
  }

  void fail(const GoldenJob& job, const std::string& reason) {
    const ShadingOptions& shading = verb_.options.shading;
    const bool any = wants_all(shading) || shading.light == LightSource::all;
    if (!job.entry && jobs_.size() == 1) throw UserError(reason);
    if (!job.entry && any) {
      if (std::find(skipped_.begin(), skipped_.end(), reason) == skipped_.end()) skipped_.push_back(reason);
      return;
    }
    GoldenRow row;
    row.folder = verb_.folder;
    row.name = job.entry ? job.entry->name : label(job.drawing);
    row.result = GoldenResult::failed;
    row.error = reason;
    if (job.entry) row.golden_frame = job.entry->frame;
    rows_.push_back(std::move(row));
  }

  static std::string label(const GoldenDrawing& drawing) {
    std::string text;
    for (const auto& [key, values] : drawing)
      if (key == "technique" || key == "map" || key == "light")
        text += (text.empty() ? "" : ", ") + fmt::format("{}", fmt::join(values, ","));
    return text;
  }

  void report() {
    if (rows_.empty())
      throw UserError(verb_.options.subject.scene +
                      ": nothing can be drawn: " + fmt::format("{}", fmt::join(skipped_, "; ")));
    std::vector<std::string> names;
    for (const GoldenRow& row : rows_) names.push_back(row.name);
    const Table table = update_table(names);
    std::string text = table.headings(), failures;
    Json entries = Json::array();
    for (const GoldenRow& row : rows_) {
      text += table.line(update_cells(row));
      if (row.result == GoldenResult::failed) failures += failure_text(row);
      const GoldenChanges& c = row.changes;
      if (row.result == GoldenResult::changed && !c.drawing && !c.bundle && !c.shader)
        failures += row.name + ": " + cause(row) + '\n';
      entries.push_back(golden_json(row));
    }
    for (const std::string& reason : skipped_) text += "skipped " + reason + '\n';
    output_.text(text + failures + update_summary(rows_));
    output_.json({{"provenance", provenance_.json()}, {"entries", entries}, {"skipped", skipped_}});
  }

  const GoldenUpdateVerb& verb_;
  Output& output_;
  const CommonOptions silent_options_;
  const Output silent_;
  Machines machines_;
  LastLitScene last_;
  Provenance provenance_;
  GoldenManifest manifest_;
  std::vector<GoldenJob> jobs_;
  std::vector<GoldenRow> rows_;
  std::vector<std::string> skipped_;
};

int GoldenUpdateVerb::run() const {
  apply(options.common);
  require_folder_name(folder);
  if (command->get_option("--only")->count() > 0 && only.empty()) throw UserError("--only '': the pattern is empty");
  Output output(options.common, {}, folder);
  return GoldenUpdateRun(*this, output).run();
}

}  // namespace

Verb add_golden_update(CLI::App& golden) {
  CLI::App* command = golden.add_subcommand(
      "update", "draw golden images and keep them; without a scene and drawing options: all that are there, again");
  const auto verb = std::make_shared<GoldenUpdateVerb>();
  verb->command = command;
  command->add_option("folder", verb->folder, "folder of golden.json and the images; made where there is none")
      ->required()
      ->type_name("DIR");
  add_drawing_options(*command, verb->options);
  command
      ->add_option("--name", verb->name,
                   "what the entry is called (default: scene and technique); of several, what their names begin with")
      ->type_name("N");
  command->add_option("--only", verb->only, "draw again only entries whose names are like this: * any text, ? any one")
      ->type_name("PATTERN");
  add_common_options(*command, verb->options.common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

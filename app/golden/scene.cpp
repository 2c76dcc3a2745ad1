#include "app/golden/scene.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/report/mismatch.h"
#include "base/error.h"
#include "base/names.h"
#include "golden/content_hashes.h"
#include "golden/frame_file.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

// Large files are often kept elsewhere, and what is checked out is a text that says where.
bool is_lfs_pointer(const std::string& path) {
  constexpr std::string_view kBeginning = "version https://git-lfs.github.com/";
  char first[kBeginning.size()] = {};
  std::ifstream(path, std::ios::binary).read(first, sizeof first);
  return std::string_view(first, sizeof first) == kBeginning;
}

std::string size_text(const Frame& frame) { return fmt::format("{}x{}", frame.width, frame.height); }

// The image with the inputs that the shader has in the frame: where pixels are of the same triangle they are the same.
Frame with_inputs(Frame image, const Frame& frame) {
  image.attribute_names = frame.attribute_names;
  image.attribute_scalars = frame.attribute_scalars;
  image.attributes = frame.attributes;
  return image;
}

}  // namespace

GoldenScene load_golden_scene(const GoldenDrawing& drawing, const std::string& folder, const CommonOptions& common,
                              const Output& output, Machines& machines, LastLitScene& last) {
  const DrawingOptions options = parse_drawing(drawing, folder);
  if (const std::size_t frames = single_drawings(drawing, options.shading).size(); frames != 1)
    throw UserError(fmt::format("\"draw\" is of {} frames: name one technique, one map, one light", frames));
  CommonOptions own = common;
  own.seed = options.common.seed;
  GoldenScene scene;
  scene.subject = load_subject(options.subject, options.shading, own, output, {}, &last);
  std::vector<Shading> shadings = load_shadings(options.shading, scene.subject);
  TWINSHADE_CHECK_EQ(shadings.size(), std::size_t{1});
  scene.shading = std::move(shadings.front());
  scene.shader_file = options.shading.shader;
  if (!scene.shader_file.empty()) scene.outputs = machines.outputs(scene.shading.source);
  if (scene.outputs.empty()) scene.outputs.emplace_back();
  scene.files = files_read(options.subject, options.shading);
  if (last.lit) scene.files.insert(scene.files.end(), last.lit->scene.files.begin(), last.lit->scene.files.end());
  scene.bundle_hash = content_hash(scene.subject.bundle);
  scene.shader_hash = content_hash(scene.shading.source);
  return scene;
}

FrameOutput find_output(const GoldenScene& scene, const GoldenEntry& entry) {
  if (entry.output.empty()) return scene.outputs.front();
  for (const FrameOutput& output : scene.outputs)
    if (output.name == entry.output) return output;
  throw UserError(scene.shading.label() + ": the shader has no output " + entry.output + " any more");
}

CommonOptions without_results(CommonOptions options) {
  options.quiet = true;
  options.json.clear();
  return options;
}

void require_folder_name(const std::string& folder) {
  if (folder.empty()) throw UserError("'': the folder's name is empty");
  std::error_code code;
  if (fs::path(folder).filename() == kManifestName && fs::is_regular_file(folder, code))
    throw UserError(folder + ": name the folder that it lies in");
}

void require_manifest(const std::string& folder) {
  std::error_code code;
  if (fs::exists(manifest_path(folder), code)) return;
  throw UserError(
      fmt::format("{}: there is none yet; say what to draw, as twinshade golden update {} courtyard --technique h4,sh3",
                  manifest_path(folder), folder));
}

GoldenImage read_golden_image(const std::string& folder, const GoldenEntry& entry) {
  const std::string path = golden_image_path(folder, entry.name);
  GoldenImage image;
  std::error_code code;
  if (!fs::exists(path, code)) {
    image.trouble = GoldenResult::no_image;
    image.reason = path + ": there is no such file";
    return image;
  }
  image.trouble = GoldenResult::damaged;
  if (is_lfs_pointer(path)) {
    image.reason = path + ": Git LFS has left a pointer in the image's place: git lfs pull";
    return image;
  }
  try {
    Frame frame = read_frame_file(path);
    if (frame_hash(frame) == entry.frame) {
      image.trouble = GoldenResult::same;
      image.frame = std::move(frame);
    } else {
      image.reason = path + ": not the image that the manifest is about: its pixels have another hash";
      image.other_frame = frame_hash(frame);
    }
  } catch (const UserError& error) {
    image.reason = error.what();
  }
  return image;
}

void hold_to_image(GoldenRow& row, const Frame& image, const Frame& frame, std::uint64_t ulp,
                   const std::function<Frame()>& inputs) {
  if (image.width != frame.width || image.height != frame.height || image.color_scalar != frame.color_scalar) {
    row.result = GoldenResult::differs;
    row.error = image.color_scalar != frame.color_scalar
                    ? "the shader's output is of another type than the golden image"
                    : fmt::format("the frame is {}, the golden image {}", size_text(frame), size_text(image));
    return;
  }
  row.comparison = compare_frames(image, frame);
  if (row.comparison->equal()) {
    row.result = GoldenResult::same;
    return;
  }
  row.result = ulp > 0 && within_ulp(image, frame, ulp) ? GoldenResult::within : GoldenResult::differs;
  Comparison shown = *row.comparison;
  const bool same_surface = shown.coverage_differs == 0 && shown.id_differs == 0;
  if (same_surface && inputs) {
    const Frame captured = inputs();
    if (!captured.attribute_names.empty())
      shown = compare_frames(with_inputs(image, captured), with_inputs(frame, captured));
  }
  row.first_difference = difference_json(shown.first, image);
  row.description = describe_mismatch(row.name, "golden", row.on, shown, image);
}

bool is_like(const std::string& name, const std::string& pattern) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::vector<GoldenEntry> chosen_entries(const GoldenManifest& manifest, const std::string& only, bool required) {
  std::vector<GoldenEntry> chosen;
  std::vector<std::string> names;
  for (const GoldenEntry& entry : manifest.entries) {
    names.push_back(entry.name);
    if (only.empty() || is_like(entry.name, only)) chosen.push_back(entry);
  }
  if (!chosen.empty() || !required) return chosen;
  if (names.empty()) throw UserError(manifest_path(manifest.folder) + ": it has no entries");
  throw UserError("--only: " + unknown_name_message("entry", only, names));
}

}  // namespace twinshade

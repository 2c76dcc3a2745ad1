#include "app/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/names.h"
#include "lighting/bake.h"
#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

constexpr std::string_view kCoefficients = "coefficients_";

bool is_bundle_file(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return false;
  std::ifstream in(path, std::ios::binary);
  char first[64];
  in.read(first, sizeof first);
  return looks_like_bundle({first, std::size_t(in.gcount())});
}

// The names X of all "coefficients_X" in a shader: what it wants baked.
std::vector<const TechniqueInfo*> techniques_whose_coefficients_are_read(const std::string& text) {
  std::vector<const TechniqueInfo*> read;
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (const TechniqueInfo& technique : techniques()) {
    const std::string name = std::string(kCoefficients) + std::string(technique.name);
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if (end < text.size() && is_word(text[end])) continue;
      read.push_back(&technique);
      break;
    }
  }
  return read;
}

// make_bundle leaves a note. A bundle without one has no coefficients, whose storage then does not matter.
CoefficientStorage storage_of(const Bundle& bundle) {
  const std::string* note = bundle.find_note("coefficients");
  return note && *note == "vertex" ? CoefficientStorage::vertex : CoefficientStorage::lightmap;
}

Bundle bundle_from_file(const SubjectOptions& options) {
  if (!options.given.empty())
    throw UserError(
        fmt::format("{}: {} cannot change a bundle; bake it again with it", options.scene, options.given.front()));
  return read_bundle(options.scene);
}

Bundle bundle_from_scene(const SubjectOptions& options, const std::vector<const TechniqueInfo*>& baked,
                         const CommonOptions& common, const Output& output) {
  const Scene scene = load_scene(options.scene);
  for (const std::string& note : scene.notes) output.note(options.scene + ": " + note);
  Environment environment = load_environment(options.environment, options.clamp_radiance);
  if (options.rotation_degrees != 0) environment = rotate_environment(environment, options.rotation_degrees);

  BakeOptions bake;
  bake.lightmap_size = options.lightmap_size;
  bake.rays = options.rays;
  bake.seed = common.seed;
  bake.show_progress = !common.quiet;
  const LightBake light = bake_light(scene, environment, bake);

  FrameOptions frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.camera = scene.camera;
  if (options.camera) {
    frame.camera.eye = options.camera->eye;
    frame.camera.target = options.camera->target;
    frame.camera.vertical_fov_degrees = options.camera->vertical_fov_degrees;
  }
  frame.albedo = options.albedo;
  frame.normal_map = options.normal_map;
  return make_bundle(scene, light, baked, frame);
}

}  // namespace

bool wants_all(const ShadingOptions& options) {
  return options.shader.empty() && options.techniques.size() == 1 && options.techniques.front() == "all";
}

std::vector<const TechniqueInfo*> chosen_techniques(const ShadingOptions& options) {
  std::vector<const TechniqueInfo*> chosen;
  for (const std::string& name : options.techniques) {
    if (name != "all") {
      chosen.push_back(&find_technique(name));
      continue;
    }
    for (const TechniqueInfo& technique : techniques())
      if (can_read(technique, CoefficientStorage::lightmap)) chosen.push_back(&technique);
  }
  // Registry order, each once: the same choice gives the same bundle however it was spelt.
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

Subject load_subject(const SubjectOptions& options, const ShadingOptions& shading, const CommonOptions& common,
                     const Output& output) {
  // Names and shaders are checked before anything that takes long.
  const std::vector<const TechniqueInfo*> baked =
      shading.shader.empty() ? chosen_techniques(shading)
                             : techniques_whose_coefficients_are_read(load_shader(shading.shader).text);
  Subject subject;
  subject.bundle =
      is_bundle_file(options.scene) ? bundle_from_file(options) : bundle_from_scene(options, baked, common, output);
  subject.hash = bundle_hash(subject.bundle);
  subject.storage = storage_of(subject.bundle);
  return subject;
}

std::vector<Shading> load_shadings(const ShadingOptions& options, const Subject& subject) {
  std::vector<Shading> shadings;
  if (!options.shader.empty()) {
    shadings.push_back({options.shader, load_shader(options.shader)});
  } else {
    for (const TechniqueInfo* technique : chosen_techniques(options))
      shadings.push_back({std::string(technique->name), technique_source(*technique, subject.storage)});
  }
  return shadings;
}

}  // namespace twinshade

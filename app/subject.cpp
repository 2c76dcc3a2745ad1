#include "app/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "app/memory_needed.h"
#include "app/own_resources.h"
#include "base/error.h"
#include "base/names.h"
#include "base/words.h"
#include "bundle/uniform_text.h"
#include "cpu_shaders/translate/source_lines.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/bake.h"
#include "lighting/environment_light.h"
#include "lighting/material_textures.h"
#include "lighting/shader_code.h"
#include "lighting/visibility_textures.h"
#include "scenes/environment.h"
#include "scenes/model_camera.h"
#include "scenes/model_file.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

constexpr CoefficientStorage kStorages[] = {CoefficientStorage::lightmap, CoefficientStorage::vertex,
                                            CoefficientStorage::volume};

// A pipe or a device can be read once only, and no model is read from one: it is a bundle, or refused as none.
bool is_bundle_file(const std::string& path) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (!std::filesystem::is_regular_file(status))
    return std::filesystem::exists(status) && !std::filesystem::is_directory(status) && model_file_ending(path).empty();
  std::ifstream in(path, std::ios::binary);
  char first[64];
  in.read(first, sizeof first);
  return looks_like_bundle({first, std::size_t(in.gcount())});
}

// Where a scene's light can be kept. Nothing is gathered for lightmaps of procedural light.
bool can_keep(const Scene& scene, CoefficientStorage storage) {
  return storage != CoefficientStorage::lightmap || (!scene.lightmap_uvs.empty() && !scene.procedural_coefficients);
}

bool stores_visibility(const TechniqueInfo& technique) { return technique.weights != VisibilityWeights::none; }

// Visibility needs surfaces in the world.
bool can_keep(const Scene& scene, const TechniqueInfo& technique, CoefficientStorage storage) {
  return can_keep(scene, storage) && !(stores_visibility(technique) && scene.procedural_coefficients);
}

// All "coefficients_X" and "volume_X" in the code of a user's shader: what it wants baked.
std::vector<LitTechnique> coefficients_read(const std::string& code, const Scene& scene, LightSource light) {
  const bool per_vertex = light == LightSource::vertex || !can_keep(scene, CoefficientStorage::lightmap);
  std::vector<LitTechnique> read;
  for (const TechniqueInfo& technique : techniques()) {
    const std::string name(technique.name);
    if (contains_word(code, "coefficients_" + name))
      read.push_back({&technique, per_vertex ? CoefficientStorage::vertex : CoefficientStorage::lightmap});
    if (contains_word(code, "volume_" + name)) read.push_back({&technique, CoefficientStorage::volume});
  }
  return read;
}

// A uniform of a user's shader that nothing gives a value is refused before the scene is lit: that takes long. The only
// ones of scenes are those of baked light.
void require_initial_values(const ShaderSource& source, const std::vector<LitTechnique>& baked,
                            const std::vector<Uniform>& given) {
  Reflection reflection;
  try {
    reflection = translate(source).reflection;
  } catch (const UserError&) {  // OpenGL alone may take it
  }
  for (const ReflectedUniform& u : reflection.uniforms) {
    const bool of_light = !baked.empty() && (u.name.starts_with("volume_") || u.name.starts_with("light_"));
    if (of_light || !u.initial.empty()) continue;
    if (std::any_of(given.begin(), given.end(), [&](const Uniform& own) { return own.name == u.name; })) continue;
    throw UserError(SourceLines(source).declaration(u.name.substr(0, u.name.find_first_of(".["))).text() +
                    ": uniform \"" + u.name + "\" is none of a scene's and has no initial value: " +
                    initial_value_remedy(u.name, u.scalar, u.columns, u.rows, u.array_length) + ", or add --uniform " +
                    u.name + "=VALUE");
  }
}

// Whether a bundle has what a technique reads from a storage. A technique that is no basis of its own may read
// anything.
bool has_coefficients(const Bundle& bundle, const TechniqueInfo& technique, CoefficientStorage storage) {
  const std::string name(technique.name);
  if (stores_visibility(technique)) {
    const std::string weights = visibility_name(technique);
    const std::uint32_t quads = std::uint32_t(technique.count + 3) / 4;
    if (storage == CoefficientStorage::vertex)
      return bundle.find_attribute(fmt::format("{}[{}]", weights, quads - 1)) != nullptr;
    const Texture* texture = bundle.find_texture(weights);
    return storage == CoefficientStorage::lightmap && texture && stored_quads(*texture) >= quads;
  }
  if (!technique.is_basis) {
    const std::string* note = bundle.find_note("coefficients");
    return !note || note->empty() || contains_word(*note, std::string(storage_name(storage)));
  }
  switch (storage) {
    case CoefficientStorage::lightmap:
      return bundle.find_texture("coefficients_" + name) != nullptr;
    case CoefficientStorage::vertex:
      return bundle.find_attribute("coefficients_" + name + "[0]") != nullptr;
    case CoefficientStorage::volume:
      return bundle.find_texture("volume_" + name) != nullptr;
  }
  return false;
}

// What a message calls the place that light is read from.
std::string_view storage_words(CoefficientStorage storage) {
  switch (storage) {
    case CoefficientStorage::lightmap:
      return "a lightmap";
    case CoefficientStorage::vertex:
      return "vertices";
    case CoefficientStorage::volume:
      return "a volume";
  }
  return "";
}

// The storages to draw each technique from. has(technique, storage): whether it is there; missing(technique, storages):
// why it is in none of those that it could read.
template <class Has, class Missing>
void choose(Subject& subject, const std::vector<const TechniqueInfo*>& chosen, const ShadingOptions& shading,
            const Has& has, const Missing& missing) {
  for (const TechniqueInfo* technique : chosen) {
    std::vector<CoefficientStorage> unread, absent;
    const std::size_t before = subject.drawn.size();
    for (const CoefficientStorage storage : kStorages) {
      const bool asked = shading.light == LightSource::automatic || shading.light == LightSource::all ||
                         int(shading.light) == 1 + int(storage);
      if (!asked) continue;
      if (!can_read(*technique, storage)) {
        unread.push_back(storage);
      } else if (!has(*technique, storage)) {
        absent.push_back(storage);
      } else {
        subject.drawn.push_back({technique, storage});
        if (shading.light == LightSource::automatic) break;
      }
    }
    if (subject.drawn.size() > before) continue;
    const std::string reason = absent.empty()
                                   ? fmt::format("it does not read its light from {}", storage_words(unread.front()))
                                   : missing(*technique, absent);
    if (!wants_all(shading)) throw UserError(fmt::format("technique {}: {}", technique->name, reason));
    subject.skipped.emplace_back(technique->name, reason);
  }
}

Bundle bundle_from_file(const SubjectOptions& options, const CommonOptions& common) {
  std::vector<std::string> given = options.given;
  if (common.seed_given) given.emplace_back("--seed");
  if (!given.empty())
    throw UserError(fmt::format("{}: {} cannot change a bundle; bake it again with it", options.scene, given.front()));
  return read_bundle(options.scene);
}

Subject subject_from_file(const SubjectOptions& options, const ShadingOptions& shading, const CommonOptions& common) {
  Subject subject;
  subject.bundle = bundle_from_file(options, common);
  if (!shading.shader.empty()) {
    if (!shading.uniforms.empty() || !shading.textures.empty())
      add_own_resources(subject.bundle, OwnResources(load_fragment_shader(shading.shader, shading.source),
                                                     shading.uniforms, shading.textures));
    return subject;
  }
  choose(
      subject, chosen_techniques(shading), shading,
      [&](const TechniqueInfo& technique, CoefficientStorage storage) {
        return has_coefficients(subject.bundle, technique, storage);
      },
      [&](const TechniqueInfo& technique, const std::vector<CoefficientStorage>& storages) {
        std::vector<std::string_view> places(storages.size());
        std::transform(storages.begin(), storages.end(), places.begin(), storage_words);
        return fmt::format("{} has nothing for it in {}; bake it again with --technique {}", options.scene,
                           fmt::join(places, " or "), technique.name);
      });
  return subject;
}

// Whether the shader of a technique reads coefficients at all.
bool reads_coefficients(const LitTechnique& lit) {
  return lit.technique->is_basis ||
         technique_source(*lit.technique, lit.storage).text.find("coefficients_") != std::string::npos;
}

// What techniques of precomputed visibility read, from each storage that one of them is drawn from.
void add_visibility(Bundle& bundle, const SubjectOptions& options, const ShadingOptions& shading, const Scene& scene,
                    const Environment& environment, const std::vector<LitTechnique>& baked, const CommonOptions& common,
                    const Output& output) {
  VisibilityOptions bake;
  bake.lightmap_size = options.lightmap_size;
  bake.rays = options.visibility_rays;
  bake.seed = common.seed;
  bake.show_progress = !common.quiet;
  std::vector<VisibilityBake> bakes;
  for (const CoefficientStorage storage : kStorages) {
    const bool needed = std::any_of(baked.begin(), baked.end(), [&](const LitTechnique& lit) {
      return lit.storage == storage && stores_visibility(*lit.technique);
    });
    if (!needed) continue;
    bake.per_vertex = storage == CoefficientStorage::vertex;
    bakes.push_back(bake_visibility(scene, bake));
    if (const VisibilityBake& done = bakes.back(); done.rays_per_second > 0)
      output.note(fmt::format("visibility baked for {} {}: {:.2f} million rays a second, {:.1f} MiB", done.cells(),
                              storage == CoefficientStorage::vertex ? "vertices" : "texels",
                              done.rays_per_second * 1e-6, double(done.memory_bytes) * 0x1p-20));
  }
  if (bakes.empty()) return;
  VisibilityLighting lighting = options.visibility;
  lighting.maps = chosen_maps(shading);
  for (const SphereMapInfo* map : lighting.maps)
    if (lighting.map_width != 0 && !map->has_axes(lighting.map_width))
      output.note(
          fmt::format("{}: of an even width, {}, it has no texels along +-x and +-y, which normals of walls and "
                      "floors read; give an odd one (--map-width {})",
                      map->name, lighting.map_width, lighting.map_width - 1));
  add_visibility(bundle, scene, bakes, environment_radiance(environment, 6), baked, lighting);
}

Bundle bundle_from_scene(const SubjectOptions& options, const ShadingOptions& shading, const LitScene& lit_scene,
                         const std::vector<LitTechnique>& baked, const CommonOptions& common, const Output& output) {
  const auto& [scene, environment] = lit_scene;
  BakeOptions bake;
  bake.lightmap_size = options.lightmap_size;
  bake.rays = options.rays;
  bake.volume = options.volume;
  bake.probe_rays = options.probe_rays;
  bake.seed = common.seed;
  bake.show_progress = !common.quiet;
  std::vector<LightBake> lights;
  for (const CoefficientStorage storage : kStorages) {
    const bool needed = std::any_of(baked.begin(), baked.end(), [&](const LitTechnique& lit) {
      return lit.storage == storage && reads_coefficients(lit);
    });
    if (!needed) continue;
    bake.per_vertex = storage == CoefficientStorage::vertex;
    lights.push_back(storage == CoefficientStorage::volume ? bake_volume(scene, environment, bake)
                                                           : bake_light(scene, environment, bake));
  }

  Bundle bundle = make_bundle(scene, lights, baked, frame_options(options, scene));
  add_visibility(bundle, options, shading, scene, environment, baked, common, output);
  return bundle;
}

// Pictures of light with fewer rows are refined: by twice as many all integrals agree to a fraction of a percent.
constexpr std::uint32_t kFewRows = 32;

Environment load_refined(const std::string& name, bool clamp_radiance) {
  return refine_small_environment(load_environment(name, clamp_radiance), kFewRows);
}

}  // namespace

Environment load_light(const SubjectOptions& options) {
  Environment environment = load_refined(options.environment, options.clamp_radiance);
  if (!options.second_environment.empty())
    environment = blend_environments(environment, load_refined(options.second_environment, options.clamp_radiance),
                                     options.blend);
  if (options.rotation_degrees != 0) environment = rotate_environment(environment, options.rotation_degrees);
  return environment;
}

FrameOptions frame_options(const SubjectOptions& options, const Scene& scene) {
  FrameOptions frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.camera = scene.camera;
  if (scene.camera_frames && !options.camera)
    frame.camera = framing_camera(bounds_of(scene.positions), double(options.width) / options.height);
  if (options.camera) {
    const glm::dvec3 eye = options.camera->eye, target = options.camera->target;
    const double fov = options.camera->vertical_fov_degrees;
    const bool is_model = !model_file_ending(options.scene).empty();
    if (is_model) {
      frame.camera = camera_at(bounds_of(scene.positions), eye, target, fov);
    } else {
      frame.camera.eye = eye;
      frame.camera.target = target;
      frame.camera.vertical_fov_degrees = fov;
      frame.camera.up = up_or_north(frame.camera.up, eye, target);
    }
  }
  frame.albedo = options.albedo;
  frame.normal_map = options.normal_map;
  return frame;
}

void note_scene(const Output& output, const SubjectOptions& options, const Scene& scene) {
  for (const std::string& note : scene.notes) output.note(options.scene + ": " + note);
  for (const std::string& note : resampling_notes(scene, options.albedo, options.normal_map))
    output.note(options.scene + ": " + note);
}

bool wants_all(const ShadingOptions& options) {
  return options.shader.empty() && options.techniques.size() == 1 && options.techniques.front() == "all";
}

std::vector<const TechniqueInfo*> chosen_techniques(const ShadingOptions& options) {
  std::vector<const TechniqueInfo*> chosen;
  for (const std::string& name : options.techniques) {
    if (name == kReferenceTechnique) throw UserError(fmt::format("technique {}: {}", name, kReferenceReason));
    if (name != "all") {
      chosen.push_back(&find_technique(name));
      continue;
    }
    for (const TechniqueInfo& technique : techniques()) chosen.push_back(&technique);
  }
  // Registry order, each once: the same choice gives the same bundle however it was spelt.
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::vector<const SphereMapInfo*> chosen_maps(const ShadingOptions& options) {
  std::vector<const SphereMapInfo*> chosen;
  for (const std::string& name : options.maps)
    for (const SphereMapInfo& map : sphere_maps())
      if (name == "all" || &map == &find_sphere_map(name)) chosen.push_back(&map);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::vector<std::string> files_among(std::vector<std::string> names, const std::vector<std::string>& built_in) {
  std::erase_if(names, [&](const std::string& name) {
    return name.empty() || std::find(built_in.begin(), built_in.end(), name) != built_in.end();
  });
  return names;
}

std::vector<std::string> files_read(const SubjectOptions& options, const ShadingOptions& shading) {
  std::vector<std::string> files;
  if (!shading.shader.empty()) files = load_fragment_shader(shading.shader, shading.source).files;
  for (const std::string& given : shading.textures) files.push_back(texture_file(given));
  for (const auto& more : {files_among({options.scene}, scene_names()),
                           files_among({options.environment, options.second_environment}, environment_names())})
    files.insert(files.end(), more.begin(), more.end());
  return files;
}

void require_one_shading(const ShadingOptions& shading, const std::string& reason) {
  if (wants_all(shading) || (shading.shader.empty() && shading.techniques.size() != 1))
    throw UserError("--technique: " + reason + "; name one technique");
  if (shading.maps.size() != 1 || shading.maps.front() == "all") throw UserError("--map: " + reason + "; name one map");
  if (shading.light == LightSource::all)
    throw UserError("--light all: " + reason + "; name lightmap, vertex or volume");
}

void require_known(const ShadingOptions& shading) {
  if (!shading.shader.empty())
    load_fragment_shader(shading.shader, shading.source);
  else
    chosen_techniques(shading);
  chosen_maps(shading);
}

LitScene load_lit_scene(const SubjectOptions& options, const Output& output, const std::string& written) {
  require_frame_memory(options.width, options.height, "cpu");
  require_scene_memory(options);
  Scene scene = load_scene(options.scene, options.triangles, !options.camera);
  output.require_not_read(scene.files, written);
  note_scene(output, options, scene);
  Environment environment = load_light(options);
  if (!environment.note.empty()) output.note(environment.note);
  return {std::move(scene), std::move(environment)};
}

Subject plan_subject(const LitScene& lit, const SubjectOptions& options, const ShadingOptions& shading) {
  Subject subject;
  choose(
      subject, chosen_techniques(shading), shading,
      [&](const TechniqueInfo& technique, CoefficientStorage storage) {
        return can_keep(lit.scene, technique, storage);
      },
      [&](const TechniqueInfo&, const std::vector<CoefficientStorage>& storages) {
        return options.scene + (storages.back() == CoefficientStorage::lightmap
                                    ? " has no lightmap; use --light vertex"
                                    : " has no surfaces in the world whose visibility could be baked");
      });
  return subject;
}

Subject light_subject(const LitScene& lit, const SubjectOptions& options, const ShadingOptions& shading,
                      const CommonOptions& common, const Output& output) {
  Subject subject;
  std::vector<LitTechnique> baked;
  std::optional<OwnResources> own;
  if (shading.shader.empty()) {
    subject = plan_subject(lit, options, shading);
    baked = subject.drawn;
  } else {
    const ShaderSource source = load_fragment_shader(shading.shader, shading.source);
    baked = coefficients_read(code_of(source.text), lit.scene, shading.light);
    own.emplace(source, shading.uniforms, shading.textures);
    require_initial_values(source, baked, own->uniforms);
  }
  require_lightmap_memory(options, baked);
  require_vertex_memory(lit.scene.positions.size(), baked);
  subject.bundle = bundle_from_scene(options, shading, lit, baked, common, output);
  if (own) add_own_resources(subject.bundle, std::move(*own));
  return subject;
}

namespace {

const LitScene& lit_scene_of(const SubjectOptions& options, const Output& output, const std::string& written,
                             LastLitScene& last) {
  const std::string key = fmt::format("{} {} {} {} {}\n{}\n{}\n{}", options.triangles, options.camera.has_value(),
                                      options.rotation_degrees, options.blend, options.clamp_radiance, options.scene,
                                      options.environment, options.second_environment);
  if (last.lit && last.key == key) {
    output.require_not_read(last.lit->scene.files, written);
  } else {
    last.lit = load_lit_scene(options, output, written);
    last.key = key;
  }
  return *last.lit;
}

}  // namespace

Subject load_subject(const SubjectOptions& options, const ShadingOptions& shading, const CommonOptions& common,
                     const Output& output, const std::string& written, LastLitScene* last) {
  require_known(shading);
  LastLitScene own;
  Subject subject =
      is_bundle_file(options.scene)
          ? subject_from_file(options, shading, common)
          : light_subject(lit_scene_of(options, output, written, last ? *last : own), options, shading, common, output);
  if (wants_all(shading)) subject.skipped.emplace_back(kReferenceTechnique, kReferenceReason);
  subject.hash = bundle_hash(subject.bundle);
  return subject;
}

void note_precision(const Output& output, const ShaderSource& source, Precision precision) {
  if (precision != Precision::mediump || source.es) return;
  output.note(
      (source.files.empty() ? source.name : source.files[0]) +
      ": precision qualifiers mean something in GLSL ES alone, so --number mediump changes nothing here; float16 "
      "computes all in half");
}

std::vector<Shading> load_shadings(const ShadingOptions& options, const Subject& subject) {
  std::vector<Shading> shadings;
  if (!options.shader.empty()) {
    shadings.push_back({options.shader, "", "", load_fragment_shader(options.shader, options.source)});
  } else {
    const TexturePacking packing = texture_packing(subject.bundle);
    for (const LitTechnique& lit : subject.drawn) {
      const std::string name(lit.technique->name), light(storage_name(lit.storage));
      if (!reads_sphere_map(*lit.technique)) {
        shadings.push_back({name, light, "",
                            stores_visibility(*lit.technique)
                                ? visibility_source(*lit.technique, lit.storage, sphere_maps().front(), packing)
                                : technique_source(*lit.technique, lit.storage)});
        continue;
      }
      for (const SphereMapInfo* map : chosen_maps(options))
        shadings.push_back(
            {name, light, std::string(map->name), visibility_source(*lit.technique, lit.storage, *map, packing)});
    }
  }
  return shadings;
}

}  // namespace twinshade

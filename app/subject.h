// What is drawn, ready: a scene loaded, lit and baked, or a bundle file read.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/options.h"
#include "app/output.h"
#include "bundle/bundle.h"
#include "lighting/bake.h"
#include "lighting/registry.h"

namespace twinshade {

struct Subject {
  Bundle bundle;
  std::string hash;                 // of the bundle
  std::vector<LitTechnique> drawn;  // what to draw with, in registry order; none for a user's shader
  // With "all": techniques that cannot be lit as asked, and why.
  std::vector<std::pair<std::string, std::string>> skipped;
};

// A fragment shader to draw with.
struct Shading {
  std::string technique;  // as on the command line; a user's shader: its path
  std::string light;      // where it reads its coefficients, as on the command line; a user's shader: empty
  std::string map;        // sphere map of the tables that it looks up; empty: none
  ShaderSource source;

  std::string label() const {
    const std::string places = light + (map.empty() ? "" : ", " + map);
    return places.empty() ? technique : technique + " (" + places + ")";
  }
};

// The technique that has no shader, and why only render draws it.
inline constexpr const char* kReferenceTechnique = "reference";
inline constexpr const char* kReferenceReason =
    "it has no shader: the host traces rays from each pixel (twinshade render)";

// Whether --technique says "all".
bool wants_all(const ShadingOptions& options);
// The techniques named; all of them that have shaders for "all". UserError with the nearest names.
std::vector<const TechniqueInfo*> chosen_techniques(const ShadingOptions& options);

// The sphere maps named, in registry order, each once. UserError with the nearest names.
std::vector<const SphereMapInfo*> chosen_maps(const ShadingOptions& options);

// The names that are neither empty nor built in: files.
std::vector<std::string> files_among(std::vector<std::string> names, const std::vector<std::string>& built_in);
// The files that these options name, and those that the shader includes: what is written must not replace them. Not the
// images and buffers that a model names (Scene::files has them). UserError where the shader is none.
std::vector<std::string> files_read(const SubjectOptions& options, const ShadingOptions& shading);

// A scene under its light: what bundles of any technique are made from.
struct LitScene {
  Scene scene;
  Environment environment;
};

// What was loaded last, for subjects that follow one another and name the same: files are taken not to change
// meanwhile.
struct LastLitScene {
  std::string key;  // the options that it was loaded by
  std::optional<LitScene> lit;
};

// UserError where a technique, a map or the shader is none: to be asked before anything that takes long.
void require_known(const ShadingOptions& shading);

// UserError, with the reason, where the options stand for several shadings. reason: "render draws one".
void require_one_shading(const ShadingOptions& shading, const std::string& reason);

// Says aloud what the loaders had to say. UserError where the scene does not fit into memory, and where `written` or
// what the output writes would replace a file that it is read from.
LitScene load_lit_scene(const SubjectOptions& options, const Output& output, const std::string& written = {});
// What of it the chosen techniques would be drawn from: a subject without a bundle. UserError as of load_subject.
Subject plan_subject(const LitScene& lit, const SubjectOptions& options, const ShadingOptions& shading);
// Bakes what the chosen techniques or the shader read, as load_subject does; its hash is left out, which takes long.
Subject light_subject(const LitScene& lit, const SubjectOptions& options, const ShadingOptions& shading,
                      const CommonOptions& common, const Output& output);

// Loads, lights and bakes, or reads the bundle; says aloud what the loader had to say. The bundle carries the
// coefficients of the chosen techniques as --light says, or, for a user's shader, those that it names
// (coefficients_BASIS, volume_BASIS); nothing else is baked. UserError where a technique that was named cannot be lit
// so, and where `written` or what the output writes would replace a file that the model is read from. last: what may
// be used again, and is then replaced by what was loaded.
Subject load_subject(const SubjectOptions& options, const ShadingOptions& shading, const CommonOptions& common,
                     const Output& output, const std::string& written = {}, LastLitScene* last = nullptr);

// The environment, or the blend of two, rotated.
Environment load_light(const SubjectOptions& options);
FrameOptions frame_options(const SubjectOptions& options, const Scene& scene);
// What is said of a scene once it is read.
void note_scene(const Output& output, const SubjectOptions& options, const Scene& scene);

// Where --number mediump changes nothing, since the shader's GLSL gives precision qualifiers no meaning.
void note_precision(const Output& output, const ShaderSource& source, Precision precision);

// The shaders to draw with, in registry order.
std::vector<Shading> load_shadings(const ShadingOptions& options, const Subject& subject);

}  // namespace twinshade

// What is drawn, ready: a scene loaded, lit and baked, or a bundle file read.
#pragma once

#include <memory>
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

// What was read last, for subjects that follow one another and name the same: files are taken not to change meanwhile.
struct SubjectInputs {
  std::string scene_key, light_key;  // the options that they were read by
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Environment> light;
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

// The names that are neither empty nor built in: files.
std::vector<std::string> files_among(std::vector<std::string> names, const std::vector<std::string>& built_in);
// The files that these options name, and those that the shader includes: what is written must not replace them. Not the
// images and buffers that a model names (Scene::files has them). UserError where the shader is none.
std::vector<std::string> files_read(const SubjectOptions& options, const ShadingOptions& shading);

// Loads, lights and bakes, or reads the bundle; says aloud what the loader had to say. The bundle carries the
// coefficients of the chosen techniques as --light says, or, for a user's shader, those that it names
// (coefficients_BASIS, volume_BASIS); nothing else is baked. UserError where a technique that was named cannot be lit
// so, and where `written` or what the output writes would replace a file that the model is read from. inputs: what may
// be used again, and is then replaced by what was read.
Subject load_subject(const SubjectOptions& options, const ShadingOptions& shading, const CommonOptions& common,
                     const Output& output, const std::string& written = {}, SubjectInputs* inputs = nullptr);

// The environment, or the blend of two, rotated.
Environment load_light(const SubjectOptions& options);
FrameOptions frame_options(const SubjectOptions& options, const Scene& scene);
// What is said of a scene once it is read.
void note_scene(const Output& output, const SubjectOptions& options, const Scene& scene);

// The shaders to draw with, in registry order.
std::vector<Shading> load_shadings(const ShadingOptions& options, const Subject& subject);

}  // namespace twinshade

// What is drawn, ready: a scene loaded, lit and baked, or a bundle file read.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "app/output.h"
#include "bundle/bundle.h"
#include "lighting/registry.h"

namespace twinshade {

struct Subject {
  Bundle bundle;
  std::string hash;  // of the bundle
  CoefficientStorage storage = CoefficientStorage::lightmap;
};

// A fragment shader to draw with.
struct Shading {
  std::string technique;  // as on the command line; a user's shader: its path
  ShaderSource source;
};

// Whether --technique says "all".
bool wants_all(const ShadingOptions& options);
// The techniques named; all of them for "all". UserError with the nearest names.
std::vector<const TechniqueInfo*> chosen_techniques(const ShadingOptions& options);

// Loads, lights and bakes, or reads the bundle; says aloud what the loader had to say. The bundle carries the
// coefficients of the chosen techniques, or, for a user's shader, of those whose coefficients it names.
Subject load_subject(const SubjectOptions& options, const ShadingOptions& shading, const CommonOptions& common,
                     const Output& output);

// The shaders to draw with, in registry order.
std::vector<Shading> load_shadings(const ShadingOptions& options, const Subject& subject);

}  // namespace twinshade

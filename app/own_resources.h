// What the command line gives a user's shader beside the scene: --uniform and --texture.
#pragma once

#include "app/texture_files.h"
#include "app/uniform_values.h"

namespace twinshade {

struct OwnResources {
  std::vector<Uniform> uniforms;
  std::vector<Texture> textures;

  // UserError as of uniform_values and texture_files.
  OwnResources(const ShaderSource& source, const std::vector<std::string>& given_uniforms,
               const std::vector<std::string>& given_textures)
      : uniforms(uniform_values(source, given_uniforms)), textures(texture_files(source, given_textures)) {}
};

// Beside the bundle's own, which stay. UserError for a name that the bundle has.
void add_own_resources(Bundle& bundle, OwnResources own);

}  // namespace twinshade

// What a technique stores of a scene's light, apart from the bundle: how large it is, and what a smaller format leaves
// of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bundle/bundle.h"
#include "lighting/bake.h"
#include "lighting/sphere_maps.h"
#include "lighting/texel_storage.h"

namespace twinshade {

// Parts of a bundle: coefficients, weights of visibility, tables, and the uniforms that go with them.
struct StoredLight {
  std::vector<Texture> textures;
  std::vector<Attribute> attributes;
  std::vector<Uniform> uniforms;
  std::uint64_t numbers = 0;  // in textures and attributes, without what only fills up texels
  std::uint64_t columns = 0;  // of which each has a range of its own as unorm8: a channel of a layer or an attribute

  // unorm8 with two floats a column; uniforms are floats always.
  std::uint64_t bytes(TexelStorage storage) const;
};

// What `lit` reads in a bundle that was made for it, among others, with TexturePacking::layers. Weights of visibility
// are those that it reads alone. map: of its tables, where it has some.
StoredLight stored_light(const Bundle& bundle, const LitTechnique& lit, const SphereMapInfo* map);

// What is left of the numbers, each column's range its own (lighting/texel_storage.h); uniforms as they are.
StoredLight through_storage(const StoredLight& light, TexelStorage storage);

// A scene's bundle whose light is exchanged, so that techniques are drawn each from what it alone reads.
class RelitBundle {
 public:
  // scene: a bundle without light, make_bundle of no lights.
  explicit RelitBundle(Bundle scene);
  // Until the next call.
  const Bundle& lit_by(const StoredLight& light);

 private:
  Bundle bundle_;
  std::size_t textures_, attributes_, uniforms_;  // the scene's own, which come first
};

}  // namespace twinshade

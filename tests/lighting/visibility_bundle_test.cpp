// What shaders of precomputed visibility find in a bundle: textures in layers and packed, and inputs at the edge of
// sense.
#include "lighting/visibility_bundle.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "lighting/visibility_textures.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

constexpr std::size_t kLightCount = 36 * 3;

std::vector<double> some_light() {
  std::vector<double> light(kLightCount);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = (i % 7 == 0 ? 1.0 : -0.2) / double(1 + i);
  return light;
}

// Two cells that see different things: a floor under half a roof.
Scene roofed_floor() {
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, {0, 0}, 0.5f);
  add_rectangle(scene, {-1, 0.5f, -1}, {1, 0, 0}, {0, 0, 2}, {0.6f, 0}, 0.3f);
  return scene;
}

VisibilityBake baked(const Scene& scene, bool per_vertex = false) {
  VisibilityOptions options;
  options.lightmap_size = 16, options.rays = 64, options.per_vertex = per_vertex;
  options.use_cache = false, options.show_progress = false;
  return bake_visibility(scene, options);
}

Bundle bundle_of(const Scene& scene, const VisibilityBake& bake, const std::vector<double>& light,
                 std::initializer_list<const char*> names, const VisibilityLighting& options) {
  std::vector<LitTechnique> wanted;
  for (const char* name : names) wanted.push_back({&find_technique(name), bake.storage});
  FrameOptions frame;
  frame.width = 8, frame.height = 8, frame.camera.eye = {0, 2, 3};
  Bundle bundle = make_bundle(scene, std::span<const LightBake>(), wanted, frame);
  add_visibility(bundle, scene, {&bake, 1}, light, wanted, options);
  validate(bundle, "test");
  return bundle;
}

VisibilityLighting lighting_with(TexturePacking packing, int width = 8) {
  VisibilityLighting lighting;
  lighting.maps = {&find_sphere_map("dual_paraboloid")};
  lighting.map_width = width;
  lighting.packing = packing;
  return lighting;
}

const Texture& texture(const Bundle& bundle, const std::string& name) {
  const Texture* found = bundle.find_texture(name);
  REQUIRE_MESSAGE(found, name);
  return *found;
}

bool all_finite(const Bundle& bundle) {
  const auto finite = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
  };
  return std::all_of(bundle.textures.begin(), bundle.textures.end(),
                     [&](const Texture& t) { return finite(t.texels); }) &&
         std::all_of(bundle.uniforms.begin(), bundle.uniforms.end(),
                     [&](const Uniform& u) { return finite(u.values); });
}

}  // namespace

TEST_CASE("packed textures hold the values of layered ones: four a texel, hemispheres and lightmaps side by side") {
  const Scene scene = roofed_floor();
  const VisibilityBake bake = baked(scene);
  const auto bundle = [&](TexturePacking packing) {
    return bundle_of(scene, bake, some_light(), {"unc3", "pca8", "preconv"}, lighting_with(packing));
  };
  const Bundle layered = bundle(TexturePacking::layers), packed = bundle(TexturePacking::dx9);
  CHECK(texture_packing(layered) == TexturePacking::layers);
  CHECK(texture_packing(packed) == TexturePacking::dx9);

  const Texture &arrays = texture(layered, "visibility_pca8"), &beside = texture(packed, "visibility_pca8");
  CHECK(beside.kind == TextureKind::two_d);
  CHECK(beside.width == 2 * 16);
  CHECK(beside.height == 16);
  CHECK(stored_quads(arrays) == 2);
  CHECK(stored_quads(beside) == 2);
  int different = 0;
  for (std::size_t quad = 0; quad < 2; ++quad)
    for (std::size_t y = 0; y < 16; ++y)
      for (std::size_t i = 0; i < 16 * 4; ++i)
        different += arrays.texels[(quad * 16 + y) * 64 + i] != beside.texels[(y * 2 + quad) * 64 + i];
  CHECK(different == 0);

  // Map m, layer l, texel x, y of tables that are 8 wide, in layers: 10 maps, as fives
  const auto colour = [](const Texture& t, std::size_t map, std::size_t l, std::size_t x, std::size_t y,
                         std::size_t c) { return t.texels[(((l * 10 + map) * 8 + y) * 8 + x) * 4 + c]; };
  const auto in_band = [](const Texture& t, std::size_t band, std::size_t l, std::size_t x, std::size_t y,
                          std::size_t c) { return t.texels[((band * 8 + y) * 16 + l * 8 + x) * 4 + c]; };
  const Texture &pca = texture(layered, "tables_pca8_dual_paraboloid"),
                &bands = texture(packed, "tables_pca8_dual_paraboloid"),
                &sh3 = texture(layered, "tables_sh3_dual_paraboloid"),
                &sh3_bands = texture(packed, "tables_sh3_dual_paraboloid");
  CHECK(pca.layers == 2 * 10);  // the mean, then the components
  CHECK(sh3.layers == 2 * 10);
  CHECK(bands.width == 2 * 8);
  CHECK(bands.height == (1 + 2 * 3) * 8);      // the mean, two groups of four components
  CHECK(sh3_bands.height == (2 * 3 + 1) * 8);  // two groups of four coefficients and the ninth
  CHECK(texture(packed, "tables_preconv_dual_paraboloid").height == 8);
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t y = 0; y < 8; ++y)
      for (std::size_t x = 0; x < 8; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          different += in_band(bands, 0, l, x, y, c) != colour(pca, 0, l, x, y, c);
          different += in_band(sh3_bands, 6, l, x, y, c) != colour(sh3, 8, l, x, y, c);
          for (std::size_t row = 0; row < 8; ++row) {
            different += in_band(bands, 1 + row / 4 * 3 + c, l, x, y, row % 4) != colour(pca, 1 + row, l, x, y, c);
            different += in_band(sh3_bands, row / 4 * 3 + c, l, x, y, row % 4) != colour(sh3, row, l, x, y, c);
          }
        }
  CHECK(different == 0);
}

TEST_CASE("maps have their usual widths unless another one is asked for, and the notes say which") {
  const Scene scene = roofed_floor();
  const VisibilityBake visibility = baked(scene);
  VisibilityLighting lighting;
  lighting.maps = {&find_sphere_map("cube"), &find_sphere_map("octahedral")};
  const std::vector<double> light = some_light();
  const Bundle usual = bundle_of(scene, visibility, light, {"unc3"}, lighting);
  CHECK(texture(usual, "tables_sh3_cube").width == 32);
  CHECK(texture(usual, "tables_sh3_octahedral").width == 33);
  REQUIRE(usual.find_note("map_width"));
  CHECK(*usual.find_note("map_width") == "32 33");
  lighting.map_width = 16;
  CHECK(texture(bundle_of(scene, visibility, light, {"unc3"}, lighting), "tables_sh3_octahedral").width == 16);
}

TEST_CASE("textures that would be too large are refused in one line, with the remedy") {
  const auto weight = [](std::size_t, std::size_t) { return 0.0f; };
  CHECK_THROWS_WITH_AS(weights_texture("visibility_sh", 2048, 9, TexturePacking::dx9, weight),
                       "visibility_sh packed into one texture would be 18432 x 2048 texels, more than 16384; make the "
                       "lightmap smaller or use packing layers",
                       UserError);
  const Scene scene = floor_scene();
  const VisibilityBake bake = baked(scene);
  CHECK_THROWS_AS(bundle_of(scene, bake, some_light(), {"unc6"}, lighting_with(TexturePacking::dx9, 640)), UserError);
  CHECK_THROWS_AS(bundle_of(scene, bake, some_light(), {"unc6"}, lighting_with(TexturePacking::layers, 4096)),
                  UserError);
  CHECK_THROWS_AS(bundle_of(scene, bake, some_light(), {"unc3"}, lighting_with(TexturePacking::layers, 4097)),
                  UserError);
  CHECK_THROWS_AS(bundle_of(scene, bake, some_light(), {"unc3"}, lighting_with(TexturePacking::layers, -1)), UserError);
}

TEST_CASE("no light, one texel a map, more components than coefficients, all seeing the same: defined numbers") {
  const Scene scene = roofed_floor();
  const VisibilityBake bake = baked(scene);
  const auto techniques = {"unc3", "pca24", "pca_alu", "preconv", "sh2_product"};
  for (const TexturePacking packing : {TexturePacking::layers, TexturePacking::dx9}) {
    // No light
    const Bundle black =
        bundle_of(scene, bake, std::vector<double>(kLightCount, 0.0), techniques, lighting_with(packing));
    for (const Texture& t : black.textures) {
      if (t.name.rfind("tables_", 0) != 0) continue;
      CAPTURE(t.name);
      CHECK(std::all_of(t.texels.begin(), t.texels.end(), [](float value) { return value == 0 || value == 1; }));
    }
    // One texel a layer
    CHECK(all_finite(bundle_of(scene, bake, some_light(), techniques, lighting_with(packing, 1))));
    // 24 components of four coefficients: the others weigh nothing
    VisibilityLighting order2 = lighting_with(TexturePacking::layers);
    order2.order = 2;
    const Bundle few = bundle_of(scene, bake, some_light(), techniques, order2);
    CHECK(all_finite(few));
    const Texture& weights = texture(few, "visibility_pca24");
    CHECK(std::all_of(weights.texels.begin() + 16 * 16 * 4, weights.texels.end(),
                      [](float value) { return value == 0; }));
    CHECK(std::any_of(weights.texels.begin(), weights.texels.begin() + 16 * 16 * 4,
                      [](float value) { return value != 0; }));
  }
}

TEST_CASE("where all cells see the same, components weigh nothing and the mean is what they see") {
  const Scene scene = floor_scene();
  VisibilityBake bake = baked(scene);
  for (std::size_t cell = 1; cell < bake.cells(); ++cell)  // no noise of rays
    std::copy_n(bake.sh.begin(), kVisibilityCount, bake.sh.begin() + std::ptrdiff_t(cell * kVisibilityCount));
  const Bundle bundle = bundle_of(scene, bake, some_light(), {"pca4"}, lighting_with(TexturePacking::layers));
  CHECK(all_finite(bundle));
  for (const float value : texture(bundle, "visibility_pca4").texels) CHECK(std::fabs(value) < 1e-6f);
}

TEST_CASE("each count of components has weights of its own; techniques of one count share them") {
  const Scene scene = roofed_floor();
  const VisibilityBake bake = baked(scene);
  const Bundle together =
      bundle_of(scene, bake, some_light(), {"pca4", "pca8", "pca12", "pca_alu"}, lighting_with(TexturePacking::layers));
  for (const char* name : {"pca4", "pca8", "pca12"}) {
    const Bundle alone = bundle_of(scene, bake, some_light(), {name}, lighting_with(TexturePacking::layers));
    const std::string weights = std::string("visibility_") + name;
    CAPTURE(weights);
    CHECK(texture(together, weights).texels == texture(alone, weights).texels);
  }
  CHECK(std::count_if(together.textures.begin(), together.textures.end(),
                      [](const Texture& t) { return t.name.rfind("visibility_", 0) == 0; }) == 3);
}

TEST_CASE("one triangle without coordinates keeps its weights at the vertices, in every storage") {
  Scene scene = floor_scene();
  scene.lightmap_uvs.clear();
  scene.indices.resize(3), scene.triangle_materials.resize(1);
  const VisibilityBake bake = baked(scene);
  REQUIRE(bake.storage == CoefficientStorage::vertex);
  for (const TexelStorage storage : {TexelStorage::float32, TexelStorage::half, TexelStorage::unorm8})
    for (const TexturePacking packing : {TexturePacking::layers, TexturePacking::dx9}) {
      VisibilityLighting lighting = lighting_with(packing);
      lighting.storage = storage;
      const Bundle bundle = bundle_of(scene, bake, some_light(), {"unc3", "pca4"}, lighting);
      CHECK(all_finite(bundle));
      const Attribute* first = bundle.find_attribute("visibility_sh[0]");
      REQUIRE(first);
      CHECK(first->components == 4);
      for (std::size_t vertex = 0; vertex < 3; ++vertex)
        for (std::size_t i = 0; i < 4; ++i)
          CHECK(first->values[vertex * 4 + i] ==
                doctest::Approx(bake.sh[vertex * kVisibilityCount + i]).epsilon(0.01).scale(1));
      CHECK(bundle.find_attribute("visibility_sh[2]"));
    }
}

TEST_CASE("half and eight bits round weights by as much as they may") {
  const Scene scene = roofed_floor();
  const VisibilityBake bake = baked(scene);
  const auto stored = [&](TexelStorage storage) {
    VisibilityLighting lighting = lighting_with(TexturePacking::layers);
    lighting.storage = storage;
    return texture(bundle_of(scene, bake, some_light(), {"unc3"}, lighting), "visibility_sh").texels;
  };
  const std::vector<float> exact = stored(TexelStorage::float32), half = stored(TexelStorage::half),
                           bytes = stored(TexelStorage::unorm8);
  float low = 0, high = 0;  // of the first weight
  for (std::size_t i = 0; i < 16 * 16 * 4; i += 4) low = std::min(low, exact[i]), high = std::max(high, exact[i]);
  double worst_byte = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CHECK(std::fabs(half[i] - exact[i]) <= std::fabs(exact[i]) * 0x1p-11 + 0x1p-25);
    if (i < 16 * 16 * 4 && i % 4 == 0) worst_byte = std::max(worst_byte, std::fabs(double(bytes[i]) - exact[i]));
  }
  CHECK(half != exact);
  CHECK(worst_byte > 0);
  CHECK(worst_byte <= (high - low) / 255 * 0.5001);
}

}  // namespace twinshade

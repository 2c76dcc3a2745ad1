// What techniques store of light: which numbers, how many bytes, and what formats leave of them.
#include "lighting/stored_light.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "lighting/visibility_bundle.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

constexpr std::uint32_t kMapSize = 16;
constexpr int kTableWidth = 4;

struct Lit {
  Scene scene = floor_scene();
  std::vector<LitTechnique> wanted;
  Bundle bundle;

  Lit(CoefficientStorage storage, std::initializer_list<const char*> names) {
    const Environment environment = uniform_environment(1);
    for (const char* name : names) wanted.push_back({&find_technique(name), storage});
    BakeOptions bake;
    bake.lightmap_size = kMapSize, bake.rays = 16, bake.volume = {3, 2, 1}, bake.probe_rays = 16;
    bake.per_vertex = storage == CoefficientStorage::vertex;
    bake.use_cache = false, bake.show_progress = false;
    const LightBake light = storage == CoefficientStorage::volume ? bake_volume(scene, environment, bake)
                                                                  : bake_light(scene, environment, bake);
    bundle = make_bundle(scene, {&light, 1}, wanted, frame());
    VisibilityOptions visible;
    visible.lightmap_size = kMapSize, visible.rays = 16, visible.per_vertex = bake.per_vertex;
    visible.use_cache = false, visible.show_progress = false;
    if (storage == CoefficientStorage::volume) return;
    const VisibilityBake seen = bake_visibility(scene, visible);
    VisibilityLighting lighting;
    lighting.maps = {&find_sphere_map("octahedral")};
    lighting.map_width = kTableWidth;
    std::vector<double> radiance(36 * 3, 0.0);
    for (std::size_t c = 0; c < 3; ++c) radiance[c] = std::sqrt(4 * 3.14159265358979);
    add_visibility(bundle, scene, {&seen, 1}, radiance, wanted, lighting);
  }
  static FrameOptions frame() {
    FrameOptions frame;
    frame.width = 8, frame.height = 8, frame.camera.eye = {0, 2, 3};
    return frame;
  }
  StoredLight light(std::size_t i) const { return stored_light(bundle, wanted[i], &find_sphere_map("octahedral")); }
};

Texture one_layer(std::vector<float> reds) {
  Texture texture;
  texture.name = "coefficients_test";
  texture.kind = TextureKind::two_d_array;
  texture.width = std::uint32_t(reds.size()), texture.height = 1;
  for (const float red : reds) texture.texels.insert(texture.texels.end(), {red, 0.1f, -3, 1});
  return texture;
}

std::vector<float> reds(const StoredLight& light) {
  std::vector<float> values;
  for (std::size_t i = 0; i < light.textures[0].texels.size(); i += 4) values.push_back(light.textures[0].texels[i]);
  return values;
}

}  // namespace

TEST_CASE("bytes: three numbers a coefficient of each texel, vertex or probe; others' coefficients are not counted") {
  const Lit maps(CoefficientStorage::lightmap, {"lightmap", "h4", "sh3", "shlmap"});
  CHECK(maps.light(1).bytes(TexelStorage::float32) == 16 * 16 * 4 * 3 * 4);
  CHECK(maps.light(2).bytes(TexelStorage::half) == 16 * 16 * 9 * 3 * 2);
  CHECK(maps.light(2).bytes(TexelStorage::unorm8) == 16 * 16 * 9 * 3 + 9 * 3 * 8);
  CHECK(maps.light(2).textures.size() == 1);
  CHECK(maps.light(3).bytes(TexelStorage::half) == maps.light(2).bytes(TexelStorage::half));  // it reads those of sh3
  const Lit vertices(CoefficientStorage::vertex, {"h4", "sh3"});
  CHECK(vertices.light(0).bytes(TexelStorage::float32) == 4 * 4 * 3 * 4);
  CHECK(vertices.light(0).attributes.size() == 4);
  const Lit volume(CoefficientStorage::volume, {"sh2", "zh3"});
  CHECK(volume.light(1).bytes(TexelStorage::float32) == 3 * 2 * 1 * 5 * 3 * 4 + 9 * 4);  // and where probes are
  CHECK(volume.light(1).uniforms.size() == 3);
  CHECK(volume.light(1).uniforms[0].name == "volume_origin");
}

TEST_CASE("weights of visibility are those that a technique reads itself, tables are counted with them") {
  const Lit maps(CoefficientStorage::lightmap, {"unc6", "unc3", "pca4", "sh2_product", "preconv"});
  const auto numbers = [&](std::size_t i) { return maps.light(i).numbers; };
  CHECK(numbers(0) == 16 * 16 * 36 + 4 * 4 * 36 * 3);
  CHECK(numbers(1) == 16 * 16 * 9 + 4 * 4 * 9 * 3);
  CHECK(numbers(2) == 16 * 16 * 4 + 4 * 4 * 5 * 3);  // and the mean's table
  CHECK(numbers(3) == 16 * 16 * 4);
  CHECK(numbers(4) == 16 * 16 * 1 + 4 * 4 * 1 * 3);
  CHECK(maps.light(3).bytes(TexelStorage::unorm8) == 16 * 16 * 4 + 4 * 8 + 4 * 3 * 4);  // uniforms stay floats

  // unc3's ninth weight is alone in its texel, as where unc6 is not there
  const Lit alone(CoefficientStorage::lightmap, {"unc3"});
  REQUIRE(maps.light(1).textures[0].layers == 3);
  CHECK(maps.light(1).textures[0].texels == alone.light(0).textures[0].texels);
  const Lit vertices(CoefficientStorage::vertex, {"unc6", "unc3"}),
      vertices_alone(CoefficientStorage::vertex, {"unc3"});
  REQUIRE(vertices.light(1).attributes.size() == 3);
  CHECK(vertices.light(1).attributes[2].values == vertices_alone.light(0).attributes[2].values);
}

TEST_CASE("unorm8: each channel of a layer has its own range, whose ends and constants are exact") {
  StoredLight light;
  light.textures = {one_layer({-1, 0.3f, 0.301f, 50}), one_layer({1, 1, 1, 1})};
  const StoredLight stored = through_storage(light, TexelStorage::unorm8);
  CHECK(reds(stored)[0] == -1);
  CHECK(reds(stored)[3] == 50);
  CHECK(reds(stored)[1] == doctest::Approx(-1 + 51.0 * 7 / 255));  // (0.3 + 1) / 51 * 255 = 6.5
  CHECK(stored.textures[1].texels == light.textures[1].texels);
  for (std::size_t i = 0; i < 16; i += 4) {
    CHECK(stored.textures[0].texels[i + 1] == 0.1f);
    CHECK(stored.textures[0].texels[i + 2] == -3);
    CHECK(stored.textures[0].texels[i + 3] == 1);
  }
}

TEST_CASE("half: eleven bits of each number; float32 is left as it is, and so are uniforms") {
  StoredLight light;
  light.textures = {one_layer({1.0f / 3, 2049, 70000, 0})};
  light.uniforms = {{"light_sh2", Scalar::f32, 1, 1, 0, {1.0f / 3}}};
  light.attributes = {{"coefficients_test[0]", Scalar::f32, 3, {1.0f / 3, 0, 2051}}};
  const StoredLight stored = through_storage(light, TexelStorage::half);
  CHECK(reds(stored)[0] == 1365.0f / 4096);
  CHECK(reds(stored)[1] == 2048);
  CHECK(std::isinf(reds(stored)[2]));
  CHECK(stored.attributes[0].values[2] == 2052);
  CHECK(stored.uniforms[0].values[0] == 1.0f / 3);
  CHECK(through_storage(light, TexelStorage::float32).textures[0].texels == light.textures[0].texels);
}

TEST_CASE("a bundle's light is exchanged: nothing of the last one stays") {
  const Lit maps(CoefficientStorage::lightmap, {"h4", "sh2_product"});
  RelitBundle relit(make_bundle(maps.scene, std::span<const LightBake>(), std::vector<LitTechnique>(), Lit::frame()));
  const std::size_t textures = relit.lit_by({}).textures.size();
  CHECK(relit.lit_by(maps.light(1)).find_texture("visibility_sh") != nullptr);
  CHECK(relit.lit_by(maps.light(1)).find_uniform("light_sh2") != nullptr);
  const Bundle& bundle = relit.lit_by(maps.light(0));
  validate(bundle, "test");
  CHECK(bundle.find_texture("coefficients_h4") != nullptr);
  CHECK(bundle.find_texture("visibility_sh") == nullptr);
  CHECK(bundle.find_uniform("light_sh2") == nullptr);
  CHECK(relit.lit_by({}).textures.size() == textures);
}

TEST_CASE("maps are halved down to one texel, odd ones to odd ones, which have texels on the axes") {
  const auto widths = [](int width) {
    std::vector<int> list{width};
    while (SphereMapInfo::half(list.back()) != list.back()) list.push_back(SphereMapInfo::half(list.back()));
    return list;
  };
  CHECK(widths(32) == std::vector{32, 16, 8, 4, 2, 1});
  CHECK(widths(33) == std::vector{33, 17, 9, 5, 3, 1});
  VisibilityLighting lighting;
  lighting.map_halvings = 2;
  CHECK(table_width(find_sphere_map("cube"), lighting) == 8);
  CHECK(table_width(find_sphere_map("octahedral"), lighting) == 9);
  lighting.map_width = 20;
  CHECK(table_width(find_sphere_map("octahedral"), lighting) == 5);
}

}  // namespace twinshade

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <set>
#include <string>

#include "base/error.h"
#include "base/portable_math.h"
#include "lighting/bake.h"
#include "lighting/camera.h"
#include "lighting/material_textures.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

LightBake flat_light(CoefficientStorage storage, std::uint32_t width, std::uint32_t height) {
  LightBake light;
  light.storage = storage;
  light.width = width, light.height = height;
  light.sh.assign(std::size_t(width) * height * 75, 0.0f);
  for (std::size_t cell = 0; cell < std::size_t(width) * height; ++cell)
    for (int c = 0; c < 3; ++c) light.sh[cell * 75 + c] = float(cell + 1) * float(c + 1);
  light.notes = {{"scene", "test"}};
  return light;
}

std::vector<const TechniqueInfo*> named(std::initializer_list<const char*> names) {
  std::vector<const TechniqueInfo*> list;
  for (const char* name : names) list.push_back(&find_technique(name));
  return list;
}

TEST_CASE("camera: the target is in the middle, near and far planes are the ends of depth") {
  Camera camera;
  camera.eye = {1, 2, 3}, camera.target = {4, 2, -1};
  camera.near_plane = 0.5, camera.far_plane = 50, camera.vertical_fov_degrees = 90;
  const CameraTransform transform(camera, 2);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec4 middle = transform.clip(camera.target);
  CHECK(std::abs(middle.x) < 1e-12);
  CHECK(std::abs(middle.y) < 1e-12);
  CHECK(middle.w == doctest::Approx(5).epsilon(1e-14));
  const glm::dvec4 near = transform.clip(camera.eye + forward * 0.5), far = transform.clip(camera.eye + forward * 50.0);
  CHECK(near.z == doctest::Approx(-near.w).epsilon(1e-12));
  CHECK(far.z == doctest::Approx(far.w).epsilon(1e-12));
  const glm::dvec4 top = transform.clip(camera.target + glm::dvec3(0, 5, 0));
  CHECK(top.y == doctest::Approx(top.w).epsilon(1e-12));  // 90 degrees: as high as far
  const glm::dvec4 right = transform.clip(camera.target + glm::cross(forward, glm::dvec3(0, 1, 0)) * 10.0);
  CHECK(right.x == doctest::Approx(right.w).epsilon(1e-12));  // aspect 2
}

TEST_CASE("an orthographic camera: as high everywhere, depth in proportion to distance") {
  Camera camera;
  camera.eye = {1, 2, 3}, camera.target = {4, 2, -1};
  camera.near_plane = 0, camera.far_plane = 50, camera.orthographic_height = 10;
  const CameraTransform transform(camera, 2);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye), up(0, 1, 0);
  for (const double distance : {0.0, 12.5, 50.0}) {
    const glm::dvec4 at = transform.clip(camera.eye + forward * distance + up * 5.0 + glm::cross(forward, up) * 10.0);
    CHECK(at.x == doctest::Approx(1).epsilon(1e-12));
    CHECK(at.y == doctest::Approx(1).epsilon(1e-12));
    CHECK(at.z == doctest::Approx(distance / 25 - 1).epsilon(1e-12));
    CHECK(at.w == 1);
  }
}

TEST_CASE("cameras that see nothing are refused") {
  for (int change = 0; change < 5; ++change) {
    Camera camera;
    if (change == 0) camera.target = camera.eye;
    if (change == 1) camera.target = camera.eye + camera.up;
    if (change == 2) camera.vertical_fov_degrees = 180;
    if (change == 3) camera.far_plane = camera.near_plane;
    if (change == 4) camera.near_plane = NAN;
    CHECK_THROWS_AS(CameraTransform(camera, 1), UserError);
  }
}

TEST_CASE("the flat lightmap of a sun two degrees above the ground has its cosine") {
  Environment environment = uniform_environment(0, 256);
  environment.radiance[62 * 256 + 37] = glm::vec3(3e5f, 2e5f, 1e5f);
  const double top = std::cos(portable::kPi * 62 / 128), bottom = std::cos(portable::kPi * 63 / 128);
  const double expected = 2 * portable::kPi / 256 * (top * top - bottom * bottom) / 2;  // of radiance 1
  BakeOptions bake;
  bake.lightmap_size = 16, bake.rays = 4096, bake.use_cache = false, bake.show_progress = false;
  Scene scene = floor_scene();
  const Bundle mapped = make_bundle(scene, bake_light(scene, environment, bake), named({"lightmap"}), FrameOptions());
  const Texture* texture = mapped.find_texture("coefficients_lightmap");
  REQUIRE(texture != nullptr);
  double mean[3] = {};
  for (int cell = 0; cell < 256; ++cell)
    for (int c = 0; c < 3; ++c) mean[c] += texture->texels[cell * 4 + c] / 256;
  for (int c = 0; c < 3; ++c) CHECK(mean[c] == doctest::Approx((3 - c) * 1e5 * expected).epsilon(2e-3));

  scene.lightmap_uvs.clear();
  const Bundle vertices = make_bundle(scene, bake_light(scene, environment, bake), named({"lightmap"}), FrameOptions());
  const Attribute* attribute = vertices.find_attribute("coefficients_lightmap[0]");
  REQUIRE(attribute != nullptr);
  for (int c = 0; c < 3; ++c) CHECK(attribute->values[c] == doctest::Approx((3 - c) * 1e5 * expected).epsilon(2e-2));
}

TEST_CASE("lightmap storage: a texture array for each basis that a technique reads, valid and complete") {
  const Scene scene = floor_scene();
  FrameOptions options;
  options.width = 100, options.height = 60;
  const Bundle bundle =
      make_bundle(scene, flat_light(CoefficientStorage::lightmap, 4, 4), named({"sh2", "cutout", "facets"}), options);
  validate(bundle, "test");
  CHECK(bundle.find_texture("coefficients_h4") != nullptr);
  CHECK(bundle.find_texture("coefficients_h6") == nullptr);
  const Texture* sh2 = bundle.find_texture("coefficients_sh2");
  REQUIRE(sh2 != nullptr);
  CHECK(sh2->layers == 4);
  CHECK(sh2->wrap == Wrap::clamp_to_edge);
  for (int cell = 0; cell < 16; ++cell)
    for (int c = 0; c < 3; ++c)
      CHECK(sh2->texels[cell * 4 + c] == doctest::Approx((cell + 1) * (c + 1) * 3.14159265358979).epsilon(1e-6));
  for (const char* name : {"v_uv", "v_material", "v_position", "v_lightmap_uv"})
    CHECK(bundle.find_attribute(name) != nullptr);
  REQUIRE(bundle.find_note("techniques") != nullptr);
  CHECK(*bundle.find_note("techniques") == "sh2 cutout facets");
  CHECK(*bundle.find_note("scene") == "test");
}

TEST_CASE("vertex storage: an attribute for each coefficient") {
  Scene scene = floor_scene();
  scene.lightmap_uvs.clear();
  const Bundle bundle =
      make_bundle(scene, flat_light(CoefficientStorage::vertex, 4, 1), named({"sh3"}), FrameOptions());
  validate(bundle, "test");
  for (int i = 0; i < 9; ++i) {
    const Attribute* attribute = bundle.find_attribute("coefficients_sh3[" + std::to_string(i) + "]");
    REQUIRE(attribute != nullptr);
    CHECK(attribute->components == 3);
    for (int v = 0; v < 4; ++v)
      CHECK(std::abs(attribute->values[v * 3 + 1] - (i == 0 ? (v + 1) * 2 * 3.14159265358979 : 0)) < 1e-5);
  }
  CHECK(bundle.find_attribute("v_lightmap_uv") == nullptr);
}

TEST_CASE("coefficients that shaders name in comments and names of files alone are not stored") {
  Scene scene = floor_scene();
  const auto coefficients = [](const Bundle& bundle) {
    std::set<std::string> names;
    for (const Texture& texture : bundle.textures) names.insert(texture.name);
    for (const Attribute& attribute : bundle.attributes)
      names.insert(attribute.name.substr(0, attribute.name.find('[')));
    std::erase_if(names, [](const std::string& name) {
      return !name.starts_with("coefficients_") && !name.starts_with("volume_");
    });
    return names;
  };
  using Names = std::set<std::string>;
  const LightBake maps = flat_light(CoefficientStorage::lightmap, 4, 4),
                  vertices = flat_light(CoefficientStorage::vertex, 4, 1);
  for (const std::string technique : {"lightmap", "sh2", "hl2", "h6"}) {
    CAPTURE(technique);
    const Names one{"coefficients_" + technique};
    CHECK(coefficients(make_bundle(scene, maps, named({technique.c_str()}), FrameOptions())) == one);
    CHECK(coefficients(make_bundle(scene, vertices, named({technique.c_str()}), FrameOptions())) == one);
  }
  LightBake volume = flat_light(CoefficientStorage::volume, 4, 4);
  volume.volume = {2, 4, 2};
  CHECK(coefficients(make_bundle(scene, volume, named({"sh2"}), FrameOptions())) == Names{"volume_sh2"});
}

TEST_CASE("pictures of other sizes than their array's are said, the budget where it makes them smaller") {
  Scene scene = floor_scene();
  const auto add = [&](std::uint32_t width, std::uint32_t height) {
    scene.materials.push_back({"m", glm::vec3(1), int(scene.images.size()), -1});
    scene.images.push_back({width, height, std::vector<float>(std::size_t(width) * height * 4, 0.5f)});
  };
  add(4, 2);
  add(4, 2);
  CHECK(resampling_notes(scene, true, true).empty());
  add(8, 1);
  const std::string layers = ", one size for the layers of all materials";
  CHECK(resampling_notes(scene, true, true) ==
        std::vector<std::string>{"3 of 3 colour pictures are resampled to 8 x 2" + layers});
  CHECK(resampling_notes(scene, false, true).empty());
  add(65536, 1);
  add(1, 65536);
  CHECK(resampling_notes(scene, true, true) ==
        std::vector<std::string>{"5 of 5 colour pictures are resampled to 2048 x 2048" + layers +
                                 ": at 65536 x 65536 they would take more than 512 MiB"});
}

TEST_CASE("clip positions of a scene replace the camera's and are fitted to the viewport") {
  Scene scene = floor_scene();
  scene.clip_positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0.5f, 1}, {-2, 2, 0, 2}};
  FrameOptions options;
  options.width = 64, options.height = 48;
  const Bundle bundle = make_bundle(scene, flat_light(CoefficientStorage::vertex, 4, 1), named({"facets"}), options);
  std::vector<float> expected;
  for (const glm::vec4& p : scene.clip_positions) expected.insert(expected.end(), {p.x, p.y, p.z, p.w});
  fit_to_viewport(expected, 64, 48);
  CHECK(bundle.clip_positions == expected);
}

TEST_CASE("materials: a layer each, of one size, the albedo multiplied in, one by one where there is nothing to see") {
  Scene scene = floor_scene();
  add_rectangle(scene, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0}, 1, 1);
  scene.materials.push_back({"checked", {0.5f, 1, 0.25f}, 0, 1});
  scene.images.push_back({2, 1, {1, 0, 0.5f, 1, 0, 1, 0.5f, 1}});
  scene.images.push_back({1, 2, {0, 0, 2, 1, 3, 0, 4, 1}});
  const Texture albedo = albedo_maps(scene, true), normal = normal_maps(scene, true);
  CHECK(albedo.layers == 2);
  CHECK(albedo.width == 2);
  CHECK(albedo.height == 1);
  CHECK(albedo.wrap == Wrap::repeat);
  CHECK(albedo.texels == std::vector<float>{0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1,  //
                                            0.5f, 0, 0.125f, 1, 0, 1, 0.125f, 1});
  CHECK(normal.texels == std::vector<float>{0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0.6f, 0, 0.8f, 1});
  CHECK(albedo_maps(scene, false).texels == std::vector<float>(8, 1.0f));
  CHECK(normal_maps(scene, false).texels == std::vector<float>{0, 0, 1, 1, 0, 0, 1, 1});

  CHECK(resampling_notes(scene, true, true).empty());

  const Bundle bundle =
      make_bundle(scene, flat_light(CoefficientStorage::lightmap, 1, 1), named({"facets"}), FrameOptions());
  const Attribute* material = bundle.find_attribute("v_material");
  REQUIRE(material != nullptr);
  CHECK(material->scalar == Scalar::i32);
  for (int v = 0; v < 8; ++v) CHECK(std::bit_cast<std::int32_t>(material->values[v]) == (v < 4 ? 0 : 1));
}

TEST_CASE("frames without size are refused") {
  for (const std::uint32_t size : {0u, 16385u}) {
    FrameOptions options;
    options.width = size;
    CHECK_THROWS_AS(
        make_bundle(floor_scene(), flat_light(CoefficientStorage::lightmap, 1, 1), named({"facets"}), options),
        UserError);
  }
}

}  // namespace
}  // namespace twinshade

#include <assimp/scene.h>
#include <doctest/doctest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/file.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_model.h"
#include "scenes/material_image.h"
#include "scenes/scene.h"
#include "tests/scenes/image_writers.h"
#include "tests/scenes/model_writers.h"
#include "tests/scenes/notes.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using glm::dvec3;
using nlohmann::json;
using twinshade::test::file_names;
using twinshade::test::has_note;

namespace {

const std::string kBoomBox = TWINSHADE_SOURCE_DIR "/../shared/models/BoomBox/BoomBox.gltf";

std::string save(const TemporaryFolder& folder, GltfWriter& writer, const std::string& name = "m") {
  folder.write(name + ".bin", writer.binary);
  return folder.write(name + ".gltf", writer.gltf(name + ".bin"));
}

// A PNG with one colour per texel, row 0 on top.
std::string png(const TemporaryFolder& folder, const std::string& name, int width, int height,
                const std::vector<std::uint8_t>& rgb) {
  write_image(folder.name(name), width, height, 3, rgb);
  return folder.name(name);
}

void check_valid(const Scene& scene) {
  const std::size_t count = scene.positions.size();
  REQUIRE(scene.normals.size() == count);
  REQUIRE(scene.tangents.size() == count);
  REQUIRE(scene.uvs.size() == count);
  REQUIRE(scene.indices.size() == 3 * scene.triangle_materials.size());
  std::vector<std::uint32_t> material(count, ~0u);
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    REQUIRE(scene.indices[i] < count);
    REQUIRE(scene.triangle_materials[i / 3] < scene.materials.size());
    std::uint32_t& m = material[scene.indices[i]];
    REQUIRE((m == ~0u || m == scene.triangle_materials[i / 3]));
    m = scene.triangle_materials[i / 3];
  }
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const dvec3 n(scene.normals[i]), t(scene.tangents[i]);
    worst = std::max({worst, std::fabs(glm::length(n) - 1), std::fabs(glm::length(t) - 1), std::fabs(glm::dot(n, t))});
  }
  CHECK(worst < 3e-7);
}

}  // namespace

TEST_CASE("a square comes in with v turned up, tangents along u, light per vertex") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  for (const std::string& file : {save(folder, writer), folder.write("m.glb", writer.glb())}) {
    const Scene scene = load_scene(file);
    check_valid(scene);
    REQUIRE(scene.positions.size() == 4);
    CHECK(scene.triangle_count() == 2);
    CHECK(scene.has_uvs);
    CHECK(scene.lightmap_uvs.empty());
    CHECK(has_note(scene, "per vertex"));
    CHECK(has_note(scene, "MikkTSpace"));
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(scene.uvs[i] == glm::vec2(scene.positions[i]));
      CHECK(scene.tangents[i] == glm::vec4(1, 0, 0, 1));
    }
    // The camera sees all of it.
    const dvec3 forward = glm::normalize(scene.camera.target - scene.camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, scene.camera.up)), up = glm::cross(right, forward);
    const double slope = std::tan(0.5 * scene.camera.vertical_fov_degrees * 3.14159265358979 / 180);
    for (const glm::vec3& p : scene.positions) {
      const dvec3 to = dvec3(p) - scene.camera.eye;
      CHECK(std::fabs(glm::dot(to, right)) < slope * glm::dot(to, forward));
      CHECK(std::fabs(glm::dot(to, up)) < slope * glm::dot(to, forward));
      CHECK(glm::dot(to, forward) > scene.camera.near_plane);
      CHECK(glm::dot(to, forward) < scene.camera.far_plane);
    }
  }
}

TEST_CASE("node transforms are baked: translation, rotation, scale, matrix, parents, mirroring") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  // Child: turned by 90 degrees about z, twice as large; parent: mirrored in x and moved.
  const double h = std::sqrt(0.5);
  writer.root["nodes"] =
      json::array({{{"children", {1}}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}},
                   {{"mesh", 0}, {"rotation", {0, 0, h, h}}, {"scale", {2, 2, 2}}, {"translation", {1, 0, 0}}}});
  const Scene scene = load_scene(save(folder, writer));
  check_valid(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 uv(scene.uvs[i]);  // the square's own x, y
    const dvec3 turned(-2 * uv.y + 1, 2 * uv.x, 0), expected(10 - turned.x, 20 + turned.y, 30);
    CHECK(glm::length(dvec3(scene.positions[i]) - expected) < 1e-5);
    CHECK(glm::length(dvec3(scene.normals[i]) - dvec3(0, 0, 1)) < 1e-6);
    CHECK(glm::length(dvec3(scene.tangents[i]) - dvec3(0, 1, 0)) < 1e-6);  // of u
    CHECK(scene.tangents[i].w == -1);
  }
  const auto corner = [&](int k) { return dvec3(scene.positions[scene.indices[std::size_t(k)]]); };
  CHECK(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z > 0);  // still counter-clockwise outside
}

TEST_CASE("the file's own tangents are kept, their sign turned by a mirroring node") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  primitive["attributes"]["TANGENT"] =
      writer.floats({0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1}, "VEC4", 4);
  writer.mesh(primitive);
  for (double mirror : {1.0, -1.0}) {
    writer.root["nodes"][0]["scale"] = {1, mirror, 1};
    const Scene scene = load_scene(save(folder, writer));
    check_valid(scene);
    CHECK(!has_note(scene, "MikkTSpace"));
    for (const glm::vec4& t : scene.tangents) {
      CHECK(glm::length(dvec3(t) - dvec3(0.6, 0.8 * mirror, 0)) < 1e-6);
      CHECK(t.w == -mirror);
    }
  }
}

TEST_CASE("the file's own tangents are kept whichever uvs the normal map is on") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  primitive["attributes"]["TEXCOORD_1"] = primitive["attributes"]["TEXCOORD_0"];
  primitive["attributes"]["TANGENT"] = writer.floats({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, "VEC4", 4);
  primitive["material"] = 0;
  writer.mesh(primitive);
  const std::string image = read_file(png(folder, "n.png", 1, 1, {128, 128, 255}));
  writer.root["textures"] = json::array({{{"source", 0}}});
  writer.root["images"] = json::array({{{"bufferView", writer.view(image.data(), image.size())}}});
  for (const int set : {0, 1}) {
    writer.root["materials"] = json::array({{{"normalTexture", {{"index", 0}, {"texCoord", set}}}}});
    const Scene scene = load_scene(save(folder, writer));
    CAPTURE(set);
    CHECK(!has_note(scene, "no tangents"));
    for (const glm::vec4& t : scene.tangents) CHECK(t == glm::vec4(0, 1, 0, -1));
  }
}

TEST_CASE("metals are drawn as matt surfaces, which is said where there are any") {
  const TemporaryFolder folder;
  for (const double metallic : {0.0, 0.25, 1.0}) {
    GltfWriter writer;
    json primitive = writer.square();
    primitive["material"] = 0;
    writer.mesh(primitive);
    writer.root["materials"].push_back({{"pbrMetallicRoughness", json::object()}});
    if (metallic < 1)
      writer.root["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = metallic;  // 1 is meant else
    CHECK(has_note(load_scene(save(folder, writer)), "metals") == (metallic > 0));
  }
}

TEST_CASE("without normals they are made flat, without uvs frames come from the normal; both are said") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square(false, false);
  writer.root["materials"] = json::array(
      {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}},
        {"normalTexture", {{"index", 0}}}}});
  writer.root["textures"] = json::array({{{"source", 0}}});
  writer.root["images"] = json::array({{{"uri", "n.png"}}});
  png(folder, "n.png", 1, 1, {128, 128, 255});
  primitive["material"] = 0;
  writer.mesh(primitive);
  const Scene scene = load_scene(save(folder, writer));
  check_valid(scene);
  CHECK(!scene.has_uvs);
  CHECK(has_note(scene, "no normals"));
  CHECK(has_note(scene, "no UVs"));
  CHECK(scene.materials[0].albedo == glm::vec3(0.25f, 0.5f, 1));
  CHECK(scene.materials[0].normal_image == -1);
  CHECK(scene.materials[0].albedo_image == -1);
  for (const glm::vec3& n : scene.normals) CHECK(n == glm::vec3(0, 0, 1));
}

TEST_CASE("images: sRGB decoded, bottom row first, normals unit with their scale, from files, data URIs and GLB") {
  TemporaryFolder folder;
  // 2 x 2, upper row red-ish values 0, 64; lower row 128, 255.
  png(folder, "colour map.png", 2, 2, {0, 10, 20, 64, 10, 20, 128, 10, 20, 255, 10, 20});
  png(folder, "n.png", 1, 1, {191, 128, 255});
  const auto load = [&](int kind) {
    GltfWriter writer;
    json primitive = writer.square();
    primitive["material"] = 0;
    writer.mesh(primitive);
    writer.root["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                             {"normalTexture", {{"index", 1}, {"scale", 0.5}}}}});
    writer.root["textures"] = json::array({{{"source", 0}}, {{"source", 1}}});
    if (kind == 0) writer.root["images"] = json::array({{{"uri", "colour%20map.png"}}, {{"uri", "n.png"}}});
    if (kind == 1)
      for (const char* name : {"colour map.png", "n.png"}) {
        const std::string bytes = read_file(folder.name(name));
        writer.root["images"].push_back(
            {{"bufferView", writer.view(bytes.data(), bytes.size())}, {"mimeType", "image/png"}});
      }
    return load_scene(kind == 0 ? save(folder, writer) : folder.write("m.glb", writer.glb()));
  };
  for (int kind : {0, 1}) {
    const Scene scene = load(kind);
    CHECK(file_names(scene) == (kind == 0 ? std::set<std::string>{"m.gltf", "m.bin", "colour map.png", "n.png"}
                                          : std::set<std::string>{"m.glb"}));
    REQUIRE(scene.materials.size() == 1);
    const Image &albedo = scene.images[std::size_t(scene.materials[0].albedo_image)],
                &normal = scene.images[std::size_t(scene.materials[0].normal_image)];
    REQUIRE(albedo.texels.size() == 16);
    const double expected[4] = {128, 255, 0, 64};  // bottom row first
    for (std::size_t i = 0; i < 4; ++i) {
      const double c = expected[i] / 255, linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      CHECK(albedo.texels[4 * i] == doctest::Approx(linear).epsilon(1e-6));
      CHECK(albedo.texels[4 * i + 3] == 1);
    }
    const dvec3 n = glm::normalize(dvec3((191 / 127.5 - 1) * 0.5, (128 / 127.5 - 1) * 0.5, 1));
    for (int c = 0; c < 3; ++c) CHECK(normal.texels[std::size_t(c)] == doctest::Approx(n[c]).epsilon(1e-6));
  }
  CHECK(srgb_decoded(1) == 1);
  CHECK(srgb_decoded(0) == 0);
}

TEST_CASE("KHR_texture_transform moves uvs as the extension says; normalised and quantised attributes are converted") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square(true, false);
  primitive["attributes"]["TEXCOORD_0"] =
      writer.accessor(std::vector<std::uint16_t>{0, 65535, 65535, 65535, 65535, 0, 0, 0}, "VEC2", 5123, 4, true);
  primitive["material"] = 0;
  writer.mesh(primitive);
  writer.root["extensionsRequired"] = {"KHR_texture_transform", "KHR_mesh_quantization"};
  writer.root["materials"] = json::array(
      {{{"pbrMetallicRoughness",
         {{"baseColorTexture",
           {{"index", 0},
            {"extensions",
             {{"KHR_texture_transform", {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"rotation", 0.5}}}}}}}}}}});
  writer.root["textures"] = json::array({{{"source", 0}}});
  writer.root["images"] = json::array({{{"uri", "c.png"}}});
  png(folder, "c.png", 1, 1, {1, 2, 3});
  const Scene scene = load_scene(save(folder, writer));
  check_valid(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    // uv = translation * rotation * scale * uv, v downwards; rotation counter-clockwise seen on the image.
    const double u = scene.positions[i].x, v = 1 - scene.positions[i].y;
    const double c = std::cos(0.5), s = std::sin(0.5);
    CHECK(scene.uvs[i].x == doctest::Approx(0.25 + c * 2 * u + s * 3 * v).epsilon(1e-6));
    CHECK(scene.uvs[i].y == doctest::Approx(1 - (0.5 - s * 2 * u + c * 3 * v)).epsilon(1e-6));
  }
}

TEST_CASE("second uvs become the lightmap's if they are in range and do not overlap") {
  TemporaryFolder folder;
  const auto load = [&](const std::vector<float>& second) {
    GltfWriter writer;
    json primitive = writer.square();
    primitive["attributes"]["TEXCOORD_1"] = writer.floats(second, "VEC2", 2);
    writer.mesh(primitive);
    return load_scene(save(folder, writer));
  };
  const Scene good = load({0.1f, 0.9f, 0.9f, 0.9f, 0.9f, 0.1f, 0.1f, 0.1f});
  REQUIRE(good.lightmap_uvs.size() == 4);
  CHECK(!has_note(good, "per vertex"));
  CHECK(good.lightmap_uvs[0].y == doctest::Approx(0.1));
  const Scene folded = load({0.1f, 0.9f, 0.9f, 0.9f, 0.9f, 0.1f, 0.8f, 0.8f});  // the second triangle lies on the first
  CHECK(folded.lightmap_uvs.empty());
  CHECK(has_note(folded, "overlap"));
  CHECK(has_note(load({0.1f, 0.9f, 1.5f, 0.9f, 0.9f, 0.1f, 0.1f, 0.1f}), "outside [0, 1]"));
  CHECK(has_note(load({0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f}), "no area"));
}

TEST_CASE("triangle strips, fans and unindexed lists; points are left out and said") {
  TemporaryFolder folder;
  for (int mode : {4, 5, 6, 0}) {
    GltfWriter writer;
    json primitive = writer.square();
    primitive["mode"] = mode;
    primitive["indices"] = writer.indices(mode == 5   ? std::vector<std::uint16_t>{0, 1, 3, 2}
                                          : mode == 6 ? std::vector<std::uint16_t>{0, 1, 2, 3}
                                                      : std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3});
    writer.mesh(primitive);
    if (mode == 0) {
      CHECK(user_error([&] { load_scene(save(folder, writer)); }).find("no triangles") != std::string::npos);
      continue;
    }
    const Scene scene = load_scene(save(folder, writer));
    check_valid(scene);
    CHECK(scene.triangle_count() == 2);
    for (std::size_t t = 0; t < 2; ++t) {
      const auto p = [&](std::size_t k) { return dvec3(scene.positions[scene.indices[3 * t + k]]); };
      CHECK(glm::cross(p(1) - p(0), p(2) - p(0)).z == doctest::Approx(1));
    }
  }
}

TEST_CASE("sparse accessors replace what they name") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  writer.mesh(primitive);
  const std::vector<std::uint16_t> which = {2};
  const std::vector<float> value = {1, 1, 7};
  json& accessor = writer.root["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  accessor["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", writer.view(which.data(), 2)}, {"componentType", 5123}}},
                        {"values", {{"bufferView", writer.view(value.data(), 12)}}}};
  const Scene scene = load_scene(save(folder, writer));
  bool found = false;
  for (const glm::vec3& p : scene.positions) found = found || p == glm::vec3(1, 1, 7);
  CHECK(found);
}

TEST_CASE("required extensions that are not supported are refused by name, optional ones are not") {
  TemporaryFolder folder;
  GltfWriter writer;
  writer.mesh(writer.square());
  writer.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  CHECK(load_scene(save(folder, writer)).triangle_count() == 2);
  writer.root["extensionsRequired"] = {"KHR_materials_ior", "KHR_draco_mesh_compression"};
  for (const std::string& file : {save(folder, writer), folder.write("m.glb", writer.glb())}) {
    const std::string message = user_error([&] { load_scene(file); });
    CHECK(message.find(file) == 0);
    CHECK(message.find("KHR_draco_mesh_compression") != std::string::npos);
  }
}

TEST_CASE("every truncation and every kind of damage is refused in one line that names the file") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  primitive["material"] = 0;
  writer.mesh(primitive);
  const std::string image = read_file(png(folder, "c.png", 8, 8, std::vector<std::uint8_t>(192, 7)));
  writer.root["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  writer.root["textures"] = json::array({{{"source", 0}}});
  writer.root["images"] = json::array({{{"bufferView", writer.view(image.data(), image.size())}}});
  const std::string whole = writer.glb();
  const auto check_refused = [&](const std::string& file, const std::string& what) {
    const std::string message = user_error([&] { load_scene(file); });
    INFO(what << ": " << message);
    CHECK(message.find(file + ": ") == 0);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < 400);
  };
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40)
    check_refused(folder.write("t.glb", whole.substr(0, size)), std::to_string(size));
  CHECK(load_scene(folder.write("t.glb", whole)).triangle_count() == 2);

  folder.write("m.bin", writer.binary);
  const std::string text = writer.gltf("m.bin");
  for (std::size_t size = 0; size < text.size(); size += 1 + size / 20)
    check_refused(folder.write("t.gltf", text.substr(0, size)), std::to_string(size));
  folder.write("m.bin", writer.binary.substr(0, 40));
  check_refused(folder.write("t.gltf", text), "short buffer");
  std::filesystem::remove(folder.name("m.bin"));
  check_refused(folder.write("t.gltf", text), "no buffer");
  folder.write("m.bin", writer.binary);

  const auto damaged = [&](const char* what, auto change) {
    json root = json::parse(text);
    change(root);
    check_refused(folder.write("d.gltf", root.dump()), what);
  };
  damaged("version", [](json& r) { r["asset"]["version"] = "1.0"; });
  damaged("no asset", [](json& r) { r.erase("asset"); });
  damaged("accessor beyond view", [](json& r) { r["accessors"][0]["count"] = 5; });
  damaged("huge accessor", [](json& r) { r["accessors"][0]["count"] = 4000000000u; });
  damaged("negative count", [](json& r) { r["accessors"][0]["count"] = -1; });
  damaged("view beyond buffer", [](json& r) { r["bufferViews"][0]["byteLength"] = 1u << 30; });
  damaged("overflowing offset", [](json& r) { r["bufferViews"][0]["byteOffset"] = 18446744073709551615ull; });
  damaged("accessor index", [](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; });
  damaged("wrong type", [](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = "x"; });
  damaged("indices are floats", [](json& r) { r["meshes"][0]["primitives"][0]["indices"] = 0; });
  damaged("mesh index", [](json& r) { r["nodes"][0]["mesh"] = 4; });
  damaged("node cycle", [](json& r) { r["nodes"][0]["children"] = {0}; });
  damaged("scene index", [](json& r) { r["scene"] = 3; });
  damaged("material index", [](json& r) { r["meshes"][0]["primitives"][0]["material"] = 3; });
  damaged("texture index", [](json& r) { r["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 3; });
  damaged("image source", [](json& r) { r["textures"][0]["source"] = 3; });
  damaged("image missing", [](json& r) { r["images"][0] = {{"uri", "none.png"}}; });
  folder.write("cut.png", image.substr(0, 60));
  damaged("image damaged", [](json& r) { r["images"][0] = {{"uri", "cut.png"}}; });
  damaged("image on the net", [](json& r) { r["images"][0] = {{"uri", "https://example.org/a.png"}}; });
  damaged("image not base64", [](json& r) { r["images"][0] = {{"uri", "data:image/png;base64,@@@"}}; });
  damaged("image truncated", [](json& r) { r["bufferViews"].back()["byteLength"] = 60; });
  damaged("component type", [](json& r) { r["accessors"][0]["componentType"] = 1; });
  damaged("zero stride", [](json& r) { r["bufferViews"][0]["byteStride"] = 0; });
  damaged("no meshes", [](json& r) {
    r.erase("nodes");
    r["scenes"][0].erase("nodes");
  });

  // An index beyond the vertices, and a position that is not a number.
  GltfWriter other;
  json bad = other.square();
  bad["indices"] = other.indices({0, 1, 9});
  other.mesh(bad);
  check_refused(save(folder, other, "o"), "vertex index");
  GltfWriter third;
  json nan = third.square();
  nan["attributes"]["POSITION"] = third.floats({0, 0, 0, 1, 0, 0, 1, std::nanf(""), 0, 0, 1, 0}, "VEC3", 3);
  third.mesh(nan);
  check_refused(save(folder, third, "p"), "NaN position");
  check_refused(folder.name("none.gltf"), "no file");
}

TEST_CASE("random damage to a file never does worse than a refusal") {
  TemporaryFolder folder;
  GltfWriter writer;
  json primitive = writer.square();
  writer.mesh(primitive);
  const std::string whole = writer.glb();
  std::uint32_t state = 1;
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = whole;
    for (int k = 0; k < 1 + round % 4; ++k) {
      state = state * 1664525u + 1013904223u;
      bytes[state % bytes.size()] = char(state >> 24);
    }
    const std::string message = user_error([&] { load_scene(folder.write("r.glb", bytes)); });
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("BoomBox: geometry as assimp reads it, its maps, a camera that sees it") {
  if (!std::filesystem::exists(kBoomBox)) {
    MESSAGE("skipped: " << kBoomBox << " is not there");
    return;
  }
  const Scene scene = load_scene(kBoomBox);
  check_valid(scene);
  CHECK(scene.triangle_count() == 18108 / 3);
  CHECK(scene.materials.size() == 1);
  CHECK(scene.images.size() == 2);
  CHECK(scene.images[0].width == 1024);
  CHECK(!has_note(scene, "MikkTSpace"));
  Assimp::Importer importer;
  const aiScene* oracle = importer.ReadFile(kBoomBox, 0);
  REQUIRE(oracle);
  const aiMesh& mesh = *oracle->mMeshes[0];
  // Its node turns it by 180 degrees about y.
  double worst = 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f)
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned i = mesh.mFaces[f].mIndices[k];
      const std::uint32_t v = scene.indices[3 * f + k];
      const dvec3 p(-mesh.mVertices[i].x, mesh.mVertices[i].y, -mesh.mVertices[i].z),
          n(-mesh.mNormals[i].x, mesh.mNormals[i].y, -mesh.mNormals[i].z);
      const dvec3 b(-mesh.mBitangents[i].x, mesh.mBitangents[i].y, -mesh.mBitangents[i].z);
      const dvec3 bitangent =
          glm::cross(dvec3(scene.normals[v]), dvec3(scene.tangents[v])) * double(scene.tangents[v].w);
      worst = std::max({worst, glm::length(p - dvec3(scene.positions[v])), glm::length(n - dvec3(scene.normals[v])),
                        0.1 * glm::length(b - bitangent),
                        std::fabs(double(mesh.mTextureCoords[0][i].x) - double(scene.uvs[v].x)),
                        std::fabs(double(mesh.mTextureCoords[0][i].y) - double(scene.uvs[v].y))});
    }
  CHECK(worst < 1e-3);
}

TEST_CASE("MikkTSpace makes BoomBox's own tangents again") {
  if (!std::filesystem::exists(kBoomBox)) {
    MESSAGE("skipped: " << kBoomBox << " is not there");
    return;
  }
  TemporaryFolder folder;
  json root = json::parse(read_file(kBoomBox));
  root["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
  const std::string source = std::filesystem::path(kBoomBox).parent_path().string();
  root["buffers"][0]["uri"] = std::filesystem::relative(source + "/BoomBox.bin", folder.path).string();
  root.erase("materials");
  root["meshes"][0]["primitives"][0].erase("material");
  const Scene own = load_scene(kBoomBox), made = load_scene(folder.write("b.gltf", root.dump()));
  REQUIRE(own.indices.size() == made.indices.size());
  std::size_t close = 0, sign = 0;
  for (std::size_t i = 0; i < own.indices.size(); ++i) {
    const glm::vec4 a = own.tangents[own.indices[i]], b = made.tangents[made.indices[i]];
    close += glm::dot(dvec3(a), dvec3(b)) > 0.99;
    sign += a.w == b.w;
  }
  CHECK(double(sign) > 0.99 * double(own.indices.size()));
  CHECK(double(close) > 0.97 * double(own.indices.size()));
}

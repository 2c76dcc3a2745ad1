#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/file.h"
#include "scenes/scene.h"
#include "tests/scenes/image_writers.h"
#include "tests/scenes/notes.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using glm::dvec3;
using twinshade::test::file_names;
using twinshade::test::has_note;

namespace {

const char* const kCube =
    "mtllib cube.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl red\nf 5/1 6/2 7/3 8/4\nf 2/1 1/2 4/3 3/4\n"
    "usemtl map\nf 6/1 2/2 3/3 7/4\nf 1/1 5/2 8/3 4/4\nf 8/1 7/2 3/3 4/4\nf 1/1 2/2 6/3 5/4\n";
const char* const kMaterials =
    "newmtl red\nKd 0.8 0.1 0.05\n"
    "newmtl map\nKd 1 1 1\nmap_Kd colour.png\nmap_Bump normal.png\n";

void write_maps(const TemporaryFolder& folder) {
  write_image(folder.name("colour.png"), 2, 2, 3, std::vector<std::uint8_t>{0, 0, 0, 64, 0, 0, 128, 0, 0, 255, 0, 0});
  write_image(folder.name("normal.png"), 2, 2, 3,
              std::vector<std::uint8_t>{128, 128, 255, 128, 128, 255, 140, 128, 250, 120, 128, 250});
}

}  // namespace

TEST_CASE("an OBJ cube: triangulated, materials and maps, flat faces at its right angles") {
  TemporaryFolder folder;
  write_maps(folder);
  folder.write("cube.mtl", kMaterials);
  const Scene scene = load_scene(folder.write("cube.obj", kCube));
  CHECK(scene.triangle_count() == 12);
  CHECK(scene.positions.size() == 24);  // four corners a face
  REQUIRE(scene.materials.size() == 2);
  CHECK(has_note(scene, "no normals"));
  CHECK(has_note(scene, "per vertex"));
  CHECK(file_names(scene) == std::set<std::string>{"cube.obj", "cube.mtl", "colour.png", "normal.png"});
  for (std::size_t t = 0; t < 12; ++t) {
    const auto p = [&](std::size_t k) { return dvec3(scene.positions[scene.indices[3 * t + k]]); };
    const dvec3 face = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
    CHECK(glm::dot(face, (p(0) + p(1) + p(2)) / 3.0 - dvec3(0.5)) > 0);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(glm::length(dvec3(scene.normals[scene.indices[3 * t + k]]) - face) < 1e-6);
      CHECK(scene.tangents[scene.indices[3 * t + k]].w == 1);
    }
    const Material& material = scene.materials[scene.triangle_materials[t]];
    if (material.name == "red") {
      CHECK(material.albedo == glm::vec3(0.8f, 0.1f, 0.05f));
      CHECK(material.albedo_image == -1);
    } else {
      REQUIRE(material.albedo_image >= 0);
      REQUIRE(material.normal_image >= 0);
      CHECK(scene.images[std::size_t(material.albedo_image)].texels[4] == 1);  // lower right
    }
  }
}

TEST_CASE("an OBJ without normals is smooth where its faces meet at small angles") {
  TemporaryFolder folder;
  std::string text;
  const int n = 24;
  for (int i = 0; i < n; ++i)
    for (int y = 0; y < 2; ++y)
      text += "v " + std::to_string(std::cos(6.2831853 * i / n)) + " " + std::to_string(y) + " " +
              std::to_string(-std::sin(6.2831853 * i / n)) + "\n";
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i + 1, b = 2 * ((i + 1) % n) + 1;
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) + " " +
            std::to_string(a + 1) + "\n";
  }
  const Scene scene = load_scene(folder.write("tube.obj", text));
  CHECK(has_note(scene, "no UVs"));
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    const dvec3 out(scene.positions[i].x, 0, scene.positions[i].z);
    CHECK(glm::dot(dvec3(scene.normals[i]), out) > 0.99);
  }
}

TEST_CASE("norm is a normal map whatever its mean, colours above 1 are drawn as 1 and said") {
  TemporaryFolder folder;
  write_image(folder.name("slanted.png"), 1, 1, 3, std::vector<std::uint8_t>{230, 128, 200});
  write_image(folder.name("bright.exr"), 1, 1, 3, std::vector<float>{3, 0.5f, 0.25f});
  folder.write("cube.mtl", "newmtl red\nKd 2 1 0.5\nnorm slanted.png\nnewmtl map\nKd 1 1 1\nmap_Kd bright.exr\n");
  const Scene scene = load_scene(folder.write("cube.obj", kCube));
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].normal_image >= 0);
  CHECK(!has_note(scene, "height field"));
  CHECK(scene.materials[0].albedo == glm::vec3(1, 1, 0.5f));
  REQUIRE(scene.materials[1].albedo_image >= 0);
  const std::vector<float>& texels = scene.images[std::size_t(scene.materials[1].albedo_image)].texels;
  CHECK(texels[0] == 1);
  CHECK(texels[1] == 0.5f);
  CHECK(has_note(scene, "colours above 1"));
}

TEST_CASE("what is missing from an OBJ is said or refused") {
  TemporaryFolder folder;
  const Scene plain = load_scene(folder.write("cube.obj", kCube));
  CHECK(plain.triangle_count() == 12);
  CHECK(has_note(plain, "cube.mtl is missing"));
  folder.write("cube.mtl", kMaterials);
  CHECK(user_error([&] { load_scene(folder.name("cube.obj")); }).find("colour.png") != std::string::npos);
  write_maps(folder);
  const std::string image = read_file(folder.name("colour.png"));
  folder.write("colour.png", image.substr(0, image.size() / 2));
  CHECK(user_error([&] { load_scene(folder.name("cube.obj")); }).find("colour.png") != std::string::npos);
  write_maps(folder);
  write_image(folder.name("normal.png"), 2, 2, 3, std::vector<std::uint8_t>(12, 90));
  CHECK(has_note(load_scene(folder.name("cube.obj")), "height field"));

  folder.write("some.mtl", "  newmtl\tred one \nKd 1 0 0\n");
  const std::string triangle = "mtllib some.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(!has_note(load_scene(folder.write("m.obj", triangle + "usemtl red one\nf 1 2 3\n")), "usemtl"));
  CHECK(has_note(load_scene(folder.write("m.obj", triangle + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 2\n")),
                 "line 5: usemtl names what no material library has, blue, red: plain"));
  for (const char* text : {"", "hello\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
                           "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"}) {
    const std::string message = user_error([&] { load_scene(folder.write("bad.obj", text)); });
    INFO(text << " -> " << message);
    CHECK(message.find("bad.obj") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(user_error([&] { load_scene(folder.name("none.obj")); }).find("none.obj") != std::string::npos);
  CHECK(user_error([&] { load_scene(folder.name("cube.obj"), 1000); }).find("--triangles") != std::string::npos);
  CHECK(user_error([&] { load_scene(folder.name("cube.fbx")); }).find(".gltf, .glb or .obj") != std::string::npos);
}

TEST_CASE("an OBJ's vertex colours and lines are left out, each said once") {
  TemporaryFolder folder;
  const std::string coloured = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\nl 1 2\nl 2 3\n";
  const Scene scene = load_scene(folder.write("m.obj", coloured));
  CHECK(scene.triangle_count() == 1);
  CHECK(std::count(scene.notes.begin(), scene.notes.end(), "vertex colours are ignored") == 1);
  CHECK(std::count(scene.notes.begin(), scene.notes.end(), "points and lines are not drawn") == 1);
}

TEST_CASE("an OBJ too far out or too small to be drawn is refused by name, from 1e-14 to 1e14 it is framed") {
  TemporaryFolder folder;
  const auto triangle_of_side = [&](const std::string& side) {
    return folder.write("side.obj", "v 0 0 0\nv " + side + " 0 0\nv 0 0 -" + side + "\nv 1e30 0 0\nf 1 2 3\n");
  };
  for (const char* side : {"1e-14", "1e-7", "1", "1e14"}) {
    const Scene scene = load_scene(triangle_of_side(side));
    const double distance = glm::length(scene.camera.target - scene.camera.eye), size = std::stod(side);
    CAPTURE(side);
    CHECK(distance > size);
    CHECK(distance < 4 * size);
  }
  for (const char* side : {"2e15", "1e20", "1e25"}) {
    const std::string message = user_error([&] { load_scene(triangle_of_side(side)); });
    INFO(message);
    CHECK(message.find("side.obj: mesh ") != std::string::npos);
    CHECK(message.find("farther than 1e15") != std::string::npos);
  }
  for (const char* side : {"1e-16", "1e-20", "0"})
    CHECK(user_error([&] { load_scene(triangle_of_side(side)); }).find("side.obj: all its triangles") !=
          std::string::npos);
}

TEST_CASE("a byte order mark before an OBJ or its materials loses nothing") {
  TemporaryFolder folder;
  const std::string mark = "\xef\xbb\xbf";
  folder.write("m.mtl", mark + "newmtl a\nKd .25 .5 1\n");
  const Scene scene =
      load_scene(folder.write("m.obj", mark + "v 0 0 5\nv 1 0 0\nv 0 1 0\nmtllib m.mtl\nusemtl a\nf 1 2 3\n"));
  REQUIRE(scene.triangle_count() == 1);
  CHECK(scene.positions[scene.indices[0]] == glm::vec3(0, 0, 5));
  CHECK(scene.materials[0].albedo == glm::vec3(0.25f, 0.5f, 1));
}

TEST_CASE("material libraries: several on a line, names with blanks, indented, missing, a folder") {
  TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
  folder.write("b.mtl", "newmtl b\nKd 0 1 0\n");
  folder.write("c d.mtl", "newmtl c\nKd 0 0 1\n");
  folder.write("m.mtl", "newmtl a\nKd 0 0 0.5\n");  // has the model's name, but nobody asks for it
  const auto model = [&](const std::string& libraries) {
    return load_scene(folder.write("m.obj", libraries + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"
                                                        "usemtl b\nf 1 3 2\nusemtl c\nf 2 3 1\n"));
  };
  for (const char* libraries :
       {"mtllib a.mtl b.mtl\nmtllib c d.mtl\n", "  mtllib\tb.mtl  a.mtl\r\n\tmtllib .\\c d.mtl \r\n",
        "mtllib a.mtl \\\n b.mtl # of a tool\nmtllib c d.mtl # blanks\n", "mtllib b.mtl a.mtl\rmtllib c d.mtl\r"}) {
    const Scene scene = model(libraries);
    CAPTURE(libraries);
    CHECK(!has_note(scene, "missing"));
    REQUIRE(scene.materials.size() == 3);
    for (int i = 0; i < 3; ++i) {
      const Material& material = scene.materials[std::size_t(i)];
      CHECK(material.albedo[material.name[0] - 'a'] == 1);
    }
    CHECK(file_names(scene) == std::set<std::string>{"m.obj", "a.mtl", "b.mtl", "c d.mtl"});
  }
  const Scene missing = model("  mtllib e.mtl\nmtllib .\nmtllib\n");
  CHECK(has_note(missing, "material library e.mtl is missing"));
  CHECK(has_note(missing, "material library . is a folder"));
  CHECK(!has_note(missing, "material library  "));
  CHECK(missing.triangle_count() == 3);
  for (const Material& material : missing.materials) CHECK(material.albedo != glm::vec3(0, 0, 0.5f));
}

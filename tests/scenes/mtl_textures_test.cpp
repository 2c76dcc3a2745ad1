#include "scenes/mtl_textures.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "scenes/scene.h"
#include "tests/scenes/image_writers.h"
#include "tests/scenes/notes.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using twinshade::test::has_note;

namespace {

using Names = std::set<std::string>;

}  // namespace

TEST_CASE("a texture line is cut down to keyword and name, whatever options and blanks it has") {
  for (const auto& [line, name, options] :
       {std::tuple<const char*, const char*, Names>{"map_Kd a.png", "a.png", {}},
        {"  map_Kd\ta.png \t\r", "a.png", {}},
        {"map_Kd two words.png ", "two words.png", {}},
        {"map_Kd -s 2 2 1 a.png", "a.png", {"-s"}},
        {"map_Kd -s 2 a.png", "a.png", {"-s"}},
        {"map_Kd -o 0.5 0 two words.png", "two words.png", {"-o"}},
        {"map_Kd -s 1 1.0 1 -o 0 0 0 -clamp off -mm 0 1 a.png", "a.png", {}},
        {"map_Kd -clamp on -mm 0.2 0.8 -blendu off -t 1 1 1 a.png", "a.png", {"-clamp", "-mm", "-t"}},
        {"map_Kd -s 2", "2", {}},
        {"map_Kd -odd a.png", "-odd a.png", {}},
        {"map_Kd 7.png", "7.png", {}}}) {
    Names ignored;
    const std::string text = with_plain_textures("newmtl a\n" + std::string(line) + "\nKd 1 1 1\n", ignored);
    INFO(text);
    CHECK(text == "newmtl a\nmap_Kd " + std::string(name) + "\nKd 1 1 1\n");
    CHECK(ignored == options);
  }
  Names ignored;
  CHECK(with_plain_textures("bump -bm 1 n.png\nmap_Bump -bm 0.5 n.png\nnorm n.png ", ignored) ==
        "bump n.png\nmap_Bump n.png\nnorm n.png\n");
  CHECK(ignored == Names{"-bm"});
  const std::string others = "map_Ks -s 2 2 2 a.png \nmap_Kd\nKd 1 1 1 \n# map_Kd -s 1 a.png\n";
  CHECK(with_plain_textures(others, ignored) == others);
}

TEST_CASE("an OBJ's texture is found behind its options and before blanks; what is ignored is said") {
  TemporaryFolder folder;
  write_image(folder.name("c.png"), 1, 1, 3, std::vector<std::uint8_t>{9, 90, 200});
  const auto load = [&](const std::string& line) {
    folder.write("m.mtl", "newmtl a\n" + line + "\n");
    return load_scene(folder.write("m.obj",
                                   "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\n"
                                   "f 1/1 2/2 3/3\n"));
  };
  for (const char* line : {"map_Kd c.png ", "map_Kd c.png\t\r", "map_Kd -s 2 c.png", "map_Kd -s 2 2 1 -o 1 c.png"}) {
    const Scene scene = load(line);
    CAPTURE(line);
    CHECK(scene.images.size() == 1);
    CHECK(scene.materials[0].albedo_image == 0);
    CHECK(has_note(scene, "m.mtl: the option -s") == (std::string(line).find("-s") != std::string::npos));
  }
}

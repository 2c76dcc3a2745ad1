#include "scenes/mtl_lines.h"

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

using Notes = std::set<std::string>;

std::string plain(const std::string& library, Notes& notes) { return plain_materials(library, "m.mtl", notes); }

std::string ignored(const std::string& option) { return "the option " + option + " of its textures is ignored"; }

}  // namespace

TEST_CASE("a texture line is cut down to keyword and name, whatever options and blanks it has") {
  for (const auto& [line, name, options] : {std::tuple<const char*, const char*, Notes>{"map_Kd a.png", "a.png", {}},
                                            {"  map_Kd\ta.png \t\r", "a.png", {}},
                                            {"map_Kd two words.png ", "two words.png", {}},
                                            {"map_Kd -s 2 2 1 a.png", "a.png", {ignored("-s")}},
                                            {"map_Kd -s 2 a.png", "a.png", {ignored("-s")}},
                                            {"map_Kd -o 0.5 0 two words.png", "two words.png", {ignored("-o")}},
                                            {"map_Kd -s 1 1.0 1 -o 0 0 0 -clamp off -mm 0 1 a.png", "a.png", {}},
                                            {"map_Kd -clamp on -mm 0.2 0.8 -blendu off -t 1 1 1 a.png",
                                             "a.png",
                                             {ignored("-clamp"), ignored("-mm"), ignored("-t")}},
                                            {"map_Kd -s 2", "2", {}},
                                            {"map_Kd -odd a.png", "-odd a.png", {}},
                                            {"map_Kd 7.png", "7.png", {}}}) {
    Notes notes;
    const std::string text = plain("newmtl a\n" + std::string(line) + "\nKd 1 1 1\n", notes);
    INFO(text);
    CHECK(text == "newmtl a\nmap_Kd " + std::string(name) + "\nKd 1 1 1\n");
    CHECK(notes == options);
  }
  Notes notes;
  CHECK(plain("newmtl a\nbump -bm 1 n.png\nmap_Bump -bm 0.5 n.png\nnorm n.png ", notes) ==
        "newmtl a\nbump n.png\nmap_Bump n.png\nnorm n.png\n");
  CHECK(notes == Notes{ignored("-bm")});
  notes.clear();
  CHECK(plain("map_Ks -s 2 2 2 a.png \nmap_Kd\n# map_Kd -s 1 a.png\nKs 1\n", notes) == "\n\n\n\n");
  CHECK(notes == Notes{"line 2: map_Kd names no file"});
}

TEST_CASE("a colour of one number is grey, of three as they are; others are refused by file and line, or noted") {
  Notes notes;
  CHECK(plain("newmtl two words # a\n  Kd .5 # grey\nKd\t.5 1e-2 \\\n.25\n", notes)
            .find("newmtl two words # a\nKd 0.5 0.5 0.5\n") == 0);
  CHECK(plain("Kd 0.5 .25 1\nKs red\nKa x\n", notes) == "Kd 0.5 0.25 1\n\n\n");
  CHECK(notes.empty());
  const std::string ways = ": write Kd with 3 numbers (r g b), or 1 for all of them";
  for (const auto& [line, what] :
       {std::pair("Kd red", "'red' is not a number"), std::pair("Kd 0.5 0.5", "Kd has 2 numbers"),
        std::pair("Kd", "Kd has 0 numbers"), std::pair("Kd 1 1 1 1", "Kd has 4 numbers")})
    CHECK(user_error([&, text = "newmtl a\n" + std::string(line)] { plain(text, notes); }) ==
          std::string("m.mtl:2: ") + what + ways);
  CHECK(plain("Kd xyz 0.5 0.5 0.5\nKd spectral a.rfl 1\nd 0.5\nd 1\nTr 0\nKe 0 0 0\nmap_d a.png\n", notes) ==
        "\n\n\n\n\n\n\n");
  CHECK(notes == Notes{"colours as xyz are ignored: their materials are plain", "cut-out materials are drawn opaque",
                       "colours as spectral are ignored: their materials are plain",
                       "transparent materials are drawn opaque"});
  notes.clear();
  plain("Pm 0\nKe 0 0 0\n", notes);
  CHECK(notes.empty());
  plain("Pm 1\nmap_Ke a.png\n", notes);
  CHECK(notes ==
        Notes{"metals (Pm) are drawn as matt surfaces of their Kd", "light that materials give (Ke) is ignored"});
}

TEST_CASE("a picture of colours without a colour beside it is drawn as it is") {
  Notes notes;
  CHECK(plain("newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\nKd 0.5\nnewmtl c\nnewmtl d\n MAP_KD d.png\n", notes) ==
        "newmtl a\nKd 1 1 1\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\nKd 0.5 0.5 0.5\nnewmtl c\nnewmtl d\nKd 1 1 1\n"
        "MAP_KD d.png\n");
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

TEST_CASE("a picture before the first material of a library belongs to none") {
  std::set<std::string> notes;
  CHECK(plain_materials("bump a.png\nmap_Kd a.png\nnewmtl red\nKd 1 0 0\n", "m.mtl", notes) ==
        "\n\nnewmtl red\nKd 1 0 0\n");
  CHECK(plain_materials("NEWMTL red\n", "m.mtl", notes) == "newmtl red\n");
}

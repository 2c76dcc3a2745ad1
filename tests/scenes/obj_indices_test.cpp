#include "scenes/obj_indices.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "scenes/obj_lines.h"
#include "scenes/scene.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;

namespace {

constexpr const char* kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\n";

std::string refusal(const std::string& text) {
  return user_error([&] {
    ObjIndices indices;
    for (ObjLines lines(text); lines.next();) indices.read(lines.statement(), "m.obj", lines.number());
    indices.check("m.obj");
  });
}

}  // namespace

TEST_CASE("faces may name what is there, from the front, from the back, and before it stands in the file") {
  for (const char* faces : {"f 1 2 3", "f 1/2/1 2/1/1 3//1", "f -3/-2/-1 -2 -1", "l 1/1 2/2", "p 3 1", "f 1 2 3 # 9",
                            "f", "f 1/ 2// 3//1", "fo 9", "s 9"}) {
    CAPTURE(faces);
    CHECK(refusal(std::string(kVertices) + faces) == "");
    if (std::string_view(faces).find('-') == std::string_view::npos)
      CHECK(refusal(faces + ("\n" + std::string(kVertices))) == "");
  }
}

TEST_CASE("a face that names what is not there is refused with file and line") {
  const auto after = [](const char* faces) { return refusal(kVertices + std::string(faces)); };
  const std::string ways = ", numbered from 1, or from -1 backwards";
  CHECK(after("f 1 2 4\nf 1 2 3") == "m.obj:7: vertex 4 is not there: there are 3" + ways);
  CHECK(after("\nf 1/1 2/3 3/2") == "m.obj:8: texture coordinate (vt) 3 is not there: there are 2" + ways);
  CHECK(after("f 1//2 2//1 3//1") == "m.obj:7: normal (vn) 2 is not there: there are 1" + ways);
  CHECK(after("f 0 1 2") == "m.obj:7: vertex 0 is not there: there are 3" + ways);
  CHECK(after("f -4 1 2") == "m.obj:7: vertex -4 is not there: there are 3 before it" + ways);
  CHECK(after("f 1 2 99999999999999") == "m.obj:7: vertex 99999999999999 is not there: there are 3" + ways);
  CHECK(refusal("f -1 -2 -3\n" + std::string(kVertices)) ==
        "m.obj:1: vertex -1 is not there: there are 0 before it" + ways);
  CHECK(refusal("v 0 0 0\nf 1//1 1 1") == "m.obj:2: normal (vn) 1 is not there: the file has none");
}

TEST_CASE("what is no corner of a face is refused with file and line") {
  for (const char* corner :
       {"x", "1x", "1.5", "+1", "1-3", "1,3", "/1", "1/x", "1/+1", "1/1/1/1", "--1", "99999999999999999999"}) {
    CAPTURE(corner);
    CHECK(refusal(kVertices + std::string("f 1 2 ") + corner + " 3") ==
          "m.obj:7: '" + std::string(corner) +
              "' names no corner: write v, v/vt, v//vn or v/vt/vn, numbers of those lines");
  }
}

TEST_CASE("a statement whose name only begins as a face's is no face") {
  TemporaryFolder folder;
  const std::string faces = std::string(kVertices) + "f 1 2 3\n";
  const Scene scene = load_scene(folder.write("m.obj", faces + "foo 3 2 1\nlow 99\npfx 99\nvx 1\n"));
  CHECK(scene.triangle_count() == 1);
}

TEST_CASE("a model whose face names a texture coordinate that is not there is not drawn without") {
  TemporaryFolder folder;
  const std::string file = folder.write("m.obj", std::string(kVertices) + "f 1/1/1 2/2/1 3/9/1\n");
  CHECK(user_error([&] { load_scene(file); }).find(file + ":7: texture coordinate (vt) 9 is not there") == 0);
}

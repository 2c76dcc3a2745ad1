#include "scenes/obj_lines.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "scenes/scene.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;

namespace {

struct Statement {
  std::size_t number;
  std::string text;
  bool operator==(const Statement&) const = default;
};

std::vector<Statement> statements(const std::string& text) {
  std::vector<Statement> list;
  for (ObjLines lines(text); lines.next();) list.push_back({lines.number(), std::string(lines.statement())});
  return list;
}

std::string added(const std::string& statement) {
  std::string text = "before ";
  add_statement(text, statement, "m.obj", 7);
  return text.substr(7);
}

}  // namespace

TEST_CASE("a statement has no blanks around it, no comment's lines, and goes on behind a backslash") {
  CHECK(statements("").empty());
  CHECK(statements("v 1\n\n \t f 2 3\t\r\n  # f 9\\\nend") ==
        std::vector<Statement>{{1, "v 1"}, {2, ""}, {3, "f 2 3"}, {4, ""}, {5, "end"}});
  CHECK(statements("f 1 \\\r\n  2\\\n3 # a \\\nf 4\nv 5\\\n# 6\nv 7 \\") ==
        std::vector<Statement>{{1, "f 1  2 3 # a \\"}, {4, "f 4"}, {5, "v 5 # 6"}, {7, "v 7"}});
}

TEST_CASE("statements become what assimp reads") {
  CHECK(added("f 1/2 3//4 -5 # 6") == "f 1/2 3//4 -5 ");
  CHECK(added("l 1 2#x") == "l 1 2");
  CHECK(added("usemtl a#1 # b") == "usemtl a#1 # b");
  CHECK(added("v\t1 -2.5  +3e-4# 4") == "v 1 -2.5 +3e-4");
  CHECK(added("v .5 -.5 ,25 1.") == "v 0.5 -.5 0,25 1.");
  CHECK(added("v 1 2 3 .1 .2 1") == "v 1 2 3 0.1 0.2 1");
  CHECK(added("v nan -INF infinity") == "v nan -INF infinity");
  CHECK(added("vn 0 0 -nan(ind)") == "vn 0 0 -nan(ind)");
  CHECK(added("vt 0.5") == "vt 0.5 0");
  CHECK(added("vt 0.5 1 0") == "vt 0.5 1 0");
  CHECK(added("vp 1") == "");
}

TEST_CASE("statements that ask for what is not drawn say so") {
  CHECK(undrawn_statement("v 1 2 3\t.1  .2 1 # red") == "vertex colours are ignored");
  CHECK(undrawn_statement("l 1 2") == "points and lines are not drawn");
  CHECK(undrawn_statement("surf 0 1 0 1 1 2 3 4") == "curves and curved surfaces are not drawn");
  for (const char* drawn : {"", "v 1 2 3", "v 1 2 3 1 # a b c", "vn 1 2 3", "vt 1 2 3", "f 1 2 3 4 5 6", "usemtl l"})
    CHECK(undrawn_statement(drawn) == "");
}

TEST_CASE("vertices with other counts of numbers, or none, are refused with file and line") {
  const auto refused = [](const std::string& statement) { return user_error([&] { added(statement); }); };
  const std::string v = ": write v with 3 numbers (x y z), 4 (x y z w) or 6 (x y z r g b)";
  CHECK(refused("v") == "m.obj:7: v has 0 numbers" + v);
  CHECK(refused("v 1 # 2 3") == "m.obj:7: v has 1 number" + v);
  CHECK(refused("v 1 2 3 4 5") == "m.obj:7: v has 5 numbers" + v);
  CHECK(refused("v 1 2 3 4 5 6 7") == "m.obj:7: v has 7 numbers" + v);
  for (const std::string word : {"x", "1x", "-", ".", "1e", "0x10", "1.5.2", "1.#IND", "1.#QNAN"})
    CHECK(refused("v 1 " + word + " 3") == "m.obj:7: '" + word + "' is not a number" + v);
  CHECK(refused("v 1 \x01" + std::string(100, 'y') + " 3") ==
        "m.obj:7: '?" + std::string(39, 'y') + "' is not a number" + v);
  CHECK(refused("vt") == "m.obj:7: vt has 0 numbers: write vt with 1 to 3 numbers (u v w)");
  CHECK(refused("vt 0 0 0 0") == "m.obj:7: vt has 4 numbers: write vt with 1 to 3 numbers (u v w)");
  CHECK(refused("vn 0 1") == "m.obj:7: vn has 2 numbers: write vn with 3 numbers (x y z)");
}

TEST_CASE("indented, commented and continued lines of a model lose nothing, malformed ones are named") {
  TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("m.obj",
                                              "  v 0 0 .5\r\n\tv 1 0 \\\r\n 0 # v\r\nv 0 1 0\r\nv 0 0 2\r\n# C:\\\r\n"
                                              " f 1 2 3 # first\r\n  f 1 2 4#x\r\nf 2 3 \\\r\n 4\r\nf 1 3 4\r\n"));
  CHECK(scene.triangle_count() == 4);
  CHECK(scene.positions[scene.indices[0]] == glm::vec3(0, 0, 0.5f));
  CHECK(scene.positions[scene.indices[1]] == glm::vec3(1, 0, 0));
  const std::string file = folder.write("bad.obj", "v 0 0 0\rv 1 0 \\\r0\rv 0 1\rv 0 1 0\rf 1 2 3\r");
  CHECK(user_error([&] { load_scene(file); }).find("bad.obj:4: v has 2 numbers: write v with 3") != std::string::npos);
}

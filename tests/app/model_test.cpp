// Models from files, drawn by the program as a user would.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {
namespace {

// A floor, three walls and a ceiling, open towards +Z.
std::string room(const Folder& folder) {
  return folder.file("room.obj",
                     "v -2 0 -3\nv 2 0 -3\nv 2 3 -3\nv -2 3 -3\nv -2 0 3\nv 2 0 3\nv 2 3 3\nv -2 3 3\n"
                     "f 1 2 3 4\nf 5 1 4 8\nf 2 6 7 3\nf 5 6 2 1\nf 4 3 7 8\n");
}

std::string frame(const std::string& model, const std::string& camera) {
  const Run run = run_twinshade({"render", model, "--technique", "h4", "--size", "16x16", "--rays", "4", "--camera",
                                 camera, "--quiet", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return run.json()["frame"];
}

}  // namespace

TEST_CASE("a camera in a room, close to a wall, far away or straight above sees the model") {
  const Folder folder;
  const std::string model = room(folder), nothing = frame(model, "0,1.5,100,0,1.5,200,60");
  for (const char* camera :
       {"0,1.5,1,0,1.5,-3,60", "0,1.5,-2.98,0,1.5,-3,60", "0,1.5,2000,0,1.5,0,0.2", "0,2.9,0,0,0,0,40"}) {
    CAPTURE(camera);
    CHECK(frame(model, camera) != nothing);
  }
}

}  // namespace twinshade

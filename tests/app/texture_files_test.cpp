// --texture, as a user would give it.
#include <doctest/doctest.h>

#include <filesystem>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("--texture gives a shader a picture, lowest row first, the same on all machines, in a golden image, too") {
  const Folder folder;
  std::filesystem::create_directory(folder / "pictures");
  // Red, green; blue, white.
  const std::string picture =
      folder.file("pictures/four.ppm", "P3\n2 2\n255\n255 0 0  0 255 0\n0 0 255  255 255 255\n");
  const auto shader = [&](const char* name, const std::string& map, const std::string& texel) {
    return folder.file(name, "in vec2 v_uv;\nout vec4 color;\n" + map + "void main() { color = " + texel + "; }\n");
  };
  const std::string fetched = shader("fetched.frag", "uniform sampler2D map;\n",
                                     "texelFetch(map, ivec2(0, 0), 0) + 2.0 * texelFetch(map, ivec2(1, 1), 0)");
  const std::string written = shader("written.frag", "", "vec4(0.0, 0.0, 1.0, 1.0) + 2.0 * vec4(0.0, 1.0, 0.0, 1.0)");
  const auto frame = [&](const std::vector<std::string>& options) {
    const Run run = run_twinshade(small_quad({"render", "--json", "-"}, options));
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run.json()["frame"];
  };
  CHECK(frame({"--shader", fetched, "--texture", "map=" + picture}) == frame({"--shader", written}));
  const std::vector<std::string> opengl = opengl_backends();
  if (!opengl.empty())
    CHECK(run_twinshade(
              small_quad({"compare"}, {"--shader", fetched, "--texture", "map=" + picture, "--on", "cpu," + opengl[0]}))
              .code == 0);
  // What it names moves with the folder.
  const std::string goldens = folder / "pictures/goldens";
  REQUIRE(run_twinshade(small_quad({"golden", "update", goldens},
                                   {"--shader", fetched, "--texture", "map=" + picture, "--name", "g"}))
              .code == 0);
  std::filesystem::create_directory(folder / "moved");
  std::filesystem::rename(folder / "pictures", folder / "moved/pictures");
  std::filesystem::rename(fetched, folder / "moved/fetched.frag");
  CHECK(run_twinshade({"golden", "check", folder / "moved/pictures/goldens"}).code == 0);
}

TEST_CASE("pictures that cannot be textures are refused in one line") {
  const Folder folder;
  const std::string shader =
      folder.file("s.frag",
                  "in vec2 v_uv;\nuniform sampler2D map;\nuniform samplerCube sky;\nout vec4 color;\n"
                  "void main() { color = texture(map, v_uv) + texture(sky, vec3(v_uv, 1.0)); }\n");
  const std::string picture = folder.file("one.ppm", "P3\n1 1\n255\n255 0 0\n");
  const auto refused = [&](const std::string& texture, const std::string& reason) {
    const Run run = run_twinshade(small_quad({"render"}, {"--shader", shader, "--texture", texture}));
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
  };
  refused("map=" + (folder / "none.png"), "none.png");
  refused("sky=" + picture, "sky is no sampler2D");
  refused("mop=" + picture, "unknown sampler2D 'mop'; did you mean 'map'?");
  refused("map", "--texture map: must be NAME=FILE");
  refused("map=", "--texture map=: must be NAME=FILE");
  // -Inf, one pixel of a PFM.
  refused("map=" + folder.file("bad.pfm", "PF\n1 1\n-1.0\n" + std::string("\0\0\200\377\0\0\0\0\0\0\0\0", 12)),
          "bad.pfm: pixel (0, 0) counted from the upper left is NaN or infinite");
  const Run none = run_twinshade(small_quad({"render"}, {"--shader", shader}));
  CHECK_MESSAGE(none.err.find("s.frag:2: texture \"map\" is not in the bundle") != std::string::npos, none.err);
  CHECK_MESSAGE(none.err.find("--texture map=FILE") != std::string::npos, none.err);
}

}  // namespace twinshade

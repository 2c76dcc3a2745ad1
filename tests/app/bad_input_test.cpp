// Whatever is wrong with what the user gives: one clear line on stderr, exit code 2, no partial file.
#include <OpenImageIO/imageio.h>
#include <sys/resource.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/sanitizers.h"
#include "run_twinshade.h"

namespace twinshade {
namespace {

void check_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& said) {
  const Run run = run_twinshade(arguments);
  std::string command = "twinshade";
  for (const std::string& argument : arguments) command += " " + argument;
  INFO(command);
  INFO(run.err);
  CHECK(run.code == 2);
  CHECK(run.out.empty());
  CHECK(run.err.rfind("twinshade: ", 0) == 0);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  for (const std::string& words : said) {
    CAPTURE(words);
    CHECK(run.err.find(words) != std::string::npos);
  }
}

// A lat-long picture of ones with one odd texel, as EXR.
std::string environment_with(const Folder& folder, const std::string& name, float odd, int x, int y) {
  constexpr int kWidth = 8, kHeight = 4;
  std::vector<float> texels(kWidth * kHeight * 3, 1.0f);
  texels[(y * kWidth + x) * 3 + 1] = odd;
  const std::string path = folder / name;
  auto out = OIIO::ImageOutput::create(path);
  REQUIRE(out);
  REQUIRE(out->open(path, OIIO::ImageSpec(kWidth, kHeight, 3, OIIO::TypeDesc::FLOAT)));
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, texels.data()));
  REQUIRE(out->close());
  return path;
}

std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("frames without pixels, or over 16384, are refused") {
  for (const char* size : {"0x10", "10x0", "16385x10", "10x16385", "-1x5", "10", "axb", "10x10x10", "1e3x10", ""}) {
    CAPTURE(size);
    check_refused({"render", "quad", "--size", size}, {"--size", "1 to 16384"});
    check_refused({"compare", "quad", "--size", size}, {"--size", "1 to 16384"});
  }
}

TEST_CASE("unknown names are refused, with the nearest known ones") {
  check_refused({"render", "quad", "--technique", "h5"}, {"h5", "h4", "h6"});
  check_refused({"compare", "quad", "--technique", "h4,sh33"}, {"sh33", "sh3"});
  check_refused({"render", "quad", "--env", "skyy"}, {"skyy", "sky"});
  check_refused({"render", "courtyrd"}, {"courtyrd", "courtyard"});
  check_refused({"compare", "quad", "--on", "cpu,elg"}, {"elg", "egl"});
  check_refused({"render", "quad", "--on", "vulkan"}, {"vulkan", "cpu"});
  check_refused({"rendr"}, {"rendr", "render"});
  check_refused({"list", "technique"}, {"technique", "techniques"});
  check_refused({"translate", "h7"}, {"h7", "h4"});
  check_refused({"translate", "reference"}, {"technique reference: it has no shader"});
  check_refused({"eval", "a.frag", "--annotate", "gitlab"}, {"--annotate gitlab", "github"});
  check_refused({"render", "quad", "--tonemap", "rheinhard"}, {"rheinhard", "reinhard"});
  check_refused({"render", "quad", "--number", "lanes5"}, {"lanes5", "lanes4"});
}

TEST_CASE("malformed options are refused") {
  check_refused({}, {"--help"});
  check_refused({"render", "quad", "--colour", "blue"}, {"--colour"});
  check_refused({"render", "quad", "spheres"}, {"spheres"});
  check_refused({"bake", "quad"}, {"--output"});
  check_refused({"render", "quad", "--threads", "0"}, {"--threads", "1 to 1024"});
  check_refused({"render", "quad", "--threads", "two"}, {"--threads"});
  check_refused({"bench", "quad", "--threads", "0"}, {"--threads", "1 to 1024"});
  check_refused({"bench", "quad", "--threads", "1000"}, {"--threads 1000", "processors"});
  check_refused({"render", "quad", "--triangles", "0"}, {"--triangles"});
  check_refused({"render", "quad", "--triangles", "200000000"}, {"--triangles", "134217728"});
  check_refused({"render", "quad", "--seed", "-1"}, {"--seed"});
  for (const char* ulp : {"-1", "x", "1.5", "4294967296", "18446744073709551615"})
    check_refused({"check", "a.frag", "--ulp", ulp}, {std::string("--ulp ") + ulp, "0 to 4294967295"});
  for (const char* rows : {"-1", "0", "-18446744073709551615", "1048577"})
    check_refused({"check", "a.frag", "--rows", rows}, {std::string("--rows ") + rows, "1 to 1048576"});
  check_refused({"eval", "a.frag", "--threads", "-1"}, {"--threads", "1 to 1024"});
  check_refused({"experiment", "sphere-map-mse", "--samples", "-1"}, {"--samples"});
  check_refused({"experiment", "sphere-map-mse", "--map-width", "-1"}, {"-1", "4096"});
  check_refused({"render", "quad", "--tile", "48"}, {"--tile", "16, 32, 64 or 128"});
  check_refused({"render", "quad", "--lanes", "32"}, {"--lanes", "4, 8 or 16"});
  check_refused({"render", "quad", "--lanes", "4", "--number", "scalar"}, {"--lanes", "--number"});
  for (const char* verb : {"render", "compare", "bench"}) {
    check_refused({verb, "quad", "--no-host-fma", "--gl-fma", "on"}, {"--no-host-fma", "--gl-fma"});
    check_refused({verb, "quad", "--gl-fma", "on", "--no-host-fma"}, {"--no-host-fma", "--gl-fma"});
  }
  check_refused({"render", "quad", "--lightmap", "0"}, {"--lightmap"});
  check_refused({"render", "quad", "--technique", "unc3", "--map", "cubes"}, {"cubes", "cube"});
  check_refused({"render", "quad", "--technique", "unc3", "--map-width", "0"}, {"--map-width", "4096"});
  check_refused({"render", "quad", "--technique", "unc3", "--map-width", "4097"}, {"--map-width", "4096"});
  check_refused({"render", "quad", "--technique", "pca8", "--order", "7"}, {"--order", "2 to 6"});
  check_refused({"render", "quad", "--technique", "pca8", "--visibility-rays", "0"}, {"--visibility-rays"});
  check_refused({"render", "quad", "--technique", "pca8", "--visibility-storage", "halves"}, {"halves", "half"});
  check_refused({"render", "quad", "--env2", "skies"}, {"skies", "sky"});
  check_refused({"render", "quad", "--env2", "studio", "--blend", "1.5"}, {"--blend", "0 to 1"});
  check_refused({"render", "raster_torture", "--technique", "unc3", "--size", "32x32"}, {"unc3"});
  check_refused({"render", "quad", "--rays", "0"}, {"--rays"});
  check_refused({"render", "quad", "--albedo", "yes"}, {"--albedo", "on or off"});
  check_refused({"render", "quad", "--exposure", "nan"}, {"--exposure", "finite"});
  check_refused({"render", "quad", "--env-rotation", "east"}, {"--env-rotation"});
  check_refused({"render", "quad", "--camera", "1,2,3"}, {"--camera", "seven numbers"});
  check_refused({"render", "quad", "--camera", "0,0,0,0,0,0,50"}, {"--camera", "same point"});
  check_refused({"render", "quad", "--camera", "1e200,0,0,0,0,0,50"}, {"--camera 1e200", "1e15"});
  check_refused({"render", "quad", "--camera", "0,0,0,0,-2e15,0,50"}, {"--camera", "1e15"});
  check_refused({"render", "quad", "--camera", "0,0,5,0,0,0,180"}, {"--camera", "field of view"});
  check_refused({"render", "quad", "--attributes", "rough"}, {"rough", "exact, native"});
  check_refused({"render", "quad", "--technique", "all"}, {"--technique"});
  check_refused({"compare", "quad", "--on", "cpu"}, {"at least two"});
  check_refused({"compare", "quad", "--on", "cpu,cpu"}, {"twice"});
  check_refused({"compare", "quad", "--on", "softpipe,cpu"}, {"cpu first"});
}

TEST_CASE("options that would mean nothing are refused, not ignored") {
  check_refused({"render", "quad", "--technique", "unc3", "--map", "cube,dual_paraboloid"}, {"--map", "name one map"});
  check_refused({"render", "quad", "--technique", "unc3", "--map", "all"}, {"--map", "name one map"});
  for (const char* verb : {"render", "compare"})
    check_refused({verb, "quad", "--shader", "a.frag", "--technique", "h4"}, {"--shader", "--technique"});
  for (const char* verb : {"render", "compare", "bake"})
    check_refused({verb, "quad", "--blend", "0.3", "-o", "none.exr"}, {"--blend", "--env2"});
  for (const char* verb : {"render", "compare"}) {
    check_refused({verb, "quad", "--exposure", "1"}, {"--exposure", "--output"});
    check_refused({verb, "quad", "--tonemap", "aces"}, {"--tonemap", "--output"});
  }
  check_refused({"render", "quad", "--technique", "h4", "--reference-rays", "3"}, {"--reference-rays", "reference"});
  check_refused({"render", "quad", "--reference-order", "3"}, {"--reference-order", "reference"});
  const std::vector<std::pair<std::string, std::vector<std::string>>> ignored{
      {"frobenius", {"--relative"}},       {"frobenius", {"--samples", "5"}},
      {"frobenius", {"--map", "cube"}},    {"frobenius", {"--order", "3"}},
      {"frobenius", {"--on", "cpu"}},      {"frobenius", {"--driver-filters"}},
      {"basis-imse", {"--relative"}},      {"figures", {"--relative"}},
      {"probe-rmse", {"--samples", "10"}}, {"sphere-map-mse", {"--basis", "sh2"}},
      {"wobble", {"--on", "cpu"}},         {"basis-imse", {"--clamp-radiance"}},
      {"wobble", {"--map-width", "8"}},    {"visibility-figures", {"--basis", "unc3"}}};
  for (const auto& [experiment, options] : ignored) {
    std::vector<std::string> arguments{"experiment", experiment};
    arguments.insert(arguments.end(), options.begin(), options.end());
    check_refused(arguments, {experiment, options.front(), "leave it out"});
  }
  for (const char* picture : {"a.exr", "a.hdr"}) {
    check_refused({"render", "quad", "-o", picture, "--exposure", "1"}, {"--exposure: PNG pictures alone have it, a."});
    check_refused({"render", "quad", "-o", picture, "--tonemap", "aces"}, {"--tonemap: PNG pictures alone have it"});
  }
}

TEST_CASE("options of machines that are not drawn on are refused") {
  const std::vector<std::pair<const char*, const char*>> of_cpu{
      {"--number", "scalar"}, {"--isa", "baseline"}, {"--tile", "16"}, {"--lanes", "4"}};
  for (const auto& [option, value] : of_cpu)
    check_refused({"render", "quad", "--on", "egl", option, value}, {option, "leave it out", "name cpu in --on"});
  check_refused({"eval", "a.frag", "--on", "egl", "--number", "scalar"}, {"--number", "name cpu in --on"});
  check_refused({"check", "a.frag", "--on", "egl,osmesa", "--lanes", "4"}, {"--lanes", "name cpu in --on"});
  check_refused({"compare", "quad", "--on", "egl,osmesa", "--lanes", "4"}, {"--lanes", "name cpu in --on"});
  check_refused({"check", "a.frag", "--tile", "16"}, {"--tile"});  // there are no tiles
  check_refused({"render", "quad", "--gl-fma", "off"}, {"--gl-fma", "leave it out", "egl, osmesa or softpipe"});
  check_refused({"render", "quad", "--on", "gpu", "--no-host-fma"}, {"--no-host-fma", "egl, osmesa or softpipe"});
  check_refused({"eval", "a.frag", "--on", "cpu", "--time-limit", "5"}, {"--time-limit", "OpenGL"});
}

TEST_CASE("options that none of the chosen techniques reads are refused") {
  for (const char* verb : {"render", "compare", "bench"})
    check_refused({verb, "quad", "--technique", "h4", "--map", "cube"}, {"--map", "h4", "leave it out", "unc3"});
  check_refused({"bake", "quad", "--technique", "h4,sh3", "--pca-metric", "surface", "-o", "none.bundle"},
                {"--pca-metric", "h4,sh3", "pca8"});
  check_refused({"render", "quad", "--technique", "unc3", "--order", "3"}, {"--order", "unc3", "pca8"});
  const Run all = run_twinshade(small_quad({"render"}, {"--technique", "pca4", "--map", "cube", "--order", "2"}));
  CHECK_MESSAGE(all.code == 0, all.err);
  for (const auto& [option, value] : {std::pair("--light", "volume"), std::pair("--attributes", "native")})
    check_refused({"render", "quad", "--technique", "reference", option, value}, {option, "reference", "leave it out"});
  const Folder folder;
  const std::string shader = folder.file("a.frag", "out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
  for (const char* verb : {"render", "compare", "bench"})
    check_refused({verb, "quad", "--shader", shader, "--light", "volume"}, {"--light volume", "leave it out"});
}

TEST_CASE("an instruction set that is unknown, or that TWINSHADE_ISA rules out, is refused") {
  ::setenv("TWINSHADE_ISA", "sse9", 1);
  check_refused(small_quad({"render"}, {}), {"TWINSHADE_ISA=sse9", "baseline, avx2, avx512"});
  check_refused({"bench", "quad"}, {"TWINSHADE_ISA=sse9"});
  CHECK(run_twinshade({"eval", "--help"}).code == 0);
  ::setenv("TWINSHADE_ISA", "baseline", 1);
  check_refused(small_quad({"render"}, {"--isa", "avx512"}), {"avx512"});
  const Run run = run_twinshade(small_quad({"render"}, {"--technique", "lightmap", "--json", "-"}));
  ::unsetenv("TWINSHADE_ISA");
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.json()["provenance"].dump().find("\"isa\":\"baseline\"") != std::string::npos);
}

TEST_CASE("a frame, a scene, lightmaps or a volume larger than memory are refused before anything is allocated") {
  if (kShadowMemory) {
    MESSAGE("not tested: sanitizers map more addresses than any limit allows");
    return;
  }
  rlimit old{};
  REQUIRE(getrlimit(RLIMIT_AS, &old) == 0);
  rlimit lower = old;
  lower.rlim_cur = rlim_t(4) << 30;
  REQUIRE(setrlimit(RLIMIT_AS, &lower) == 0);  // inherited by the program
  check_refused({"render", "quad", "--size", "16384x16384"}, {"16384x16384", "GiB", "smaller --size"});
  check_refused({"render", "quad", "--triangles", "100000000"}, {"100000000 triangles", "GiB", "fewer --triangles"});
  check_refused({"bench", "quad", "--lightmap", "4096"}, {"4096x4096 texels", "GiB", "smaller --lightmap"});
  check_refused({"bench", "quad", "--scaling", "threads", "--lightmap", "4096"},
                {"4096x4096 texels", "GiB", "smaller --lightmap"});
  check_refused({"bench", "quad", "--scaling", "threads", "--triangles", "100000000"},
                {"100000000 triangles", "GiB", "fewer --triangles"});
  check_refused({"render", "quad", "--technique", "sh6", "--light", "volume", "--volume", "256x128x128"},
                {"256x128x128 probes", "GiB", "smaller --volume"});
  REQUIRE(setrlimit(RLIMIT_AS, &old) == 0);
}

TEST_CASE("missing and truncated models are refused by name") {
  const Folder folder;
  check_refused({"render", folder / "none.gltf"}, {"none.gltf"});
  check_refused({"render", folder.file("cut.glb", std::string("glTF\x02\x00\x00\x00\xff\x00\x00\x00", 12))},
                {"cut.glb"});
  check_refused({"render", folder.file("cut.gltf", "{\"asset\": {\"version\"")}, {"cut.gltf"});
  check_refused({"render", folder.file("empty.obj", "")}, {"empty.obj"});
  check_refused({"render", folder.file("model.xyz", "solid")}, {"model.xyz"});
}

TEST_CASE("damaged bundles are refused by name, and those that are not there or none with the reason") {
  const Folder folder;
  check_refused({"render", folder / "none.bundle"}, {"none.bundle: cannot be read: No such file or directory"});
  check_refused({"render", folder.file("no.bundle", "text")}, {"no.bundle: is not a bundle; make one with"});
  const std::string good = folder / "good.bundle";
  const Run bake = run_twinshade(small_quad({"bake"}, {"--technique", "lightmap", "-o", good}));
  REQUIRE_MESSAGE(bake.code == 0, bake.err);
  std::string bytes = content_of(good);
  check_refused({"render", folder.file("cut.bundle", bytes.substr(0, bytes.size() / 2)), "--technique", "lightmap"},
                {"cut.bundle"});
  bytes[bytes.size() / 2] ^= 1;
  check_refused({"render", folder.file("flipped.bundle", bytes), "--technique", "lightmap"}, {"flipped.bundle"});
}

TEST_CASE("a bundle without a technique's coefficients names all places that it looked in, and the remedy") {
  const Folder folder;
  const std::string bundle = folder / "quad.bundle";
  REQUIRE(run_twinshade(small_quad({"bake"}, {"--technique", "h4", "-o", bundle})).code == 0);
  check_refused(
      {"render", bundle, "--technique", "sh3"},
      {"technique sh3: " + bundle + " has nothing for it in a lightmap or vertices or a volume", "--technique sh3"});
  check_refused({"render", bundle, "--technique", "h6", "--light", "vertex"}, {"in vertices; bake"});
}

TEST_CASE("options that would change a bundle are refused, not ignored") {
  const Folder folder;
  const std::string bundle = folder / "b.bundle";
  REQUIRE(run_twinshade(small_quad({"bake"}, {"--technique", "lightmap", "-o", bundle})).code == 0);
  check_refused({"render", bundle, "--technique", "lightmap", "--size", "10x10"}, {"--size", "bake"});
  check_refused({"render", bundle, "--technique", "lightmap", "--env", "sky"}, {"--env", "bake"});
  check_refused({"render", bundle, "--technique", "lightmap", "--clamp-radiance"}, {"--clamp-radiance", "bake"});
  check_refused({"render", bundle, "--technique", "lightmap", "--seed", "2"}, {"--seed", "bake"});
  check_refused({"render", bundle, "--technique", "reference"}, {"b.bundle: technique reference", "name a built-in"});
}

TEST_CASE("environments with NaN, infinite or negative radiance name the pixel, and are taken clamped if asked") {
  const Folder folder;
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<std::string, float>> odd{
      {"nan.exr", NAN}, {"inf.exr", infinity}, {"negative.exr", -1.0f}};
  for (const auto& [name, value] : odd) {
    const std::string path = environment_with(folder, name, value, 5, 2);
    check_refused(small_quad({"render"}, {"--env", path}), {name, "5", "2", "--clamp-radiance"});
    const Run clamped = run_twinshade(small_quad({"render"}, {"--env", path, "--clamp-radiance"}));
    INFO(clamped.err);
    CHECK(clamped.code == 0);
  }
}

TEST_CASE("missing and truncated environment pictures are refused by name") {
  const Folder folder;
  const std::string whole = content_of(environment_with(folder, "whole.exr", 2.0f, 0, 0));
  check_refused({"render", "quad", "--env", folder / "none.hdr"}, {"none.hdr"});
  check_refused({"render", "quad", "--env", folder.file("cut.exr", whole.substr(0, whole.size() / 2))}, {"cut.exr"});
  check_refused({"render", "quad", "--env", folder.file("text.hdr", "not a picture")}, {"text.hdr"});
}

TEST_CASE("bad GLSL is refused with the file and line of the include that is wrong") {
  const Folder folder;
  folder.file("part.glsl", "float half_of(float x) {\n  return x * half;\n}\n");
  const std::string main = folder.file(
      "main.frag",
      "#include \"part.glsl\"\nin vec2 v_uv;\nout vec4 color;\nvoid main() { color = vec4(half_of(v_uv.x)); }\n");
  check_refused(small_quad({"render"}, {"--shader", main}), {"part.glsl:2"});
  check_refused({"translate", main}, {"part.glsl:2"});
  const std::string missing =
      folder.file("missing.frag", "out vec4 color;\n#include \"nowhere.glsl\"\nvoid main() {}\n");
  check_refused({"translate", missing}, {"missing.frag:2", "nowhere.glsl"});
  check_refused({"render", "quad", "--shader", folder / "none.frag"}, {"none.frag"});
  const std::string broken = folder.file("new\nline.frag", "out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
  check_refused({"translate", broken}, {"new?line.frag: the path has a control"});
  check_refused(small_quad({"render"}, {"--shader", broken}), {"new?line.frag: the path has a control"});
}

TEST_CASE("a shader that reads what the scene does not have is refused, naming it") {
  const Folder folder;
  const std::string shader =
      folder.file("wants.frag", "in vec2 v_warp;\nout vec4 color;\nvoid main() { color = vec4(v_warp, 0.0, 1.0); }\n");
  const std::string timed = folder.file("timed.frag",
                                        "out vec4 color;\nuniform float unused; uniform vec3 tint = vec3(2);\n"
                                        "uniform float time;\nvoid main() { color = vec4(tint, time); }\n");
  for (const char* verb : {"render", "compare"}) {
    const Run run = run_twinshade(small_quad({verb}, {"--shader", timed}));
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find("timed.frag:3: uniform \"time\" is none of a scene's and has no initial value: write "
                               "\"uniform float time = 1.0;\"") != std::string::npos,
                  run.err);
    CHECK(run.err.find("baking") == std::string::npos);
  }
  check_refused(small_quad({"render"}, {"--shader", shader}), {"wants.frag:1: input \"v_warp\"", "v_uv"});
  check_refused(small_quad({"compare"}, {"--shader", shader, "--on", "cpu,egl"}), {"wants.frag:1", "v_warp"});
  const std::string light = folder.file("light.frag",
                                        "struct Light { vec3 colour; };\nout vec4 color;\n\nuniform Light light;\n"
                                        "void main() { color = vec4(light.colour, 1.0); }\n");
  check_refused(small_quad({"render"}, {"--shader", light}),
                {"light.frag:4: uniform \"light.colour\"", "initial value"});
}

TEST_CASE("outputs that cannot be written are refused before anything is drawn") {
  const Folder folder;
  check_refused(small_quad({"render"}, {"-o", "/nonexistent/x.exr"}), {"/nonexistent"});
  check_refused(small_quad({"bake"}, {"-o", "/nonexistent/x.bundle"}), {"/nonexistent"});
  check_refused(small_quad({"render"}, {"--json", "/nonexistent/x.json"}), {"/nonexistent"});
  check_refused({"translate", "h4", "-o", "/nonexistent/x.cpp"}, {"/nonexistent"});
  check_refused(small_quad({"render"}, {"-o", folder / "x.bmp"}), {"x.bmp", ".exr, .hdr or .png"});
  check_refused(small_quad({"render"}, {"-o", folder / ""}), {".exr, .hdr or .png"});
  std::filesystem::create_directories(folder / "taken.exr");
  check_refused(small_quad({"render"}, {"-o", folder / "taken.exr"}), {"taken.exr", "folder"});
  check_refused(small_quad({"compare"}, {"-o", folder.file("file", "x")}), {"file"});
  CHECK(folder.names() == std::vector<std::string>{"file", "taken.exr"});
}

TEST_CASE("an empty name of what to write is refused by its option") {
  for (const char* option : {"-o", "--output"})
    for (const char* verb : {"render", "bake", "compare", "bench"})
      check_refused({verb, "quad", option, ""}, {"-o '': the name is empty; name the f"});
  check_refused({"translate", "h4", "-o", ""}, {"-o '': the name is empty; name the file to write"});
  check_refused({"experiment", "frobenius", "-o", ""}, {"-o '': the name is empty; name the folder to write"});
  check_refused({"bake", "quad", "-o", "-"}, {"-o -: ", "/dev/stdout"});
  check_refused({"list", "--json", ""}, {"--json '': the name is empty; name the file to write"});
  check_refused({"check", "a.frag", "--junit", ""}, {"--junit '': the name is empty"});
  check_refused({"check", "a.frag", "--html", ""}, {"--html '': the name is empty"});
  check_refused({"eval", "a.frag", "--cases", "a.json", "--junit", ""}, {"--junit '': the name is empty"});
}

TEST_CASE(
    "an empty name of what to read is refused: another shader's frames would pass for those of the one that is meant") {
  for (const char* verb : {"render", "compare", "bench"}) {
    check_refused({verb, "quad", "--shader", ""}, {"--shader '': the name is empty; name the file to read"});
    check_refused({verb, "quad", "--env2", ""}, {"--env2 '': the name is empty"});
  }
  check_refused({"check", "a.frag", "--inputs", ""}, {"--inputs '': the name is empty"});
  check_refused({"eval", "a.frag", "--cases", ""}, {"--cases '': the name is empty"});
}

TEST_CASE("a refusal makes no folder of results, and what would keep it from being made is said before any work") {
  const Folder folder;
  const std::string fresh = folder / "new/results", file = folder.file("file", "x");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"bench", "quad", "--scaling", "overdraw"},
                                                    {"bench", "quad", "--scaling", "threads", "--technique", "unc3"},
                                                    {"bench", "quad", "--technique", "h5"},
                                                    {"compare", "quad", "--technique", "h5"},
                                                    {"compare", "courtyrd"},
                                                    {"experiment", "frobenius", "--basis", "h5"}}) {
    std::vector<std::string> refused = arguments;
    refused.insert(refused.end(), {"-o", fresh});
    if (arguments[0] == "bench") refused.insert(refused.end(), {"--threads", "1"});
    check_refused(refused, {});
  }
  const std::string below = file + "/results", long_name = folder / std::string(300, 'x');
  check_refused({"compare", "quad", "-o", below}, {below + ": cannot be created: " + file + " is not a folder"});
  check_refused({"compare", "quad", "-o", long_name}, {long_name + ": cannot be created: File name too long"});
  CHECK(folder.names() == std::vector<std::string>{"file"});
  CHECK(run_twinshade({"experiment", "frobenius", "--basis", "sh2", "-o", fresh}).code == 0);
  CHECK(std::filesystem::exists(fresh + "/frobenius.csv"));
}

TEST_CASE("what may not grow to its size is refused by name, the old file stays, and a bake is only not cached") {
  const Folder folder;
  const std::vector<std::string> pictures{"a.exr", "a.hdr", "a.png"};
  const std::vector<std::string> bake = small_quad({"bake"}, {"--technique", "h4", "-o", folder / "a.bundle"});
  REQUIRE(run_twinshade(bake).code == 0);  // its light is in the cache now
  for (const std::string& name : pictures)
    REQUIRE(run_twinshade({"render", folder / "a.bundle", "--technique", "h4", "-o", folder / name}).code == 0);
  const std::string bundle = content_of(folder / "a.bundle"), picture = content_of(folder / "a.png");
  folder.file("a.cpp", "old");
  const std::vector<std::string> before = folder.names();
  rlimit old{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
  rlimit lower = old;
  lower.rlim_cur = 512;
  REQUIRE(setrlimit(RLIMIT_FSIZE, &lower) == 0);  // inherited by the program
  for (const std::string& name : pictures)
    check_refused({"render", folder / "a.bundle", "--technique", "h4", "-o", folder / name},
                  {(folder / name) + ": cannot be written: File too large"});
  check_refused(bake, {"a.bundle: cannot be written: File too large"});
  check_refused({"translate", "h4", "-o", folder / "a.cpp"}, {"a.cpp: cannot be written: File too large"});
  const Run fresh = run_twinshade(small_quad({"render"}, {"--technique", "h4", "--seed", "20231"}));
  REQUIRE(setrlimit(RLIMIT_FSIZE, &old) == 0);
  CHECK(fresh.code == 0);
  CHECK(fresh.err.find("bake not cached: ") != std::string::npos);
  CHECK(folder.names() == before);
  CHECK(content_of(folder / "a.bundle") == bundle);
  CHECK(content_of(folder / "a.png") == picture);
  CHECK(content_of(folder / "a.cpp") == "old");
}

TEST_CASE("a folder without permission is refused") {
  if (::geteuid() == 0) {
    MESSAGE("not tested: root may write everywhere");
    return;
  }
  const Folder folder;
  std::filesystem::create_directories(folder / "shut");
  std::filesystem::permissions(folder / "shut",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  check_refused(small_quad({"render"}, {"-o", folder / "shut/x.exr"}), {"shut"});
}

TEST_CASE("a refusal after drawing has begun leaves no partial file") {
  const Folder folder, output;
  const std::string shader =
      folder.file("wants.frag", "in vec2 v_warp;\nout vec4 color;\nvoid main() { color = vec4(v_warp, 0.0, 1.0); }\n");
  check_refused(small_quad({"render"}, {"--shader", shader, "-o", output / "x.exr", "--json", output / "x.json"}),
                {"v_warp"});
  CHECK(output.names().empty());
}

TEST_CASE("a file without an end is refused by name, whatever it is given as") {
  const Folder folder;
  const std::string shader = folder.file("a.frag", "#version 450\nout vec4 color;\nvoid main() { color = vec4(1); }\n");
  check_refused({"translate", "/dev/zero"}, {"/dev/zero: has more than"});
  check_refused({"eval", shader, "--cases", "/dev/zero", "--on", "cpu"}, {"/dev/zero: has more than 256 MiB"});
}

TEST_CASE("a misspelt folder of cases is said to be missing, one that cannot be read is named") {
  const Folder folder;
  check_refused({"eval", folder / "no", "--on", "cpu"}, {"no: there is no such file or folder"});
  check_refused({"eval", folder.file("a.frag", ""), "--on", "cpu"}, {"--cases is missing"});
  if (::geteuid() == 0) {
    MESSAGE("not tested: root may read every folder");
    return;
  }
  std::filesystem::create_directories(folder / "shut");
  std::filesystem::permissions(folder / "shut", std::filesystem::perms::none);
  check_refused({"eval", folder / "shut", "--on", "cpu"}, {"shut: cannot be read: Permission denied"});
}

}  // namespace twinshade

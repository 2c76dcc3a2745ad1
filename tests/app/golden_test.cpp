// The verb golden: images are drawn, kept, and held to; what differs is named with its cause.
#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "run_twinshade.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const char* const kGoldenShader = R"(#version 450
in vec2 v_uv;
flat in int v_material;
uniform sampler2DArray albedo_maps;
out vec4 color;
void main() {
  precise vec3 c = texelFetch(albedo_maps, ivec3(0, 0, v_material), 0).rgb * v_uv.x + v_uv.y;
  color = vec4(c, 1.000000000);
}
)";

std::string golden_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  REQUIRE_MESSAGE(text.find(from) != std::string::npos, from);
  return text.replace(text.find(from), from.size(), to);
}

Run update(const std::string& folder, const std::vector<std::string>& more) {
  return run_twinshade(small_quad({"golden", "update", folder}, more));
}

Run update_again(const std::string& folder, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"golden", "update", folder, "--json", "-"});
  return run_twinshade(more);
}

Run check(const std::string& folder, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"golden", "check", folder, "--json", "-"});
  return run_twinshade(more);
}

Json golden_row(const Run& run, const std::string& name) {
  const Json json = run.json();
  for (const Json& row : json.contains("results") ? json["results"] : json["entries"])
    if (row["name"] == name) return row;
  FAIL("no row " << name << ": " << run.out);
  return {};
}

// Exit code 2 and one line that says so.
void check_golden_refused(const Run& run, const std::string& reason) {
  CHECK(run.code == 2);
  CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("what golden update kept golden check finds the same, on every backend, number type and thread count") {
  const Folder folder;
  const std::string goldens = folder / "goldens";
  const Run made = update(goldens, {"--technique", "h4,sh3"});
  REQUIRE_MESSAGE(made.code == 0, made.err);
  CHECK(made.out.find("2 added") != std::string::npos);
  CHECK(fs::exists(goldens + "/golden.json"));
  CHECK(fs::exists(goldens + "/quad.h4.exr"));
  CHECK(fs::exists(goldens + "/quad.sh3.exr"));
  const auto same = [&](const std::vector<std::string>& options) {
    const Run run = check(goldens, options);
    CHECK_MESSAGE(run.code == 0, run.err);
    const Json json = run.json();
    for (const Json& row : json["results"]) CHECK(row["result"] == "same");
    return json["results"].size();
  };
  CHECK(same({}) == 2);
  CHECK(same({"--threads", "1"}) == 2);
  CHECK(same({"--number", "scalar"}) == 2);
  CHECK(same({"--isa", "baseline"}) == 2);
  CHECK(same({"--tile", "16", "--only", "quad.h*"}) == 1);
  std::string backends = "cpu";
  for (const std::string& backend : opengl_backends()) backends += "," + backend;
  CHECK(same({"--on", backends}) == 2 * std::size_t(1 + std::count(backends.begin(), backends.end(), ',')));
}

TEST_CASE("updating again what has not changed writes the same bytes, and on one thread the same as on two") {
  const Folder folder;
  REQUIRE(update(folder / "a", {"--technique", "h4,unc3", "--threads", "1"}).code == 0);
  REQUIRE(update(folder / "b", {"--technique", "unc3,h4", "--threads", "2"}).code == 0);
  for (const char* file : {"golden.json", "quad.h4.exr", "quad.unc3_cube.exr"})
    CHECK_MESSAGE(golden_bytes(folder / "a/" + file) == golden_bytes(folder / "b/" + file), file);
  const auto before = fs::last_write_time(folder / "a/quad.h4.exr");
  const std::string manifest = golden_bytes(folder / "a/golden.json");
  const Run again = update_again(folder / "a");
  CHECK(again.code == 0);
  CHECK(golden_row(again, "quad.h4")["result"] == "same");
  CHECK(golden_row(again, "quad.h4")["image"].is_null());
  CHECK(fs::last_write_time(folder / "a/quad.h4.exr") == before);
  CHECK(golden_bytes(folder / "a/golden.json") == manifest);
}

TEST_CASE("a shader that changed by one ULP is found, and named as the cause; update accepts it") {
  const Folder folder;
  const std::string shader = folder.file("mine.frag", kGoldenShader), goldens = folder / "goldens";
  REQUIRE(update(goldens, {"--shader", shader, "--name", "mine"}).code == 0);
  CHECK(check(goldens).code == 0);
  // A comment changes the source, not the frame.
  folder.file("mine.frag", kGoldenShader + std::string("// looks good\n"));
  Run run = check(goldens);
  CHECK(run.code == 0);
  CHECK(golden_row(run, "mine")["changed"] == Json({"shader"}));

  folder.file("mine.frag", edited(kGoldenShader, "1.000000000", "1.000000119"));
  run = check(goldens, {"-o", folder / "out", "--junit", folder / "j.xml", "--html", folder / "r.html"});
  CHECK(run.code == 1);
  const Json row = golden_row(run, "mine");
  CHECK(row["result"] == "DIFFERS");
  CHECK(row["max_ulp"] == 1);
  CHECK(row["coverage_differs"] == 0);
  CHECK(row["pixels_differ"] == row["shaded_pixels"]);
  CHECK(row["first_difference"]["layer"] == "color");
  CHECK(row["first_difference"]["component"] == "color.a");
  CHECK(row["first_difference"]["inputs"].size() == 3);
  CHECK(row["changed"] == Json({"shader"}));
  CHECK(run.err.find("the shader's source has changed") != std::string::npos);
  CHECK(run.err.find("0 of 1 the same") != std::string::npos);
  for (const char* name : {"mine.golden.png", "mine.cpu.png", "mine.cpu.difference.png", "mine.cpu.exr"})
    CHECK_MESSAGE(fs::exists(folder / "out/" + name), name);
  const std::string page = golden_bytes(folder / "r.html");
  CHECK(page.find("<figcaption>golden</figcaption>") != std::string::npos);
  CHECK(page.find("the shader's source has changed") != std::string::npos);
  const std::string junit = golden_bytes(folder / "j.xml");
  CHECK(junit.find("failures=\"1\"") != std::string::npos);
  CHECK(junit.find("the shader's source has changed") != std::string::npos);
  if (const std::vector<std::string> backends = opengl_backends(); !backends.empty()) {
    const Run both = check(goldens, {"--on", "cpu," + backends.front()});
    CHECK(both.code == 1);
    CHECK(both.err.find("mine: " + backends.front() + " draws the same bits as cpu") != std::string::npos);
    CHECK(both.err.find("0 of 2 the same") != std::string::npos);
  }
  CHECK(check(goldens, {"--ulp", "1"}).code == 0);
  CHECK(golden_row(check(goldens, {"--ulp", "1"}), "mine")["result"] == "within");

  run = update_again(goldens);
  CHECK(run.code == 0);
  CHECK(golden_row(run, "mine")["result"] == "changed");
  CHECK(golden_row(run, "mine")["max_ulp"] == 1);
  run = check(goldens, {"-o", folder / "out"});
  CHECK(run.code == 0);
  CHECK_FALSE(fs::exists(folder / "out/mine.cpu.difference.png"));
}

TEST_CASE("where the CPU draws the image and a driver does not, the line that differs is named, once for a shader") {
  const std::vector<std::string> backends = opengl_backends();
  if (backends.empty()) return;
  const Folder folder;
  const std::string shader = folder.file("s.frag",
                                         "in vec2 v_uv;\nout vec4 color;\nvoid main() {\n  float a = v_uv.x * 3.0;\n"
                                         "  float x = sin(a * 13.0);\n  color = vec4(x, a, 0.5, 1.0);\n}\n"),
                    goldens = folder / "goldens";
  for (const char* name : {"s", "t"}) REQUIRE(update(goldens, {"--shader", shader, "--name", name}).code == 0);
  const Run run = check(goldens, {"--on", backends.front(), "--annotate", "github"});
  CHECK(run.code == 1);
  const Json row = golden_row(run, "s");
  CHECK(row["first_line"]["line"] == 5);
  CHECK(row["first_line"]["value"] == "x");
  CHECK_FALSE(golden_row(run, "t").contains("first_line"));
  CHECK(run.err.find(",line=5,") != std::string::npos);
  // Changed, the CPU draws another image: no driver is to blame.
  folder.file("s.frag", edited(golden_bytes(shader), "3.0", "3.5"));
  CHECK_FALSE(golden_row(check(goldens, {"--on", backends.front()}), "s").contains("first_line"));
}

TEST_CASE("the cause of a difference is the bundle where that changed, and none where nothing did") {
  const Folder folder;
  const std::string bundle = folder / "a.bundle", goldens = folder / "goldens";
  const auto bake = [&](const char* environment) {
    REQUIRE(run_twinshade(small_quad({"bake"}, {"--technique", "h4", "--env", environment, "-o", bundle})).code == 0);
  };
  bake("sky");
  REQUIRE(run_twinshade({"golden", "update", goldens, bundle, "--technique", "h4"}).code == 0);
  CHECK(check(goldens).code == 0);
  bake("studio");
  Run run = check(goldens);
  CHECK(run.code == 1);
  CHECK(golden_row(run, "a.h4")["changed"] == Json({"bundle"}));
  CHECK(run.err.find("the bundle (scene, camera, light or bake) has changed") != std::string::npos);

  // The image of another frame, with a manifest that says it is of this one: as of a compiler that has changed.
  REQUIRE(run_twinshade({"golden", "update", folder / "other", bundle, "--technique", "h4"}).code == 0);
  bake("sky");
  const Json other = Json::parse(golden_bytes(folder / "other/golden.json"))["entries"][0];
  std::string manifest = golden_bytes(goldens + "/golden.json");
  const Json own = Json::parse(manifest)["entries"][0];
  std::ofstream(goldens + "/golden.json") << edited(manifest, own["frame"], other["frame"]);
  fs::copy_file(folder / "other/a.h4.exr", goldens + "/a.h4.exr", fs::copy_options::overwrite_existing);
  run = check(goldens);
  CHECK(run.code == 1);
  CHECK(golden_row(run, "a.h4")["changed"].empty());
  CHECK(run.err.find("neither the shader's source nor the bundle has changed") != std::string::npos);
}

TEST_CASE("a folder moves with the files that it names") {
  const Folder folder;
  fs::create_directories(folder / "here/shaders");
  folder.file("here/shaders/mine.frag", kGoldenShader);
  REQUIRE(update(folder / "here/goldens", {"--shader", folder / "here/shaders/mine.frag"}).code == 0);
  const std::string manifest = golden_bytes(folder / "here/goldens/golden.json");
  CHECK(manifest.find("\"../shaders/mine.frag\"") != std::string::npos);
  fs::rename(folder / "here", folder / "there");
  const Run run = check(folder / "there/goldens");
  CHECK_MESSAGE(run.code == 0, run.err);
  CHECK(run.json()["results"][0]["changed"].empty());
  CHECK(golden_row(update_again(folder / "there/goldens"), "quad.mine")["result"] == "same");
  CHECK(golden_bytes(folder / "there/goldens/golden.json") == manifest);
}

TEST_CASE("an image that is missing or damaged fails by name, and update makes it anew") {
  const Folder folder;
  const std::string goldens = folder / "goldens", image = goldens + "/quad.h4.exr";
  REQUIRE(update(goldens, {"--technique", "h4,lightmap"}).code == 0);
  const std::string good = golden_bytes(image);
  const auto fails = [&](const char* word, const char* reason) {
    const Run run = check(goldens);
    CHECK(run.code == 1);
    CHECK(golden_row(run, "quad.h4")["result"] == word);
    CHECK(golden_row(run, "quad.lightmap")["result"] == "same");
    CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
    CHECK(run.err.find("1 of 2 the same") != std::string::npos);
  };
  fs::remove(image);
  fails("no image", "there is no such file");
  std::ofstream(image, std::ios::binary) << good.substr(0, good.size() / 2);
  fails("damaged", "quad.h4.exr: cannot be read as an image");
  std::ofstream(image, std::ios::binary) << "version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 2\n";
  fails("damaged", "git lfs pull");
  fs::copy_file(goldens + "/quad.lightmap.exr", image, fs::copy_options::overwrite_existing);
  fails("damaged", "not the image that the manifest is about");
  CHECK(golden_row(update_again(goldens, {"--only", "*.h4"}), "quad.h4")["result"] == "restored");
  CHECK(golden_bytes(image) == good);
  CHECK(check(goldens).code == 0);
}

TEST_CASE("an entry that cannot be drawn fails by name, and the others go on") {
  const Folder folder;
  const std::string goldens = folder / "goldens";
  REQUIRE(update(goldens, {"--technique", "h4,lightmap,sh3"}).code == 0);
  std::string manifest = golden_bytes(goldens + "/golden.json");
  manifest = edited(manifest, "\"technique\": \"lightmap\"", "\"technique\": \"lightmop\"");
  manifest = edited(manifest,
                    "\"quad\",\n        \"size\": \"64x40\",\n        \"lightmap\": \"16\",\n        \"rays\": "
                    "\"16\",\n        \"technique\": \"sh3\"",
                    "\"quod\",\n        \"technique\": \"sh3\"");
  std::ofstream(goldens + "/golden.json") << manifest;
  for (const bool updates : {false, true}) {
    const Run run = updates ? update_again(goldens) : check(goldens);
    CHECK(run.code == 1);
    CHECK(golden_row(run, "quad.h4")["result"] == "same");
    CHECK(golden_row(run, "quad.lightmap")["result"] == "failed");
    CHECK(run.err.find("unknown technique 'lightmop'; did you mean 'lightmap'?") != std::string::npos);
    CHECK_MESSAGE(run.err.find("unknown scene 'quod'; did you mean 'quad'?") != std::string::npos, run.err);
  }
  CHECK(golden_bytes(goldens + "/golden.json") == manifest);
}

TEST_CASE("a shader with several outputs has an image of each") {
  const Folder folder;
  const std::string shader = folder.file("two.frag", R"(#version 450
in vec2 v_uv;
layout(location = 1) out uvec4 number;
layout(location = 0) out vec4 color;
void main() {
  color = vec4(v_uv, 0.0, 1.0);
  number = uvec4(floatBitsToUint(v_uv.x), 0xff800001u, 1u, 0xffffffffu);
}
)");
  REQUIRE(update(folder / "g", {"--shader", shader, "--name", "two"}).code == 0);
  const Run run = check(folder / "g", {"--on", opengl_backends().empty() ? "cpu" : "cpu," + opengl_backends().front()});
  CHECK_MESSAGE(run.code == 0, run.err);
  CHECK(golden_row(run, "two.color")["result"] == "same");
  CHECK(golden_row(run, "two.number")["result"] == "same");
  folder.file("two.frag", edited(golden_bytes(shader), "0xff800001u", "0xff800002u"));
  const Run changed = check(folder / "g", {"--ulp", "100"});
  CHECK(changed.code == 1);
  CHECK(golden_row(changed, "two.color")["result"] == "same");
  CHECK(golden_row(changed, "two.number")["result"] == "DIFFERS");
  folder.file("two.frag",
              edited(golden_bytes(shader), "out uvec4 number", "out uvec4 digits") + "#define number digits\n");
  CHECK(golden_row(check(folder / "g"), "two.number")["result"] == "failed");
}

TEST_CASE("runs of update at once keep each other's entries") {
  const Folder folder;
  const std::string goldens = folder / "g";
  std::vector<std::thread> runs;
  for (const char* name : {"a", "b", "c", "d"})
    runs.emplace_back([&, name] { CHECK(update(goldens, {"--technique", "lightmap", "--name", name}).code == 0); });
  for (std::thread& run : runs) run.join();
  const Run run = check(goldens);
  CHECK(run.code == 0);
  CHECK(run.json()["results"].size() == 4);
}

TEST_CASE("remove drops entries with their images, and images without an entry; what it does not know drops nothing") {
  const Folder folder;
  const std::string goldens = folder / "g";
  REQUIRE(update(goldens, {"--technique", "h4,h6,lightmap,sh3"}).code == 0);
  fs::copy_file(goldens + "/quad.h4.exr", goldens + "/stray.exr");
  std::ofstream(goldens + "/quad.other.exr") << "a picture of mine";
  const std::string manifest = golden_bytes(goldens + "/golden.json");
  const auto remove = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"golden", "remove", goldens});
    return run_twinshade(words);
  };
  check_golden_refused(remove({"quad.h4", "quad.h5"}), "did you mean 'quad.h4'");
  check_golden_refused(remove({""}), "the entry's name is empty");
  check_golden_refused(remove({"quad.other"}), "unknown entry 'quad.other'");
  check_golden_refused(remove({"quad.h4", "--json", goldens + "/golden.json"}), "it would replace");
  check_golden_refused(remove({}), "golden remove --help");
  check_golden_refused(run_twinshade({"golden", "remove", folder / "none", "x"}), "there is none yet");
  CHECK(golden_bytes(goldens + "/golden.json") == manifest);
  CHECK(fs::exists(goldens + "/quad.h4.exr"));

  const Run run = remove({"stray", "quad.h?", "quad.h4"});
  CHECK_MESSAGE(run.code == 0, run.err);
  CHECK(run.out == "removed quad.h4\nremoved quad.h6\nremoved stray\n3 removed, 2 left\n");
  for (const char* name : {"quad.h4", "quad.h6", "stray"}) CHECK_FALSE(fs::exists(goldens + "/" + name + ".exr"));
  CHECK(golden_bytes(goldens + "/quad.other.exr") == "a picture of mine");
  CHECK(check(goldens).json()["results"].size() == 2);
  const Json left = remove({"*", "--json", "-"}).json();
  CHECK(left["left"] == 0);
  CHECK(left["removed"][1]["name"] == "quad.sh3");
  check_golden_refused(check(goldens, {"--quiet"}), "it has no entries");
}

TEST_CASE("where a merge took the image of one side and the manifest of the other, check says so") {
  const Folder folder;
  REQUIRE(update(folder / "ours", {"--technique", "h4"}).code == 0);
  REQUIRE(update(folder / "theirs", {"--technique", "h4", "--env", "studio"}).code == 0);
  const auto says = [&](const std::string& manifest, const std::string& image) {
    fs::create_directories(folder / "merged");
    for (const auto& [from, file] : {std::pair(manifest, "/golden.json"), std::pair(image, "/quad.h4.exr")})
      fs::copy_file(folder / from + file, folder / "merged" + file, fs::copy_options::overwrite_existing);
    const Run run = check(folder / "merged");
    CHECK(run.code == 1);
    return run.err;
  };
  CHECK(says("ours", "theirs").find("makes the image anew") != std::string::npos);
  // Options of ours, hash of theirs: frames are drawn as the image is.
  std::string mixed = golden_bytes(folder / "ours/golden.json");
  const Json theirs = Json::parse(golden_bytes(folder / "theirs/golden.json"))["entries"][0];
  mixed = edited(mixed, Json::parse(mixed)["entries"][0]["frame"], theirs["frame"]);
  fs::create_directories(folder / "mixed");
  std::ofstream(folder / "mixed/golden.json") << mixed;
  CHECK(says("mixed", "ours").find("is the image") != std::string::npos);
}

TEST_CASE("files that have but the root in common with the folder are kept by absolute paths") {
  const Folder folder;
  const std::string name = "twinshade_golden_" + std::to_string(::getpid());
  const fs::path elsewhere = fs::path("/dev/shm") / name;
  if (!fs::is_directory("/dev/shm") || *std::next(fs::path(folder / "g").begin()) == "dev") return;
  fs::create_directories(elsewhere);
  const std::string shader = (elsewhere / "mine.frag").string();
  std::ofstream(shader) << kGoldenShader;
  const Run made = update(folder / "g", {"--shader", shader, "--name", "mine"});
  CHECK_MESSAGE(made.code == 0, made.err);
  CHECK(golden_bytes(folder / "g/golden.json").find('"' + shader + '"') != std::string::npos);
  CHECK(check(folder / "g").code == 0);
  fs::remove_all(elsewhere);
  check_golden_refused(update(folder / "g", {"--shader", "none.frag"}),
                       (fs::current_path() / "none.frag").string() + ": cannot be read");
}

TEST_CASE("entries of one scene do not depend on each other") {
  const Folder folder;
  REQUIRE(update(folder / "all", {"--technique", "unc3,unc6,h4,pca4", "--order", "3"}).code == 0);
  const Json all = Json::parse(golden_bytes(folder / "all/golden.json"))["entries"];
  for (const Json& entry : all) {
    const std::string technique = entry["draw"]["technique"];
    std::vector<std::string> options{"--technique", technique};
    if (technique == "pca4") options.insert(options.end(), {"--order", "3"});
    REQUIRE(update(folder / technique, options).code == 0);
    const Json alone = Json::parse(golden_bytes(folder / (technique + "/golden.json")))["entries"][0];
    for (const char* key : {"name", "draw", "frame", "bundle", "shader"})
      CHECK_MESSAGE(alone[key] == entry[key], technique);
  }
}

TEST_CASE("--quiet prints what does not pass, and the sum") {
  const Folder folder;
  REQUIRE(update(folder / "g", {"--technique", "h4,lightmap"}).code == 0);
  Run run = run_twinshade({"golden", "check", folder / "g", "--quiet"});
  CHECK(run.code == 0);
  CHECK(run.out == "2 of 2 the same\n");
  CHECK(run.err.empty());
  fs::remove(folder / "g/quad.h4.exr");
  run = run_twinshade({"golden", "check", folder / "g", "--quiet"});
  CHECK(run.code == 1);
  CHECK(run.out.find("quad.lightmap") == std::string::npos);
  CHECK(run.out.find("quad.h4") != std::string::npos);
}

TEST_CASE("a backend that cannot draw is told apart from one that draws otherwise") {
  if (why_missing("gpu").empty()) return;
  const Folder folder;
  REQUIRE(update(folder / "g", {"--technique", "h4"}).code == 0);
  const Run run = check(folder / "g", {"--on", "cpu,gpu"});
  CHECK(run.code == 2);
  CHECK(run.json()["results"][0]["result"] == "same");
  CHECK(run.json()["results"][1]["result"] == "no backend");
}

TEST_CASE("golden refuses what it cannot do in one line, and writes nothing") {
  const Folder folder;
  const std::string goldens = folder / "goldens", shader = folder.file("mine.frag", kGoldenShader);
  check_golden_refused(run_twinshade({"golden", "update", goldens}), "there is none yet");
  check_golden_refused(run_twinshade({"golden"}), "say update, check or remove");
  check_golden_refused(run_twinshade({"golden", "chekc", goldens}), "did you mean 'check'?");
  check_golden_refused(run_twinshade({"golden", "check", goldens, "--onn", "cpu"}), "--onn");
  check_golden_refused(run_twinshade({"golden", "check", ""}), "the folder's name is empty");
  check_golden_refused(update(goldens, {"--technique", "h5"}), "unknown technique 'h5'");
  check_golden_refused(update(goldens, {"--technique", "reference"}), "it has no shader");
  check_golden_refused(update(goldens, {"--technique", "h4", "--name", "../x"}), "--name '../x'");
  check_golden_refused(update(goldens, {"--technique", "h4", "--name", ""}), "--name ''");
  check_golden_refused(update(goldens, {"--technique", "h4", "--name", "a", "--name", "b"}),
                       "--name is given 2 times: give it once (twinshade golden update --help");
  check_golden_refused(update(goldens, {"--technique"}), "--technique: its value is missing: T,...");
  check_golden_refused(run_twinshade({"golden", "check", goldens}), "there is none yet");
  check_golden_refused(update(goldens, {"--technique", "h4", "--only", "x"}), "--only");
  check_golden_refused(update(goldens, {"--shader", folder / "none.frag"}), "none.frag");
  check_golden_refused(update(goldens, {"--shader", shader, "--technique", "h4"}), "--shader");
  check_golden_refused(run_twinshade({"golden", "update", goldens, folder / "none.glb"}), "none.glb");
  check_golden_refused(update(shader, {"--technique", "h4"}), "is not a folder");
  CHECK_FALSE(fs::exists(goldens));

  REQUIRE(update(goldens, {"--technique", "h4"}).code == 0);
  const std::string manifest = golden_bytes(goldens + "/golden.json");
  check_golden_refused(run_twinshade({"golden", "check", goldens + "/golden.json"}), "name the folder that it lies in");
  check_golden_refused(check(goldens, {"--only", ""}), "the pattern is empty");
  check_golden_refused(check(goldens, {"--only", "quad.h5"}), "did you mean 'quad.h4'?");
  check_golden_refused(check(goldens, {"--seed", "2"}), "--seed");
  check_golden_refused(check(goldens, {"--on", "softpipe"}), "softpipe");
  check_golden_refused(check(goldens, {"--number", "float64"}), "float64");
  check_golden_refused(check(goldens, {"--ulp", "-1"}), "--ulp");
  check_golden_refused(run_twinshade({"golden", "check", goldens, "--json", goldens + "/golden.json"}),
                       "it would replace");
  check_golden_refused(run_twinshade({"golden", "check", goldens, "--junit", goldens + "/quad.h4.exr"}),
                       "it would replace");
  check_golden_refused(run_twinshade({"golden", "update", goldens, "--json", goldens + "/golden.json"}),
                       "it would replace");
  check_golden_refused(update(goldens, {"--technique", "sh3", "--json", goldens + "/quad.sh3.exr"}),
                       "it would be taken for a golden image");
  REQUIRE(update(folder / "own", {"--shader", shader, "--name", "own"}).code == 0);
  check_golden_refused(run_twinshade({"golden", "check", folder / "own", "--json", shader}), "it would replace");
  check_golden_refused(run_twinshade({"golden", "update", folder / "own", "--json", shader}), "it would replace");
  CHECK(golden_bytes(shader) == kGoldenShader);
  check_golden_refused(check(goldens, {goldens + "/."}), "is named twice");
  fs::copy(goldens, folder / "again");
  check_golden_refused(check(goldens, {folder / "again", "-o", folder / "out"}), "two folders have an entry");
  std::ofstream(goldens + "/quad.lightmap.exr") << "a picture of mine";
  check_golden_refused(update(goldens, {"--technique", "lightmap"}), "is no golden image");
  CHECK(golden_bytes(goldens + "/quad.lightmap.exr") == "a picture of mine");
  CHECK(check(goldens).err.find("quad.lightmap.exr: belongs to no entry") != std::string::npos);
  CHECK(golden_bytes(goldens + "/golden.json") == manifest);
  std::ofstream(goldens + "/golden.json") << manifest.substr(0, manifest.size() / 2);
  check_golden_refused(check(goldens), "parse error");
  check_golden_refused(update_again(goldens), "parse error");
}

}  // namespace twinshade

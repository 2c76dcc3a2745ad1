// Where output goes, and what the verbs that only show say.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/file.h"
#include "run_twinshade.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

// Of a shell: `line` begins with the program's arguments. Exit status; stderr is kept in `err`.
int run_in_shell(const Folder& folder, const std::string& line, std::string& err) {
  const std::string errors = folder / "err";
  const int status = std::system(("{ '" TWINSHADE_BINARY "' " + line + "; } 2>'" + errors + "'").c_str());
  err = read_file(errors);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr const char* kAddingShader = "#version 450\nin float x;\nout float y;\nvoid main() { y = x + 1.0; }\n";
constexpr const char* kCases = R"({"values": {"inputs": [{"name": "x", "type": "float", "values": [1, 2]}],
                                             "outputs": [{"name": "y", "type": "float", "values": [2, 3]}]}})";

}  // namespace

TEST_CASE("help and version succeed on stdout") {
  for (const char* option : {"--help", "--version"}) {
    const Run run = run_twinshade({option});
    CHECK(run.code == 0);
    CHECK_FALSE(run.out.empty());
    CHECK(run.err.empty());
  }
  for (const char* verb : {"list", "bake", "render", "compare", "translate", "bench", "experiment"}) {
    CAPTURE(verb);
    const Run run = run_twinshade({verb, "--help"});
    CHECK(run.code == 0);
    for (const char* option : {"--json", "--threads", "--seed", "--quiet"})
      CHECK(run.out.find(option) != std::string::npos);
  }
}

TEST_CASE("help of a verb that draws with one technique says so") {
  const std::string render = run_twinshade({"render", "--help"}).out,
                    compare = run_twinshade({"compare", "--help"}).out;
  for (const char* several : {"techniques, or all", "sphere maps of", "volume|all", "all: from each"}) {
    CAPTURE(several);
    CHECK(render.find(several) == std::string::npos);
    CHECK(compare.find(several) != std::string::npos);
  }
}

TEST_CASE("list names what there is") {
  const Run run = run_twinshade({"list", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const auto json = run.json();
  const auto names = [&](const char* kind) {
    std::string text = " ";
    for (const auto& entry : json[kind]) text += entry["name"].get<std::string>() + " ";
    return text;
  };
  for (const char* name : {" lightmap ", " hl2 ", " h4 ", " h6 ", " sh3 ", " cutout "})
    CHECK(names("techniques").find(name) != std::string::npos);
  CHECK(names("bases").find(" cutout ") == std::string::npos);
  for (const char* name : {" courtyard ", " spheres ", " quad ", " raster_torture "})
    CHECK(names("scenes").find(name) != std::string::npos);
  for (const char* name : {" sky ", " studio ", " window ", " constant "})
    CHECK(names("environments").find(name) != std::string::npos);
  CHECK(names("backends") == " cpu egl osmesa softpipe gpu ");
  for (const auto& scene : json["scenes"])
    if (scene["name"] == "courtyard") CHECK(scene["triangles"].get<int>() >= 20000);
}

TEST_CASE("JSON goes to a file whole, and the table to stdout") {
  const Folder folder;
  const Run run = run_twinshade({"list", "techniques", "--json", folder / "list.json"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.out.find("directional_occlusion") != std::string::npos);
  std::ifstream in(folder / "list.json");
  CHECK(nlohmann::json::parse(in)["techniques"].size() > 0);
  CHECK(folder.names() == std::vector<std::string>{"list.json"});
}

TEST_CASE("render writes every kind of picture, and nothing else") {
  const Folder folder;
  for (const char* name : {"a.exr", "a.hdr", "a.png"}) {
    const Run run = run_twinshade(small_quad({"render"}, {"-o", folder / name}));
    INFO(run.err);
    CHECK(run.code == 0);
  }
  const std::string png = read_file(folder / "a.png");
  CHECK(run_twinshade(small_quad({"render"}, {"-o", folder / "a.png", "--exposure", "-1", "--tonemap", "aces"})).code ==
        0);
  CHECK(read_file(folder / "a.png") != png);
  CHECK(folder.names() == std::vector<std::string>{"a.exr", "a.hdr", "a.png"});
}

TEST_CASE("a picture of integers says what it cannot hold, and refuses what means nothing for them") {
  const Folder folder;
  const std::string shader = folder.file("ids.frag", "out uvec4 id;\nvoid main() { id = uvec4(200u, 0u, 7u, 1u); }\n");
  const auto drawn_to = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> after{"--shader", shader, "-o", folder / name};
    after.insert(after.end(), more.begin(), more.end());
    return run_twinshade(small_quad({"render"}, after));
  };
  const Run png = drawn_to("a.png", {}), exr = drawn_to("a.exr", {});
  CHECK(png.code == 0);
  CHECK(png.err.find("a.png: integers below 0 are 0, above 255 they are 255") != std::string::npos);
  CHECK(exr.code == 0);
  CHECK(exr.err.empty());
  const Run exposed = drawn_to("b.png", {"--exposure", "1"}), radiance = drawn_to("b.hdr", {});
  for (const Run& refused : {exposed, radiance}) {
    CHECK(refused.code == 2);
    CHECK_MESSAGE(refused.err.find("integers") != std::string::npos, refused.err);
  }
  CHECK(folder.names() == std::vector<std::string>{"a.exr", "a.png", "ids.frag"});
}

TEST_CASE("translate writes C++ that names its GLSL") {
  const Folder folder;
  const Run run = run_twinshade({"translate", "h4", "-o", folder / "h4.cpp"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  std::ifstream in(folder / "h4.cpp");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  CHECK(text.find("cpu_shaders/runtime/runtime.h") != std::string::npos);
  CHECK(text.find("shaders/basis/h4.glsl") != std::string::npos);
  CHECK(run_twinshade({"translate", "h4"}).out == text);
}

TEST_CASE("a stdout that is full or closed is one line and a failure") {
  const Folder folder;
  for (const char* arguments : {"translate h4", "list", "list --json -", "--help", "list --help"})
    for (const char* stdout_is : {">/dev/full", ">&-"}) {
      CAPTURE(arguments);
      CAPTURE(stdout_is);
      std::string err;
      CHECK(run_in_shell(folder, std::string(arguments) + " " + stdout_is, err) == 2);
      CHECK_MESSAGE(err.find("twinshade: stdout: cannot be written: ") != std::string::npos, err);
    }
}

TEST_CASE("a reader that has enough ends the program without a word") {
  const Folder folder;
  std::string err;
  CHECK(run_in_shell(folder, "translate h4 | head -n 1 >/dev/null", err) == 0);
  CHECK(err.empty());
}

TEST_CASE("the hash of a shader is that of its text, wherever its files lie") {
  const Folder here, there;
  std::set<std::string> hashes;
  for (const Folder* folder : {&here, &there}) {
    folder->file("part.glsl", "float part(float x) { return x + 1.0; }\n");
    const std::string adding =
        folder->file("add.frag", "#include \"part.glsl\"\nin float x;\nout float y;\nvoid main() { y = part(x); }\n");
    const std::string cases = folder->file("add.json", kCases);
    std::vector<std::vector<std::string>> runs{{"eval", adding, "--cases", cases, "--on", "cpu", "--json", "-"},
                                               {"translate", adding, "--json", "-", "-o", *folder / "add.cpp"}};
    if (why_missing("egl").empty()) runs.push_back({"check", adding, "--no-timing", "--on", "cpu,egl", "--json", "-"});
    for (const std::vector<std::string>& arguments : runs)
      hashes.insert(run_twinshade(arguments).json()["provenance"]["shaders"].begin()->get<std::string>());
  }
  CHECK(hashes.size() == 1);
}

TEST_CASE("results are in files even where nobody reads the table, or it cannot be written") {
  const Folder folder;
  const std::string shader = folder.file("add.frag", kAddingShader), cases = folder.file("add.json", kCases),
                    json = folder / "out.json", junit = folder / "out.xml";
  std::vector<std::vector<std::string>> runs{
      small_quad({"render"}, {"--technique", "lightmap", "--json", json}),
      small_quad({"bake"}, {"--technique", "lightmap", "-o", folder / "quad.bundle", "--json", json}),
      {"list", "maps", "--json", json},
      {"translate", "h4", "--json", json},
      {"eval", shader, "--cases", cases, "--on", "cpu", "--json", json, "--junit", junit}};
  if (why_missing("egl").empty()) {
    const std::string both = "cpu,egl";
    runs.push_back({"check", shader, "--on", both, "--no-timing", "--json", json, "--junit", junit});
    runs.push_back(small_quad({"compare"}, {"--technique", "lightmap,h4", "--on", both, "--json", json}));
  }
  for (const std::vector<std::string>& arguments : runs) {
    CAPTURE(arguments[0]);
    const Run unread = run_twinshade_unread(arguments);
    CHECK(unread.code == 0);
    CHECK_MESSAGE(unread.err.find("twinshade:") == std::string::npos, unread.err);
    REQUIRE(fs::exists(json));
    CHECK(nlohmann::json::parse(read_file(json)).size() > 1);
    fs::remove(json);

    std::string err, line;
    for (const std::string& argument : arguments) line += "'" + argument + "' ";
    CHECK(run_in_shell(folder, line + ">/dev/full", err) == 2);
    CHECK_MESSAGE(err.find("twinshade: stdout: cannot be written: ") != std::string::npos, err);
    CHECK(fs::exists(json));
  }
}

TEST_CASE("without results in files a reader that has left ends the run") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"list", "maps", "--json", "-"}, {"list", "maps"}, {"translate", "h4"}, {"--help"}}) {
    const Run unread = run_twinshade_unread(arguments);
    CHECK(unread.code == 128 + SIGPIPE);
    CHECK_MESSAGE(unread.err.find("twinshade:") == std::string::npos, unread.err);
  }
}

TEST_CASE("results go to pipes, links and stdout, which stay what they are") {
  const Folder folder;
  std::string err;
  const std::string pipe = folder / "pipe", link = folder / "link.json", out = folder / "out.json";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const std::string table = " >'" + (folder / "table") + "'";
  CHECK(run_in_shell(folder,
                     "list techniques --json '" + pipe + "'" + table + " & cat '" + pipe + "' >'" + out + "'; wait $!",
                     err) == 0);
  CHECK_MESSAGE(err.empty(), err);
  CHECK(fs::is_fifo(pipe));
  CHECK(nlohmann::json::parse(read_file(out))["techniques"].size() > 0);

  fs::create_symlink("linked.json", link);
  CHECK(run_twinshade({"list", "techniques", "--json", link}).code == 0);
  CHECK(fs::is_symlink(link));
  CHECK(read_file(folder / "linked.json") == read_file(out));

  const Run both = run_twinshade({"list", "techniques", "--json", "/dev/stdout"});
  CHECK(both.out == read_file(folder / "table") + read_file(out));
}

TEST_CASE("a bundle that goes to stdout is alone there") {
  const Folder folder;
  const std::string bundle = folder / "quad.bundle", piped = folder / "piped";
  REQUIRE(run_twinshade(small_quad({"bake"}, {"--technique", "lightmap", "-o", bundle})).code == 0);
  const std::vector<std::string> to_stdout = small_quad({"bake"}, {"--technique", "lightmap", "-o", "/dev/stdout"});
  const Run run = run_twinshade(to_stdout);
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK(run.out == read_file(bundle));
  CHECK(run.err.find("\nbundle ") != std::string::npos);
  std::string line, err;
  for (const std::string& argument : to_stdout) line += argument + " ";
  CHECK(run_in_shell(folder, line + "| cat >'" + piped + "'", err) == 0);
  CHECK(read_file(piped) == read_file(bundle));

  std::vector<std::string> both = to_stdout;
  both.insert(both.end(), {"--json", "-"});
  const Run refused = run_twinshade(both);
  CHECK(refused.code == 2);
  CHECK(refused.out.empty());
  CHECK(refused.err == "twinshade: --json -: -o /dev/stdout goes to stdout, too; name a file for one of them\n");
}

TEST_CASE("a bundle is read from a pipe") {
  const Folder folder;
  const std::string bundle = folder / "quad.bundle", pipe = folder / "pipe", out = folder / "out";
  REQUIRE(run_twinshade(small_quad({"bake"}, {"--technique", "lightmap", "-o", bundle})).code == 0);
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string err;
  const int code = run_in_shell(
      folder,
      "render '" + pipe + "' --technique lightmap >'" + out + "' & cat '" + bundle + "' >'" + pipe + "'; wait $!", err);
  REQUIRE_MESSAGE(code == 0, err);
  CHECK(read_file(out) == run_twinshade({"render", bundle, "--technique", "lightmap"}).out);
}

TEST_CASE("a file that is replaced keeps its permissions") {
  const Folder folder;
  const std::string file = folder / "out.json";
  write_file(file, "{}");
  const fs::perms own = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(file, own);
  REQUIRE(run_twinshade({"list", "techniques", "--json", file}).code == 0);
  CHECK(fs::status(file).permissions() == own);
  CHECK(read_file(file) != "{}");
}

TEST_CASE("nothing is written over what is read, nor two results to one file") {
  const Folder folder;
  const std::string part = folder.file("part.glsl", "float part(float x) { return x; }\n");
  const std::string text = "#include \"part.glsl\"\nin float x; out float r;\nvoid main() { r = part(x); }\n";
  const std::string shader = folder.file("a.frag", text);
  const std::string cases =
      folder.file("a.json", R"({"values": {"inputs": [{"name": "x", "type": "float", "values": [5]}]}})");
  const std::string side = folder.file("a.frag.inputs", "x 0..1\n");
  fs::create_symlink(cases, folder / "link.json");
  const std::string model = folder.file("model.glb", "a model"), sky = folder.file("sky.hdr", "a sky");
  const std::string fresh = folder / "fresh";
  const std::vector<std::string> eval{"eval", shader, "--cases", cases, "--on", "cpu"};
  const std::vector<std::string> check{"check", shader, "--on", "cpu,egl", "--no-timing"};
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> refused{
      {eval, {"--json", cases}},
      {eval, {"--junit", folder / "link.json"}},
      {eval, {"--json", shader}},
      {{"eval", folder.file("bad.frag", "no GLSL"), "--cases", cases}, {"--json", cases}},
      {eval, {"--json", part}},
      {eval, {"--json", fresh, "--junit", folder / "./fresh"}},
      {{"eval", folder / ".", "--on", "cpu"}, {"--json", folder / "results.json"}},
      {check, {"--json", side}},
      {check, {"--junit", shader}},
      {check, {"--junit", part}},
      {check, {"--inputs", fresh, "--json", fresh}},
      {{"translate", shader}, {"-o", part}},
      {{"translate", shader}, {"-o", fresh, "--json", fresh}},
      {{"bake", model}, {"-o", model}},
      {{"bake", "quad"}, {"-o", fresh, "--json", fresh}},
      {{"render", "quad", "--env", sky}, {"-o", sky}},
      {{"render", "quad", "--env", sky, "--technique", "reference"}, {"--json", sky}},
      {{"compare", "quad", "--env2", sky}, {"--json", sky}},
      {{"compare", "quad", "--shader", shader}, {"--json", part}},
      {{"bench", "quad", "--env", sky, "--threads", "1"}, {"--json", sky}},
      {{"bench", "quad", "--env", sky, "--threads", "1", "--technique", "sh3", "--scaling", "pixels"}, {"--json", sky}},
      {{"experiment", "probe-rmse", sky}, {"--json", sky}}};
  for (const auto& verb_and_files : refused) {
    std::vector<std::string> arguments = verb_and_files.first;
    arguments.insert(arguments.end(), verb_and_files.second.begin(), verb_and_files.second.end());
    const Run run = run_twinshade(arguments);
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(run.err.find(": name a") != std::string::npos);
  }
  CHECK(read_file(shader) == text);
  CHECK(read_file(side) == "x 0..1\n");
  CHECK(read_file(model) == "a model");
  CHECK(read_file(sky) == "a sky");
  CHECK(!fs::exists(fresh));
}

TEST_CASE("nothing is written over what a model names") {
  const Folder folder;
  const std::string image = folder / "colour.png", library = folder.file("m.mtl", "newmtl a\nmap_Kd colour.png\n");
  REQUIRE(run_twinshade({"render", "quad", "--size", "16x16", "-o", image}).code == 0);
  const std::string picture = read_file(image);
  const std::string model = folder.file(
      "m.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const std::vector<std::string> render{"render", model, "--size", "16x16"}, bake{"bake", model, "--size", "16x16"};
  for (const auto& [verb, options] :
       {std::pair(render, std::vector<std::string>{"-o", image}),
        std::pair(render, std::vector<std::string>{"--json", library}),
        std::pair(render, std::vector<std::string>{"--technique", "reference", "-o", image}),
        std::pair(bake, std::vector<std::string>{"-o", folder / "new.bundle", "--json", image}),
        std::pair(bake, std::vector<std::string>{"-o", library})}) {
    std::vector<std::string> arguments = verb;
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Run run = run_twinshade(arguments);
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(run.err.find("which is read: name another file") != std::string::npos);
  }
  CHECK(read_file(image) == picture);
  CHECK(!fs::exists(folder / "new.bundle"));
  std::vector<std::string> elsewhere = render;
  elsewhere.insert(elsewhere.end(), {"-o", folder / "new.png"});
  CHECK(run_twinshade(elsewhere).code == 0);
}

TEST_CASE("JSON may go into a folder of results that is not there yet, and into no other") {
  const Folder folder;
  for (const char* name : {"new/out", "new/out/", "other"}) {
    const std::string out = folder / name, json = (std::filesystem::path(out) / "r.json").string();
    const Run run = run_twinshade({"experiment", "frobenius", "-o", out, "--json", json});
    INFO(run.err);
    CHECK(run.code == 0);
    CHECK(std::filesystem::is_regular_file(json));
  }
  const Run refused =
      run_twinshade({"experiment", "frobenius", "-o", folder / "third", "--json", folder / "third/deep/r.json"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("third/deep") != std::string::npos);
  CHECK(!std::filesystem::exists(folder / "third"));
}

TEST_CASE("nothing in a folder of results replaces what is read, nor another result") {
  const Folder folder;
  const std::string here = folder / ".", image = folder / "h4.cpu.png";
  REQUIRE(run_twinshade({"render", "quad", "--size", "16x16", "-o", image}).code == 0);
  const std::string picture = read_file(image);
  folder.file("m.mtl", "newmtl a\nmap_Kd h4.cpu.png\n");
  const std::string model = folder.file(
      "m.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const std::string sky = folder.file("sky.hdr", "a sky");
  const std::string irradiance = folder.file("probe-rmse-sky-irradiance.exr", "irradiance");
  fs::create_symlink(sky, folder / "h6.cpu.png");
  const std::vector<std::string> compare{"compare", model, "--technique", "h4,h6", "--on", "cpu,egl", "-o", here};
  const std::vector<std::string> frobenius{"experiment", "frobenius", "--basis", "sh2", "-o", here};
  for (const auto& [verb, options] :
       {std::pair(compare, std::vector<std::string>{}), std::pair(compare, std::vector<std::string>{"--env", sky}),
        std::pair(compare, std::vector<std::string>{"--json", folder / "h4.cpu-egl.difference.png"}),
        std::pair(compare, std::vector<std::string>{"--json", sky}),
        std::pair(frobenius, std::vector<std::string>{"--json", folder / "frobenius.csv"}),
        std::pair(frobenius, std::vector<std::string>{"--json", folder / "./frobenius.svg"}),
        std::pair(std::vector<std::string>{"experiment", "probe-rmse", sky, irradiance, "--basis", "sh2"},
                  std::vector<std::string>{"-o", here})}) {
    std::vector<std::string> arguments = verb;
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Run run = run_twinshade(arguments);
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(run.err.find("-o " + here) != std::string::npos);
    CHECK(run.err.find(": name another f") != std::string::npos);
  }
  CHECK(read_file(image) == picture);
  CHECK(read_file(sky) == "a sky");
  CHECK(read_file(irradiance) == "irradiance");
  CHECK(run_twinshade({"experiment", "frobenius", "--basis", "sh2", "-o", here, "--json", folder / "a.json"}).code ==
        0);
}

TEST_CASE("JUnit XML goes to stdout if asked, alone, but not beside JSON") {
  const Folder folder;
  const std::vector<std::string> eval{
      "eval", folder.file("a.frag", kAddingShader), "--cases", folder.file("a.json", kCases), "--on", "cpu", "--junit",
      "-"};
  const Run run = run_twinshade(eval);
  CHECK_MESSAGE(run.code == 0, run.err);
  CHECK_MESSAGE(run.out.find("<?xml") == 0, run.out);
  CHECK_MESSAGE(run.out.ends_with("</testsuites>\n"), run.out);
  CHECK(!run.err.empty());
  CHECK(folder.names() == std::vector<std::string>{"a.frag", "a.json"});
  std::vector<std::string> both = eval;
  both.insert(both.end(), {"--json", "-"});
  const Run refused = run_twinshade(both);
  CHECK(refused.code == 2);
  CHECK(refused.out.empty());
  CHECK(refused.err == "twinshade: --json - and --junit -: both go to stdout; name a file for one of them\n");
  both = eval;
  both.insert(both.end(), {"--html", "-"});
  CHECK(run_twinshade(both).err ==
        "twinshade: --junit - and --html -: both go to stdout; name a file for one of them\n");
  both = {eval.begin(), eval.end() - 2};
  both.insert(both.end(), {"--html", folder / "x", "--json", folder / "x"});
  CHECK(run_twinshade(both).err ==
        "twinshade: --json and --html both write " + (folder / "x") + ": name another file for one of them\n");
  both = {eval.begin(), eval.end() - 2};
  both.insert(both.end(), {"--html", "-"});
  CHECK(run_twinshade(both).out.find("<!DOCTYPE html>") == 0);
}

TEST_CASE("files of eval are there even where nobody reads the text") {
  const Folder folder;
  std::string err;
  folder.file("a.frag", kAddingShader);
  folder.file("a.json", kCases);
  run_in_shell(folder,
               "eval '" + (folder / "a.frag") + "' --cases '" + (folder / "a.json") + "' --on cpu --junit '" +
                   (folder / "out.xml") + "' --json '" + (folder / "out.json") + "' | true",
               err);
  CHECK_MESSAGE(err.empty(), err);
  CHECK(read_file(folder / "out.xml").find("tests=\"1\"") != std::string::npos);
  CHECK(nlohmann::json::parse(read_file(folder / "out.json"))["cases"].size() == 1);
}

}  // namespace twinshade

// eval as its users meet it: exit codes, tables, JSON, JUnit, bad input.
#include <doctest/doctest.h>

#include <algorithm>

#include "base/file.h"
#include "run_twinshade.h"

namespace twinshade {
namespace {

const std::string kShader =
    "in vec2 uv; flat in int n;\nuniform float gain;\nout vec2 r; out ivec2 i; out float wide;\n"
    "void main() {\n  if (n == 9) discard;\n  r = uv * gain; i = ivec2(n, -n); wide = uv.x / 3.0;\n}\n";

// The rows of r that are expected.
std::string cases(const std::string& r) {
  return R"({"values": {"inputs": [{"name": "uv", "type": "vec2", "values": [[0.5, 1], [2, 3]]},
                                   {"name": "n", "type": "int", "values": [4, 5]}],
                        "uniforms": [{"name": "gain", "type": "float", "values": [2]}],
                        "outputs": [{"name": "r", "type": "vec2", "values": )" +
         r + "}]}}";
}

void check_refused(const std::vector<std::string>& arguments, const std::string& said) {
  const Run run = run_twinshade(arguments);
  INFO(run.err);
  CHECK(run.code == 2);
  CHECK(run.out.empty());
  CHECK(run.err.find(said) != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("eval passes what is as expected, and answers on every backend") {
  const Folder folder;
  const std::string shader = folder.file("a.frag", kShader), json = folder.file("a.json", cases("[[1, 2], [4, 6]]"));
  std::string on = "cpu";
  for (const std::string& backend : opengl_backends()) on += "," + backend;
  const Run run = run_twinshade({"eval", shader, "--cases", json, "--on", on, "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const auto result = run.json()["cases"][0];
  CHECK(result["name"] == "a");
  CHECK(result["rows"] == 2);
  CHECK(result["pass"] == true);
  for (const auto& backend : result["backends"]) {
    CHECK(backend["outputs"]["r"] == nlohmann::json::parse("[[1.0, 2.0], [4.0, 6.0]]"));
    CHECK(backend["outputs"]["i"] == nlohmann::json::parse("[[4, -4], [5, -5]]"));
    CHECK(backend["worst"]["ulp"] == 0);
  }
  const Run in_double =
      run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--number", "double", "--json", "-"});
  REQUIRE_MESSAGE(in_double.code == 0, in_double.err);
  CHECK(in_double.json()["cases"][0]["backends"][0]["outputs"]["wide"][0][0] == 0.5 / 3.0);
}

TEST_CASE("eval's JSON has the hash of each shader, as check's has, and another one once its text changes") {
  const Folder folder;
  const std::string first = folder.file("a.frag", kShader), second = folder.file("b.frag", kShader + "// changed\n");
  for (const char* name : {"a.json", "b.json"}) folder.file(name, cases("[[1, 2], [4, 6]]"));
  const Run run = run_twinshade({"eval", folder / "", "--on", "cpu", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json shaders = run.json()["provenance"]["shaders"];
  REQUIRE(shaders.size() == 2);
  CHECK(shaders[first].get<std::string>().size() == 64);
  CHECK(shaders[first] != shaders[second]);
  if (!why_missing("egl").empty()) return;
  const Run check = run_twinshade({"check", first, "--on", "cpu,egl", "--rows", "16", "--no-timing", "--json", "-"});
  CHECK(check.json()["provenance"]["shaders"][first] == shaders[first]);
}

TEST_CASE("eval shows a failure with its inputs, in decimal and as hex floats") {
  const Folder folder;
  const std::string junit = folder / "out.xml";
  const Run run = run_twinshade({"eval", folder.file("a.frag", kShader), "--cases",
                                 folder.file("a.json", cases("[[1, 2], [4, 6.5]]")), "--on", "cpu", "--junit", junit});
  CHECK(run.code == 1);
  for (const char* words :
       {"1 of 2 rows fail", "r.y", "6.5", "0x1.8p+2", "0x1.ap+2", "in uv.x", "in n", "uniform gain"})
    CHECK_MESSAGE(run.out.find(words) != std::string::npos, words, "\n", run.out);
  const std::string xml = read_file(junit);
  CHECK(xml.find("tests=\"1\" failures=\"1\" errors=\"0\"") != std::string::npos);
  CHECK(xml.find("name=\"a on cpu\"") != std::string::npos);
}

TEST_CASE("a value of a row that was discarded is at no distance from what is expected") {
  const Folder folder;
  const std::string shader =
      folder.file("gone.frag", "in float x;\nout float r;\nvoid main() {\n  if (x > 0.0) discard;\n  r = x;\n}\n");
  const std::string json = folder.file("gone.json", R"({"values": {
      "inputs": [{"name": "x", "type": "float", "values": [1]}],
      "outputs": [{"name": "r", "type": "float", "values": [1]}]}})");
  const Run run = run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--json", "-"});
  CHECK(run.code == 1);
  const auto result = run.json()["cases"][0];
  const auto worst = result["backends"][0]["worst"];
  REQUIRE(worst.is_object());
  for (const char* distance : {"got", "ulp", "abs", "rel"}) CHECK(worst[distance].is_null());
}

TEST_CASE("a shader that does not compile ends the run, and services are told where") {
  const Folder folder;
  const std::string junit = folder / "out.xml", json = folder.file("a.json", cases("[[1, 2], [4, 6]]"));
  const std::string shader = folder.file("a.frag", "#version 450\nvoid main() { x = 1; }\n");
  const Run run =
      run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--junit", junit, "--annotate", "github"});
  CHECK(run.code == 2);
  CHECK_MESSAGE(run.err.find("a.frag:2: ") != std::string::npos, run.err);
  CHECK_MESSAGE(run.out.find("::error file=" + shader + ",line=2") == 0, run.out);
  CHECK(read_file(junit).find("tests=\"1\" failures=\"0\" errors=\"1\"") != std::string::npos);
  const std::string written = folder / "out.json";
  CHECK(run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--json", written}).code == 2);
  const auto results = nlohmann::json::parse(read_file(written));
  REQUIRE(results["cases"].size() == 1);
  CHECK(results["cases"][0]["pass"] == false);
  CHECK(results["cases"][0]["error"].get<std::string>().find("a.frag:2: ") != std::string::npos);
}

TEST_CASE("what is wrong with the cases is said of their file, not of the shader's") {
  const Folder folder;
  const std::string shader = folder.file("a.frag", kShader);
  std::string other = cases("[[1, 2], [4, 6]]");
  other.replace(other.find("gain"), 4, "gian");
  const std::string json = folder.file("b.json", other);
  const Run run = run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--annotate", "github"});
  CHECK(run.code == 2);
  CHECK_MESSAGE(
      run.err == "twinshade: " + json + ": uniform gain (float) has no value in the table (shader: " + shader + ")\n",
      run.err);
  CHECK_MESSAGE(run.out.find("::error file=" + json + ",title=a") == 0, run.out);
}

TEST_CASE("eval looks for included files in the folders that it is given, for one shader and for many") {
  const Folder folder, common;
  common.file("part.glsl", "float twice(float x) { return x + x; }\n");
  const std::string shader = folder.file("a.frag",
                                         "#include \"part.glsl\"\nin float x; out float y;\n"
                                         "void main() { y = twice(x); }\n");
  const std::string json = folder.file("a.json", R"({"values": {
      "inputs": [{"name": "x", "type": "float", "values": [2]}], "outputs": [{"name": "y", "type": "float", "values": [4]}]}})");
  const std::string found = common / ".";
  CHECK(run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "-I", found}).code == 0);
  CHECK(run_twinshade({"eval", folder / ".", "--on", "cpu", "--include", found}).code == 0);
  CHECK(run_twinshade({"translate", shader, "-I", found}).code == 0);
  check_refused({"eval", shader, "--cases", json, "--on", "cpu"}, "a.frag:1: ");
  for (const std::vector<std::string>& verb :
       {std::vector<std::string>{"eval", shader, "--cases", json}, {"translate", shader}, {"check", shader}}) {
    std::vector<std::string> arguments = verb;
    arguments.insert(arguments.end(), {"-I", found, "-I", folder / "nosuch"});
    check_refused(arguments, "--include " + folder / "nosuch" + ": there is no such folder");
  }
}

TEST_CASE("macros may be defined for a shader, in each verb that reads one alone") {
  const Folder folder;
  const std::string shader =
      folder.file("a.frag", "#version 330\nin float x; out float y;\nvoid main() { y = x * float(FACTOR); }\n");
  const std::string json = folder.file("a.json", R"({"values": {
      "inputs": [{"name": "x", "type": "float", "values": [2]}], "outputs": [{"name": "y", "type": "float", "values": [6]}]}})");
  CHECK(run_twinshade({"eval", shader, "--cases", json, "--on", "cpu,egl", "-D", "FACTOR=3"}).code == 0);
  CHECK(run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--define", "FACTOR"}).code == 1);
  CHECK(run_twinshade({"check", shader, "--on", "cpu,egl", "--no-timing", "-DFACTOR=3"}).code == 0);
  const Run translated = run_twinshade({"translate", shader, "-D", "FACTOR=7"});
  CHECK_MESSAGE(translated.out.find("UF(7.0f)") != std::string::npos, translated.out);
  check_refused({"eval", shader, "--cases", json, "--on", "cpu"}, "a.frag:3: ");
  check_refused({"check", shader, "-D", "7=3"}, "--define 7=3: wants NAME or NAME=VALUE");
  check_refused({"render", "quad", "--technique", "lightmap", "-D", "A"}, "--define requires --shader");
  const std::string drawn = folder.file("b.frag", "#version 330\nout vec4 c;\nvoid main() { c = vec4(FACTOR); }\n");
  CHECK(run_twinshade({"compare", "quad", "--shader", drawn, "-D", "FACTOR=3", "--size", "16x16", "--on", "cpu,egl"})
            .code == 0);
}

TEST_CASE("textures and storage buffers, which a table cannot give, are refused at their declaration") {
  const Folder folder;
  const std::string json =
      folder.file("a.json", R"({"values": {"inputs": [{"name": "x", "type": "float", "values": [1]}]}})");
  const std::string buffer =
      folder.file("buffer.frag",
                  "// Data is read\nin float x;\nlayout(std430) readonly buffer Data { int n; float "
                  "data[]; };\nout float y;\nvoid main() { y = x + data[n]; }\n");
  check_refused({"eval", buffer, "--cases", json, "--on", "cpu"}, "buffer.frag:3: storage buffer Data: neither eval's");
  const std::string texture = folder.file("texture.frag",
                                          "in float x; out vec4 y;\nuniform sampler2D map;\n"
                                          "void main() { y = texture(map, vec2(x)); }\n");
  check_refused({"eval", texture, "--cases", json, "--on", "cpu"},
                "texture.frag:2: texture map: eval's tables have no");
  const Run check = run_twinshade({"check", buffer, "--on", "cpu,egl", "--no-timing", "--json", "-"});
  CHECK(check.code == 2);
  CHECK(check.json()["shaders"][0]["message"].get<std::string>().find("buffer.frag:3: storage buffer Data") !=
        std::string::npos);
}

TEST_CASE("eval runs a folder: a shader that is wrong spoils no other") {
  const Folder folder;
  for (const char* name : {"b", "a", "c", "d"}) {
    folder.file(std::string(name) + ".frag", name[0] == 'c' ? "void main() { x = 1; }\n" : kShader);
    folder.file(std::string(name) + ".json",
                name[0] == 'd' ? "{\n[" : cases(name[0] == 'b' ? "[[1, 3], null]" : "[[1, 2], null]"));
  }
  const Run run = run_twinshade({"eval", folder / ".", "--on", "cpu", "--json", "-"});
  CHECK(run.code == 2);
  const auto all = run.json()["cases"];
  REQUIRE(all.size() == 4);
  CHECK(all[0]["pass"] == true);
  CHECK(all[1]["pass"] == false);
  CHECK(all[1]["backends"][0]["failed_values"] == 1);
  CHECK(all[2]["error"].get<std::string>().find("c.frag:1") != std::string::npos);
  CHECK(all[3]["error"].get<std::string>().find("d.json:2: malformed JSON") != std::string::npos);
  CHECK(run.err.find("4 shaders: 1 passed, 1 failed, 2 with errors") != std::string::npos);
}

TEST_CASE("one shader of a folder is no shaders") {
  const Folder folder;
  folder.file("a.frag", kShader);
  folder.file("a.json", cases("[[1, 2], null]"));
  CHECK(run_twinshade({"eval", folder / ".", "--on", "cpu"}).out == "1 shader: 1 passed, 0 failed, 0 with errors\n");
}

TEST_CASE("a file of a folder without its partner is an error of its own, and the others run all the same") {
  const Folder folder;
  const std::string junit = folder / "out.xml";
  folder.file("a.frag", kShader);
  folder.file("a.json", cases("[[1, 2], [4, 6]]"));
  folder.file("lonely.frag", kShader);
  folder.file("alone.json", cases("[[1, 2], [4, 6]]"));
  const Run run = run_twinshade({"eval", folder / ".", "--on", "cpu", "--json", "-", "--junit", junit});
  CHECK(run.code == 2);
  const auto all = run.json()["cases"];
  REQUIRE(all.size() == 3);
  CHECK(all[0]["pass"] == true);
  CHECK(all[1]["error"].get<std::string>().find("alone.json has no alone.frag beside it") != std::string::npos);
  CHECK(all[2]["error"].get<std::string>().find("lonely.frag has no lonely.json beside it") != std::string::npos);
  CHECK(read_file(junit).find("tests=\"3\" failures=\"0\" errors=\"2\"") != std::string::npos);
}

TEST_CASE("a link that leads nowhere is one error, of the file that cannot be read") {
  const Folder folder;
  folder.file("l.json", cases("[[1, 2], [4, 6]]"));
  std::filesystem::create_symlink("nowhere", folder / "l.frag");
  const Run run = run_twinshade({"eval", folder / ".", "--on", "cpu", "--json", "-"});
  CHECK(run.code == 2);
  REQUIRE(run.json()["cases"].size() == 1);
  CHECK(run.json()["cases"][0]["error"].get<std::string>().find("cannot be") != std::string::npos);
}

TEST_CASE("eval tells which rows a shader fails in mediump, and in half altogether") {
  const Folder folder;
  const std::string shader = folder.file("m.frag",
                                         "#version 300 es\nprecision mediump float;\nin vec3 n; in highp float x;\n"
                                         "layout(location = 0) out vec3 unit; layout(location = 1) out highp float y;\n"
                                         "void main() {\n  unit = normalize(n);\n  y = fract(x * 1024.0);\n}\n");
  const std::string json = folder.file("m.json", R"({"tolerance": {"abs": 0.002},
                    "values": {"inputs": [{"name": "n", "type": "vec3", "values": [[0, 0.6, 0.8], [0, 180, 240]]},
                                          {"name": "x", "type": "float", "values": [0.5, 3.7003]}],
                               "outputs": [{"name": "unit", "type": "vec3", "values": [[0, 0.6, 0.8], [0, 0.6, 0.8]]},
                                           {"name": "y", "type": "float", "values": [0, 0.1072]}]}})");
  const auto outputs = [&](const std::string& number, int code) {
    const Run run = run_twinshade({"eval", shader, "--cases", json, "--on", "cpu", "--number", number, "--json", "-"});
    CHECK_MESSAGE(run.code == code, run.err);
    return run.json()["cases"][0]["backends"][0]["outputs"];
  };
  CHECK(outputs("mediump", 1)["unit"][0][1] == doctest::Approx(0.6).epsilon(2e-3));
  CHECK(outputs("mediump", 1)["unit"][1] == nlohmann::json::parse("[0.0, 0.0, 0.0]"));  // 90000 is infinite
  CHECK(outputs("mediump", 1)["y"] == outputs("lanes", 0)["y"]);                        // highp
  CHECK(outputs("float16", 1)["y"][1] == nlohmann::json::parse("[0.0]"));
}

TEST_CASE("mediump tells which lines may be in 16 bits, over inputs made up or of cases") {
  const Folder folder;
  const std::string shader =
      folder.file("tiles.frag",
                  "in vec2 uv;  // @input uv 0..40\nin float glow;  // @input glow 0..1\nout vec2 c;\n"
                  "void main() {\n  vec2 cell = fract(uv * 8.0);\n  float tint = glow * 0.5;\n"
                  "  c = vec2(cell.x * 0.9, tint);\n}\n");
  const Run run = run_twinshade({"mediump", shader, "--json", folder / "lines.json"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  CHECK_MESSAGE(run.out.find("\n   5  highp") != std::string::npos, run.out);
  CHECK_MESSAGE(run.out.find("2 of 3 lines may be mediump at once") != std::string::npos, run.out);
  const nlohmann::json json = nlohmann::json::parse(read_file(folder / "lines.json"));
  REQUIRE(json["lines"].size() == 3);
  CHECK(json["lines"][0]["line"] == 5);
  CHECK(json["lines"][0]["text"] == "vec2 cell = fract(uv * 8.0);");
  CHECK(json["lines"][0]["may_be"] == "highp");
  CHECK(json["lines"][0]["alone"]["off"] > 400);  // the other end of a cell
  CHECK(json["lines"][1]["may_be"] == "mediump");
  CHECK(json["together"]["off"] <= 1);
  CHECK(json["rows"] == 16384);

  // Coordinates of one tile stand it.
  const auto cases_with = [](const std::string& tint) {
    return R"({"values": {"inputs": [{"name": "uv", "type": "vec2", "values": [[0.03, 0.0], [0.1, 0.0]]},
                                     {"name": "glow", "type": "float", "values": [0.3, 0.7]}],
                          "outputs": [{"name": "c", "type": "vec2", "values": [[0.216, )" +
           tint + R"(], [0.72, 0.35]]}]}, "tolerance": {"abs": 0.001}})";
  };
  const std::string cases = folder.file("tiles.json", cases_with("0.15"));
  const Run given = run_twinshade({"mediump", shader, "--cases", cases});
  CHECK_MESSAGE(given.out.find("3 of 3 lines may be mediump at once") != std::string::npos, given.err);

  check_refused({"mediump", shader, "--abs", "-1"}, "--abs -1: must be a number, 0 or more");
  check_refused({"mediump", shader, "--cases", cases, "--rel", "0.1"}, "excludes");
  check_refused({"mediump", folder / "none.frag"}, "none.frag");
  const std::string wrong = folder.file("wrong.json", cases_with("0.2"));
  check_refused({"mediump", shader, "--cases", wrong}, "wrong.json: row 0 is beyond the tolerance in float already");
}

TEST_CASE("mediump leaves a frame of a technique as it is, float16 does not, and other verbs refuse both in one line") {
  const auto frame = [](const std::string& number) {
    const Run run = run_twinshade({"render", "--technique", "lightmap", "--size", "64x64", "--lightmap", "32", "--rays",
                                   "16", "--number", number, "--json", "-"});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run.json()["frame"];
  };
  CHECK(frame("mediump") == frame("lanes4"));
  CHECK(frame("float16") != frame("lanes4"));
  const Folder folder;
  const std::string shader = folder.file("a.frag", kShader);
  const std::string refusal =
      "--number mediump: halves have other bits and another speed by design; twinshade render and eval compute them, "
      "twinshade mediump tells which lines stand them";
  check_refused({"check", shader, "--number", "mediump"}, refusal);
  check_refused({"compare", "--number", "mediump"}, refusal);
  check_refused({"bench", "--number", "mediump"}, refusal);
  check_refused({"render", "--technique", "reference", "--number", "float16"}, "traced, not shaded");
  check_refused({"translate", shader, "--number", "lanes4"}, "must be mediump or float16");
  const std::string casts =
      folder.file("b.frag", "in float x; out float c;\nvoid main() { c = float(floatBitsToInt(x)); }\n");
  const std::string json =
      folder.file("b.json", R"({"values": {"inputs": [{"name": "x", "type": "float", "values": [1]}],
                                           "outputs": [{"name": "c", "type": "float", "values": [1065353216]}]}})");
  check_refused({"eval", casts, "--cases", json, "--on", "cpu", "--number", "float16"},
                "b.frag:2: floatBitsToInt: cannot be evaluated in half");
  CHECK(run_twinshade({"eval", casts, "--cases", json, "--on", "cpu", "--number", "mediump"}).code == 0);
  CHECK(run_twinshade({"translate", shader, "--number", "float16"}).out.find("of_halves(") != std::string::npos);
}

TEST_CASE("number types are refused with the list that --help has") {
  const Folder folder;
  const std::string shader = folder.file("a.frag", kShader), json = folder.file("a.json", cases("[[1, 2], [4, 6]]"));
  check_refused({"eval", shader, "--cases", json, "--number", "quad"},
                "known: lanes4, lanes8, lanes16, lanes, scalar, float, double, float64, mediump, float16");
  CHECK(run_twinshade({"eval", "--help"}).out.find("lanes4|lanes8|lanes16|lanes|scalar|float|double|float64") !=
        std::string::npos);
}

TEST_CASE("eval refuses what it cannot run in one line") {
  const Folder folder, empty;
  const std::string shader = folder.file("a.frag", kShader), json = folder.file("a.json", cases("[[1, 2], [4, 6]]"));
  check_refused({"eval", shader}, "--cases is missing");
  check_refused({"eval", folder / ".", "--cases", json}, "have their cases in NAME.json");
  check_refused({"eval", empty / "."}, "no shaders in it");
  check_refused({"eval", folder / "none.frag", "--cases", json}, "none.frag");
  check_refused({"eval", shader, "--cases", folder / "none.json"}, "none.json");
  check_refused({"eval", shader, "--cases", json, "--on", "cqu"}, "did you mean 'cpu'");
  check_refused({"eval", shader, "--cases", json, "--number", "lanes5"}, "did you mean 'lanes4'");
  check_refused(
      {"eval", shader, "--cases",
       folder.file("b.json", R"({"values": {"inputs": [{"name": "vu", "type": "vec2", "values": [[1, 2]]}]}})"), "--on",
       "cpu"},
      "input n (int) has no values in the table");
}

TEST_CASE("a driver that refuses the shader is an error of its own, and the others' results stay") {
  if (!why_missing("softpipe").empty()) return;
  const Folder folder;
  const std::string shader =  // softpipe has no gl_HelperInvocation
      folder.file("a.frag", "in float x; out float r;\nvoid main() { r = gl_HelperInvocation ? 2.0 : x; }\n");
  const std::string json = folder.file("a.json", R"({"values": {
      "inputs": [{"name": "x", "type": "float", "values": [5]}],
      "outputs": [{"name": "r", "type": "float", "values": [5]}]}})");
  const Run run = run_twinshade({"eval", shader, "--cases", json, "--on", "softpipe,cpu", "--json", "-"});
  CHECK(run.code == 2);
  const nlohmann::json backends = run.json()["cases"][0]["backends"];
  REQUIRE(backends.size() == 2);
  CHECK(backends[0]["error"].get<std::string>().find("gl_HelperInvocation") != std::string::npos);
  CHECK(backends[1]["failed_rows"] == 0);
  check_refused({"eval", shader, "--cases", json, "--on", "softpipe"}, "gl_HelperInvocation");
}

TEST_CASE("a backend that cannot run is named with its reason, and the others' results stay") {
  const Folder folder;
  ::setenv("TWINSHADE_WORKER", "/nonexistent/worker", 1);
  const Run run = run_twinshade({"eval", folder.file("a.frag", kShader), "--cases",
                                 folder.file("a.json", cases("[[1, 2], [4, 6]]")), "--on", "cpu,egl", "--json", "-"});
  ::unsetenv("TWINSHADE_WORKER");
  CHECK(run.code == 2);
  const auto backends = run.json()["cases"][0]["backends"];
  CHECK(backends[0]["worst"]["ulp"] == 0);
  CHECK(backends[1]["error"].get<std::string>().find("egl: ") == 0);
}

}  // namespace twinshade

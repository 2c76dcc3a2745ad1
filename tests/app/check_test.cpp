// `check`, run as a user would.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include "run_twinshade.h"

namespace twinshade {
namespace {

const std::string kHead =
    "in vec3 a; in vec3 b;\n"
    "// @input a -4..4\n"
    "// @input b 0.5..3\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() {\n"
    "  precise float before = a.y - b.y;\n";

std::string planted(const std::string& line) {
  return kHead + "  float value = " + line + ";\n  color = vec4(value, before, 1.0, 1.0);\n}\n";
}

constexpr int kPlantedLine = 7;

std::vector<std::string> arguments(const std::string& shader, const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"check", shader, "--on", "cpu,egl", "--rows", "512", "--no-timing", "--json", "-"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

bool names_line(const nlohmann::json& findings, int line) {
  for (const auto& finding : findings)
    if (finding["line"] == line) return true;
  return false;
}

}  // namespace

TEST_CASE("a planted driver-dependent expression is named at its line by lint and by values, and made exact") {
  if (const std::string reason = why_missing("egl"); !reason.empty()) {
    MESSAGE("not tested: " << reason);
    return;
  }
  const Folder folder;
  for (const std::string line : {"a.x * b.x + a.x * b.y", "mix(a.x, b.x, b.z)", "sin(a.x)"}) {
    CAPTURE(line);
    const std::string shader = folder.file("planted.frag", planted(line));
    const Run run = run_twinshade(arguments(shader));
    CAPTURE(run.err);
    CHECK(run.code == 1);
    const nlohmann::json result = run.json()["shaders"][0];
    CHECK(result["verdict"] == "differs");
    CHECK(names_line(result["outside_exact_dialect"], kPlantedLine));
    REQUIRE(result["counterexample"].is_object());
    CHECK(result["counterexample"]["output"] == "color.x");
    CHECK(result["counterexample"]["first_line"]["file"] == shader);
    CHECK(result["counterexample"]["first_line"]["line"] == kPlantedLine);
    CHECK(names_line(result["counterexample"]["first_line"]["findings"], kPlantedLine));
    CHECK(result["counterexample"]["constant_folding"] == false);

    const Run exact = run_twinshade(arguments(shader, {"--make-exact"}));
    CHECK(exact.code == 0);
    CHECK(exact.json()["shaders"][0]["verdict"] == "same bits");
    CHECK(exact.json()["shaders"][0]["not_made_exact"].empty());
  }
}

TEST_CASE(
    "what differs in an included file, a loop or a function is named there, at the iteration that first shows it") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  folder.file("part.glsl",
              "\nfloat curve(float x) {\n  float bent = x;\n  for (int i = 0; i < 4; ++i)\n    bent = bent + pow(x, "
              "float(i));\n  return bent;\n}\n");
  const std::string shader = folder.file("loop.frag",
                                         "// @input x 1.5..1.9\nin float x; out vec4 color;\n#include "
                                         "\"part.glsl\"\nvoid main() {\n  color = vec4(curve(x));\n}\n");
  const nlohmann::json line = run_twinshade(arguments(shader)).json()["shaders"][0]["counterexample"]["first_line"];
  CAPTURE(line.dump());
  CHECK(line["file"].get<std::string>().find("part.glsl") != std::string::npos);
  CHECK(line["line"] == 5);
  CHECK(line["occurrence"].get<int>() >= 2);  // pow(x, 0) is 1 everywhere
}

TEST_CASE("a difference that comes from constant folding is named as such") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader = folder.file("folded.frag",
                                         "in float x; out vec4 color;\n// @input x 0.5..2\nvoid main() {\n  precise "
                                         "float k = 0.1 * 0.7 + 0.3 / 1.7 * 5.3 - 0.9;\n"
                                         "  precise float y = x * k;\n  color = vec4(y);\n}\n");
  const Run run = run_twinshade(arguments(shader));
  const nlohmann::json example = run.json()["shaders"][0]["counterexample"];
  CAPTURE(run.out);
  REQUIRE(example.is_object());
  CHECK(example["constant_folding"] == true);
  CHECK(example["first_line"]["line"] == 4);
}

TEST_CASE("made exact, what is computed of constants is not blamed for what differs elsewhere") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  // Mesa drops the sign of CM[0].y's zero, or does not: where it knew it, that depended on the probe.
  const std::string shader = folder.file("inverse.frag",
                                         "in float a;  // @input a 1e20..1e20\nout vec4 o;\n"
                                         "const mat2 CM = inverse(mat2(4.0));\nvoid main() {\n"
                                         "  float b = float(int(a));\n  o = vec4(CM[0], CM[1].x, b);\n}\n");
  const Run run = run_twinshade(arguments(shader, {"--make-exact"}));
  CAPTURE(run.out);
  CHECK(run.json()["shaders"][0]["counterexample"]["first_line"]["line"] == 5);
}

TEST_CASE("a float out of range that is converted to an integer is named as the cause, by its value") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const auto cause = [&](const std::string& statements, const std::vector<std::string>& more) {
    const std::string shader = folder.file("converted.frag",
                                           "in float a;  // @input a 1..2\nin float w;  // @input w {0}\n"
                                           "out vec4 c;\nint floor_of(float x) {\n  return int(x);\n}\n"
                                           "void main() {\n  int known = int(a);\n" +
                                               statements + "\n}\n");
    const nlohmann::json line =
        run_twinshade(arguments(shader, more)).json()["shaders"][0]["counterexample"]["first_line"];
    CAPTURE(line.dump());
    return line["cause"].is_string() ? line["line"].dump() + ": " + line["cause"].get<std::string>() : line.dump();
  };
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, std::vector<std::string>{"--make-exact"}}) {
    CHECK(cause("  int i = int(a / w);\n  c = vec4(i, known, 0, 1);", more).starts_with("9: int() of inf"));
    CHECK(cause("  if (uvec2(a, a - 8.0).y > 9u) c = vec4(1);\n  else c = vec4(a);", more)
              .starts_with("9: uvec2() of -"));
    CHECK(cause("  c = vec4(floor_of(a), floor_of(a / w), 0, 1);", more).starts_with("5: int() of inf"));
    CHECK(cause("  float b = float(int(a * 1e20));\n  c = vec4(b);", more).starts_with("9: int() of 1"));
  }
  CHECK(cause("  int i = int(sin(a) * 1e6);\n  c = vec4(i);", {}).find("\"cause\":null") != std::string::npos);
}

TEST_CASE("JSON says what ran and which shader: instruction set, driver, hash; what was not measured is null") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader = folder.file("sum.frag", "in float x; out float y;\nvoid main() { y = x + x; }\n");
  const Run run = run_twinshade(arguments(shader));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json json = run.json(), provenance = json["provenance"];
  CAPTURE(provenance.dump());
  CHECK(provenance["backends"]["cpu"].contains("isa"));
  CHECK(provenance["backends"]["egl"].contains("GL_RENDERER"));
  CHECK(provenance["backends"]["egl"].contains("GL_VERSION"));
  CHECK(provenance["shaders"][shader].get<std::string>().size() == 64);
  for (const auto& backend : json["shaders"][0]["backends"]) CHECK(backend["ns_per_invocation"].is_null());
}

TEST_CASE("JSON has all rows of a quad that derivatives are taken in, or the difference could not be seen again") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader =
      folder.file("a.frag", "in float x; out vec2 y;\nvoid main() { y = vec2(exp(x), dFdx(x)); }\n");
  const Run run = run_twinshade(arguments(shader));
  REQUIRE_MESSAGE(run.code == 1, run.err);
  const nlohmann::json input = run.json()["shaders"][0]["counterexample"]["inputs"][0];
  REQUIRE(input["quad"].size() == 4);
  CHECK(std::count(input["quad"].begin(), input["quad"].end(), input["value"]) > 0);
}

TEST_CASE("NaN and infinities are inputs where they are asked for, and NaN is one class") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader = folder.file("nan.frag",
                                         "// @input x any\nin float x; out vec4 color;\nvoid main() {\n  precise float "
                                         "root = sqrt(x);\n  precise float other = x / x;\n"
                                         "  color = vec4(root, other, x > 1.0 ? 1.0 : 2.0, x == x ? 1.0 : 0.0);\n}\n");
  const Run run = run_twinshade(arguments(shader));
  CAPTURE(run.out);
  CHECK(run.code == 0);
  CHECK(run.json()["shaders"][0]["verdict"] == "same bits");
}

TEST_CASE("a list of backends leaves the shader behind it to the verb; ES with gl_FragCoord is searched for its line") {
  if (const std::string reason = why_missing("egl"); !reason.empty()) {
    MESSAGE("not tested: " << reason);
    return;
  }
  const Folder folder;
  const std::string shader = folder.file("es.frag",
                                         "#version 300 es\nprecision highp float;\nin vec4 a; out vec4 color;\n"
                                         "void main() {\n  color = sin(a) + gl_FragCoord.x;\n}\n");
  const Run run = run_twinshade({"check", "--on", "cpu,egl", shader, "--no-timing", "--json", "-"});
  CAPTURE(run.err);
  CHECK(run.code == 1);
  const nlohmann::json result = run.json()["shaders"][0];
  CHECK(result["verdict"] == "differs");
  REQUIRE(result["counterexample"].is_object());
  CHECK(result["counterexample"]["first_line"]["line"] == 5);
}

TEST_CASE("zeros of different sign differ, unless --ulp is given: then they are equal") {
  if (const std::string reason = why_missing("egl"); !reason.empty()) {
    MESSAGE("not tested: " << reason);
    return;
  }
  const Folder folder;
  const std::string shader = folder.file("zero.frag",
                                         "// @input x {-1.0, 2.0}\nin float x; out float y;\n"
                                         "void main() { y = x * 0.0; }\n");  // llvmpipe folds it to +0
  const Run strict = run_twinshade(arguments(shader));
  CHECK(strict.code == 1);
  CHECK(strict.json()["shaders"][0]["verdict"] == "differs");
  CHECK(strict.json()["shaders"][0]["max_ulp"] == 0);
  CHECK(strict.err.find("the sign of zero alone") != std::string::npos);
  const Run given = run_twinshade(arguments(shader, {"--ulp", "0"}));
  CHECK(given.code == 0);
  CHECK(given.json()["shaders"][0]["verdict"] == "same to 0 ULP");
}

TEST_CASE("names that became keywords after the shader's version are compared, and end nobody's check") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string named = folder.file(
      "named.frag", "#version 330\nin float patch;\nout float sample;\nvoid main() { (sample) = patch; }\n");
  const std::string plain = folder.file("plain.frag", "in float x; out float y;\nvoid main() { y = x + x; }\n");
  const Run run = run_twinshade({"check", named, plain, "--on", "cpu,egl", "--no-timing", "--json", "-"});
  CHECK_MESSAGE(run.code == 0, run.err);
  const nlohmann::json json = run.json();
  for (const auto& shader : json["shaders"]) CHECK(shader["verdict"] == "same bits");
}

TEST_CASE("a backend whose driver refuses the shader is named, and the others' verdict stands") {
  if (!why_missing("egl").empty() || !why_missing("softpipe").empty()) return;
  const Folder folder;
  const std::string shader =  // softpipe has no gl_HelperInvocation
      folder.file("helper.frag",
                  "in float x; out float y;\nvoid main() { y = (gl_HelperInvocation ? 2.0 : 1.0) + sin(x); }\n");
  const Run run =
      run_twinshade({"check", shader, "--on", "cpu,softpipe,egl", "--rows", "256", "--no-timing", "--json", "-"});
  CHECK(run.code == 2);  // softpipe was asked for
  const nlohmann::json result = run.json()["shaders"][0];
  CHECK(result["verdict"] == "differs");
  CHECK(result["backends"][1]["not_run"].get<std::string>().find("gl_HelperInvocation") != std::string::npos);
  CHECK(result["backends"][2]["rows_differ"] > 0);
  const Run alone = run_twinshade({"check", shader, "--on", "cpu,softpipe", "--no-timing", "--json", "-"});
  CHECK(alone.code == 2);
  CHECK(alone.json()["shaders"][0]["verdict"] == "refused");
}

TEST_CASE("softpipe's denormals are the CPU's whichever comes first; where every row has one, nothing is the same") {
  if (!why_missing("egl").empty() || !why_missing("softpipe").empty()) return;
  const Folder folder;
  const std::string body =
      "uniform float u; in float x; out float color;\nvoid main() {\n"
      "  precise float r = u * 16777216.0; precise float q = r * 16777216.0; color = q + x;\n}\n";
  const std::string shader = folder.file("denormal.frag", "// @input u {1e-40}\n// @input x 0..0\n" + body);
  const auto verdict = [&](const std::string& on) {
    const Run run = run_twinshade({"check", shader, "--on", on, "--rows", "64", "--no-timing", "--json", "-"});
    return run.json()["shaders"][0];
  };
  CHECK(verdict("cpu,softpipe")["verdict"] == "same bits");
  CHECK(verdict("softpipe,cpu")["verdict"] == "same bits");
  for (const std::string on : {"egl,softpipe", "softpipe,egl"}) {
    const nlohmann::json result = verdict(on);
    CHECK(result["verdict"] == "not run");
    CHECK(result["message"].get<std::string>().find("not compared: every row has a denormal") != std::string::npos);
  }
}

TEST_CASE("a pixel that only one machine discards is at no distance") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader =
      folder.file("holes.frag",
                  "// @input x 0.1..3\nin float x;\nout vec4 o;\n"
                  "void main() { if ((floatBitsToInt(pow(x, 2.3)) & 1) == 1) discard; o = vec4(1.0); }\n");
  const Run run = run_twinshade(arguments(shader, {"--ulp", "4"}));
  CHECK(run.code == 1);
  CHECK(run.json()["shaders"][0]["counterexample"]["output"] == "discard");
}

TEST_CASE("under --ulp what is reported is what exceeds it") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader = folder.file("far.frag",  // what near is a few ULP off, far is many
                                         "// @input x 1..1.1\nin float x;\n"
                                         "layout(location = 0) out float near; layout(location = 1) out float far;\n"
                                         "void main() { near = sin(x); far = sin(x) - 0.875; }\n");
  const Run run = run_twinshade(arguments(shader, {"--ulp", "4"}));
  CHECK(run.code == 1);
  const nlohmann::json result = run.json()["shaders"][0];
  REQUIRE(result["counterexample"].is_object());
  CHECK(result["counterexample"]["output"] == "far");
  CHECK(result["counterexample"]["ulp"] > 4);
  CHECK(result["backends"][1]["rows_differ"] < result["backends"][1]["rows"]);
}

TEST_CASE("a loop that llvmpipe leaves early is named as what may be the cause") {
  if (!why_missing("egl").empty()) return;
  const Folder folder;
  const std::string shader =
      folder.file("long.frag",
                  "// @input n {70000}\nflat in int n; out float r;\nvoid main() {\n  int i = 0;\n"
                  "  for (; i < n; ++i) r = 0.0;\n  r = float(i);\n}\n");
  const Run run = run_twinshade({"check", shader, "--on", "cpu,egl", "--rows", "16", "--no-timing", "--json", "-"});
  const nlohmann::json result = run.json()["shaders"][0];
  REQUIRE(result["verdict"] == "differs");
  const std::string note = result["counterexample"]["first_line"]["note"];
  CHECK_MESSAGE(note.find("leaves every loop after 65535 iterations") != std::string::npos, note);
}

TEST_CASE("a shader whose name has a quote is called by its name, in JSON and in annotations") {
  if (const std::string reason = why_missing("egl"); !reason.empty()) {
    MESSAGE("not tested: " << reason);
    return;
  }
  const Folder folder;
  const std::string shader = folder.file("q\"3.frag", planted("a.x * b.x + a.x * b.y"));
  const nlohmann::json result = run_twinshade(arguments(shader)).json()["shaders"][0];
  REQUIRE(result["verdict"] == "differs");
  REQUIRE_FALSE(result["outside_exact_dialect"].empty());
  CHECK(result["outside_exact_dialect"][0]["file"] == shader);
  REQUIRE(result["counterexample"]["first_line"].contains("file"));
  CHECK(result["counterexample"]["first_line"]["file"] == shader);
  CHECK_FALSE(result["counterexample"]["first_line"]["findings"].empty());
  const std::string bad = folder.file("b\"a:7:d.frag", "out vec4 color;\nvoid main() {\n  color = nothing;\n}\n");
  const Run run = run_twinshade({"check", bad, shader, "--on", "cpu,egl", "--no-timing", "--annotate", "github"});
  CHECK_MESSAGE(run.out.find("b\"a%3A7%3Ad.frag,line=3,title=") != std::string::npos, run.out);
  CHECK_MESSAGE(run.out.find("q\"3.frag,line=7,title=") != std::string::npos, run.out);
  CHECK_MESSAGE(run.out.find("undeclared identifier\n") != std::string::npos, run.out);
}

TEST_CASE("under --watch a file that is saved while it is checked is checked again") {
  const Folder folder;
  const std::string shader = folder.file("a.frag", "in float x; out float y;\nvoid main() { y = x; }\n");
  const std::string ranges = folder / "ranges", json = folder / "check.json";
  REQUIRE(::mkfifo(ranges.c_str(), 0600) == 0);  // read once the shader has been read: its reader waits for us
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  int reads = 0;
  run_twinshade_until(
      {"check", shader, "--watch", "--inputs", ranges, "--on", "cpu,egl", "--no-timing", "--json", json}, [&] {
        if (std::chrono::steady_clock::now() > deadline) return true;
        if (reads == 1 && !std::filesystem::exists(json)) return false;  // the first check goes on
        const int pipe = ::open(ranges.c_str(), O_WRONLY | O_NONBLOCK);
        if (pipe < 0) return false;  // nobody reads it yet
        if (++reads == 1) folder.file("a.frag", "in float x; out float y;\nvoid main() { y = -x; }\n");
        ::close(pipe);
        return reads == 2;
      });
  CHECK(reads == 2);
}

TEST_CASE("wrong shaders, ranges and files are refused with their place, the others are checked all the same") {
  const Folder folder;
  const std::string bad = folder.file("bad.frag", "out vec4 color;\nvoid main() {\n  color = nothing;\n}\n");
  const std::string range =
      folder.file("range.frag", "// @input q 0..1\nin float x; out vec4 color;\nvoid main() { color = vec4(x); }\n");
  const std::string missing = folder / "missing.frag";
  const std::string later = folder.file("later.frag",
                                        "#version 330\nin float x; out vec4 color;\nvoid main() {\n"
                                        "  precise float y = x + 1.0;\n  color = vec4(y);\n}\n");
  const std::string junit = folder / "check.xml";
  const Run run = run_twinshade(
      {"check", bad, range, missing, later, "--on", "cpu,egl", "--no-timing", "--json", "-", "--junit", junit});
  CHECK(run.code == 2);
  const nlohmann::json shaders = run.json()["shaders"];
  REQUIRE(shaders.size() == 4);
  CHECK(shaders[0]["message"].get<std::string>().find(bad + ":3: ") == 0);
  CHECK(shaders[1]["message"].get<std::string>().find(range + ":1: unknown input 'q'") == 0);
  CHECK(shaders[2]["message"].get<std::string>().find(missing) == 0);
  if (shaders[3]["verdict"] == "refused") {  // where there is an EGL to refuse it
    CHECK(shaders[3]["message"].get<std::string>().find(later + ":4: ") == 0);
    CHECK(shaders[3]["message"].get<std::string>().find("GLSL 330 may lack what #version 450 has") !=
          std::string::npos);
  }
  CHECK(run_twinshade({"check", bad, "--on", "cpu"}).code == 2);
  CHECK(run_twinshade({"check", bad, "--on", "cpu,metal"}).code == 2);
}

}  // namespace twinshade

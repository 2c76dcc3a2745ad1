// What compare says, in numbers, in JSON and by its exit code.
#include <doctest/doctest.h>
#include <algorithm>

#include "base/file.h"
#include "run_twinshade.h"

namespace twinshade {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

void check_equal(const nlohmann::json& report) {
  REQUIRE(report["results"].size() > 0);
  for (const auto& result : report["results"]) {
    CAPTURE(result.dump());
    REQUIRE_FALSE(result.contains("error"));
    CHECK(result["shaded_pixels"].get<int>() > 0);
    for (const char* count :
         {"coverage_differs", "id_differs", "depth_differs", "attributes_differ", "pixels_differ", "max_ulp"})
      CHECK(result[count] == 0);
    CHECK(result["first_difference"].is_null());
    CHECK(result["a_frame"] == result["b_frame"]);
    CHECK((result["map"].is_null() || result["map"] == "cube"));
  }
}

}  // namespace

TEST_CASE("every technique draws the same bits on the CPU and on OpenGL") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Run run = run_twinshade(small_quad({"compare"}, {"--on", "cpu," + joined(opengl), "--json", "-"}));
  INFO(run.err);
  CHECK(run.code == 0);
  const auto report = run.json();
  check_equal(report);
  const auto techniques = run_twinshade({"list", "techniques", "--json", "-"}).json()["techniques"];
  CHECK(report["results"].size() + report["skipped"].size() * opengl.size() == techniques.size() * opengl.size());
  for (const char* key : {"processor", "compiler", "flags", "shaders", "bundle", "seed", "backends"}) {
    CAPTURE(key);
    CHECK(report["provenance"].contains(key));
  }
  for (const std::string& backend : opengl) {
    CHECK(report["provenance"]["backends"][backend].contains("GL_RENDERER"));
    CHECK(report["provenance"]["backends"][backend].contains("GL_VERSION"));
  }
}

TEST_CASE("thread count, lanes and llvmpipe's fused multiply-add change nothing") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  std::string frame;
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--threads", "1"},
                                             {"--threads", "2", "--lanes", "4"},
                                             {"--gl-fma", "off", "--tile", "16"},
                                             {"--no-host-fma", "--number", "scalar"}}) {
    std::vector<std::string> after{"--technique", "h4", "--on", "cpu," + opengl.front(), "--json", "-"};
    after.insert(after.end(), options.begin(), options.end());
    const Run run = run_twinshade(small_quad({"compare"}, after));
    INFO(run.err);
    REQUIRE(run.code == 0);
    check_equal(run.json());
    const std::string now = run.json()["results"][0]["a_frame"];
    if (!frame.empty()) CHECK(now == frame);
    frame = now;
  }
}

TEST_CASE("softpipe shades the CPU's pixels to the same bits") {
  if (const std::string reason = why_missing("softpipe"); !reason.empty()) {
    MESSAGE("not tested on softpipe: " << reason);
    return;
  }
  const Run run =
      run_twinshade(small_quad({"compare"}, {"--technique", "h4,sh3", "--on", "cpu,softpipe", "--json", "-"}));
  INFO(run.err);
  CHECK(run.code == 0);
  const auto answer = run.json();
  for (const auto& result : answer["results"]) {
    CAPTURE(result.dump());
    CHECK(result["pixels_differ"] == result["denormal_only"]);
  }
}

TEST_CASE("softpipe is left out once for a shader that takes derivatives, however many outputs it has") {
  const Folder folder;
  const std::string shader =
      folder.file("slopes.frag",
                  "#version 450\nin vec2 v_uv;\nlayout(location = 0) out vec4 a;\nlayout(location = 1) out vec4 b;\n"
                  "void main() { a = vec4(dFdx(v_uv), 0.0, 1.0); b = vec4(1.0); }\n");
  const std::string reason = "softpipe: the shader takes derivatives";
  // The only backend: that is all there is to say.
  const Run alone = run_twinshade(small_quad({"compare"}, {"--shader", shader, "--on", "cpu,softpipe"}));
  CHECK(alone.code == 2);
  CHECK(alone.err.find(reason) != std::string::npos);
  CHECK(alone.err.find(reason) == alone.err.rfind(reason));
  for (const std::string& backend : opengl_backends()) {
    const Run run = run_twinshade(
        small_quad({"compare"}, {"--shader", shader, "--on", "cpu," + backend + ",softpipe", "--json", "-"}));
    REQUIRE(run.json()["skipped"].size() == 1);
    CHECK(run.json()["skipped"][0]["reason"].get<std::string>().find(reason) == 0);
    CHECK(run.json()["results"].size() == 2);
  }
}

TEST_CASE("a sum that a driver may refactor is found, and layer, pixel, inputs and ULP are named") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const std::string shader = folder.file("sum.frag",
                                         "in vec2 v_uv;\nin vec3 v_position;\nout vec4 color;\n"
                                         "void main() {\n"
                                         "  float sum = v_uv.x * v_position.x + v_uv.x * v_uv.y;\n"
                                         "  color = vec4(sum, sum * v_uv.y + v_position.y * v_uv.y, 0.0, 1.0);\n"
                                         "}\n");
  const std::vector<std::string> options{"--shader", shader, "--on", "cpu," + opengl.front()};
  const Run table = run_twinshade(small_quad({"compare"}, options));
  INFO(table.out << table.err);
  CHECK(table.code == 1);
  for (const char* words : {"DIFFERS", "layer color", "pixel (", "v_uv.x = ", "v_position.y = ", "0x1.", "ULP"}) {
    CAPTURE(words);
    CHECK(table.out.find(words) != std::string::npos);
  }

  std::vector<std::string> as_json = options;
  as_json.insert(as_json.end(), {"--json", "-"});
  const Run run = run_twinshade(small_quad({"compare"}, as_json));
  CHECK(run.code == 1);
  const auto result = run.json()["results"][0];
  CHECK(result["pixels_differ"].get<int>() > 0);
  CHECK(result["coverage_differs"] == 0);
  const auto first = result["first_difference"];
  CHECK(first["layer"] == "color");
  CHECK(first["ulp"].get<int>() > 0);
  CHECK(first["inputs"].size() == 5);
  CHECK(first["a_hex"] != first["b_hex"]);
  const auto line = result["first_line"];
  CHECK(line["file"] == shader);
  CHECK(line["line"] == 5);
  CHECK(line["value"] == "sum");
  CHECK(line["a"] != line["b"]);
  CHECK(line["findings"][0]["rule"] == "precise");
  CHECK(table.out.find("first line that differs: " + shader + ":5: sum: cpu ") != std::string::npos);

  std::vector<std::string> reported = options;
  reported.insert(reported.end(), {"--html", folder / "r.html", "--junit", folder / "r.xml"});
  CHECK(run_twinshade(small_quad({"compare", "--annotate", "github"}, reported)).out.find("::error file=" + shader) !=
        std::string::npos);
  const std::string page = read_file(folder / "r.html"), junit = read_file(folder / "r.xml");
  CHECK(junit.find("tests=\"1\" failures=\"1\" errors=\"0\"") != std::string::npos);
  CHECK(junit.find("v_position.y = ") != std::string::npos);
  CHECK(page.find("v_position.y = ") != std::string::npos);
  CHECK(page.find(", line 5</div>") != std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = page.find("base64,iVBORw0KGgo"); at != std::string::npos;  // a PNG's first bytes
       at = page.find("base64,iVBORw0KGgo", at + 1))
    ++pictures;
  CHECK(pictures == 3);
}

TEST_CASE("the first line that differs is looked for with the scene's textures, and not where a pixel is not enough") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const auto first_line = [&](const std::string& shader) {
    const Run run = run_twinshade(small_quad(
        {"compare"}, {"--shader", folder.file("a.frag", shader), "--on", "cpu," + opengl.front(), "--json", "-"}));
    CHECK_MESSAGE(run.code == 1, run.err);
    return run.json()["results"][0]["first_line"];
  };
  const std::string declarations =
      "in vec2 v_uv;\nin vec2 v_lightmap_uv;\nuniform sampler2DArray coefficients_h4;\nout vec4 color;\n";
  const auto of_texture = first_line(declarations +
                                     "void main() {\n"
                                     "  vec3 c = texelFetch(coefficients_h4, ivec3(v_lightmap_uv * 16.0, 0), 0).rgb;\n"
                                     "  float x = sin(c.x * 100.0 + v_uv.x);\n"
                                     "  color = vec4(x, c);\n"
                                     "}\n");
  CHECK(of_texture["line"] == 7);
  CHECK(of_texture["value"] == "x");
  const auto note = [&](const std::string& value) {
    return first_line(declarations + "void main() { color = vec4(sin(" + value + " * 123.0)); }\n")["note"]
        .get<std::string>();
  };
  CHECK(note("dFdx(v_uv.x)").find("not looked for: the shader takes derivatives") == 0);
  CHECK(note("gl_FragCoord.x").find("not looked for: the shader reads gl_FragCoord") == 0);
}

TEST_CASE("an integer output that differs is found, as integers, and so is what differs in a second output") {
  const Folder folder;
  const std::string head =
      "#version 450\nlayout(location = 0) in vec2 v_uv;\nlayout(location = 1) flat in int v_material;\n";
  // sin is the driver's own.
  const std::string packed =
      folder.file("packed.frag",
                  head +
                      "out uint packed_color;\nvoid main() {\n"
                      "  packed_color = 0xffc00000u + uint(fract(sin(v_uv.x * 12.9898) * 43758.5453) * 65536.0);\n}\n");
  const std::string two =
      folder.file("two.frag", head +
                                  "layout(location = 0) out vec4 color;\nlayout(location = 2) out vec4 more[2];\n"
                                  "void main() {\n  color = vec4(v_material);\n"
                                  "  more[0] = vec4(1.0);\n  more[1] = vec4(sin(v_uv * 40.0), 0.0, 1.0);\n}\n");
  for (const std::string& backend : opengl_backends()) {
    Run run = run_twinshade(small_quad({"compare"}, {"--shader", packed, "--on", "cpu," + backend, "--json", "-"}));
    CHECK(run.code == 1);
    auto json = run.json();
    REQUIRE(json["results"].size() == 1);
    const auto first = json["results"][0]["first_difference"];
    CHECK(first["a_hex"].get<std::string>().find("0xffc") == 0);
    CHECK(first["a"].get<double>() > 4e9);
    CHECK(run.err.find(" apart") != std::string::npos);

    run = run_twinshade(
        small_quad({"compare"}, {"--shader", two, "--on", "cpu," + backend, "--json", "-", "-o", folder / "out"}));
    CHECK(run.code == 1);
    json = run.json();
    REQUIRE(json["results"].size() == 3);
    const std::vector<std::pair<std::string, std::string>> expected = {
        {"color", "equal"}, {"more[0]", "equal"}, {"more[1]", "DIFFERS"}};
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(json["results"][i]["output"] == expected[i].first);
      CHECK(json["results"][i]["verdict"] == expected[i].second);
    }
    CHECK(run.err.find("two.frag: more[1]: cpu and " + backend + " differ") != std::string::npos);
    CHECK(run.err.find("v_material = 0 (0x00000000)") != std::string::npos);
  }
}

TEST_CASE("softpipe alone is compared with the CPU, which must be named") {
  const Run run = run_twinshade(small_quad({"compare"}, {"--technique", "h4", "--on", "egl,softpipe"}));
  CHECK(run.code == 2);
  CHECK(run.err.find("name cpu first, as cpu,softpipe") != std::string::npos);
}

TEST_CASE("pictures of frames, and of differences where there are any, are written") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const Run run = run_twinshade(
      small_quad({"compare"}, {"--technique", "h4", "--on", "cpu," + opengl.front(), "-o", folder / "new/pictures"}));
  INFO(run.err);
  CHECK(run.code == 0);
  CHECK(std::filesystem::exists(folder / "new/pictures/h4.cpu.png"));
  CHECK(std::filesystem::exists(folder / ("new/pictures/h4." + opengl.front() + ".png")));
  CHECK_FALSE(std::filesystem::exists(folder / ("new/pictures/h4.cpu-" + opengl.front() + ".difference.png")));
}

TEST_CASE("no picture of a difference of an earlier run stays beside frames that are equal") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  folder.file("h4.cpu-" + opengl.front() + ".difference.png", "of an earlier run");
  const std::string other = folder.file("h6.cpu-" + opengl.front() + ".difference.png", "of another technique");
  const Run run = run_twinshade(
      small_quad({"compare"}, {"--technique", "h4", "--on", "cpu," + opengl.front(), "-o", folder / "."}));
  INFO(run.err);
  CHECK(run.code == 0);
  CHECK(folder.names() == std::vector<std::string>{"h4.cpu.png", "h4." + opengl.front() + ".png",
                                                   "h6.cpu-" + opengl.front() + ".difference.png"});
}

TEST_CASE("pictures that cannot be written are told of behind the comparison, which stands") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  for (const std::string& backend : {std::string("cpu"), opengl.front()})
    std::filesystem::create_directories(folder / ("h4." + backend + ".png/in the way"));
  const Run run = run_twinshade(
      small_quad({"compare"}, {"--technique", "h4", "--on", "cpu," + opengl.front(), "-o", folder / "."}));
  INFO(run.out << run.err);
  CHECK(run.code == 2);
  CHECK(run.out.find("equal\n") != std::string::npos);
  CHECK(run.out.find("failed") == std::string::npos);
  CHECK(run.err.find("h4.cpu.png: cannot be written: it is a folder (and 1 more picture)\n") != std::string::npos);
}

TEST_CASE("rows are written as they are known: a run that is stopped has told of those before") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const Run run = run_twinshade_until(
      small_quad({"compare"}, {"--technique", "h4,h6", "--on", "cpu," + opengl.front(), "-o", folder / "."}),
      [&] { return std::filesystem::exists(folder / "h6.cpu.png"); });
  INFO(run.err);
  CHECK(run.out.rfind("technique", 0) == 0);
  CHECK(run.out.find("equal\n") != std::string::npos);
}

TEST_CASE("softpipe's frames and differences are drawn, too") {
  if (const std::string reason = why_missing("softpipe"); !reason.empty()) {
    MESSAGE("not tested on softpipe: " << reason);
    return;
  }
  const Folder folder;
  const std::string shader =
      folder.file("sine.frag", "in vec2 v_uv;\nout vec4 color;\nvoid main() { color = vec4(sin(v_uv.x * 9.0)); }\n");
  const Run run =
      run_twinshade(small_quad({"compare"}, {"--shader", shader, "--on", "cpu,softpipe", "-o", folder / "new"}));
  INFO(run.err);
  CHECK(run.code == 1);
  CHECK(std::filesystem::exists(folder / "new/sine.cpu-softpipe.difference.png"));
  CHECK(std::filesystem::exists(folder / "new/sine.softpipe.png"));
}

TEST_CASE("what is covered and hidden is no helper invocation, with derivatives either") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const std::string shader = folder.file("helpers.frag",
                                         "#version 450\nin vec3 v_position;\nout vec4 color;\n"
                                         "void main() {\n  float helper = gl_HelperInvocation ? 1.0 : 0.0;\n"
                                         "  precise float a = dFdx(helper), b = dFdy(helper);\n"
                                         "  color = vec4(a, b, helper, 1.0);\n}\n");
  const Run run = run_twinshade({"compare", "raster_torture", "--shader", shader, "--size", "160x100", "--on",
                                 "cpu," + opengl.front(), "--json", "-"});
  CHECK_MESSAGE(run.code == 0, run.out);
}

TEST_CASE("what samplers and inputs allow that differs between invocations or from pixel to pixel is translated") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const std::string size = folder.file("size.frag",
                                       "#version 450\nin vec2 v_uv;\nout vec4 color;\n"
                                       "uniform sampler2DArray albedo_maps;\nvoid main() {\n"
                                       "  int level = int(v_uv.x) * 0;\n"
                                       "  color = vec4(textureSize(albedo_maps, level), 1.0);\n}\n");
  CHECK(run_twinshade(small_quad({"compare"}, {"--shader", size, "--on", "cpu," + opengl.front()})).code == 0);
  const std::string sample = folder.file("sample.frag",
                                         "#version 450\nsample in vec3 v_position;\nout vec4 color;\n"
                                         "void main() { color = vec4(v_position.x > -1e9); }\n");
  for (const char* attributes : {"exact", "native"})
    CHECK(run_twinshade(small_quad({"compare"},
                                   {"--shader", sample, "--on", "cpu," + opengl.front(), "--attributes", attributes}))
              .code == 0);
}

TEST_CASE("native attributes are reported and are no failure") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Run run = run_twinshade(small_quad(
      {"compare"}, {"--technique", "h4", "--on", "cpu," + opengl.front(), "--attributes", "native", "--json", "-"}));
  INFO(run.err);
  CHECK(run.code == 0);
  const auto result = run.json()["results"][0];
  CHECK(result["attributes"] == "native");
  CHECK(result["coverage_differs"] == 0);
  CHECK(result["max_ulp"].is_number());
}

TEST_CASE("NaN on one side is at no distance in JSON") {
  const std::vector<std::string> opengl = opengl_backends();
  if (opengl.empty()) return;
  const Folder folder;
  const std::string shader = folder.file(  // drivers' asin beyond 1 is NaN
      "nan.frag", "in vec2 v_uv;\nout vec4 color;\nvoid main() { color = vec4(asin(v_uv.x * 0.0 - 2.0)); }\n");
  const Run run =
      run_twinshade(small_quad({"compare"}, {"--shader", shader, "--on", "cpu," + opengl.front(), "--json", "-"}));
  REQUIRE_MESSAGE(run.code == 1, run.err);
  const auto result = run.json()["results"][0];
  CHECK(result["max_ulp"].is_null());
  CHECK(result["first_difference"]["ulp"].is_null());
}

TEST_CASE("bench gives medians, quartiles and a ratio") {
  const std::vector<std::string> opengl = opengl_backends();
  const Run run =
      run_twinshade(small_quad({"bench"}, {"--technique", "h4", "--rounds", "3", "--repeat", "2", "--json", "-"}));
  INFO(run.err);
  const bool egl = std::find(opengl.begin(), opengl.end(), "egl") != opengl.end();
  CHECK(run.code == (egl ? 0 : 2));
  bool ours = false;
  const auto result = run.json();
  for (const auto& row : result["rows"]) {
    if (row.contains("error")) continue;
    CAPTURE(row.dump());
    CHECK(row["technique"] == "h4");
    CHECK(row["ms_q1"].get<double>() <= row["ms"].get<double>());
    CHECK(row["ms"].get<double>() <= row["ms_q3"].get<double>());
    CHECK(row["ns_per_pixel"].get<double>() > 0);
    CHECK(row["ratio_to_llvmpipe"].is_number() == egl);
    ours = ours || row["renderer"] == "cpu";
  }
  CHECK(ours);
}

}  // namespace twinshade

// What bench says hangs together, whatever this machine's speed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "run_twinshade.h"

namespace twinshade {
namespace {

std::string first_line(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string whole(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Rows of a CSV file that is whole: its lines are ended and have as many cells as its first.
std::size_t rows_of_whole(const std::string& csv) {
  REQUIRE(!csv.empty());
  CHECK(csv.back() == '\n');
  std::istringstream lines(csv);
  std::size_t rows = 0;
  std::ptrdiff_t commas = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    bool quoted = false;
    const std::ptrdiff_t count = std::count_if(line.begin(), line.end(), [&](char c) {
      quoted = quoted != (c == '"');
      return c == ',' && !quoted;
    });
    if (rows == 0) commas = count;
    CHECK(count == commas);
  }
  return rows - 1;
}

}  // namespace

TEST_CASE("bench times every instruction set in both attribute modes, its stages, and its share of the roofline") {
  const Folder folder;
  const Run run = run_twinshade(small_quad(
      {"bench"}, {"--technique", "lightmap,h6", "--rounds", "2", "--repeat", "1", "-o", folder / "", "--json", "-"}));
  REQUIRE_MESSAGE((run.code == 0 || !why_missing("egl").empty()), run.err);
  const nlohmann::json json = run.json();
  std::vector<std::string> files{"bench-stages.png", "bench-stages.svg", "bench.csv"};
  if (why_missing("egl").empty()) files.insert(files.end(), {"bench.png", "bench.svg"});  // ratios to llvmpipe
  CHECK(folder.names() == files);
  CHECK(first_line(folder / "bench.csv").rfind("technique,light,map,renderer,isa", 0) == 0);

  std::set<std::string> isas;
  std::size_t cpu_rows = 0;
  for (const auto& [isa, limits] : json["limits"].items()) {
    isas.insert(isa);
    CHECK(limits["flops_per_second"].get<double>() > 1e9);
    CHECK(limits["l1_bytes_per_second"].get<double>() > 1e9);
    CHECK(limits["l2_bytes_per_second"].get<double>() > 1e9);
  }
  CHECK(isas.count("baseline") == 1);
  for (const auto& row : json["rows"]) {
    CAPTURE(row.dump());
    if (row["renderer"] != "cpu") continue;
    ++cpu_rows;
    CHECK(isas.count(row["isa"]) == 1);
    const double ms = row["ms"];
    CHECK(ms > 0);
    CHECK(row["ms_q1"].get<double>() <= ms);
    CHECK(row["ms_q3"].get<double>() >= ms);
    double stages = 0;
    for (const char* stage : {"vertex", "bin", "raster", "interpolate", "shade", "store"})
      stages += row[std::string(stage) + "_ms"].get<double>();
    CHECK(stages > 0.5 * ms);  // medians of each, and of their sum
    CHECK(stages < 2 * ms);
    CHECK(row["ns_per_pixel"].get<double>() ==
          doctest::Approx(ms * 1e6 / row["shaded_pixels"].get<double>()).epsilon(1e-6));
    CHECK(row["peak_memory"].get<std::int64_t>() > 1 << 20);
    CHECK(row["roofline_fraction"].get<double>() > 0);
    CHECK(row["roofline_fraction"].get<double>() <= 1);
    // Four taps: of two material maps, 16 bytes each, and of the lightmap, a line of five layers and 16 bytes of the
    // sixth; or of albedo and of one layer alone.
    const bool h6 = row["technique"] == "h6";
    CHECK(row["texel_bytes_per_pixel"] == 4.0 * (h6 ? 2 * 16 + 64 + 16 : 16 + 16));
    CHECK(row["input_bytes_per_pixel"] == 4.0 * (2 + 2 + 1));
    CHECK(row["flops_per_pixel"].get<double>() > 28.0 * 2 + (h6 ? 21.0 * 6 : 28.0));  // of the filters
  }
  CHECK(cpu_rows == 2 * 2 * isas.size());
  std::set<std::string> recorded;  // of each machine of ours
  for (const auto& [machine, said] : json["provenance"]["backends"].items())
    if (machine.rfind("cpu ", 0) == 0) recorded.insert(said["isa"].get<std::string>());
  CHECK(recorded == isas);
  for (const auto& mean : json["summary"]) {
    CHECK(mean["techniques"] == 2);
    double product = 1;
    for (const auto& row : json["rows"])
      if (row["isa"] == mean["isa"] && row["attributes"] == mean["attributes"])
        product *= row["ratio_to_llvmpipe"].get<double>();
    CHECK(mean["geometric_mean_ratio_to_llvmpipe"].get<double>() == doctest::Approx(std::sqrt(product)));
  }
}

TEST_CASE("rows of a number type that one instruction set has code for are labelled by that one, once") {
  const std::vector<std::string> quick{"--technique", "lightmap", "--attributes", "exact", "--rounds", "1",
                                       "--repeat",    "1",        "--lanes",      "4",     "--json",   "-"};
  for (const std::vector<std::string>& more :
       {quick, [&] {
          std::vector<std::string> scaling = quick;
          scaling.erase(scaling.begin(), scaling.begin() + 4);
          scaling.insert(scaling.end(), {"--scaling", "threads", "--threads", "1"});
          return scaling;
        }()}) {
    const Run run = run_twinshade(small_quad({"bench"}, more));
    REQUIRE_MESSAGE((run.code == 0 || !why_missing("egl").empty()), run.err);
    std::size_t rows = 0;
    const nlohmann::json json = run.json();
    for (const auto& row : json["rows"])
      if (row["renderer"] == "cpu") {
        CHECK(row["isa"] == "baseline");
        ++rows;
      }
    CHECK(rows == 1);
    if (json.contains("limits")) CHECK(json["limits"].size() == 1);
  }
  const Run refused = run_twinshade(
      small_quad({"bench"}, {"--technique", "lightmap", "--isa", "avx2", "--lanes", "4", "--rounds", "1"}));
  CHECK(refused.code == 2);
  CHECK(refused.err.find('\n') == refused.err.size() - 1);
  if (refused.err.find("no avx2") == std::string::npos && refused.err.find("rules avx2 out") == std::string::npos)
    CHECK(refused.err.find("--isa avx2: lanes4 runs on code for baseline here") != std::string::npos);
}

TEST_CASE("a shader that discards is timed without a depth prepass, and not skipped") {
  if (!why_missing("egl").empty()) {
    MESSAGE("not tested: " << why_missing("egl"));
    return;
  }
  const Run run = run_twinshade(small_quad({"bench"}, {"--technique", "cutout", "--attributes", "native", "--isa",
                                                       "baseline", "--rounds", "1", "--repeat", "1", "--json", "-"}));
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json rows = run.json()["rows"];
  REQUIRE(rows.size() == 2);
  CHECK(rows[0]["renderer"] == "cpu");
  CHECK(rows[1]["renderer"] == "egl");
  CHECK(rows[1]["depth_prepass"] == false);
}

TEST_CASE("scaling measures an axis, and names the axes there are") {
  const Folder folder;
  const Run run = run_twinshade(small_quad(
      {"bench"}, {"--scaling", "threads", "--rounds", "1", "--repeat", "1", "-o", folder / "", "--json", "-"}));
  REQUIRE_MESSAGE((run.code == 0 || !why_missing("egl").empty()), run.err);
  std::set<double> threads;
  const nlohmann::json rows = run.json()["rows"];
  for (const auto& row : rows) {
    CHECK(row["axis"] == "threads");
    CHECK(row["value"] == row["threads"]);
    threads.insert(row["value"].get<double>());
  }
  CHECK(threads.count(1) == 1);
  CHECK(folder.names() == std::vector<std::string>{"scaling-threads-memory.png", "scaling-threads-memory.svg",
                                                   "scaling-threads.png", "scaling-threads.svg", "scaling.csv"});
  const Run unknown = run_twinshade({"bench", "--scaling", "pixel"});
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("pixels") != std::string::npos);
  CHECK(run_twinshade({"bench", "--scaling", "all", "--technique", "unc3"}).err.find("lightmaps") != std::string::npos);
}

TEST_CASE("where native attributes alone are timed, nothing is labelled as exact") {
  const Folder folder;
  const Run run = run_twinshade(small_quad({"bench"}, {"--technique", "lightmap", "--attributes", "native", "--rounds",
                                                       "1", "--repeat", "1", "-o", folder / ""}));
  REQUIRE_MESSAGE((run.code == 0 || !why_missing("egl").empty()), run.err);
  std::istringstream lines(run.out);
  std::string line;
  while (std::getline(lines, line) && line.find("exact/native") == std::string::npos) {
  }
  REQUIRE(std::getline(lines, line));
  std::istringstream cells(line);
  std::vector<std::string> words;
  for (std::string word; cells >> word;) words.push_back(word);
  REQUIRE(words.size() > 2);
  CHECK(words[words.size() - 2] == "-");  // before the peak memory
  if (!why_missing("egl").empty()) return;
  const std::string svg = whole(folder / "bench.svg");
  CHECK(svg.find("native attributes against") != std::string::npos);
  CHECK(svg.find("exact attributes") == std::string::npos);
}

TEST_CASE("bench refuses files that it could not write, or would write twice, before it measures") {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& more, const std::string& what) {
    const Run run = run_twinshade(small_quad({"bench"}, more));
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(run.out.empty());
    CHECK(run.err.find(what) != std::string::npos);
    CHECK(run.err.find('\n') == run.err.size() - 1);
  };
  for (const char* name : {"bench.csv", "bench-stages.png"})
    refused({"-o", folder / "", "--json", folder / name}, std::string(name) + ": -o " + folder / "" + " writes it");
  refused({"--scaling", "threads", "-o", folder / "", "--json", folder / "scaling-threads.svg"},
          "scaling-threads.svg: -o " + folder / "" + " writes it");
  CHECK(folder.names().empty());
  std::filesystem::create_directory(folder / "bench.csv");
  refused({"-o", folder / ""}, "bench.csv");
}

TEST_CASE("scaling without llvmpipe measures ours, names what failed at which point, and is no success") {
  ::setenv("TWINSHADE_EGL_LIBRARY", "libNone.so", 1);
  const Run run = run_twinshade(small_quad(
      {"bench"}, {"--scaling", "threads", "--threads", "1", "--rounds", "1", "--repeat", "1", "--json", "-"}));
  ::unsetenv("TWINSHADE_EGL_LIBRARY");
  CHECK(run.code == 2);
  const nlohmann::json json = run.json();
  CHECK(json["rows"].size() == 1);
  REQUIRE_MESSAGE(!json["notes"].empty(), run.err);
  CHECK(json["notes"][0].get<std::string>().find("threads: 1: egl: egl: cannot load libNone.so") == 0);
}

TEST_CASE("scaling refuses by name what has no meaning there") {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& what) {
    const Run run = run_twinshade(arguments);
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(run.err.find(what) != std::string::npos);
    CHECK(run.err.find('\n') == run.err.size() - 1);
  };
  for (const auto& [option, value] : {std::pair("--attributes", "native"), std::pair("--light", "volume"),
                                      std::pair("--map", "octahedral"), std::pair("--visibility-rays", "16")})
    refused({"bench", "quad", "--scaling", "threads", option, value},
            std::string(option) + " has no meaning with --scaling");
  const std::string bundle = folder / "quad.bundle";
  REQUIRE(run_twinshade(small_quad({"bake"}, {"--technique", "lightmap", "-o", bundle})).code == 0);
  refused({"bench", bundle, "--scaling", "threads"}, "quad.bundle: --scaling bakes what it draws");
}

TEST_CASE("scaling refuses what none of the chosen axes reads, and takes what one of them does") {
  const auto refused = [](const std::vector<std::string>& arguments, const std::string& what) {
    const Run run = run_twinshade(arguments);
    CAPTURE(run.err);
    CHECK(run.code == 2);
    CHECK(run.out.empty());
    CHECK(run.err.find(what) != std::string::npos);
    CHECK(run.err.find('\n') == run.err.size() - 1);
  };
  refused({"bench", "--scaling", "threads", "--volume", "2x2x2"},
          "--volume has no meaning with --scaling threads: of the axes coefficients alone reads it; leave it out");
  refused({"bench", "--scaling", "pixels,threads", "--probe-rays", "16"}, "--probe-rays has no meaning with --scaling");
  refused({"bench", "--scaling", "pixels", "--size", "64x40"},
          "--size has no meaning with --scaling pixels: of the axes threads, coefficients read it; leave it out");
  refused({"bench", "house", "--scaling", "triangles,overdraw"}, "house has no meaning with --scaling");
  for (const auto& [option, value] : {std::pair("--triangles", "100"), std::pair("--camera", "0,0,5,0,0,0,50"),
                                      std::pair("--albedo", "off"), std::pair("--normal-map", "off")})
    refused({"bench", "--scaling", "overdraw", option, value},
            std::string(option) + " has no meaning with --scaling overdraw");
  refused({"bench", "--scaling", "coefficients", "--technique", "h4"},
          "--technique has no meaning with --scaling coefficients");
  for (const char* several : {"all", "h4,h6"})
    refused({"bench", "--scaling", "all", "--technique", several}, "--scaling draws with one technique");
  refused({"bench", "--scaling", "pixel", "--volume", "2x2x2"}, "pixels");
  const Run taken = run_twinshade(
      small_quad({"bench"}, {"--scaling", "threads", "--threads", "1", "--albedo", "off", "--technique", "h4",
                             "--triangles", "100", "--rounds", "1", "--repeat", "1", "--json", "-"}));
  CHECK_MESSAGE((taken.code == 0 || !why_missing("egl").empty()), taken.err);
}

TEST_CASE("points against coefficients come in their order, and memory, the same for all, is not drawn against them") {
  const Folder folder;
  const Run run =
      run_twinshade(small_quad({"bench"}, {"--scaling", "coefficients", "--volume", "2x2x2", "--probe-rays", "16",
                                           "--rounds", "1", "--repeat", "1", "-o", folder / "", "--json", "-"}));
  REQUIRE_MESSAGE((run.code == 0 || !why_missing("egl").empty()), run.err);
  std::map<std::string, double> last;
  const nlohmann::json json = run.json();
  for (const auto& row : json["rows"]) {
    double& before = last[row["light"].get<std::string>() + row["renderer"].get<std::string>()];
    CHECK(row["value"].get<double>() >= before);
    before = row["value"].get<double>();
  }
  CHECK(last["volumecpu"] == 36);
  CHECK(folder.names() ==
        std::vector<std::string>{"scaling-coefficients.png", "scaling-coefficients.svg", "scaling.csv"});
}

TEST_CASE("a bench that is stopped leaves the rows that it had measured, in whole files") {
  const std::vector<std::string> quick{"--rounds", "1", "--repeat", "1", "--isa", "baseline"};
  for (const auto& [csv_name, more] :
       {std::pair("bench.csv", std::vector<std::string>{"--technique",
                                                        "lightmap,hl2,h4,h6,sh2,sh3,sh5,zernike3,zernike6,hsh4,hsh9"}),
        std::pair("scaling.csv", std::vector<std::string>{"--scaling", "threads,coefficients"})}) {
    const std::string name = csv_name;
    CAPTURE(name);
    const Folder folder;
    folder.file(name, "of an earlier run");
    std::vector<std::string> arguments = quick;
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"-o", folder / "", "--json", folder / "rows.json"});
    bool kept = true;  // what was there, until the first row is
    const Run run = run_twinshade_until(small_quad({"bench"}, arguments), [&] {
      const std::string csv = whole(folder / name);
      kept = kept && !csv.empty();
      return csv != "of an earlier run" && std::filesystem::exists(folder / "rows.json");
    });
    CHECK(kept);
    CAPTURE(run.err);
    CHECK(run.code == 128 + SIGTERM);
    std::vector<std::string> names{name, "rows.json"};
    std::sort(names.begin(), names.end());
    CHECK(folder.names() == names);
    CHECK(rows_of_whole(whole(folder / name)) > 0);
    const nlohmann::json json = nlohmann::json::parse(whole(folder / "rows.json"));
    CHECK(json["complete"] == false);
    CHECK(json["rows"].size() > 0);
  }
}

TEST_CASE("a bench that fails before its first row leaves what was there") {
  const Folder folder;
  for (const std::vector<std::string>& failing :
       {std::vector<std::string>{"--lightmap", "4096", "--rays", "65536", "--technique", "nonsense"},
        {"--scaling", "threads", "--technique", "unc3"}}) {
    for (const char* name : {"bench.csv", "scaling.csv", "rows.json"}) folder.file(name, "of an earlier run");
    std::vector<std::string> arguments{"bench", "quad", "-o", folder / "", "--json", folder / "rows.json"};
    arguments.insert(arguments.end(), failing.begin(), failing.end());
    CHECK(run_twinshade(arguments).code == 2);
    for (const char* name : {"bench.csv", "scaling.csv", "rows.json"})
      CHECK(whole(folder / name) == "of an earlier run");
    CHECK(folder.names().size() == 3);
  }
}

TEST_CASE("JSON that goes to stdout or to a descriptor is one document, at the end") {
  for (const char* to : {"-", "/dev/stdout"}) {
    const Run run = run_twinshade(small_quad({"bench"}, {"--technique", "lightmap,h4", "--rounds", "1", "--repeat", "1",
                                                         "--isa", "baseline", "--attributes", "exact", "--json", to}));
    REQUIRE_MESSAGE((run.code == 0 || !why_missing("egl").empty()), run.err);
    const std::string json = run.out.substr(run.out.find("{\n"));
    CHECK(nlohmann::json::parse(json)["complete"] == true);
  }
}

}  // namespace twinshade

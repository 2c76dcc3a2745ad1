// The verb experiment, where more than one part of the program is needed.
#include <doctest/doctest.h>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("sphere maps are read alike on the CPU and by OpenGL, to the bit") {
  std::string machines = "cpu";
  for (const char* backend : {"egl", "osmesa"}) {
    const std::string missing = why_missing(backend);
    if (missing.empty())
      machines += std::string(",") + backend;
    else
      MESSAGE("not compared with " << backend << ": " << missing);
  }
  const Run run = run_twinshade({"experiment", "sphere-map-mse", "--on", machines, "--map", "cube,dual_paraboloid",
                                 "--map-width", "5", "--order", "3", "--samples", "3000", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const auto rows = run.json()["rows"];
  CHECK(rows.size() >= 6);
  CHECK(run.json()["provenance"]["backends"]["cpu"].contains("isa"));
  if (why_missing("egl").empty()) CHECK(run.json()["provenance"]["backends"]["egl"].contains("GL_VERSION"));
  for (const auto& row : rows) CHECK_MESSAGE(row["values_differ"] == 0, row.dump());
}

TEST_CASE("softpipe reads sphere maps where the CPU covers, beside the CPU or alone, and by its own filters") {
  if (const std::string missing = why_missing("softpipe"); !missing.empty()) {
    MESSAGE("not tested: " << missing);
    return;
  }
  const std::vector<std::string> small{
      "experiment", "sphere-map-mse", "--map", "cube", "--map-width", "4", "--order", "3,3", "--samples",
      "100",        "--json",         "-"};
  const auto rows = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = small;
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Run run = run_twinshade(arguments);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run.json()["rows"];
  };
  const auto both = rows({"--on", "cpu,softpipe"});
  CHECK(both.size() == 2 * 3);  // three storages; the order that is named twice is one
  for (const auto& row : both) CHECK_MESSAGE(row["values_differ"] == 0, row.dump());
  const auto alone = rows({"--on", "softpipe", "--driver-filters"});
  CHECK(alone.size() == 3 * 3);  // three filters
  CHECK(alone[0]["mse"] == both[0]["mse"]);
}

TEST_CASE("the folder of an experiment may be named by --output, and help has no words of the parser") {
  const Folder folder;
  const Run run = run_twinshade({"experiment", "frobenius", "--basis", "sh2", "--output", folder / "."});
  CHECK_MESSAGE(run.code == 0, run.err);
  CHECK(std::filesystem::exists(folder / "frobenius.csv"));
  for (const char* verb : {"experiment", "eval"}) {
    const std::string help = run_twinshade({verb, "--help"}).out;
    for (const char* raw : {":INT", "{github}"}) CHECK_MESSAGE(help.find(raw) == std::string::npos, help);
  }
}

TEST_CASE("drivers filter flat maps as written out but for rounding, and cubes with or without seams") {
  if (!why_missing("egl").empty()) return;
  const Run run = run_twinshade({"experiment", "sphere-map-mse", "--on", "cpu,egl", "--driver-filters", "--map",
                                 "cube,cube_dx9,dual_paraboloid", "--map-width", "5", "--order", "3", "--samples",
                                 "3000", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  int rows = 0;
  const nlohmann::json result = run.json()["rows"];
  for (const auto& row : result) {
    CAPTURE(row.dump());
    const std::string map = row["map"], filter = row["filter"];
    if (filter == "written_out") {
      CHECK(row["values_differ"] == 0);
      continue;
    }
    ++rows;
    // Faces that end at their edge are what cube_dx9 is, faces that go on what cube is
    const bool alike = map == "dual_paraboloid" || (filter == "driver") == (map == "cube_dx9");
    if (alike)
      CHECK(row["max_difference"] < 1e-5);
    else
      CHECK(row["max_difference"] > 1e-3);
  }
  CHECK(rows == 3 * (3 + 3 + 2));  // storages; filters of cube, cube_dx9, dual_paraboloid
}

TEST_CASE("every file of a folder of results is one that was to be expected") {
  const Folder folder;
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"frobenius", "--basis", "sh2"},
        {"wobble", "--basis", "sh2", "--samples", "2"},
        {"figures", "--basis", "h4,sh2"},
        {"basis-imse", "--basis", "h4", "--samples", "10"},
        {"sphere-map-mse", "--map", "cube", "--map-width", "4", "--samples", "100"},
        {"probe-rmse", "constant", "--basis", "sh2"}}) {
    std::vector<std::string> arguments{"experiment"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), {"-o", folder / "."});
    const Run run = run_twinshade(arguments);
    CHECK_MESSAGE(run.code == 0, run.err);
    CHECK(std::filesystem::exists(folder / (options.front() + ".csv")));
  }
}

}  // namespace twinshade

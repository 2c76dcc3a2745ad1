// The verb choose: the least that is within an error.
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "run_twinshade.h"

namespace twinshade {
namespace {

const std::vector<std::string> kSmallLight{"--env",
                                           "window",
                                           "--size",
                                           "96x64",
                                           "--rays",
                                           "64",
                                           "--volume",
                                           "4x4x4",
                                           "--probe-rays",
                                           "64",
                                           "--visibility-rays",
                                           "64",
                                           "--pixels",
                                           "500",
                                           "--reference-rays",
                                           "128",
                                           "--rounds",
                                           "1",
                                           "--repeat",
                                           "1",
                                           "--json",
                                           "-"};

Run small_house(const std::string& verb, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{verb, "house"};
  arguments.insert(arguments.end(), kSmallLight.begin(), kSmallLight.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_twinshade(arguments);
}

Run choose(const std::string& max_error, std::vector<std::string> more = {}) {
  for (const char* word : {"--lightmap", "64", "--technique", "lightmap,h4,sh3,zh3,unc3"}) more.emplace_back(word);
  more.insert(more.begin(), {"--max-error", max_error});
  return small_house("choose", more);
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

TEST_CASE("what is chosen is within the error, measured again by frontier, and its command draws it") {
  const Folder folder;
  const Run run = choose("60%", {"-o", folder / "out"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json json = run.json(), chosen = json["chosen"];
  CHECK(json["max_error"] == doctest::Approx(0.6));
  CHECK(chosen["error"] <= 0.6);
  REQUIRE(chosen["light"] == "volume");
  CHECK(chosen["shade_ns_per_pixel"] > 0);
  int marked = 0;
  for (const auto& row : json["rows"]) {
    CAPTURE(row.dump());
    marked += row["chosen"] == true;
    CHECK(row["within"] == (double(row["error"]) <= 0.6));
    if (row["within"] == true) CHECK(row["bytes"] >= chosen["bytes"]);
  }
  CHECK(marked == 1);

  // Only the bounced light of the truth differs, where the lightmap that it is taken from does.
  const Run again = run_twinshade({"frontier",
                                   "house",
                                   "--env",
                                   "window",
                                   "--size",
                                   "96x64",
                                   "--rays",
                                   "64",
                                   "--probe-rays",
                                   "64",
                                   "--pixels",
                                   "500",
                                   "--reference-rays",
                                   "128",
                                   "--rounds",
                                   "1",
                                   "--repeat",
                                   "1",
                                   "--lightmap",
                                   "64",
                                   "--technique",
                                   chosen["technique"],
                                   "--light",
                                   chosen["light"],
                                   "--volume",
                                   chosen["size"],
                                   "--json",
                                   "-"});
  REQUIRE_MESSAGE(again.code == 0, again.err);
  CHECK(double(again.json()["rows"][0]["error"]) == doctest::Approx(double(chosen["error"])).epsilon(0.02));
  std::vector<std::string> words = words_of(chosen["command"]);
  REQUIRE(words.size() > 3);
  CHECK(words[0] == "twinshade");
  CHECK(words[1] == "render");
  const Run drawn = run_twinshade({words.begin() + 1, words.end()});
  CHECK_MESSAGE(drawn.code == 0, drawn.err);
  CHECK(run.err.find(std::string(chosen["command"])) != std::string::npos);
  for (const char* name : {"choose.csv", "choose.svg", "choose.png"})
    CHECK_MESSAGE(std::filesystem::exists(folder / ("out/" + std::string(name))), name);
}

TEST_CASE("a size that is not within the error does not hide a smaller one that is") {
  // Errors of sh3: 38.2 %, 41.6 % and, where fewer probes lie in walls, 33.8 %.
  std::vector<std::string> arguments{"choose", "house"};
  arguments.insert(arguments.end(), kSmallLight.begin(), kSmallLight.end());
  std::replace(arguments.begin(), arguments.end(), std::string("4x4x4"), std::string("8x4x8"));
  for (const char* word : {"--technique", "sh3", "--light", "volume", "--storage", "float32", "--max-error", "40%"})
    arguments.emplace_back(word);
  const Run run = run_twinshade(arguments);
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json rows = run.json()["rows"];
  REQUIRE(rows.size() == 4);
  for (std::size_t i = 0; i < rows.size(); ++i) CHECK_MESSAGE(rows[i]["within"] == (i == 0 || i == 2), rows[i].dump());
  CHECK(rows[2]["volume"] == "2x1x2");
  CHECK(rows[2]["chosen"] == true);
}

TEST_CASE("at the largest size and as float32 errors are those of frontier") {
  const Run run = choose("1e-6", {"--light", "all"});
  CHECK(run.code == 1);
  const nlohmann::json rows = run.json()["rows"];
  const Run measured =
      small_house("frontier", {"--lightmap", "64", "--technique", "lightmap,h4,sh3,zh3,unc3", "--light", "all"});
  REQUIRE_MESSAGE(measured.code == 0, measured.err);
  const nlohmann::json wanted = measured.json()["rows"];
  std::size_t same = 0;
  for (const auto& row : wanted)
    for (const auto& tried : rows)
      if (row["technique"] == tried["technique"] && row["light"] == tried["light"]) {
        CAPTURE(tried.dump());
        CHECK(tried["error"] == row["error"]);
        CHECK(tried["worst"] == row["worst"]);
        ++same;
      }
  CHECK(same == rows.size());
  CHECK(same == wanted.size());
}

TEST_CASE("a larger error never costs more bytes, and a choice of storages never fewer than all of them") {
  double before = 1e30;
  for (const char* error : {"45%", "100%"}) {
    const Run run = choose(error);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    const double bytes = run.json()["chosen"]["bytes"];
    CHECK_MESSAGE(bytes <= before, error);
    before = bytes;
  }
  const nlohmann::json floats = choose("100%", {"--storage", "float32"}).json()["chosen"];
  REQUIRE(floats.is_object());
  CHECK(floats["storage"] == "float32");
  CHECK(double(floats["bytes"]) >= before);
}

TEST_CASE("nothing within the error: what comes closest is named") {
  const Run run = choose("0.000001");
  CHECK(run.code == 1);
  const nlohmann::json json = run.json();
  CHECK(json["chosen"].is_null());
  const std::string technique = json["closest"]["technique"];
  CHECK_MESSAGE(run.err.find(technique + " (") != std::string::npos, run.err);
  CHECK(run.err.find("comes closest") != std::string::npos);
  CHECK(run.err.find("--reference-rays") != std::string::npos);  // the truth's noise is above it
  for (const auto& row : json["rows"]) CHECK(row["error"] >= json["closest"]["error"]);
}

TEST_CASE("choices do not depend on the number of threads") {
  const auto chosen = [](const char* threads) {
    nlohmann::json json = small_house("choose", {"--technique", "zh3,sh3", "--light", "volume", "--max-error", "0.7",
                                                 "--threads", threads})
                              .json()["chosen"];
    REQUIRE(json.is_object());
    json.erase("shade_ns_per_pixel");
    return json.dump();
  };
  CHECK(chosen("1") == chosen("2"));
}

TEST_CASE("choose refuses what is no error, no cost and no scene") {
  const auto refused = [](std::vector<std::string> arguments, const char* reason) {
    arguments.insert(arguments.begin(), "choose");
    const Run run = run_twinshade(arguments);
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find(reason) != std::string::npos, run.err);
  };
  for (const char* error : {"0", "-0.1", "nan", "inf", "120%", "5 %", "5%%", "", "%", "1e-400"})
    refused({"--max-error", error}, "--max-error");
  refused({"--by", "size"}, "--by size");
  refused({"--storage", "bc6h"}, "storage");
  refused({"--technique", "cutout"}, "technique cutout");
  refused({"--technique", "zh3", "--light", "vertex"}, "technique zh3");
  refused({"raster_torture", "--technique", "sh3"}, "no surfaces in the world");
  refused({"nowhere.gltf"}, "nowhere.gltf");
}

}  // namespace twinshade

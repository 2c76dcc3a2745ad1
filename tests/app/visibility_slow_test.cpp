// Precomputed visibility on the scene house, as pictures: what the paper says of how much is enough.
#include <doctest/doctest.h>

#include <map>

#include "run_twinshade.h"

namespace twinshade {

TEST_CASE("image error falls with components and with order; 12 are enough at order 4, 16 to 24 at order 6") {
  const Run run = run_twinshade({"experiment", "visibility-figures", "sky", "--samples", "1024", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  std::map<std::string, double> relative;  // by figure, order and technique
  const nlohmann::json rows = run.json()["rows"];
  for (const auto& row : rows)
    relative[row["figure"].get<std::string>() + " " + std::to_string(row["order"].get<int>()) + " " +
             row["technique"].get<std::string>()] = row["relative"];
  const auto error = [&](const std::string& key) {
    REQUIRE_MESSAGE(relative.contains(key), key);
    return relative[key];
  };
  for (const std::string order : {"4", "6"}) {
    double before = 1e30;
    for (const std::string technique : {"pca4", "pca8", "pca12", "pca16", "pca24"}) {
      if (order == "4" && technique == "pca24") continue;  // order 4 has 16 coefficients
      const double now = error("components " + order + " " + technique);
      CAPTURE(order);
      CAPTURE(technique);
      CHECK(now < before);
      before = now;
    }
  }
  CHECK(error("components 4 pca12") < 0.01);
  CHECK(error("components 6 pca24") < 0.01);
  CHECK(error("components 6 pca24") < error("components 6 pca12"));
  CHECK(error("orders 6 unc6") < error("orders 6 unc4"));
  CHECK(error("orders 6 unc4") < error("orders 6 unc3"));
  CHECK(error("orders 6 unc3") < error("orders 6 preconv"));
}

}  // namespace twinshade

// Precomputed visibility on the scene house, as pictures: what the paper says of how much is enough.
#include <doctest/doctest.h>

#include <cmath>

#include "run_twinshade.h"

namespace twinshade {

// What passes for the same picture: 40 dB of peak signal to noise.
constexpr double kSamePicture = 40;

TEST_CASE("image error falls with components and with order; 12 are enough at order 4, 16 to 24 at order 6") {
  const Run run = run_twinshade({"experiment", "visibility-figures", "sky", "--samples", "1024", "--json", "-"});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  const nlohmann::json rows = run.json()["rows"];
  const auto value = [&](const std::string& figure, int order, const std::string& technique, const char* column) {
    for (const auto& row : rows)
      if (row["figure"] == figure && row["order"] == order && row["technique"] == technique)
        return row[column].is_null() ? std::nan("") : row[column].get<double>();
    FAIL(figure << " has no row for " << technique << " at order " << order);
    return 0.0;
  };
  for (const int order : {4, 6}) {
    double before = 1e30;
    for (const std::string technique : {"pca4", "pca8", "pca12", "pca16", "pca24"}) {
      if (order == 4 && technique == "pca24") continue;  // order 4 has 16 coefficients
      const double now = value("components", order, technique, "relative");
      CAPTURE(order);
      CAPTURE(technique);
      CHECK(now < before);
      before = now;
    }
  }
  CHECK(value("components", 4, "pca12", "relative") < 0.01);
  CHECK(value("components", 6, "pca24", "relative") < 0.01);
  CHECK(value("components", 6, "pca24", "relative") < value("components", 6, "pca12", "relative"));
  CHECK(value("components", 4, "pca8", "psnr") < kSamePicture);
  CHECK(value("components", 4, "pca12", "psnr") > kSamePicture);
  CHECK(value("components", 6, "pca12", "psnr") < kSamePicture);
  CHECK(value("components", 6, "pca24", "psnr") > kSamePicture);
  const auto against_rays = [&](const char* technique) { return value("orders", 6, technique, "relative"); };
  CHECK(against_rays("unc6") < against_rays("unc4"));
  CHECK(against_rays("unc4") < against_rays("unc3"));
  CHECK(against_rays("unc3") < against_rays("preconv"));
}

}  // namespace twinshade

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
  for (const auto& row : rows) CHECK_MESSAGE(row["values_differ"] == 0, row.dump());
}

}  // namespace twinshade

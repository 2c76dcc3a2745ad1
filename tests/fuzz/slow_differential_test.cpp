// As differential_test.cpp, 1,500 programs on every number type.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/differential.h"

using namespace twinshade;

TEST_CASE("1,500 generated programs: 4, 8 and 16 lanes, scalar and llvmpipe compute what they mean") {
  std::vector<EvaluationTarget> targets;
  for (const Number number : {Number::scalar, Number::lanes4, Number::lanes8, Number::lanes16})
    targets.push_back({Backend::cpu, number, Isa::baseline});
#if TWINSHADE_HAS_GL
  targets.push_back({Backend::egl, Number::scalar, {}});
#endif
  // An hour may pass on a busy machine: differences are told as they are found.
  std::size_t mistranslated = 0, driver_differs = 0;
  const auto tell = [](const std::vector<std::string>& lines, std::size_t& told) {
    for (; told < lines.size(); ++told) std::fprintf(stderr, "%s\n", lines[told].c_str());
  };
  const auto progress = [&](const fuzz::Tally& tally) {
    std::fprintf(stderr, "%zu programs\n", tally.programs);
    tell(tally.mistranslated, mistranslated);
    tell(tally.driver_differs, driver_differs);
  };
  const fuzz::Tally tally = fuzz::compare_programs(1, 1500, targets, 48, progress);
  CHECK(tally.programs == 1500);
  for (const std::string& line : tally.mistranslated) FAIL_CHECK(line);
  for (const std::string& line : tally.driver_differs) FAIL_CHECK(line);
}

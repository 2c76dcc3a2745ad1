// The table of Iwanicki and Sloan, Ambient Dice, EGSR 2017, section 4.1, with the norms cumulative to the order, and
// the condition numbers, both worked out independently in double precision.
#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "experiments/experiment.h"
#include "lighting/registry.h"

using namespace twinshade;

namespace {

struct ExpectedNorms {
  double norms[4];  // SH2 to SH5
  double condition;
};
const std::map<std::string, ExpectedNorms> kNorms = {
    {"ambient_cube", {{.1082532, 1.73543, 3.162279, 4.3589}, 2.5}},
    {"ad_linear_planar", {{.003542313, .1844129, 2.00906, 3.606017}, 3.973}},
    {"ad_linear_spherical", {{.001870961, .1544227, 2.006371, 3.605892}, 4.217}},
    {"ad_cos2cos4", {{8.910936e-5, .02830032, 2.0002, 3.605551}, 13.04}},
    {"ad_cos2cos4_raw", {{3.971024e-4, .01425998, 2.000052, 3.605552}, 16.04}},
    {"ad_cos2", {{.002229458, .002229458, 2.000057, 3.605583}, 27.19}},
    {"ad_flat", {{2.806231e-4, .003090632, .02786209, .1955406}, 363.3}},
    {"ad_spherical", {{2.728352e-4, .001490093, .02772364, .1687397}, 203.8}},
    {"sh2", {{0, std::sqrt(5.0), std::sqrt(12.0), std::sqrt(21.0)}, 1}},
    {"sh3", {{0, 0, std::sqrt(7.0), 4}, 1}},
    {"sh5", {{0, 0, 0, 0}, 1}},
};
// Condition numbers on the hemisphere; those of spherical harmonics restricted to it.
const std::map<std::string, double> kHemisphere = {
    {"hl2", 1}, {"h4", 1}, {"h6", 1}, {"sh2_lsq", 13.9}, {"sh3_lsq", 254}};

bool close(double value, double expected, double relative) {
  return std::abs(value - expected) <= relative * std::abs(expected) + 1e-12;
}

}  // namespace

TEST_CASE("what each basis misses of spherical harmonics, and the condition of its Gram matrix") {
  const ExperimentResult result = run_frobenius({.pictures = false});
  std::map<std::string, int> seen;
  for (std::size_t r = 0; r < result.rows.size(); ++r) {
    const std::string basis = std::get<std::string>(result.rows.at(r, "basis"));
    CAPTURE(basis);
    ++seen[basis];
    const double condition = result.rows.number(r, "condition");
    if (const auto found = kNorms.find(basis); found != kNorms.end()) {
      const int order = int(result.rows.number(r, "order"));
      CAPTURE(order);
      CHECK(close(result.rows.number(r, "norm"), found->second.norms[order - 2], 1e-5));
      CHECK(close(condition, found->second.condition, 5e-4));  // four digits are given
    } else if (const auto hemisphere = kHemisphere.find(basis); hemisphere != kHemisphere.end()) {
      CHECK(close(condition, hemisphere->second, 4e-3));  // three digits are given
    }
  }
  for (const auto& [basis, expected] : kNorms)
    for (const TechniqueInfo& technique : techniques())
      if (technique.name == basis) CHECK(seen[basis] == 4);
}

TEST_CASE("that bases of the hemisphere have no norm is noted where there are some") {
  CHECK(run_frobenius({.bases = {"sh3"}, .pictures = false}).notes.empty());
  CHECK(run_frobenius({.bases = {"sh3", "h4"}, .pictures = false}).notes.size() == 1);
}

TEST_CASE("the heat map has a row for each basis of the sphere") {
  const ExperimentResult result = run_frobenius({.bases = {"sh3", "h4"}});
  REQUIRE(result.pictures.size() == 1);
  const std::string svg = std::get<Drawing>(result.pictures[0].content).svg();
  CHECK(svg.find(">sh3<") != std::string::npos);
  CHECK(svg.find(">h4<") == std::string::npos);
}

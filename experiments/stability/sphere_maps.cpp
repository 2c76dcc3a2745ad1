// The tests of sphere maps. What a map of usual width stores is each texel's own direction, so that what is read should
// be the direction asked for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/directions.h"
#include "experiments/stability/seams.h"
#include "experiments/stability/test.h"

namespace twinshade {
namespace {

constexpr std::size_t kMapNormals = 20000;
constexpr int kWidths[] = {1, 2, 3, 4, 5, 8, 9, 16, 17, 32, 33, 64};  // at which texels are looked at
constexpr double kUnit = 1e-6, kMostMapUnits = 64, kMostMisread = 0.01, kMostWeightOff = 1e-6;

Finding map_finding(const std::string& test, const std::string& measure, const std::string& unit) {
  Finding finding;
  finding.test = test;
  finding.measure = measure;
  finding.unit = unit;
  return finding;
}

std::vector<glm::dvec3> inside_normals(const TestedMap& tested) {
  std::vector<glm::dvec3> normals;
  for (const TrickyNormal& tricky : tested.tricky)
    if (tricky.inside) normals.push_back(tricky.n);
  for (std::size_t i = 0; i < kMapNormals; ++i) normals.push_back(to_float(lattice_direction(i, kMapNormals)));
  return normals;
}

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

// Of a texel's direction: a unit vector?
Finding texel_directions(const TestedMap& tested) {
  Finding finding = map_finding("finite", "texels", "");
  std::size_t texels = 0;
  for (const int width : kWidths)
    for (const Number number : {Number::scalar, Number::float64}) {
      const std::vector<glm::dvec3> directions = SphereMapGrid(tested.grid.map(), width).directions(number);
      texels += directions.size();
      for (std::size_t i = 0; i < directions.size(); ++i) {
        if (std::abs(length_of(directions[i]) - 1) <= kUnit) continue;
        if (finding.value++ == 0) finding.what = fmt::format("texel {} of width {}", i, width);
      }
    }
  finding.unit = fmt::format("of {} texels", texels);
  finding.verdict = finding.value > 0 ? Verdict::fails : Verdict::ok;
  return finding;
}

}  // namespace

TestedMap::TestedMap(const SphereMapInfo& map)
    : grid(map, map.usual_width()), directions(grid.directions()), tricky(tricky_normals(Domain::sphere)) {}

std::vector<glm::dvec3> TestedMap::read(Number number, std::span<const glm::dvec3> normals) const {
  std::vector<glm::dvec3> values;
  for (const SphereMapTaps& taps : grid.taps(normals, number)) {
    glm::dvec3 sum(0);
    for (std::size_t t = 0; t < 4; ++t)
      if (taps.texel[t] < directions.size()) sum += directions[taps.texel[t]] * taps.weight[t];
    values.push_back(sum);
  }
  return values;
}

std::vector<Finding> test_map_constant(const TestedMap& tested) {
  const std::vector<glm::dvec3> normals = inside_normals(tested);
  const std::vector<SphereMapTaps> taps = tested.grid.taps(normals, Number::scalar);
  Finding least = map_finding("constant", "least", "of 1"), greatest = map_finding("constant", "greatest", "of 1");
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double sum = (taps[i].weight[0] + taps[i].weight[1]) + (taps[i].weight[2] + taps[i].weight[3]);
    if (i == 0 || sum < least.value) least.value = sum, least.normal = normals[i];
    if (i == 0 || sum > greatest.value) greatest.value = sum, greatest.normal = normals[i];
  }
  for (Finding* finding : {&least, &greatest})
    finding->verdict = within(std::abs(finding->value - 1) <= kMostWeightOff);
  return {least, greatest};
}

std::vector<Finding> test_map_finite(const TestedMap& tested) {
  std::vector<glm::dvec3> normals;
  for (const TrickyNormal& tricky : tested.tricky) normals.push_back(tricky.n);
  const std::vector<SphereMapTaps> taps = tested.grid.taps(normals, Number::scalar);
  Finding inside = map_finding("finite", "inside", ""), other = map_finding("finite", "other normals", "");
  std::size_t inside_count = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    inside_count += tested.tricky[i].inside;
    bool good = true;
    for (std::size_t t = 0; t < 4; ++t)
      good = good && std::isfinite(taps[i].weight[t]) && taps[i].texel[t] < tested.directions.size();
    if (good) continue;
    Finding& finding = tested.tricky[i].inside ? inside : other;
    if (finding.value++ > 0) continue;
    finding.what = tested.tricky[i].what;
    finding.normal = normals[i];
  }
  inside.unit = fmt::format("of {} inputs", inside_count);
  other.unit = fmt::format("of {} inputs", normals.size() - inside_count);
  inside.verdict = inside.value > 0 ? Verdict::fails : Verdict::ok;
  return {inside, other, texel_directions(tested)};
}

std::vector<Finding> test_map_rounding(const TestedMap& tested) {
  const std::vector<glm::dvec3> normals = inside_normals(tested);
  const std::vector<glm::dvec3> exact = tested.read(Number::float64, normals),
                                rounded = tested.read(Number::scalar, normals);
  Finding worst = map_finding("rounding", "largest", "2^-24");
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (const double error = length_of(rounded[i] - exact[i]) * 0x1p24; error > worst.value)
      worst.value = error, worst.normal = normals[i];
  worst.verdict = within(worst.value <= kMostMapUnits);
  return {worst};
}

std::vector<Finding> test_map_jump(const TestedMap& tested) {
  const SeamSearch search(tested.tricky, false, [](const glm::dvec3& n) { return to_float(unit(n)); });
  return seam_findings(
      search.find([&](std::span<const glm::dvec3> normals) { return tested.read(Number::scalar, normals); }));
}

std::vector<Finding> test_map_reading(const TestedMap& tested) {
  const std::vector<glm::dvec3> normals = inside_normals(tested);
  const std::vector<glm::dvec3> values = tested.read(Number::float64, normals);
  Finding worst = map_finding("reading", "largest", "of a unit vector");
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (const double error = length_of(values[i] - normals[i]); error > worst.value)
      worst.value = error, worst.normal = normals[i];
  worst.verdict = within(worst.value <= kMostMisread);
  return {worst};
}

}  // namespace twinshade

// Ringing: what a basis makes of a unit sun, whose irradiance is between 0 and 1 everywhere. Least: light that is taken
// away on the dark side; greatest: how far the bright side overshoots. Over all directions of the sun and the normal.
#include <algorithm>
#include <cmath>

#include "experiments/directions.h"
#include "experiments/stability/test.h"

namespace twinshade {
namespace {

constexpr std::size_t kSuns = 120, kNormals = 500;
constexpr std::size_t kRefined = 3;                    // of the worst suns
constexpr double kFirstStep = 0.12, kLastStep = 1e-4;  // radians
constexpr double kGain = 1e-6;                         // less is no reason for a sun that is harder to name
constexpr double kMostRinging = 0.05, kMostPeakOff = 0.1;

struct Extreme {
  double value = 0;
  glm::dvec3 sun{0}, normal{0};
};

class Search {
 public:
  // sign: 1 for the greatest, -1 for the least.
  Search(const TestedBasis& tested, double sign) : tested_(tested), sign_(sign) {}

  // The best of some normals.
  Extreme best(const glm::dvec3& sun, std::span<const glm::dvec3> normals) const {
    return best(sun, normals, tested_.irradiance(Number::float64, tested_.fit.coefficients(unit_sun(sun)), normals));
  }
  Extreme best(const glm::dvec3& sun, std::span<const glm::dvec3> normals, const std::vector<double>& values) const {
    Extreme found{values[0], sun, normals[0]};
    for (std::size_t i = 1; i < normals.size(); ++i)
      if (better(values[i * 3], found.value, kGain)) found = {values[i * 3], sun, normals[i]};
    return found;
  }

  // Steps to the best of the places about the sun and the normal, each step half as long as the one before where none
  // is better.
  Extreme climb(Extreme at) const {
    for (double step = kFirstStep; step > kLastStep; step /= 2) {
      Extreme next = best(at.sun, around(at.normal, at.normal, step));
      if (!better(next.value, at.value, 0)) next = at;
      for (const glm::dvec3& moved : directions_around(at.sun, step)) {
        const glm::dvec3 sun = tested_.inside(moved);
        const Extreme found = best(sun, around(next.normal, next.normal + (sun - at.sun), step));
        if (better(found.value, next.value, 0)) next = found;
      }
      if (better(next.value, at.value, kGain)) at = next;
    }
    return at;
  }

  bool better(double value, double than, double by) const { return sign_ * value > sign_ * than + by; }

 private:
  std::vector<glm::dvec3> around(const glm::dvec3& n, const glm::dvec3& turned, double step) const {
    std::vector<glm::dvec3> list{n, tested_.inside(turned)};
    for (const glm::dvec3& moved : directions_around(unit(turned), step)) list.push_back(tested_.inside(moved));
    return list;
  }

  const TestedBasis& tested_;
  double sign_;
};

// First those that are easy to name: of equals they stay.
std::vector<glm::dvec3> ringing_suns(const TestedBasis& tested) {
  std::vector<glm::dvec3> list;
  for (const glm::dvec3& sun :
       {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), unit({1, 1, 0}), unit({1, 1, 1})})
    list.push_back(to_float(sun));
  for (const glm::dvec3& sun : icosahedron_vertices())
    if (!tested.hemisphere() || sun.z >= 0) list.push_back(to_float(sun));
  for (const glm::dvec3& sun : tested.normals(kSuns)) list.push_back(sun);
  return list;
}

Extreme worst_extreme(const Search& search, std::vector<Extreme> each) {
  std::stable_sort(each.begin(), each.end(),
                   [&](const Extreme& a, const Extreme& b) { return search.better(a.value, b.value, kGain); });
  Extreme found = each.front();
  for (std::size_t i = 0; i < std::min(kRefined, each.size()); ++i)
    if (const Extreme climbed = search.climb(each[i]); search.better(climbed.value, found.value, kGain))
      found = climbed;
  return found;
}

}  // namespace

std::vector<Finding> test_ringing(const TestedBasis& tested) {
  const Search down(tested, -1), up(tested, 1);
  std::vector<glm::dvec3> normals;
  for (const TrickyNormal& tricky : tested.tricky)
    if (tricky.inside && tricky.what == "axis") normals.push_back(tricky.n);
  for (const glm::dvec3& n : tested.normals(kNormals)) normals.push_back(n);
  std::vector<Extreme> least, greatest;
  for (const glm::dvec3& sun : ringing_suns(tested)) {
    const std::vector<double> values =
        tested.irradiance(Number::float64, tested.fit.coefficients(unit_sun(sun)), normals);
    least.push_back(down.best(sun, normals, values));
    greatest.push_back(up.best(sun, normals, values));
  }
  std::vector<Finding> findings;
  const auto add = [&](const char* measure, const Extreme& extreme, bool good) {
    findings.push_back({"ringing",
                        measure,
                        extreme.value,
                        "of the peak",
                        judged(extreme.value, good),
                        "",
                        extreme.sun,
                        extreme.normal,
                        {},
                        tested.fit.coefficients(unit_sun(extreme.sun))});
  };
  const Extreme low = worst_extreme(down, least), high = worst_extreme(up, greatest);
  add("least", low, low.value >= -kMostRinging);
  add("greatest", high, std::abs(high.value - 1) <= kMostPeakOff);
  return findings;
}

}  // namespace twinshade

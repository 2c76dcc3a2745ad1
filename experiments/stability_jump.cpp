// Jumps: how far apart irradiance in float is at neighbouring normals. Great circles are walked in small steps; where a
// step's change stands out from those beside it the step is halved until its ends are floats next to each other: what
// is then left is a seam, or rounding. Normals that formulas trip over are left in steps of several directions as well,
// and zeros of one sign compared with those of the other. On the way the greatest change of slope is found: a crease,
// where shading is continuous but shows an edge.
#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "experiments/directions.h"
#include "experiments/stability_test.h"

namespace twinshade {
namespace {

constexpr std::size_t kCircles = 24, kSteps = 2048, kHalved = 200;
constexpr int kMostHalvings = 80;
constexpr double kAside = 1e-5;
constexpr double kMostJump = 1e-4;  // of the largest irradiance

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Two normals and what irradiance is there.
struct Pair {
  glm::dvec3 a, b, at_a{0}, at_b{0};
  double difference() const { return largest_of(at_a - at_b); }
};

// Walks over the domain: each a list of normals, one step apart.
std::vector<std::vector<glm::dvec3>> walks(const TestedBasis& tested) {
  std::vector<glm::dvec3> poles{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (std::size_t i = 0; poles.size() < kCircles; ++i) poles.push_back(lattice_direction(i, 2 * kCircles));
  std::vector<std::vector<glm::dvec3>> list;
  for (const glm::dvec3& pole : poles) {
    const auto [u, v] = tangents(pole);
    std::vector<glm::dvec3> walk;
    for (std::size_t k = 0; k <= kSteps; ++k) {
      const double angle = 2 * portable::kPi * double(k) / double(kSteps);
      const glm::dvec3 n = to_float(u * portable::cos(angle) + v * portable::sin(angle));
      if (!tested.hemisphere() || n.z >= 0) {
        walk.push_back(n);
      } else if (walk.size() > 2) {  // below the horizon: what comes up again is another walk
        list.push_back(std::move(walk));
        walk.clear();
      } else {
        walk.clear();
      }
    }
    if (walk.size() > 2) list.push_back(std::move(walk));
  }
  return list;
}

// From normals that formulas trip over to places aside, and to themselves with zeros of the other sign.
using Ends = std::vector<std::pair<glm::dvec3, glm::dvec3>>;
Ends steps_aside(const TestedBasis& tested) {
  Ends pairs;
  for (const TrickyNormal& tricky : tested.tricky) {
    if (!tricky.inside) continue;
    for (const glm::dvec3& aside : directions_around(unit(tricky.n), kAside))
      pairs.emplace_back(tricky.n, tested.inside(aside));
    for (int axis = 0; axis < 3; ++axis)
      if (tricky.n[axis] == 0) {
        glm::dvec3 turned = tricky.n;
        turned[axis] = -turned[axis];
        pairs.emplace_back(tricky.n, turned);
      }
  }
  return pairs;
}

// By the shader in float.
std::vector<glm::dvec3> shaded(const TestedBasis& tested, const std::vector<double>& coefficients,
                               const std::vector<glm::dvec3>& normals) {
  const std::vector<double> rgb = tested.irradiance(Number::scalar, coefficients, normals);
  std::vector<glm::dvec3> values;
  for (std::size_t i = 0; i < rgb.size(); i += 3) values.emplace_back(rgb[i], rgb[i + 1], rgb[i + 2]);
  return values;
}

std::vector<Pair> shaded(const TestedBasis& tested, const std::vector<double>& coefficients,
                         const std::vector<std::pair<glm::dvec3, glm::dvec3>>& ends) {
  std::vector<glm::dvec3> normals;
  for (const auto& [a, b] : ends) normals.insert(normals.end(), {a, b});
  const std::vector<glm::dvec3> values = shaded(tested, coefficients, normals);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < ends.size(); ++i)
    pairs.push_back({ends[i].first, ends[i].second, values[i * 2], values[i * 2 + 1]});
  return pairs;
}

// The pairs whose ends differ most, at most kHalved.
void keep_steepest(std::vector<Pair>& pairs) {
  const std::size_t kept = std::min(kHalved, pairs.size());
  std::partial_sort(pairs.begin(), pairs.begin() + std::ptrdiff_t(kept), pairs.end(),
                    [](const Pair& a, const Pair& b) { return a.difference() > b.difference(); });
  pairs.resize(kept);
}

// Each pair halved, towards the side of the larger difference, until its ends are next to each other.
void halve(const TestedBasis& tested, const std::vector<double>& coefficients, std::vector<Pair>& pairs) {
  for (int halving = 0; halving < kMostHalvings; ++halving) {
    std::vector<glm::dvec3> middles;
    std::vector<Pair*> open;
    for (Pair& pair : pairs) {
      const glm::dvec3 middle = to_float((pair.a + pair.b) * 0.5);
      if (middle == pair.a || middle == pair.b) continue;
      middles.push_back(middle);
      open.push_back(&pair);
    }
    if (open.empty()) break;
    const std::vector<glm::dvec3> values = shaded(tested, coefficients, middles);
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Pair first{open[i]->a, middles[i], open[i]->at_a, values[i]},
          second{middles[i], open[i]->b, values[i], open[i]->at_b};
      *open[i] = first.difference() >= second.difference() ? first : second;
    }
  }
}

struct Worst {
  double jump = 0, crease = 0;  // of the largest irradiance; of that per radian
  Pair at_jump, at_crease;
};

Worst worst_of(const TestedBasis& tested, const std::vector<double>& coefficients,
               const std::vector<std::vector<glm::dvec3>>& walks, const Ends& aside) {
  Worst worst;
  double peak = 0;
  std::vector<Pair> bends;  // of two steps each: what is left of their changes' difference stands for a pair's
  for (const std::vector<glm::dvec3>& walk : walks) {
    const std::vector<glm::dvec3> values = shaded(tested, coefficients, walk);
    for (const glm::dvec3& value : values) peak = std::max(peak, largest_of(value));
    for (std::size_t k = 1; k + 1 < walk.size(); ++k)  // smooth changes cancel
      bends.push_back({walk[k - 1], walk[k + 1], values[k + 1] - values[k], values[k] - values[k - 1]});
  }
  if (!(peak > 0)) return worst;
  keep_steepest(bends);
  worst.crease = bends.front().difference() / peak / (2 * portable::kPi / double(kSteps));
  worst.at_crease = bends.front();

  std::vector<Pair> pairs = shaded(tested, coefficients, aside);
  keep_steepest(pairs);
  Ends bent;
  for (const Pair& bend : bends) bent.emplace_back(bend.a, bend.b);
  for (const Pair& pair : shaded(tested, coefficients, bent)) pairs.push_back(pair);
  halve(tested, coefficients, pairs);
  for (const Pair& pair : pairs)
    if (pair.difference() / peak > worst.jump) worst.jump = pair.difference() / peak, worst.at_jump = pair;
  return worst;
}

}  // namespace

std::vector<Finding> test_jump(const TestedBasis& tested) {
  const std::vector<std::vector<glm::dvec3>> over = walks(tested);
  const Ends aside = steps_aside(tested);
  Finding jump{"jump", "value", 0, "of the largest", Verdict::ok, "", {}, {}, {}, {}}, crease = jump;
  crease.measure = "slope";
  crease.unit = "of the largest a radian";
  crease.verdict = Verdict::none;
  const auto take = [](Finding& finding, double value, const Pair& pair, const SmallLight& light,
                       const std::vector<double>& coefficients) {
    if (!(value > finding.value)) return;
    finding.value = value;
    finding.what = light.name;
    finding.light = light.suns.size() == 1 ? std::optional(light.suns[0].direction) : std::nullopt;
    finding.normal = pair.a;
    finding.other_normal = pair.b;
    finding.coefficients = coefficients;
  };
  for (const SmallLight& light :
       {unit_sun(unit({2, 3, 6})), unit_sun({1, 0, 0}),
        SmallLight{"a red sky and a blue sun", {0.3, 0.1, 0.1}, {{unit({-3, -4, 2}), {0.1, 0.3, 0.9}}}}}) {
    const std::vector<double> coefficients = tested.fit.coefficients(light);
    const Worst worst = worst_of(tested, coefficients, over, aside);
    take(jump, worst.jump, worst.at_jump, light, coefficients);
    take(crease, worst.crease, worst.at_crease, light, coefficients);
  }
  jump.verdict = within(jump.value <= kMostJump);
  return {jump, crease};
}

}  // namespace twinshade

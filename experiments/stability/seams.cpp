#include "experiments/stability/seams.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.h"
#include "experiments/directions.h"
#include "lighting/quadrature.h"

namespace twinshade {
namespace {

constexpr std::size_t kCircles = 24, kSteps = 2048, kHalved = 200;
constexpr int kMostHalvings = 80;
constexpr double kAside = 1e-5;  // radians

using Ends = std::pair<glm::dvec3, glm::dvec3>;

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Two normals and what is shaded there.
struct Pair {
  glm::dvec3 a, b, at_a, at_b;
  double difference() const { return largest_of(at_a - at_b); }
};

// The parts of a great circle about `pole` that are in the domain, one step apart.
void add_walks(const glm::dvec3& pole, bool hemisphere, std::vector<std::vector<glm::dvec3>>& walks) {
  const auto [u, v] = tangents(pole);
  std::vector<glm::dvec3> walk;
  const auto end = [&] {
    if (walk.size() > 2) walks.push_back(std::move(walk));
    walk.clear();
  };
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double angle = 2 * portable::kPi * double(k) / double(kSteps);
    const glm::dvec3 n = to_float(u * portable::cos(angle) + v * portable::sin(angle));
    if (hemisphere && n.z < 0)
      end();
    else
      walk.push_back(n);
  }
  end();
}

std::vector<Pair> shade_ends(const Shade& shade, const std::vector<Ends>& ends) {
  std::vector<glm::dvec3> normals;
  for (const auto& [a, b] : ends) normals.insert(normals.end(), {a, b});
  const std::vector<glm::dvec3> values = shade(normals);
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
void halve(const Shade& shade, std::vector<Pair>& pairs) {
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
    const std::vector<glm::dvec3> values = shade(middles);
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Pair first{open[i]->a, middles[i], open[i]->at_a, values[i]},
          second{middles[i], open[i]->b, values[i], open[i]->at_b};
      *open[i] = first.difference() >= second.difference() ? first : second;
    }
  }
}

}  // namespace

SeamSearch::SeamSearch(const std::vector<TrickyNormal>& tricky, bool hemisphere,
                       const std::function<glm::dvec3(const glm::dvec3&)>& inside) {
  for (const glm::dvec3& pole : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)})
    add_walks(pole, hemisphere, walks_);
  for (std::size_t i = 3; i < kCircles; ++i) add_walks(lattice_direction(i - 3, 2 * kCircles), hemisphere, walks_);
  for (const TrickyNormal& normal : tricky) {
    if (!normal.inside) continue;
    for (const glm::dvec3& aside : directions_around(unit(normal.n), kAside))
      aside_.emplace_back(normal.n, inside(aside));
    for (int axis = 0; axis < 3; ++axis)
      if (normal.n[axis] == 0) {
        glm::dvec3 turned = normal.n;
        turned[axis] = -turned[axis];
        aside_.emplace_back(normal.n, turned);
      }
  }
}

Seams SeamSearch::find(const Shade& shade) const {
  Seams seams;
  double peak = 0;
  std::vector<Pair> bends;  // of two steps each: their changes stand for values, so that smooth ones cancel
  for (const std::vector<glm::dvec3>& walk : walks_) {
    const std::vector<glm::dvec3> values = shade(walk);
    for (const glm::dvec3& value : values) peak = std::max(peak, largest_of(value));
    for (std::size_t k = 1; k + 1 < walk.size(); ++k)
      bends.push_back({walk[k - 1], walk[k + 1], values[k + 1] - values[k], values[k] - values[k - 1]});
  }
  if (!(peak > 0)) return seams;
  keep_steepest(bends);
  seams.crease = bends.front().difference() / peak / (2 * portable::kPi / double(kSteps));
  seams.crease_at[0] = bends.front().a, seams.crease_at[1] = bends.front().b;

  std::vector<Pair> pairs = shade_ends(shade, aside_);
  keep_steepest(pairs);
  std::vector<Ends> bent;
  for (const Pair& bend : bends) bent.emplace_back(bend.a, bend.b);
  for (const Pair& pair : shade_ends(shade, bent)) pairs.push_back(pair);
  halve(shade, pairs);
  for (const Pair& pair : pairs)
    if (pair.difference() / peak > seams.jump) {
      seams.jump = pair.difference() / peak;
      seams.jump_at[0] = pair.a, seams.jump_at[1] = pair.b;
    }
  return seams;
}

}  // namespace twinshade

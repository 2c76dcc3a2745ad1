#include "experiments/stability/tricky_inputs.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "experiments/directions.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

constexpr double kRounding = 1e-6, kLargestHalf = 65504;
constexpr int kAzimuths = 16, kRandomSets = 4;
constexpr std::uint64_t kCoefficientDomain = 80;  // of random_bits

class Normals {
 public:
  explicit Normals(bool hemisphere) : hemisphere_(hemisphere) {}

  void add(const glm::dvec3& exact, const std::string& what) {
    const glm::dvec3 n = to_float(exact);
    const bool inside = std::abs(glm::dot(n, n) - 1) < 2 * kRounding && (!hemisphere_ || n.z >= -kRounding);
    list.push_back({n, what, inside});
  }

  // And its neighbours among floats.
  void add_about(const glm::dvec3& exact, const std::string& what) {
    add(exact, what);
    const glm::vec3 n(exact);
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-2.0f, 2.0f}) {
        glm::vec3 moved = n;
        moved[axis] = std::nextafter(n[axis], side);
        add(moved, "beside " + what);
      }
  }

  std::vector<TrickyNormal> list;

 private:
  bool hemisphere_;
};

void add_octants(Normals& normals) {
  const double levels[] = {1, 0.0, -0.0, -1};
  for (const double x : levels)
    for (const double y : levels)
      for (const double z : levels) {
        const double square = x * x + y * y + z * z;
        if (square == 0) continue;
        normals.add_about(glm::dvec3(x, y, z) / std::sqrt(square), square == 1   ? "axis"
                                                                   : square == 2 ? "edge of octants"
                                                                                 : "corner of a cube");
      }
}

void add_icosahedron(Normals& normals) {
  const std::vector<glm::dvec3> vertices = icosahedron_vertices();
  const auto adjacent = [&](std::size_t i, std::size_t j) { return glm::dot(vertices[i], vertices[j]) > 0.4; };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    normals.add_about(vertices[i], "vertex of the icosahedron");
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      if (!adjacent(i, j)) continue;
      for (const double part : {0.5, 0.001})
        normals.add_about(unit(vertices[i] * part + vertices[j] * (1 - part)), "edge of the icosahedron");
      for (std::size_t k = j + 1; k < vertices.size(); ++k)
        if (adjacent(i, k) && adjacent(j, k))
          normals.add_about(unit(vertices[i] + vertices[j] + vertices[k]), "face of the icosahedron");
    }
  }
}

void add_horizon_and_poles(Normals& normals) {
  for (int k = 0; k < kAzimuths; ++k) {
    const double angle = 2 * portable::kPi * (k + 0.37) / kAzimuths, x = portable::cos(angle), y = portable::sin(angle);
    for (const double z : {0.0, -0.0, 1e-40, -1e-40, 1e-20, 1e-9, -1e-9, 1e-7, -1e-7, 1e-4}) {
      const double side = std::sqrt(1 - z * z);
      normals.add({side * x, side * y, z}, "horizon");
    }
    for (const double away : {1e-40, 1e-20, 1e-9, 1e-7, 1e-4})
      for (const double pole : {1.0, -1.0})
        normals.add({away * x, away * y, pole * std::sqrt(1 - away * away)}, "beside a pole");
  }
}

void add_outside(Normals& normals, bool hemisphere) {
  for (const double x : {0.0, -0.0})
    for (const double y : {0.0, -0.0})
      for (const double z : {0.0, -0.0}) normals.add({x, y, z}, "zero vector");
  std::vector<glm::dvec3> some = icosahedron_vertices();
  for (int k = 0; k < 40; ++k) some.push_back(lattice_direction(std::size_t(k), 40));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      glm::dvec3 n(0);
      n[axis] = side;
      some.push_back(n);
    }
  for (const glm::dvec3& n : some)
    if (hemisphere && n.z < 0) normals.add(n, "below the horizon");
  for (const double length : {1.001, 0.5, 2.0, 1e-3, 1e3, 1e-6, 1e6, 1e-10, 1e10, 1e-20, 1e20, 1e-40, 1e38})
    for (const glm::dvec3& n : some) normals.add(n * length, "not of unit length");
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value = double(float(value * factor));
  return values;
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

std::vector<TrickyNormal> tricky_normals(Domain domain) {
  const bool hemisphere = domain == Domain::hemisphere;
  Normals normals(hemisphere);
  add_octants(normals);
  add_icosahedron(normals);
  add_horizon_and_poles(normals);
  add_outside(normals, hemisphere);
  return std::move(normals.list);
}

std::vector<TrickyCoefficients> tricky_coefficients(const TechniqueInfo& basis, const LightFit& fit,
                                                    std::uint64_t seed) {
  const glm::dvec3 up(0, 0, 1), slanted = unit({2, 3, 6}), white(1);
  const std::size_t count = std::size_t(basis.count) * 3;
  std::vector<TrickyCoefficients> list;
  for (const SmallLight& light :
       {SmallLight{"no light", {}, {}}, SmallLight{"constant light", white, {}},
        SmallLight{"red constant light", {1, 0, 0}, {}}, SmallLight{"a sun at the zenith", {}, {{up}}},
        SmallLight{"a blue sun", {}, {{slanted, {0, 0, 1}}}}, SmallLight{"a sun at the horizon", {}, {{{1, 0, 0}}}},
        SmallLight{"two opposite suns", {}, {{slanted}, {-slanted}}},
        SmallLight{"suns of opposite colours", {}, {{slanted, {1, 0, 0}}, {-slanted, {0, 0.2126 / 0.7152, 0}}}},
        SmallLight{"light without a mean", {}, {{slanted}, {-slanted, -white}}},
        SmallLight{"negative constant light", -white, {}}, SmallLight{"a negative sun", {}, {{slanted, -white}}}})
    list.push_back({fit.coefficients(light), light.name, true});

  const std::vector<double> sun = fit.coefficients({"", {}, {{slanted}}});
  const double largest = largest_magnitude(sun) > 0 ? largest_magnitude(sun) : 1;
  list.push_back({scaled(sun, kLargestHalf / largest), "a sun up to the largest half", true});
  list.push_back({scaled(sun, 1e-10), "a sun times 1e-10", true});
  list.push_back({scaled(sun, 1e-20), "a sun times 1e-20", true});
  list.push_back({scaled(sun, 1e-39), "a sun times 1e-39 (denormal)", true});
  for (std::size_t i = 0; i < std::size_t(basis.count); ++i)
    for (const double value : {1.0, -kLargestHalf}) {
      std::vector<double> one(count, 0.0);
      for (std::size_t c = 0; c < 3; ++c) one[i * 3 + c] = value;
      list.push_back({std::move(one), "coefficient " + std::to_string(i) + " alone", true});
    }
  for (int set = 0; set < kRandomSets; ++set) {
    std::vector<double> any(count), ends(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double real = unit_real(random_bits(seed, kCoefficientDomain, std::uint64_t(set), k));
      any[k] = double(float(2 * real - 1));
      ends[k] = real < 0.5 ? -kLargestHalf : kLargestHalf;
    }
    list.push_back({std::move(any), "random coefficients", true});
    list.push_back({std::move(ends), "random signs of the largest half", true});
  }
  for (const double factor : {1e15, 1e20, 1e30, 1e37})
    list.push_back({scaled(sun, factor), "a sun beyond halves", false});
  return list;
}

}  // namespace twinshade

#include "scenes/mikktspace.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace twinshade;
using glm::dvec3;

namespace {

struct Soup {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  void corner(const dvec3& p, const dvec3& n, const glm::dvec2& uv) {
    positions.emplace_back(p);
    normals.emplace_back(glm::normalize(n));
    uvs.emplace_back(uv);
  }
  std::vector<glm::vec4> tangents() const { return mikktspace_tangents(positions, normals, uvs); }
};

struct Sample {
  dvec3 position, normal, tangent;
  glm::dvec2 uv;
};

// A grid of cells over a surface given by (u, v) in [0, 1]^2.
Soup grid(int columns, int rows, const std::function<Sample(double, double)>& surface) {
  Soup soup;
  const auto add = [&](int i, int j) {
    const Sample s = surface(double(i) / columns, double(j) / rows);
    soup.corner(s.position, s.normal, s.uv);
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      for (auto [x, y] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j}, {i + 1, j + 1}, {i, j + 1}}) add(x, y);
    }
  return soup;
}

void check_frames(const Soup& soup, const std::vector<glm::vec4>& tangents) {
  REQUIRE(tangents.size() == soup.positions.size());
  double worst = 0;
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    const dvec3 t(tangents[i]), n(soup.normals[i]);
    worst = std::max({worst, std::fabs(glm::length(t) - 1), std::fabs(glm::dot(t, n))});
    REQUIRE(std::fabs(tangents[i].w) == 1);
  }
  CHECK(worst < 3e-7);
}

constexpr double kTurn = 6.283185307179586;

}  // namespace

TEST_CASE("on a plane the tangent is the direction of u, exactly, whatever the triangles") {
  for (double angle : {0.0, 0.3, 1.5, 4.0}) {
    std::mt19937 random(3);
    Soup soup;
    for (int i = 0; i < 200; ++i) {
      glm::dvec2 p[3];
      for (auto& q : p) q = glm::dvec2(double(random() % 1000) / 100, double(random() % 1000) / 100);
      if ((p[1] - p[0]).x * (p[2] - p[0]).y - (p[1] - p[0]).y * (p[2] - p[0]).x <= 0) std::swap(p[1], p[2]);
      for (const auto& q : p)
        soup.corner({q.x, q.y, 0}, {0, 0, 1},
                    {q.x * std::cos(angle) + q.y * std::sin(angle), q.y * std::cos(angle) - q.x * std::sin(angle)});
    }
    const auto tangents = soup.tangents();
    check_frames(soup, tangents);
    for (const glm::vec4& t : tangents) {
      CHECK(glm::length(dvec3(t) - dvec3(std::cos(angle), std::sin(angle), 0)) < 2e-3);  // thin triangles: float uvs
      CHECK(t.w == 1);
    }
  }
}

TEST_CASE("on a sphere and a torus tangents follow the circles of latitude") {
  const auto sphere = [](double u, double v) {
    const double a = kTurn * u, b = 0.5 * kTurn * (0.1 + 0.8 * v);
    const dvec3 n(std::sin(b) * std::cos(a), -std::cos(b), -std::sin(b) * std::sin(a));
    return Sample{2.0 * n, n, {-std::sin(a), 0, -std::cos(a)}, {4 * u, 2 * v}};
  };
  const auto torus = [](double u, double v) {
    const double a = kTurn * u, b = kTurn * v;
    const dvec3 out(std::cos(a), 0, -std::sin(a));
    const dvec3 n = out * std::cos(b) + dvec3(0, std::sin(b), 0);
    return Sample{out * 3.0 + n, n, {-std::sin(a), 0, -std::cos(a)}, {6 * u, 2 * v}};
  };
  for (const auto& surface :
       {std::function<Sample(double, double)>(sphere), std::function<Sample(double, double)>(torus)}) {
    const Soup soup = grid(96, 64, surface);
    const auto tangents = soup.tangents();
    check_frames(soup, tangents);
    const std::size_t row = 96 * 6;
    double worst = 0;
    for (std::size_t i = 8 * row; i < soup.positions.size() - 8 * row; ++i) {
      const double u = soup.uvs[i].x / surface(1, 0).uv.x;
      if (u < 0.05 || u > 0.95) continue;  // at the seam only one side counts
      worst = std::max(worst, glm::length(dvec3(tangents[i]) - surface(u, 0.5).tangent));
      CHECK(tangents[i].w == 1);
    }
    CHECK(worst < 0.02);
  }
}

TEST_CASE("mirrored uvs have the other handedness and do not mix with their neighbours") {
  // Two quads that share an edge at x = 0; u grows away from it on both sides.
  const auto folded = [](double u, double v) {
    const double x = 2 * u - 1;
    return Sample{{x, v, 0}, {0, 0, 1}, {}, {std::fabs(x), v}};
  };
  const Soup soup = grid(2, 1, folded);
  const auto tangents = soup.tangents();
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(tangents[i] == glm::vec4(-1, 0, 0, -1));
    CHECK(tangents[6 + i] == glm::vec4(1, 0, 0, 1));
  }
}

TEST_CASE("a seam in the uvs splits the tangents, a smooth edge shares them") {
  // A gentle ridge along x = 0.
  Soup smooth = grid(2, 1, [](double u, double v) {
    const double x = 2 * u - 1;
    return Sample{{x, v, -0.2 * std::fabs(x)}, {0, 0, 1}, {}, {u, v}};
  });
  const auto shared = smooth.tangents();
  CHECK(shared[1] == shared[6]);  // (0, 0) seen from both sides
  for (std::size_t i = 6; i < 12; ++i)
    smooth.uvs[i] = glm::vec2(smooth.uvs[i].y + 5, -smooth.uvs[i].x);  // turned by 90 degrees
  const auto split = smooth.tangents();
  CHECK(split[1] != split[6]);
  CHECK(std::fabs(split[6].y) > 0.9);
}

TEST_CASE("a triangle weighs by its angle at the vertex, not by its size or number") {
  // A quadrant in one piece on the right, in six slices on the left; u axes 60 degrees apart.
  Soup soup;
  const auto slice = [&](double from, double to, double turn, double radius) {
    for (double a : {-1.0, from, to}) {
      const dvec3 p = a < 0 ? dvec3(0) : dvec3(std::cos(a), std::sin(a), 0) * radius;
      soup.corner(p, {0, 0, 1},
                  {p.x * std::cos(turn) + p.y * std::sin(turn), p.y * std::cos(turn) - p.x * std::sin(turn)});
    }
  };
  // The edges towards +x and +y agree in both uv systems only at the origin, so the pieces are groups of their own;
  // joined ones are compared instead: one system, different slicing, same tangent.
  slice(0, kTurn / 4, 0.4, 1);
  for (int i = 0; i < 6; ++i) slice(kTurn / 4 * (1 + i / 6.0), kTurn / 4 * (1 + (i + 1) / 6.0), 0.4, 5);
  const auto tangents = soup.tangents();
  for (const glm::vec4& t : tangents) CHECK(glm::length(dvec3(t) - dvec3(std::cos(0.4), std::sin(0.4), 0)) < 1e-5);
}

TEST_CASE("triangles without area, in space or in uvs, neither break their neighbours nor stay without a frame") {
  Soup soup = grid(2, 2, [](double u, double v) { return Sample{{u, v, 0}, {0, 0, 1}, {}, {u, v}}; });
  const auto before = soup.tangents();
  const std::size_t count = soup.positions.size();
  for (std::size_t i : {0u, 0u, 1u}) soup.corner(dvec3(soup.positions[i]), {0, 0, 1}, glm::dvec2(soup.uvs[i]));
  for (std::size_t i : {0u, 1u, 2u}) soup.corner(dvec3(soup.positions[i]) + dvec3(0, 0, 1), {0, 1, 0}, {0.5, 0.5});
  const auto after = soup.tangents();
  check_frames(soup, after);
  for (std::size_t i = 0; i < count; ++i) CHECK(after[i] == before[i]);
  CHECK(after[count] == before[0]);
}

TEST_CASE("a fan of a hundred thousand triangles around one vertex is no problem") {
  Soup soup;
  const int n = 100000;
  for (int i = 0; i < n; ++i)
    for (double a : {-1.0, kTurn * i / n, kTurn * (i + 1) / n}) {
      const dvec3 p = a < 0 ? dvec3(0) : dvec3(std::cos(a), std::sin(a), 0) * 1000.0;
      soup.corner(p, {0, 0, 1}, {p.x, p.y});
    }
  const auto tangents = soup.tangents();
  CHECK(glm::length(dvec3(tangents[0]) - dvec3(1, 0, 0)) < 1e-3);
}

TEST_CASE(
    "a hundred thousand triangles on one side of an edge are no problem, and the one on its other side joins one") {
  Soup soup;
  const int n = 100000;
  const auto page = [&](double angle, const dvec3& from, const dvec3& to) {
    const dvec3 out(std::cos(angle), std::sin(angle), 0);
    for (const dvec3& p : {from, to, out}) soup.corner(p, {0, 0, 1}, {p.x + p.z, p.y});
  };
  for (int i = 0; i < n; ++i) page(kTurn * i / n, {0, 0, 0}, {0, 0, 1});
  page(0.1, {0, 0, 1}, {0, 0, 0});
  const auto tangents = soup.tangents();
  CHECK(tangents[3 * n + 1] == tangents[0]);
}

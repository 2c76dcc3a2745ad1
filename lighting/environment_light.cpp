// Sums are taken row by row and added in the order of rows, pixels of a row in four interleaved sums: the same bits on
// any number of threads.
#include "lighting/environment_light.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

void check(const Environment& environment) {
  const std::size_t pixels = std::size_t(environment.width) * environment.height;
  if (pixels == 0 || environment.radiance.size() != pixels)
    throw UserError("environment " + environment.name + " has no pixels");
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c)
      if (const float value = environment.radiance[i][c]; !(value >= 0) || std::isinf(value))
        throw UserError("environment " + environment.name + ": radiance " + std::to_string(value) + " at pixel " +
                        std::to_string(i % environment.width) + ", " + std::to_string(i / environment.width) +
                        " is not light; replace it (--clamp-radiance)");
}

// The environment as lights: direction and radiance times solid angle, component by component, padded with darkness to
// a multiple of four.
struct Lights {
  std::vector<double> x, y, z, r, g, b;

  explicit Lights(const Environment& environment) {
    const PixelDirections directions(environment.width, environment.height);
    for (std::uint32_t row = 0; row < environment.height; ++row) {
      const double solid_angle = environment.pixel_solid_angle(row);
      for (std::uint32_t column = 0; column < environment.width; ++column) {
        const glm::dvec3 d = directions(column, row);
        const glm::dvec3 power =
            glm::dvec3(environment.radiance[std::size_t(row) * environment.width + column]) * solid_angle;
        add(d, power);
      }
    }
    while (x.size() % 4 != 0) add({0, 0, 0}, {0, 0, 0});
  }

  void add(const glm::dvec3& d, const glm::dvec3& power) {
    x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
    r.push_back(power.r), g.push_back(power.g), b.push_back(power.b);
  }
};

glm::dvec3 irradiance(const Lights& lights, const glm::dvec3& normal) {
  double red[4] = {}, green[4] = {}, blue[4] = {};
  for (std::size_t i = 0; i < lights.x.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) {
      const double cosine = (lights.x[i + k] * normal.x + lights.y[i + k] * normal.y) + lights.z[i + k] * normal.z;
      const double lit = cosine > 0 ? cosine : 0;
      red[k] += lit * lights.r[i + k];
      green[k] += lit * lights.g[i + k];
      blue[k] += lit * lights.b[i + k];
    }
  return {(red[0] + red[1]) + (red[2] + red[3]), (green[0] + green[1]) + (green[2] + green[3]),
          (blue[0] + blue[1]) + (blue[2] + blue[3])};
}

}  // namespace

std::vector<double> environment_radiance(const Environment& environment, int order) {
  if (order < 1 || order > 6) throw UserError("order " + std::to_string(order) + " is not within 1 to 6");
  check(environment);
  const int functions = std::max(4, order * order), count = order * order;
  const PixelDirections direction(environment.width, environment.height);
  std::vector<std::vector<double>> rows(environment.height);
  parallel_for(environment.height, [&](std::size_t row, int) {
    std::vector<glm::dvec3> directions;
    for (std::uint32_t column = 0; column < environment.width; ++column)
      directions.push_back(direction(column, std::uint32_t(row)));
    const std::vector<double> values = radiance_basis(directions, functions);
    rows[row].assign(std::size_t(count) * 3, 0.0);
    for (std::uint32_t column = 0; column < environment.width; ++column) {
      const glm::dvec3 radiance(environment.radiance[row * environment.width + column]);
      for (int j = 0; j < count; ++j)
        for (int c = 0; c < 3; ++c) rows[row][j * 3 + c] += values[std::size_t(column) * functions + j] * radiance[c];
    }
  });
  std::vector<double> sum(std::size_t(count) * 3, 0.0);
  for (std::uint32_t row = 0; row < environment.height; ++row) {
    const double solid_angle = environment.pixel_solid_angle(row);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += rows[row][i] * solid_angle;
  }
  return sum;
}

std::vector<double> environment_irradiance(const Environment& environment, std::span<const glm::dvec3> normals) {
  check(environment);
  for (std::size_t p = 0; p < normals.size(); ++p)
    if (!(std::abs(glm::dot(normals[p], normals[p]) - 1) < 1e-3))
      throw UserError("normal " + std::to_string(p) + " is not a unit vector: (" + std::to_string(normals[p].x) + ", " +
                      std::to_string(normals[p].y) + ", " + std::to_string(normals[p].z) + ")");
  const Lights lights(environment);
  std::vector<double> result(normals.size() * 3);
  constexpr std::size_t kBlock = 16;
  parallel_for((normals.size() + kBlock - 1) / kBlock, [&](std::size_t block, int) {
    for (std::size_t p = block * kBlock; p < std::min(normals.size(), (block + 1) * kBlock); ++p) {
      const glm::dvec3 lit = irradiance(lights, normals[p]);
      for (int c = 0; c < 3; ++c) result[p * 3 + c] = lit[c];
    }
  });
  return result;
}

}  // namespace twinshade

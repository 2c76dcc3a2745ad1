#include "scenes/patch_mesh.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "scenes/orthonormal_basis.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

std::uint32_t cells(double at_density_1, double density) {
  return std::max(1u, std::uint32_t(std::ceil(at_density_1 * density - 1e-9)));
}

// The outermost texel centres of a chart lie this far, in texels, inside its uvs: rasterising a lightmap finds them
// whatever the rounding, and a bilinear fetch at the rim still takes 7/8 of its light from the chart.
constexpr double kChartInset = 0.375;

dvec2 lightmap_uv(const ChartPlace& place, const dvec2& in_chart) {
  const dvec2 corner(place.x + kChartInset, place.y + kChartInset);
  const dvec2 size(place.width - 2 * kChartInset, place.height - 2 * kChartInset);
  return (corner + in_chart * size) / double(kChartAtlasSize);
}

double snap(double metres) { return std::floor(metres * 0x1p16 + 0.5) * 0x1p-16; }

}  // namespace

int PatchMesh::add_chart(double width, double height) {
  charts_.push_back({width, height});
  return int(charts_.size()) - 1;
}

std::uint64_t PatchMesh::count(double density) const {
  std::uint64_t sum = 0;
  for (const Patch& patch : patches_) {
    const std::uint64_t columns = cells(patch.columns, density), rows = cells(patch.rows, density);
    sum += 2 * columns * rows - columns * (std::uint64_t(patch.pole_at_start) + std::uint64_t(patch.pole_at_end));
  }
  return sum;
}

void PatchMesh::build(Scene& scene, std::uint32_t triangles) const {
  double density = 1;
  if (count(1) < triangles) density = std::sqrt(double(triangles) / double(count(1)));
  while (count(density) < triangles) density *= 1.005;
  const std::vector<ChartPlace> places = pack_charts(charts_);

  for (const Patch& patch : patches_) {
    const std::uint32_t columns = cells(patch.columns, density), rows = cells(patch.rows, density);
    const auto first = std::uint32_t(scene.positions.size());
    std::vector<dvec3> corners;
    std::vector<dvec3> normals;
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (std::uint32_t i = 0; i <= columns; ++i) {
        // A pole has one vertex a triangle, one less than a row.
        if ((patch.pole_at_start && j == 0 && i == columns) || (patch.pole_at_end && j == rows && i == 0)) continue;
        const SurfacePoint point = patch.at(double(i) / columns, double(j) / rows);
        const dvec3 normal = glm::normalize(point.normal);
        const dvec3 position(snap(point.position.x), snap(point.position.y), snap(point.position.z));
        corners.push_back(position);
        normals.push_back(normal);
        scene.positions.emplace_back(position);
        scene.normals.emplace_back(normal);
        scene.tangents.push_back(tangent_frame(normal, point.u_axis, point.v_axis));
        scene.uvs.emplace_back(point.uv);
        scene.lightmap_uvs.emplace_back(lightmap_uv(places[std::size_t(patch.chart)], point.chart));
      }

    // Two triangles a cell, one at a pole.
    std::vector<std::uint32_t> indices;
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t a = j * (columns + 1) + i - (patch.pole_at_start && j > 0), b = a + 1;
        const std::uint32_t d =
            (j + 1) * (columns + 1) + i - patch.pole_at_start - (patch.pole_at_end && j + 1 == rows);
        const std::uint32_t c = d + 1;
        if (!(patch.pole_at_start && j == 0)) indices.insert(indices.end(), {a, b, c});
        if (!(patch.pole_at_end && j + 1 == rows)) indices.insert(indices.end(), {a, c, d});
      }
    // Counter-clockwise outside: the patch as a whole is turned if most of its area faces against its normals.
    double agreement = 0;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      const dvec3 &a = corners[indices[t]], &b = corners[indices[t + 1]], &c = corners[indices[t + 2]];
      agreement += glm::dot(glm::cross(b - a, c - a), normals[indices[t]]);
    }
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      if (agreement < 0) std::swap(indices[t + 1], indices[t + 2]);
      for (std::size_t k = 0; k < 3; ++k) scene.indices.push_back(first + indices[t + k]);
      scene.triangle_materials.push_back(std::uint32_t(patch.material));
    }
  }
}

void check_triangle_request(std::uint32_t triangles) {
  if (triangles > (1u << 27))
    throw UserError("--triangles " + std::to_string(triangles) + ": at most " + std::to_string(1u << 27));
}

glm::vec4 tangent_frame(const dvec3& unit_normal, const dvec3& u_axis, const dvec3& v_axis) {
  dvec3 tangent = u_axis - unit_normal * glm::dot(unit_normal, u_axis);
  const double length = glm::length(tangent);
  tangent = length > 0 ? tangent / length : orthonormal_tangent(unit_normal);
  const double handedness = glm::dot(glm::cross(unit_normal, tangent), v_axis) < 0 ? -1 : 1;
  return glm::vec4(glm::vec3(tangent), float(handedness));
}

}  // namespace twinshade

#include "lighting/surface_metric.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "lighting/radiance_basis.h"
#include "lighting/sh_product.h"

namespace twinshade {
namespace {

// Cells of the cube map; odd, so that the commonest normals are in the middle of one.
constexpr int kGroupWidth = 9;
static_assert(kSurfaceGroups == 6 * kGroupWidth * kGroupWidth && kGroupWidth % 2 == 1);
constexpr double kTilt = 0.5;  // tangent of the widest tilt
constexpr int kRings = 2, kSpokes = 6;
constexpr double kLeastWeight = 0.03;  // of the mean weight

glm::dvec3 normal_of(std::span<const float> normals, std::size_t cell) {
  return {normals[cell * 3], normals[cell * 3 + 1], normals[cell * 3 + 2]};
}

// Face axis * 2 + (negative), then the next two axes across.
std::uint16_t group_of(const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (!(size[axis] > 0)) return 0;
  const auto place = [&](int k) {
    return std::min(kGroupWidth - 1, int((normal[(axis + k) % 3] / size[axis] + 1) / 2 * kGroupWidth));
  };
  return std::uint16_t(((axis * 2 + (normal[axis] < 0)) * kGroupWidth + place(1)) * kGroupWidth + place(2));
}

glm::dvec3 middle_of(std::size_t group) {
  const int face = int(group) / (kGroupWidth * kGroupWidth), axis = face / 2;
  const auto across = [](std::size_t place) { return 2 * (double(place) + 0.5) / kGroupWidth - 1; };
  glm::dvec3 middle;
  middle[axis] = face % 2 == 0 ? 1 : -1;
  middle[(axis + 1) % 3] = across(group / kGroupWidth % kGroupWidth);
  middle[(axis + 2) % 3] = across(group % kGroupWidth);
  return glm::normalize(middle);
}

// The normal itself and those around it.
std::vector<glm::dvec3> tilted(const glm::dvec3& normal) {
  const glm::dvec3 other = std::abs(normal.x) > 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 tangent = glm::normalize(glm::cross(normal, other)), bitangent = glm::cross(normal, tangent);
  std::vector<glm::dvec3> normals{normal};
  for (int ring = 1; ring <= kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double angle = 2 * portable::kPi * (spoke + 0.5 * ring) / kSpokes, tilt = kTilt * ring / kRings;
      normals.push_back(
          glm::normalize(normal + tilt * (portable::cos(angle) * tangent + portable::sin(angle) * bitangent)));
    }
  return normals;
}

void add_metric(const glm::dvec3& normal, int order, double* metric) {
  const auto n = Eigen::Index(order) * order;
  const std::vector<glm::dvec3> normals = tilted(normal);
  const std::vector<double> basis = radiance_basis(normals, kMostRadianceCount);
  const auto cosine = clamped_cosine_factors();
  Eigen::Map<Eigen::MatrixXd> sum(metric, n, n);
  std::vector<double> lobe(static_cast<std::size_t>(n));
  for (std::size_t p = 0; p < normals.size(); ++p) {
    for (std::size_t j = 0; j < lobe.size(); ++j) lobe[j] = cosine[j] * basis[p * kMostRadianceCount + j];
    const std::vector<double> product = sh_product_matrix(lobe, 1, order);
    const Eigen::Map<const Eigen::MatrixXd> matrix(product.data(), n, n);
    sum += matrix * matrix / double(normals.size());
  }
  sum.diagonal().array() += kLeastWeight * sum.trace() / double(n);
}

}  // namespace

std::vector<std::uint16_t> surface_groups(std::span<const float> normals) {
  std::vector<std::uint16_t> groups(normals.size() / 3);
  for (std::size_t cell = 0; cell < groups.size(); ++cell) groups[cell] = group_of(normal_of(normals, cell));
  return groups;
}

std::vector<double> surface_metrics(std::span<const float> normals, std::span<const float> cell_weights, int order) {
  TWINSHADE_CHECK_EQ(normals.size(), cell_weights.size() * 3);
  const std::size_t square = std::size_t(order) * std::size_t(order) * std::size_t(order) * std::size_t(order);
  std::vector<glm::dvec3> facing(kSurfaceGroups, glm::dvec3(0));
  for (std::size_t cell = 0; cell < cell_weights.size(); ++cell) {
    const glm::dvec3 normal = normal_of(normals, cell);
    facing[group_of(normal)] += normal * double(cell_weights[cell]);
  }
  std::vector<double> metrics(kSurfaceGroups * square, 0.0);
  parallel_for(kSurfaceGroups, [&](std::size_t group, int) {
    const double length = glm::length(facing[group]);
    add_metric(length > 0 ? facing[group] / length : middle_of(group), order, metrics.data() + group * square);
  });
  return metrics;
}

}  // namespace twinshade

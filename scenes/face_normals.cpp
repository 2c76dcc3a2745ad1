#include "scenes/face_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace twinshade {

using glm::dvec3;

namespace {

// The triangles around one place by where they face, so that those within a crease angle of one of them are summed
// without looking at each: of many around one place, that would take the square of their number.
class Fan {
 public:
  // area, unit: of all triangles, their normals times twice their area, and of length 1.
  Fan(const std::vector<dvec3>& area, const std::vector<dvec3>& unit, double cos_crease)
      : area_(area), unit_(unit), cos_crease_(cos_crease) {}

  void add(std::size_t triangle) {
    constexpr double kCells = 16;  // along an axis, each way: some thousands over all directions
    const dvec3 n = unit_[triangle] * kCells;
    cells_[{int(std::floor(n.x)), int(std::floor(n.y)), int(std::floor(n.z))}].triangles.push_back(triangle);
  }

  void finish() {
    for (auto& [place, cell] : cells_) {
      for (const std::size_t t : cell.triangles) cell.area += area_[t], cell.middle += unit_[t];
      cell.middle = glm::normalize(cell.middle);
      for (const std::size_t t : cell.triangles) cell.cosine = std::min(cell.cosine, glm::dot(unit_[t], cell.middle));
    }
  }

  dvec3 sum_around(std::size_t own) const {
    constexpr double kRounding = 1e-9;
    dvec3 sum(0);
    for (const auto& [place, cell] : cells_) {
      const double cosine = glm::dot(unit_[own], cell.middle);
      const double both = cosine * cell.cosine, sines = sine(cosine) * sine(cell.cosine);
      if (both - sines >= cos_crease_ + kRounding) {  // all of the cell
        sum += cell.area;
      } else if (cosine >= cell.cosine || both + sines >= cos_crease_ - kRounding) {  // else none of it
        for (const std::size_t t : cell.triangles)
          if (glm::dot(unit_[own], unit_[t]) >= cos_crease_ || t == own) sum += area_[t];
      }
    }
    return sum;
  }

 private:
  struct Cell {
    std::vector<std::size_t> triangles;
    dvec3 area{0}, middle{0};
    double cosine = 1;  // of the largest angle from the middle
  };

  static double sine(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }

  const std::vector<dvec3>&area_, &unit_;
  double cos_crease_;
  std::map<std::array<int, 3>, Cell> cells_;
};

// Fewer triangles around one place are looked at one by one: that is faster there.
constexpr std::size_t kManyAroundOne = 256;

}  // namespace

std::vector<glm::vec3> face_normals(const std::vector<glm::vec3>& corner_positions, double cos_crease) {
  const std::size_t corners = corner_positions.size();
  std::vector<dvec3> area(corners / 3), unit(corners / 3);
  for (std::size_t t = 0; t < area.size(); ++t) {
    const dvec3 a(corner_positions[3 * t]), b(corner_positions[3 * t + 1]), c(corner_positions[3 * t + 2]);
    area[t] = glm::cross(b - a, c - a);
    const double length = glm::length(area[t]);
    unit[t] = length > 0 ? area[t] / length : dvec3(0);
  }
  // Corners in one place stand next to each other, in the order of triangles.
  std::vector<std::uint32_t> order(corners);
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    const glm::vec3& p = corner_positions[i];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto pa = place(a), pb = place(b);
    return pa != pb ? pa < pb : a < b;
  });
  std::vector<glm::vec3> normals(corners);
  for (std::size_t start = 0; start < corners;) {
    std::size_t end = start;
    while (end < corners && place(order[end]) == place(order[start])) ++end;
    dvec3 all(0);  // of what has an area
    for (std::size_t i = start; i < end; ++i) all += area[order[i] / 3];
    const bool creased = cos_crease < 1, many = creased && end - start > kManyAroundOne;
    Fan fan(area, unit, cos_crease);
    for (std::size_t i = start; i < end && many; ++i)
      if (unit[order[i] / 3] != dvec3(0)) fan.add(order[i] / 3);
    fan.finish();
    for (std::size_t i = start; i < end; ++i) {
      const std::size_t own = order[i] / 3;
      const bool degenerate = unit[own] == dvec3(0);
      dvec3 sum = degenerate ? all : area[own];
      if (many && !degenerate) sum = fan.sum_around(own);
      if (creased && !many && !degenerate)
        for (std::size_t j = start; j < end; ++j) {
          const std::size_t other = order[j] / 3;
          if (other != own && glm::dot(unit[own], unit[other]) >= cos_crease) sum += area[other];
        }
      const double length = glm::length(sum);
      normals[order[i]] = length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
    }
    start = end;
  }
  return normals;
}

}  // namespace twinshade

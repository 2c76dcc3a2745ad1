// M. S. Mikkelsen, Simulation of wrinkled surfaces revisited, master's thesis, University of Copenhagen, 2008,
// section 2.4 and appendix A, with the rules for degenerate triangles of the tangent space that bears his name. In
// double, with sums in the order of the triangles. (Its limit on the angle within a group is at its default, 180
// degrees: none.)
#include "scenes/mikktspace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "base/portable_math.h"
#include "scenes/orthonormal_basis.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr std::uint32_t kNone = ~0u;

struct Triangle {
  std::array<std::uint32_t, 3> vertex;
  std::array<std::uint32_t, 3> neighbour{kNone, kNone, kNone};  // across the edge from corner i to corner i + 1
  std::array<std::uint32_t, 3> group{kNone, kNone, kNone};
  dvec3 u_axis{0}, v_axis{0};  // unit: where u and v grow
  bool preserving = false;     // uvs are not mirrored
  bool joins_any = true;       // its uvs have no area: it takes the side of its neighbours and adds nothing
  bool degenerate = false;     // two corners in one place
};

struct Group {
  std::uint32_t vertex;
  bool preserving;
  std::vector<std::uint32_t> triangles;
};

dvec3 normalized_or_zero(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : dvec3(0);
}

dvec3 in_plane(const dvec3& v, const dvec3& normal) { return normalized_or_zero(v - normal * glm::dot(normal, v)); }

// Equal position, normal and uv: one number for each different corner.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals,
                                const std::vector<glm::vec2>& uvs) {
  using Key = std::array<float, 8>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (float f : key) hash = (hash ^ std::bit_cast<std::uint32_t>(f)) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
      return std::size_t(hash);
    }
  };
  std::unordered_map<Key, std::uint32_t, Hash> numbers;
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Key key = {positions[i].x, positions[i].y, positions[i].z, normals[i].x,
               normals[i].y,   normals[i].z,   uvs[i].x,       uvs[i].y};
    for (float& f : key) f += 0.0f;  // -0 is 0
    result.push_back(numbers.try_emplace(key, std::uint32_t(numbers.size())).first->second);
  }
  return result;
}

// Pairs triangles along edges that they walk in opposite directions; where more than two meet, in the order of
// triangles.
void find_neighbours(std::vector<Triangle>& triangles) {
  struct Edge {
    std::uint32_t low, high, triangle, corner;
    bool upwards;
  };
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (triangles[t].degenerate) continue;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t].vertex[i], b = triangles[t].vertex[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, i, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::array{a.low, a.high, a.triangle, a.corner} < std::array{b.low, b.high, b.triangle, b.corner};
  });
  const auto neighbour = [&](const Edge& edge) -> std::uint32_t& {
    return triangles[edge.triangle].neighbour[edge.corner];
  };
  for (std::size_t start = 0, end = 0; start < edges.size(); start = end) {
    while (end < edges.size() && edges[end].low == edges[start].low && edges[end].high == edges[start].high) ++end;
    std::array<std::size_t, 2> next{start, start};  // the first that may be free, of those that go down and up
    for (std::size_t i = start; i < end; ++i) {
      if (neighbour(edges[i]) != kNone) continue;
      std::size_t& j = next[edges[i].upwards ? 0 : 1];
      while (j < end && (j <= i || edges[j].upwards == edges[i].upwards || neighbour(edges[j]) != kNone)) ++j;
      if (j == end) continue;
      neighbour(edges[i]) = edges[j].triangle;
      neighbour(edges[j]) = edges[i].triangle;
    }
  }
}

// A group: the triangles around a vertex that are joined by edges and mirrored alike.
std::vector<Group> find_groups(std::vector<Triangle>& triangles) {
  std::vector<Group> groups;
  for (std::uint32_t start = 0; start < triangles.size(); ++start)
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      Triangle& first = triangles[start];
      if (first.degenerate || first.joins_any || first.group[corner] != kNone) continue;
      const auto number = std::uint32_t(groups.size());
      Group group{first.vertex[corner], first.preserving, {}};
      std::vector<std::uint32_t> pending = {start};
      while (!pending.empty()) {
        const std::uint32_t t = pending.back();
        pending.pop_back();
        Triangle& triangle = triangles[t];
        std::uint32_t i = 0;
        while (triangle.vertex[i] != group.vertex) ++i;
        if (triangle.group[i] != kNone) continue;
        const bool free = triangle.group == std::array<std::uint32_t, 3>{kNone, kNone, kNone};
        if (triangle.joins_any && free) triangle.preserving = group.preserving;
        if (triangle.preserving != group.preserving) continue;
        triangle.group[i] = number;
        group.triangles.push_back(t);
        const std::uint32_t left = triangle.neighbour[i], right = triangle.neighbour[(i + 2) % 3];
        if (right != kNone) pending.push_back(right);
        if (left != kNone) pending.push_back(left);
      }
      std::sort(group.triangles.begin(), group.triangles.end());
      groups.push_back(std::move(group));
    }
  return groups;
}

}  // namespace

std::vector<glm::vec4> mikktspace_tangents(const std::vector<glm::vec3>& positions,
                                           const std::vector<glm::vec3>& normals, const std::vector<glm::vec2>& uvs) {
  const std::vector<std::uint32_t> vertex = weld(positions, normals, uvs);
  std::vector<Triangle> triangles(positions.size() / 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Triangle& triangle = triangles[t];
    triangle.vertex = {vertex[3 * t], vertex[3 * t + 1], vertex[3 * t + 2]};
    const dvec3 p0(positions[3 * t]), p1(positions[3 * t + 1]), p2(positions[3 * t + 2]);
    triangle.degenerate = p0 == p1 || p1 == p2 || p2 == p0;
    const dvec2 uv0(uvs[3 * t]), d1 = dvec2(uvs[3 * t + 1]) - uv0, d2 = dvec2(uvs[3 * t + 2]) - uv0;
    const double area = d1.x * d2.y - d1.y * d2.x;
    triangle.preserving = area > 0;
    if (area == 0) continue;
    const double sign = area > 0 ? 1 : -1;
    triangle.u_axis = normalized_or_zero(((p1 - p0) * d2.y - (p2 - p0) * d1.y) * sign);
    triangle.v_axis = normalized_or_zero(((p2 - p0) * d1.x - (p1 - p0) * d2.x) * sign);
    triangle.joins_any = triangle.u_axis == dvec3(0) || triangle.v_axis == dvec3(0);
  }
  find_neighbours(triangles);

  // A group's tangent: those of its triangles in the plane of the vertex's normal, weighted by the angles at the
  // vertex.
  std::vector<glm::vec4> tangents(positions.size(), glm::vec4(0));
  std::vector<glm::vec4> of_vertex(positions.size(), glm::vec4(0));  // any, for degenerate triangles
  for (const Group& group : find_groups(triangles)) {
    const auto corner_of = [&](std::uint32_t t) {
      std::size_t i = 0;
      while (triangles[t].vertex[i] != group.vertex) ++i;
      return i;
    };
    dvec3 sum(0);
    for (std::uint32_t t : group.triangles) {
      if (triangles[t].joins_any) continue;
      const std::size_t i = corner_of(t), at = 3 * std::size_t(t);
      const dvec3 normal(normals[at + i]), here(positions[at + i]);
      const dvec3 previous = in_plane(dvec3(positions[at + (i + 2) % 3]) - here, normal);
      const dvec3 next = in_plane(dvec3(positions[at + (i + 1) % 3]) - here, normal);
      sum += in_plane(triangles[t].u_axis, normal) * portable::acos(glm::dot(previous, next));
    }
    const std::size_t first = 3 * std::size_t(group.triangles.front()) + corner_of(group.triangles.front());
    const dvec3 normal(normals[first]);
    dvec3 tangent = in_plane(sum, normal);
    if (tangent == dvec3(0)) tangent = orthonormal_tangent(normal);
    const glm::vec4 result(glm::vec3(tangent), group.preserving ? 1.0f : -1.0f);
    for (std::uint32_t t : group.triangles) tangents[3 * std::size_t(t) + corner_of(t)] = result;
    if (of_vertex[group.vertex].w == 0) of_vertex[group.vertex] = result;
  }

  // Corners that no group reached: what another triangle has at the vertex, else any frame.
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    if (tangents[i].w != 0) continue;
    tangents[i] = of_vertex[vertex[i]];
    if (tangents[i].w == 0) tangents[i] = glm::vec4(glm::vec3(orthonormal_tangent(dvec3(normals[i]))), 1);
  }
  return tangents;
}

}  // namespace twinshade

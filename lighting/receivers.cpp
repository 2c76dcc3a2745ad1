#include "lighting/receivers.h"

#include <algorithm>
#include <cmath>

#include "lighting/quadrature.h"
#include "lighting/texel_coverage.h"

namespace twinshade {
namespace {

// How far in from its corner a vertex' site is, as barycentric weight of each of the other two corners.
constexpr double kInset = 1.0 / 64;
constexpr std::size_t kMaxSites = 8;

bool usable(const glm::dvec3& v) {
  const double square = glm::dot(v, v);
  return std::isfinite(square) && square > 1e-24;
}

template <class Vector>
auto blend(const Vector* values, const std::uint32_t* corners, double b1, double b2) {
  using Wide = glm::vec<Vector::length(), double>;
  return Wide(values[corners[0]]) * ((1 - b1) - b2) + Wide(values[corners[1]]) * b1 + Wide(values[corners[2]]) * b2;
}

// Bilinear, repeating, row 0 at t = 0: as the shader reads the albedo, in double.
glm::dvec3 sample(const Image& image, const glm::dvec2& uv) {
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return glm::dvec3(1);
  const double x = (uv.x - std::floor(uv.x)) * image.width - 0.5, y = (uv.y - std::floor(uv.y)) * image.height - 0.5;
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  const auto texel = [&](double column, double row) {
    const std::uint32_t i = std::uint32_t(std::int64_t(std::floor(column)) + image.width) % image.width;
    const std::uint32_t j = std::uint32_t(std::int64_t(std::floor(row)) + image.height) % image.height;
    const float* t = image.texels.data() + (std::size_t(j) * image.width + i) * 4;
    return glm::dvec3(t[0], t[1], t[2]);
  };
  const glm::dvec3 low = texel(x, y) * (1 - fx) + texel(x + 1, y) * fx;
  const glm::dvec3 high = texel(x, y + 1) * (1 - fx) + texel(x + 1, y + 1) * fx;
  return low * (1 - fy) + high * fy;
}

glm::vec3 albedo_at(const Scene& scene, std::uint32_t triangle, double b1, double b2) {
  if (scene.materials.empty()) return glm::vec3(Material{}.albedo);
  const Material& material = scene.materials[scene.triangle_materials[triangle]];
  glm::dvec3 albedo(material.albedo);
  if (material.albedo_image >= 0 && scene.has_uvs)
    albedo *= sample(scene.images[material.albedo_image],
                     blend(scene.uvs.data(), scene.indices.data() + 3 * std::size_t(triangle), b1, b2));
  // More than it receives no surface reflects
  return glm::vec3(glm::clamp(albedo, 0.0, 1.0));
}

class Builder {
 public:
  Builder(const Scene& scene, const RayScene& rays) : scene_(scene), rays_(rays) {}

  // False where nothing can stand on the triangle.
  bool add_site(Receivers& out, std::uint32_t triangle, double b1, double b2) const {
    const glm::dvec3 normal = rays_.geometric_normal(triangle);
    if (!usable(normal)) return false;
    const glm::dvec3 place = blend(scene_.positions.data(), corners(triangle), b1, b2);
    out.sites.push_back({glm::vec3(place + normal * rays_.lift(glm::vec3(place))), glm::vec3(normal), triangle});
    return true;
  }

  void add_receiver(Receivers& out, std::uint32_t cell, std::uint32_t first_site, std::uint32_t triangle, double b1,
                    double b2, double area) const {
    const std::uint32_t* corner = corners(triangle);
    glm::dvec3 tangent(0);
    double handedness = 1;
    if (!scene_.tangents.empty()) {
      tangent = glm::dvec3(blend(scene_.tangents.data(), corner, b1, b2));
      handedness = scene_.tangents[corner[0]].w < 0 ? -1 : 1;
    }
    const glm::dmat3 frame = tangent_frame(blend(scene_.normals.data(), corner, b1, b2), tangent, handedness,
                                           rays_.geometric_normal(triangle));
    out.receiver_of_cell[cell] = std::uint32_t(out.list.size());
    out.list.push_back({cell, first_site, std::uint32_t(out.sites.size()) - first_site, glm::vec3(frame[0]),
                        glm::vec3(frame[1]), glm::vec3(frame[2]), albedo_at(scene_, triangle, b1, b2), float(area)});
  }

 private:
  const std::uint32_t* corners(std::uint32_t triangle) const {
    return scene_.indices.data() + 3 * std::size_t(triangle);
  }
  const Scene& scene_;
  const RayScene& rays_;
};

}  // namespace

glm::dmat3 tangent_frame(glm::dvec3 normal, glm::dvec3 tangent, double handedness, const glm::dvec3& fallback) {
  normal = usable(normal) ? unit(normal) : fallback;
  tangent -= normal * glm::dot(normal, tangent);
  if (!usable(tangent)) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    tangent = axis - normal * glm::dot(normal, axis);
  }
  tangent = unit(tangent);
  return {tangent, glm::cross(normal, tangent) * handedness, normal};
}

Receivers lightmap_receivers(const Scene& scene, const RayScene& rays, std::uint32_t size) {
  Receivers out;
  out.storage = CoefficientStorage::lightmap;
  out.width = out.height = size;
  out.receiver_of_cell.assign(std::size_t(size) * size, kNoReceiver);
  const Builder builder(scene, rays);
  const std::vector<TexelOwner> owners = texel_owners(scene, size);
  for (std::uint32_t cell = 0; cell < owners.size(); ++cell) {
    const TexelOwner& owner = owners[cell];
    if (owner.triangle == kNoTriangle) continue;
    const std::uint32_t first_site = std::uint32_t(out.sites.size());
    if (builder.add_site(out, owner.triangle, owner.b1, owner.b2))
      builder.add_receiver(out, cell, first_site, owner.triangle, owner.b1, owner.b2, owner.surface);
  }
  return out;
}

Receivers vertex_receivers(const Scene& scene, const RayScene& rays) {
  Receivers out;
  out.storage = CoefficientStorage::vertex;
  out.width = std::uint32_t(scene.positions.size());
  out.height = 1;
  out.receiver_of_cell.assign(out.width, kNoReceiver);
  const Builder builder(scene, rays);

  // Corners by vertex, in order of triangle
  std::vector<std::uint32_t> first(std::size_t(out.width) + 1, 0), corners(scene.indices.size());
  for (const std::uint32_t vertex : scene.indices) ++first[vertex + 1];
  for (std::uint32_t v = 0; v < out.width; ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t corner = 0; corner < scene.indices.size(); ++corner)
    corners[next[scene.indices[corner]]++] = corner;

  for (std::uint32_t v = 0; v < out.width; ++v) {
    const std::uint32_t first_site = std::uint32_t(out.sites.size());
    std::uint32_t home = kNoTriangle;
    double home_b1 = 0, home_b2 = 0, area = 0;
    for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) area += triangle_area(scene, corners[i] / 3) / 3;
    for (std::uint32_t i = first[v]; i < first[v + 1] && out.sites.size() - first_site < kMaxSites; ++i) {
      const std::uint32_t triangle = corners[i] / 3, corner = corners[i] % 3;
      const double b1 = corner == 1 ? 1 - 2 * kInset : kInset, b2 = corner == 2 ? 1 - 2 * kInset : kInset;
      if (!builder.add_site(out, triangle, b1, b2) || home != kNoTriangle) continue;
      home = triangle;
      home_b1 = corner == 1 ? 1 : 0, home_b2 = corner == 2 ? 1 : 0;
    }
    if (home != kNoTriangle) builder.add_receiver(out, v, first_site, home, home_b1, home_b2, area);
  }
  return out;
}

std::uint32_t Receivers::at(const Scene& scene, std::uint32_t triangle, double b1, double b2, double choice) const {
  const std::uint32_t* corner = scene.indices.data() + 3 * std::size_t(triangle);
  if (storage == CoefficientStorage::vertex)
    return receiver_of_cell[corner[choice < b1 ? 1 : choice < b1 + b2 ? 2 : 0]];
  const glm::dvec2 uv = blend(scene.lightmap_uvs.data(), corner, b1, b2);
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return kNoReceiver;
  const std::uint32_t x = std::uint32_t(std::clamp(uv.x * width, 0.0, width - 1.0));
  const std::uint32_t y = std::uint32_t(std::clamp(uv.y * height, 0.0, height - 1.0));
  return receiver_of_cell[std::size_t(y) * width + x];
}

}  // namespace twinshade

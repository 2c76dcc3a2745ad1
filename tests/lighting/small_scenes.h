// Scenes and environments of a few numbers, whose light is known in closed form.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {

// Adds the rectangle origin, origin + a, origin + a + b, origin + b; its front is cross(a, b). Lightmap chart: the
// square of side `chart_size` at `chart`.
inline void add_rectangle(Scene& scene, const glm::vec3& origin, const glm::vec3& a, const glm::vec3& b,
                          glm::vec2 chart, float chart_size, std::uint32_t material = 0) {
  const std::uint32_t first = std::uint32_t(scene.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(a, b));
  for (int corner = 0; corner < 4; ++corner) {
    const float s = corner == 1 || corner == 2 ? 1 : 0, t = corner >= 2 ? 1 : 0;
    scene.positions.push_back(origin + a * s + b * t);
    scene.normals.push_back(normal);
    scene.tangents.push_back(glm::vec4(glm::normalize(a), 1));
    scene.uvs.push_back({s, t});
    scene.lightmap_uvs.push_back(chart + glm::vec2(s, t) * chart_size);
  }
  for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) scene.indices.push_back(first + corner);
  scene.triangle_materials.insert(scene.triangle_materials.end(), 2, material);
}

inline Scene scene_with_albedo(float albedo) {
  Scene scene;
  scene.name = "test";
  scene.materials.push_back({"matt", glm::vec3(albedo), -1, -1});
  return scene;
}

// A floor at y = 0 around the origin, facing up; the chart is the whole lightmap.
inline Scene floor_scene(float half = 1) {
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, {0, 0}, 1);
  return scene;
}

// A cube of side 2 around the origin seen from inside; each wall a chart of its own.
inline Scene furnace_scene(float albedo) {
  Scene scene = scene_with_albedo(albedo);
  const auto chart = [](int i) { return glm::vec2(float(i % 3), float(i / 3)) * 0.33f + 0.015f; };
  constexpr float size = 0.3f;
  add_rectangle(scene, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, chart(0), size);  // floor
  add_rectangle(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, chart(1), size);   // ceiling
  add_rectangle(scene, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, chart(2), size);  // back
  add_rectangle(scene, {1, -1, 1}, {-2, 0, 0}, {0, 2, 0}, chart(3), size);   // front
  add_rectangle(scene, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, chart(4), size);  // left
  add_rectangle(scene, {1, -1, -1}, {0, 0, 2}, {0, 2, 0}, chart(5), size);   // right
  return scene;
}

inline Environment uniform_environment(float radiance, std::uint32_t width = 32) {
  Environment environment;
  environment.name = "uniform";
  environment.width = width, environment.height = width / 2;
  environment.radiance.assign(std::size_t(width) * width / 2, glm::vec3(radiance));
  return environment;
}

}  // namespace twinshade

// Scenes are built of patches: rectangles of cells bent over a parametric surface, each with its place in a lightmap
// chart.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/chart_packing.h"
#include "scenes/scene.h"

namespace twinshade {

struct SurfacePoint {
  glm::dvec3 position;        // metres
  glm::dvec3 normal;          // any length, outwards
  glm::dvec3 u_axis, v_axis;  // where the material's u and v grow; any length
  glm::dvec2 uv;              // of the material
  glm::dvec2 chart;           // in the chart, [0, 1] each way; one-to-one over all patches of a chart
};

struct Patch {
  int material = 0;
  int chart = 0;
  double columns = 1, rows = 1;                        // cells at density 1
  bool pole_at_start = false, pole_at_end = false;     // v = 0 or v = 1 is a single point
  std::function<SurfacePoint(double u, double v)> at;  // u, v in [0, 1]
};

class PatchMesh {
 public:
  // Size in metres; a chart gets texels in proportion. Returns its index.
  int add_chart(double width, double height);
  void add(Patch patch) { patches_.push_back(std::move(patch)); }

  // Fills positions, normals, tangents, uvs, lightmap uvs, indices and triangle materials. All cells are divided alike
  // until there are at least `triangles` (0: as they are). Positions are snapped to 2^-16 m, so that patches that meet
  // with equal cells share their vertices bit for bit.
  void build(Scene& scene, std::uint32_t triangles) const;

 private:
  std::uint64_t count(double density) const;

  std::vector<ChartSize> charts_;
  std::vector<Patch> patches_;
};

// UserError where more than 2^27 triangles are asked for.
void check_triangle_request(std::uint32_t triangles);

// Rebuilds an exactly orthogonal unit tangent frame in float from any two directions; w is the handedness of
// (normal, u_axis, v_axis).
glm::vec4 tangent_frame(const glm::dvec3& unit_normal, const glm::dvec3& u_axis, const glm::dvec3& v_axis);

}  // namespace twinshade

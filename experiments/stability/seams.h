// Seams and creases: where what is shaded changes with the normal by leaps, or shows an edge.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "experiments/stability/tricky_inputs.h"

namespace twinshade {

// RGB at normals whose components are floats, as the shader computes it in float.
using Shade = std::function<std::vector<glm::dvec3>(std::span<const glm::dvec3>)>;

// A great circle is walked in small steps; where a step's change stands out from that beside it the step is halved
// until its ends are floats next to each other: what is left is a seam, or rounding. Normals that formulas trip over
// are left in steps of several directions as well, and zeros of one sign compared with those of the other. On the way
// the greatest change of slope is found: a crease, where shading is continuous but shows an edge; what is smooth has
// some 0.01.
struct Seams {
  double jump = 0;    // largest difference between neighbours, of the largest value
  double crease = 0;  // largest change of slope within 0.006 radians, of the largest value per radian
  glm::dvec3 jump_at[2] = {}, crease_at[2] = {};
};

class SeamSearch {
 public:
  // inside: moves a normal into the method's domain and rounds it to floats. hemisphere: what is below the horizon is
  // not looked at.
  SeamSearch(const std::vector<TrickyNormal>& tricky, bool hemisphere,
             const std::function<glm::dvec3(const glm::dvec3&)>& inside);

  Seams find(const Shade& shade) const;

 private:
  std::vector<std::vector<glm::dvec3>> walks_;
  std::vector<std::pair<glm::dvec3, glm::dvec3>> aside_;
};

}  // namespace twinshade

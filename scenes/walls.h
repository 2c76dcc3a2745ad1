// Walls with a row of round-arched openings.
#pragma once

#include "scenes/surfaces.h"

namespace twinshade {

// In the wall's plane coordinates. Arched: the top is a half circle of radius half_width about (centre, spring).
struct Opening {
  double centre, half_width, sill, spring;
};

// Cells at density 1 along the lines that neighbouring parts of a wall share.
struct WallCells {
  double beside = 1;  // between an opening and the bay's end, and from its arch outwards
  double across = 2;  // of the opening
  double jamb = 2;    // sill to spring
  double below = 1;   // under the sill
  double arch = 3;    // per 45 degrees
};

// One bay of a wall, [low, high] of the plane, around the opening. Parts of no size are left out: an arcade's bay has
// low.y = sill = spring, a door's has low.y = sill.
void add_wall_bay(PatchMesh& mesh, const Plane& plane, const Finish& finish, const glm::dvec2& low,
                  const glm::dvec2& high, const Opening& opening, const WallCells& cells);

// The four sides of an opening's hollow, `depth` metres inwards, and a panel behind it.
void add_niche(PatchMesh& mesh, const Plane& plane, const Finish& reveal, const Finish& panel, const Opening& opening,
               double depth, const WallCells& cells);

}  // namespace twinshade

// Materials painted by the program: a colour and a height for each point of a repeating tile; the normal map is derived
// from the heights by finite differences.
#pragma once

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace twinshade {

struct PatternPoint {
  double height;      // metres
  glm::dvec3 albedo;  // linear
};

// The point (u, v) of a tile, both in [0, 1), repeating outside.
using Pattern = PatternPoint (*)(double u, double v);

PatternPoint cobbles(double u, double v);   // rounded stones in sand; tile of 1.5 m
PatternPoint bricks(double u, double v);    // running bond; tile of 1 m
PatternPoint plaster(double u, double v);   // trowelled, stained; tile of 2 m
PatternPoint ashlar(double u, double v);    // sawn blocks with narrow joints; tile of 1.6 m
PatternPoint fluted(double u, double v);    // four flutes along v; tile of .3 m
PatternPoint marble(double u, double v);    // worn and veined; tile of 1 m
PatternPoint shingles(double u, double v);  // wooden, overlapping downwards; tile of 1.2 m
PatternPoint siding(double u, double v);    // painted clapboards along u; tile of 1.2 m
PatternPoint planks(double u, double v);    // along u; tile of 1 m

// Adds a material with an albedo image and a normal image of size x size texels to the scene; returns its index.
// tile: metres that the tile covers, so that slopes are true.
int add_pattern_material(Scene& scene, const char* name, Pattern pattern, std::uint32_t size, double tile);

}  // namespace twinshade

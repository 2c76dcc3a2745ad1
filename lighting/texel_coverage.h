// Which texels of a lightmap a triangle touches, and where on the triangle each of them is.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/scene.h"

namespace twinshade {

struct TexelOwner {
  std::uint32_t triangle = 0xffffffffu;  // none
  double area = -1;                      // covered part of the texel, 0 to 1; 2 where the triangle contains the centre
  double b1 = 0, b2 = 0;                 // barycentric weights of the second and third corner, inside the triangle
  double surface = 0;                    // area in the world of what of all triangles lies in the texel
};

// In the world; 0 where it is not finite.
double triangle_area(const Scene& scene, std::size_t triangle);

// size * size owners, row 0 at v = 0.
std::vector<TexelOwner> texel_owners(const Scene& scene, std::uint32_t size);

}  // namespace twinshade

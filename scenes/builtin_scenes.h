// The scenes that the program makes itself. triangles: refine to at least this many; 0: the scene's own number.
#pragma once

#include <cstdint>

#include "scenes/scene.h"

namespace twinshade {

Scene make_courtyard(std::uint32_t triangles);
Scene make_house(std::uint32_t triangles);
Scene make_spheres(std::uint32_t triangles);
Scene make_quad(std::uint32_t triangles);
// with_invalid: NaN and infinite clip positions among the valid ones.
Scene make_raster_torture(std::uint32_t triangles, bool with_invalid);

}  // namespace twinshade

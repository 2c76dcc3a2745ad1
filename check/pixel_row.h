// A pixel of a frame as a row of a table, so that what its shader did there can be looked into.
#pragma once

#include <cstdint>

#include "bundle/bundle.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/values.h"
#include "raster/renderer.h"

namespace twinshade {

// The shader's inputs at pixel (x, y) (y upwards) of a frame that captured them, and the uniforms, textures and uniform
// blocks of the bundle that it was drawn from. UserError saying why, where a row by itself is not what the shader had:
// it takes derivatives, or reads gl_FragCoord and other built-ins that tell where it is, or storage buffers.
ValueTable row_of_pixel(const Reflection& shader, const Bundle& bundle, const Frame& frame, std::uint32_t x,
                        std::uint32_t y);

}  // namespace twinshade

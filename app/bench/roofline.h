// How fast a shader could be at most, from what the translator makes C++ of.
#pragma once

#include "app/bench/limits.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade::bench {

// Of one pixel's invocation of main.
struct ShaderCost {
  double flops = 0;        // additions, multiplications, divisions and square roots
  double texel_bytes = 0;  // RGBA32F texels fetched, shared with neighbouring pixels or not
  double input_bytes = 0;  // interpolated inputs, read once
  bool loops = false;      // there is a loop of unknown length, counted up to the first way out of it

  double bytes() const { return texel_bytes + input_bytes; }
};

// What no invocation can do without (least_operations). The module is the one that draws. UserError where the shader
// cannot be translated.
ShaderCost shader_cost(const ShaderSource& source);

// Nanoseconds a pixel that no implementation can stay under, on all threads together: the larger of arithmetic at the
// multiply-add rate and reading at the rate of the first cache. Divisions and square roots, which take longer than a
// multiplication, are counted as one: the bound stays a bound.
double roofline_ns(const ShaderCost& cost, const Limits& limits);

}  // namespace twinshade::bench

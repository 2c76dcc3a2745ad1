#include "app/bench/roofline.h"

#include <algorithm>

#include "cpu_shaders/translate/count_operations.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade::bench {

ShaderCost shader_cost(const ShaderSource& source) {
  const OperationCount count = count_operations(source, "main", "");
  ShaderCost cost;
  cost.flops = count.additions + count.multiplications + count.divisions + count.square_roots;
  cost.texel_bytes = 16.0 * count.texels;
  cost.input_bytes = 4.0 * translate(source).reflection.input_components;
  cost.loops = count.loops;
  return cost;
}

double roofline_ns(const ShaderCost& cost, const Limits& limits) {
  return 1e9 * std::max(cost.flops / limits.flops, cost.bytes() / limits.l1_bytes);
}

}  // namespace twinshade::bench

#include "app/bench/roofline.h"

#include <algorithm>

#include "cpu_shaders/translate/count_operations.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade::bench {

ShaderCost shader_cost(const ShaderSource& source) {
  const OperationCount count = least_operations(source);
  ShaderCost cost;
  cost.flops =
      double(count.additions) + double(count.multiplications) + double(count.divisions) + double(count.square_roots);
  cost.texel_bytes = 16.0 * double(count.texels);
  cost.input_bytes = 4.0 * translate(source).reflection.input_components;
  cost.loops = count.loops;
  return cost;
}

double roofline_ns(const ShaderCost& cost, const Limits& limits) {
  return 1e9 * std::max(cost.flops / limits.flops, cost.bytes() / limits.l1_bytes);
}

}  // namespace twinshade::bench

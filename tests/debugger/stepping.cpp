// Runs one invocation block of a translated shader, for a debugger to step through.
#include <cstdio>

#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {
extern const ShaderEntry twinshade_entries_stepping_baseline[];
}

int main() {
  using namespace twinshade;
  constexpr std::uint32_t kCount = 16;
  alignas(64) float x[kCount], coordinates[4 * kCount] = {}, color[4 * kCount] = {}, depth[kCount] = {};
  alignas(64) std::uint32_t live[kCount], front[kCount] = {}, primitive[kCount] = {}, kept[kCount] = {};
  for (std::uint32_t i = 0; i < kCount; ++i) x[i] = 2.0f + static_cast<float>(i), live[i] = ~0u;
  const ShadeCall call{kCount, kCount, x, coordinates, live, front, primitive, color, depth, kept};
  twinshade_entries_stepping_baseline[0].shade(ShaderData{nullptr, nullptr, nullptr}, call);
  std::printf("%g\n", static_cast<double>(color[0]));
  return color[0] == 12.0f ? 0 : 1;
}

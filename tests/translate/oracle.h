// The kernels as the host compiler understands them.
#pragma once

#include <array>
#include <string>

namespace twinshade {
// double_precision: float means double. Only for kernels that allow it.
std::array<int, 4> oracle(const std::string& kernel, bool double_precision, int a, int b, float x, float y);
}  // namespace twinshade

#include "oracle.h"

#include <glm/glm.hpp>

#define OUT(T) T&
#define INOUT(T) T&

namespace {
using namespace glm;
using uint = unsigned;

namespace in_float {
#include "kernel_oracles.inc"
}
namespace in_double {
#define float double
#include "kernel_oracles_double.inc"
#undef float
}  // namespace in_double
}  // namespace

namespace twinshade {

std::array<int, 4> oracle(const std::string& kernel, bool double_precision, int a, int b, float x, float y) {
#define KERNEL_DOUBLE_0(name)
#define KERNEL_DOUBLE_1(name)                             \
  if (kernel == #name && double_precision) {              \
    const ivec4 r = in_double::name().kernel(a, b, x, y); \
    return {r.x, r.y, r.z, r.w};                          \
  }
#define KERNEL(name, has_double, numbers)                \
  if (kernel == #name && !double_precision) {            \
    const ivec4 r = in_float::name().kernel(a, b, x, y); \
    return {r.x, r.y, r.z, r.w};                         \
  }                                                      \
  KERNEL_DOUBLE_##has_double(name)
#include "kernel_cases.inc"
#undef KERNEL
  return {};
}

}  // namespace twinshade

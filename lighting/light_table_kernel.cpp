#include "lighting/light_table_kernel.h"

#include <cstring>

#include "cpu_shaders/runtime/isa.h"

namespace twinshade::light_table {
namespace {

// Sixteen floats; the compiler cuts them to the registers that there are.
typedef float Lanes __attribute__((vector_size(kBlock * sizeof(float))));

Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

Lanes reversed(const Lanes& lanes) {
  Lanes out;
  for (std::size_t i = 0; i < kBlock; ++i) out[i] = lanes[kBlock - 1 - i];
  return out;
}

void store(float* plane, const std::uint32_t* texels, bool up, bool down, const Lanes& lanes) {
  if (up) {
    std::memcpy(plane + texels[0], &lanes, sizeof lanes);
  } else if (down) {
    const Lanes turned = reversed(lanes);
    std::memcpy(plane + texels[kBlock - 1], &turned, sizeof turned);
  } else {
    for (std::size_t i = 0; i < kBlock; ++i) plane[texels[i]] = lanes[i];
  }
}

// Of the functions of one parity, three channels at a time.
struct Sums {
  Lanes r, g, b;
};

Sums sum_of(const float* red, const float* green, const float* blue, const float* cosine, std::size_t count,
            std::size_t stride) {
  Sums sums{};
  for (std::size_t k = 0; k < count; ++k) {
    const Lanes h = load(cosine + k * stride);
    sums.r += h * red[k];
    sums.g += h * green[k];
    sums.b += h * blue[k];
  }
  return sums;
}

void fill(const Call& call) {
  const std::size_t count = call.even + call.odd, stride = call.blocks * kBlock;
  for (std::size_t row = 0; row < call.rows; ++row) {
    const float *red = call.products + row * 3 * count, *green = red + count, *blue = green + count;
    float *out_red = call.values + row * 3 * call.texels, *out_green = out_red + call.texels,
          *out_blue = out_green + call.texels;
    for (std::size_t block = 0; block < call.blocks; ++block) {
      const float* cosine = call.cosine + block * kBlock;
      const Sums even = sum_of(red, green, blue, cosine, call.even, stride);
      const Sums odd =
          sum_of(red + call.even, green + call.even, blue + call.even, cosine + call.even * stride, call.odd, stride);
      // Negating z flips the sign of functions with odd l + m (NMV section 3.3 says odd m)
      const std::uint32_t *upper = call.upper + block * kBlock, *lower = call.lower + block * kBlock;
      const bool lower_up = call.layout[block] & kLowerRunsUp, lower_down = call.layout[block] & kLowerRunsDown,
                 upper_up = call.layout[block] & kUpperRuns;
      store(out_red, lower, lower_up, lower_down, even.r - odd.r);
      store(out_green, lower, lower_up, lower_down, even.g - odd.g);
      store(out_blue, lower, lower_up, lower_down, even.b - odd.b);
      store(out_red, upper, upper_up, false, even.r + odd.r);
      store(out_green, upper, upper_up, false, even.g + odd.g);
      store(out_blue, upper, upper_up, false, even.b + odd.b);
    }
  }
}

void blend(const float* a, const float* b, float part, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = a[i] + (b[i] - a[i]) * part;
}

}  // namespace

Kernel TWINSHADE_JOIN(kernel_of_, TWINSHADE_ISA)() { return {fill, blend}; }

}  // namespace twinshade::light_table

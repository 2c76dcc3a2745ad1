// Runs a fragment shader over rows of floats, one invocation a row, as the renderers run it: denormals flushed, blocks
// of invocations, any number type.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cpu_shaders/load/load.h"

namespace twinshade::test {

class RowShader {
 public:
  // `text` may include shaders/ by "exact/dot.glsl" and so on.
  RowShader(const std::string& name, const std::string& text, Number number = Number::lanes8);

  // inputs: component-major, [component * rows + row]; the result likewise.
  std::vector<float> run(const std::vector<float>& inputs, std::size_t rows,
                         std::span<const TextureView> textures = {}) const;

  const ShaderModule& module() const { return *module_; }

 private:
  const ShaderModule* module_;
  ShadeFunction shade_ = nullptr;
};

// 0 for equal values, NaN with NaN included; infinite where only one of them is infinite or NaN. An exact result below
// 2^-126 may be 0.
double ulp_error(float computed, long double exact);

// Bits of a float, and back; hex text for messages.
std::uint32_t bits_of(float x);
float float_of(std::uint32_t bits);
std::string hex(float x);

// Deterministic, full period 2^64 - 1: xorshift (Marsaglia, Xorshift RNGs, 2003).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
  std::uint32_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<std::uint32_t>(state_ >> 16);
  }
  float uniform(float low, float high) { return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f); }

 private:
  std::uint64_t state_;
};

}  // namespace twinshade::test

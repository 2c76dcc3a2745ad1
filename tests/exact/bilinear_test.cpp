// The written-out bilinear filter: against interpolation in double, and on every uv there is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/exact/shader_rows.h"

namespace twinshade::test {
namespace {

constexpr const char* kBilinear = R"(
#include "exact/bilinear.glsl"

in vec2 uv;
uniform sampler2D map;
uniform sampler2DArray maps;
layout(location = 0) out vec4 clamped;
layout(location = 1) out vec4 repeated;
layout(location = 2) out vec4 array_clamped;   // layer 0
layout(location = 3) out vec4 array_repeated;  // layer 1
layout(location = 4) out vec4 weight_sum;

void main() {
  clamped = exact_bilinear_2d(map, uv);
  repeated = exact_bilinear_2d_repeat(map, uv);
  array_clamped = exact_bilinear_2d_array(maps, uv, 0);
  array_repeated = exact_bilinear_2d_array_repeat(maps, uv, 1);
  vec4 w = exact_taps_clamp(uv, textureSize(map, 0)).weight;
  precise float sum = (w.x + w.y) + (w.z + w.w);
  weight_sum = vec4(sum);
}
)";

constexpr int kWidth = 5, kHeight = 3;
constexpr int kTexels = kWidth * kHeight * 4;

const RowShader& bilinear() {
  static const RowShader made("bilinear", kBilinear, Number::scalar);
  return made;
}

const std::vector<float>& texels() {  // two layers
  static const std::vector<float> made = [] {
    Random random(6);
    std::vector<float> list(2 * kTexels);
    for (float& value : list) value = random.uniform(-3, 3);
    return list;
  }();
  return made;
}

struct Filtered {
  std::vector<float> values;
  std::size_t rows;
  float at(std::size_t row, int output, int component) const {
    return values[static_cast<std::size_t>(output * 4 + component) * rows + row];
  }
};

Filtered filter(const std::vector<float>& u, const std::vector<float>& v) {
  // slots in the module's order
  std::vector<TextureView> views(bilinear().module().texture_count);
  for (std::uint32_t i = 0; i < bilinear().module().resource_count; ++i) {
    const ShaderResource& resource = bilinear().module().resources[i];
    const bool array = resource.kind == ResourceKind::sampler_2d_array;
    views[resource.slot] = {texels().data(),
                            kWidth,
                            kHeight,
                            array ? 2 : 1,
                            kWidth * 4,
                            kTexels,
                            array ? TextureKind::two_d_array : TextureKind::two_d,
                            Filter::nearest,
                            Wrap::clamp_to_edge};
  }
  std::vector<float> inputs = u;
  inputs.insert(inputs.end(), v.begin(), v.end());
  return {bilinear().run(inputs, u.size(), views), u.size()};
}

float texel(int layer, int x, int y, int component) {
  return texels()[static_cast<std::size_t>(layer * kTexels + (y * kWidth + x) * 4 + component)];
}

// The definition in OpenGL 4.5, section 8.14.2, in double.
double reference(int layer, double u, double v, bool repeat, int component) {
  const double x = u * kWidth - 0.5, y = v * kHeight - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto wrap = [&](double i, int size) {
    const int whole = static_cast<int>(i);
    return repeat ? ((whole % size) + size) % size : std::clamp(whole, 0, size - 1);
  };
  double sum = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double weight = (dx ? x - x0 : 1 - (x - x0)) * (dy ? y - y0 : 1 - (y - y0));
      sum += weight * texel(layer, wrap(x0 + dx, kWidth), wrap(y0 + dy, kHeight), component);
    }
  return sum;
}

}  // namespace

TEST_CASE("the written-out filter is OpenGL's, clamped and repeated, in 2D and in arrays") {
  Random random(7);
  std::vector<float> u, v;
  for (int i = 0; i < 20000; ++i) {
    u.push_back(random.uniform(-3, 3));
    v.push_back(random.uniform(-3, 3));
  }
  const Filtered filtered = filter(u, v);
  for (std::size_t row = 0; row < u.size(); ++row) {
    CAPTURE(hex(u[row]));
    CAPTURE(hex(v[row]));
    for (int c = 0; c < 4; ++c) {
      constexpr double kTolerance = 2e-5;  // uv near 3 has 2^-22, a texel step 6, eighteen times that
      CHECK(std::fabs(filtered.at(row, 0, c) - reference(0, u[row], v[row], false, c)) < kTolerance);
      CHECK(std::fabs(filtered.at(row, 1, c) - reference(0, u[row], v[row], true, c)) < kTolerance);
      CHECK(filtered.at(row, 2, c) == filtered.at(row, 0, c));
      CHECK(std::fabs(filtered.at(row, 3, c) - reference(1, u[row], v[row], true, c)) < kTolerance);
    }
    CHECK(std::fabs(filtered.at(row, 4, 0) - 1) <= 0x1p-22);
  }
}

TEST_CASE("texel centres give the texel itself") {
  std::vector<float> u, v;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      u.push_back((static_cast<float>(x) + 0.5f) / kWidth);
      v.push_back((static_cast<float>(y) + 0.5f) / kHeight);
    }
  const Filtered filtered = filter(u, v);
  for (std::size_t row = 0; row < u.size(); ++row)
    for (int c = 0; c < 4; ++c) {
      const float expected = texel(0, static_cast<int>(row) % kWidth, static_cast<int>(row) / kWidth, c);
      CHECK(std::fabs(filtered.at(row, 0, c) - expected) < 4e-6f);
      CHECK(std::fabs(filtered.at(row, 1, c) - expected) < 4e-6f);
    }
}

TEST_CASE("every uv has a value between the texels': NaN, infinities, huge and tiny ones") {
  std::vector<float> u, v;
  const std::vector<float> odd = {NAN,      -NAN,    INFINITY,    -INFINITY, 3e38f,     -3e38f, 0x1p31f,
                                  -0x1p31f, 0x1p32f, 1e10f,       -0x1p-30f, 0x1p-130f, 0.0f,   -0.0f,
                                  1.0f,     -1.0f,   0.99999994f, 1e-30f,    -1e-38f};
  for (const float a : odd)
    for (const float b : odd) {
      u.push_back(a);
      v.push_back(b);
    }
  Random random(8);
  for (int i = 0; i < 100000; ++i) {
    u.push_back(float_of(random.bits()));
    v.push_back(float_of(random.bits()));
  }
  const Filtered filtered = filter(u, v);
  const auto [low, high] = std::minmax_element(texels().begin(), texels().end());
  int outside = 0;
  for (std::size_t row = 0; row < u.size(); ++row)
    for (int output = 0; output < 4; ++output)
      for (int c = 0; c < 4; ++c) {
        const float value = filtered.at(row, output, c);
        outside += !(value >= *low - 1e-5f && value <= *high + 1e-5f);
      }
  CHECK(outside == 0);
  CHECK(filtered.at(0, 0, 0) == texel(0, 0, 0, 0));  // NaN reads texel 0 when clamped
}

}  // namespace twinshade::test

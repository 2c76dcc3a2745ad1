// Functions served by the runtime are held to their own translation: the same GLSL with the names changed is not
// served.
#include <doctest/doctest.h>

#include <cmath>

#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/translate/translate.h"
#include "tests/exact/shader_rows.h"
#include "tests/runtime/operations.h"

namespace twinshade::test {
namespace {

// Fetches from a 2D texture and from an array, by uniform and by varying layer, clamped and repeated.
constexpr const char* kFetches = R"(
#include "exact/bilinear.glsl"
uniform sampler2D map;
uniform sampler2DArray maps;
in vec2 uv;
in float layer;
out vec4 clamped;
out vec4 repeated;
out vec4 second_layer;
out vec4 any_layer;
out vec4 same_for_all;
void main() {
  clamped = exact_bilinear_2d(map, uv);
  repeated = exact_bilinear_2d_repeat(map, uv);
  second_layer = exact_bilinear_2d_array(maps, uv, 1);
  any_layer = exact_bilinear_2d_array_repeat(maps, uv, int(layer));
  same_for_all = exact_bilinear_2d(map, vec2(0.3, 0.6)) + exact_bilinear_2d_array(maps, vec2(0.7, 0.1), 2);
}
)";

}  // namespace

TEST_CASE("the served bilinear filter gives the bits of its GLSL, for every lane count") {
  const std::string renamed = std::string("#define exact_fetch fetch_as_written\n") + kFetches;
  const auto calls_runtime = [](const std::string& text) {
    return translate(resolve_shader("fetch", text, "fetch.frag")).cpp.find("served::exact_fetch") != std::string::npos;
  };
  REQUIRE(calls_runtime(kFetches));
  REQUIRE(!calls_runtime(renamed));
  const TextureView views[2] = {test_texture(0), test_texture(3)};
  constexpr std::size_t kRows = 20000;
  std::vector<float> inputs(3 * kRows);
  Random random(7);
  const float special[] = {0.0f, -0.0f, 1.0f, 0.5f, -0.5f, 1e30f, -1e30f, INFINITY, -INFINITY, NAN, 0x1p-140f};
  for (std::size_t i = 0; i < kRows; ++i) {
    const auto pick = [&] {
      return random.bits() % 8 == 0 ? special[random.bits() % 11] : random.uniform(-0.5f, 1.5f);
    };
    inputs[i] = pick();
    inputs[kRows + i] = pick();
    inputs[2 * kRows + i] = random.uniform(0, 2.99f);
  }
  for (const Number number : {Number::lanes4, Number::lanes8, Number::lanes16}) {
    const auto served = RowShader("served_fetch", kFetches, number).run(inputs, kRows, views);
    const auto written = RowShader("fetch_as_written", renamed, number).run(inputs, kRows, views);
    REQUIRE(served.size() == written.size());
    std::size_t differ = 0, first = 0;
    for (std::size_t i = 0; i < served.size(); ++i) {
      const bool both_nan = std::isnan(served[i]) && std::isnan(written[i]);
      if (!both_nan && bits_of(served[i]) != bits_of(written[i]) && differ++ == 0) first = i;
    }
    CHECK_MESSAGE(differ == 0, "lanes of number ", static_cast<int>(number), ": ", differ, " differ; uv ",
                  hex(inputs[first % kRows]), " ", hex(inputs[kRows + first % kRows]), " component ", first / kRows,
                  " is ", hex(served[first]), ", written ", hex(written[first]));
  }
}

TEST_CASE("in double the transcendentals of shaders/exact/ are good to 1e-15, not to their float polynomials") {
  const ShaderSource source = resolve_shader("double_transcendentals", R"(
#include "exact/exp2.glsl"
#include "exact/log2.glsl"
#include "exact/pow.glsl"
#include "exact/sin_cos.glsl"
#include "exact/atan2.glsl"
#include "exact/acos.glsl"
in float x;
out float results[8];
void main() {
  results[0] = exact_exp2(x);
  results[1] = exact_log2(x + 1.5);
  results[2] = exact_pow(x + 1.5, x);
  results[3] = exact_sin(x);
  results[4] = exact_cos(x);
  results[5] = exact_atan2(x, x + 0.25);
  results[6] = exact_acos(x);
  results[7] = exact_asin(x);
}
)",
                                             "double_transcendentals.frag");
  constexpr std::size_t kRows = 64;
  std::vector<double> inputs(kRows);
  for (std::size_t i = 0; i < kRows; ++i) inputs[i] = -0.99 + 0.031 * static_cast<double>(i);
  const auto results = run_module(load_module(source, Number::float64), Number::float64, inputs, kRows);
  for (std::size_t i = 0; i < kRows; ++i) {
    const long double x = inputs[i];
    const long double expected[8] = {std::exp2(x), std::log2(x + 1.5L),      std::pow(x + 1.5L, x), std::sin(x),
                                     std::cos(x),  std::atan2(x, x + 0.25L), std::acos(x),          std::asin(x)};
    for (std::size_t r = 0; r < 8; ++r) {
      CAPTURE(inputs[i]);
      CAPTURE(r);
      CHECK(std::fabs(static_cast<double>(results[r * kRows + i] - expected[r])) <= 2e-15);
    }
  }
}

}  // namespace twinshade::test

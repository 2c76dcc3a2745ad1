// Calls shaders with every type and compares with numbers worked out by hand. Exit status: failures.
// The headers of C come first: their macros must not replace the shaders' names.
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

#include <bit>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "bits_only.h"
#include "initial.h"
#include "names.h"
#include "narrow.h"
#include "quads.h"
#include "types.h"
#include "wide.h"

// other_unit.cpp
float clamped_elsewhere(float x);
float sum_elsewhere();
std::size_t length_elsewhere(const char* text);
// tone.cpp
float warm_tone(float x);
float cold_tone(float x);

namespace {

int failures = 0;

template <class A, class B>
void expect_equal(const char* what, A is, B should) {
  if (double(is) == double(should)) return;
  std::printf("%s: %a, not %a\n", what, double(is), double(should));
  ++failures;
}

template <class Action>
void expect_invalid_argument(const char* what, Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    if (std::strstr(error.what(), what)) return;
    std::printf("%s: the message says %s\n", what, error.what());
  }
  ++failures;
}

struct TypesFixture {
  TypesFixture() {
    uniforms.lights[1].power = {0.0f, 0.5f};
    uniforms.lights[2].colour = {3.0f, 2.0f, 1.0f};
    uniforms.columns = {{{1.0f, 2.0f}, {3.0f, 4.0f}, {5.0f, 6.0f}}};
    uniforms.bias = {100, -200};
    uniforms.negate = true;
    uniforms.mask = 0xff00ff00u;
    uniforms.picture = twinshade::texture_2d(texels.data(), 2, 1);
    uniforms.pictures[0] = uniforms.pictures[1] = twinshade::texture_2d_array(texels.data(), 1, 1, 2);
    uniforms.Scales = std::as_bytes(std::span(block));
  }
  template <class Real>
  static types::BasicInputs<Real> inputs(Real x) {
    types::BasicInputs<Real> in;
    in.delete_ = {x, 1, 1};
    in.index = {1, -7};
    in.bits = 0x12345678u;
    in.turn = {{{0, 1}, {-1, 0}}};  // a quarter turn, by columns
    in.Real_ = {0, 0, 64};
    return in;
  }
  // columns * (x, 1, 1) is (x + 8, 2 x + 10); turned: (-2 x - 10, x + 8); scale.xy * offsets[1] is (4, 8).
  template <class Outputs>
  static void check(const Outputs& out, double x) {
    expect_equal("operator_.x", out.operator_[0], -2 * x - 6);
    expect_equal("operator_.y", out.operator_[1], x + 16);
    expect_equal("operator_.z", out.operator_[2], -0.5 * (3 + 20 + 100));
    expect_equal("operator_.w", out.operator_[3], 6 + 5 + 64);
    expect_equal("sums.x", out.sums[0], 101);
    expect_equal("sums.y", out.sums[1], -207);
    expect_equal("masked", out.masked, 0x12005600);
  }

  const std::vector<float> texels{1, 2, 3, 4, 5, 6, 7, 8};
  const std::vector<float> block{1, 2, 0, 0, 9, 0, 0, 0, 4, 0, 0, 0};  // std140: float arrays have a stride of 16 bytes
  types::Uniforms uniforms;
};

void check_types() {
  const TypesFixture fixture;
  TypesFixture::check(types::shade(fixture.uniforms, TypesFixture::inputs(2.0f)), 2.0);
  TypesFixture::check(types::shade(fixture.uniforms, TypesFixture::inputs(2.0 + 0x1p-40)), 2.0 + 0x1p-40);
  for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 256u, 300u}) {
    std::vector<types::Inputs> inputs(count);
    for (std::size_t i = 0; i < count; ++i) inputs[i] = TypesFixture::inputs(float(i));
    std::vector<types::Outputs> outputs(count);
    types::shade(fixture.uniforms, inputs, outputs);
    for (std::size_t i = 0; i < count; ++i) TypesFixture::check(outputs[i], double(i));
  }
}

void check_refusals() {
  std::vector<types::Inputs> inputs(3);
  std::vector<types::Outputs> outputs(2);
  const TypesFixture whole;
  expect_invalid_argument("3 inputs and 2 outputs", [&] { types::shade(whole.uniforms, inputs, outputs); });
  types::Uniforms uniforms = whole.uniforms;
  uniforms.Scales = whole.uniforms.Scales.first(16);
  expect_invalid_argument("types: Scales", [&] { types::shade(uniforms, inputs[0]); });
  uniforms = whole.uniforms;
  uniforms.pictures[1] = whole.uniforms.picture;
  expect_invalid_argument("types: pictures[1]", [&] { types::shade(uniforms, inputs[0]); });
  uniforms.picture = {};
  expect_invalid_argument("types: picture:", [&] { types::shade(uniforms, inputs[0]); });
}

template <class Real>
void check_quads() {
  using Inputs = quads::BasicInputs<Real>;
  // Two quads and half of a third, which is made whole by repeating its last row.
  std::vector<Inputs> inputs;
  for (const Real x : std::initializer_list<Real>{1, 3, 7, 9, 4, 4, -1, 4, 2, 5})
    inputs.push_back({.x = x, .gl_FragCoord = {0, 0, x, 1}, .gl_FrontFacing = x != 3, .gl_PrimitiveID = 10 + int(x)});
  std::vector<quads::BasicOutputs<Real>> outputs(inputs.size());
  quads::shade(quads::Uniforms{}, std::span<const Inputs>(inputs), std::span(outputs));
  expect_equal("dFdx", outputs[0].slope[0], 2);
  expect_equal("dFdy", outputs[0].slope[1], 6);
  expect_equal("dFdx of half a quad", outputs[8].slope[0], 3);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    expect_equal("discarded", outputs[i].discarded, i == 6);
    if (i == 6) continue;
    expect_equal("id", outputs[i].id, inputs[i].gl_PrimitiveID * (inputs[i].gl_FrontFacing ? 1 : -1));
    expect_equal("gl_FragDepth", outputs[i].gl_FragDepth, 0.25 * double(inputs[i].x));
  }
  const auto alone = quads::shade(quads::Uniforms{}, inputs[1]);
  expect_equal("dFdx alone", alone.slope[0], 0);
  expect_equal("id alone", alone.id, -13);
}

// What a struct of uniforms holds before anyone sets it is what the GLSL says, to the bit.
void check_initial_values() {
  const initial::Uniforms u;
  const auto expect_bits = [](const char* what, float is, std::uint32_t should) {
    expect_equal(what, std::bit_cast<std::uint32_t>(is), should);
  };
  expect_bits("gain", u.gain, 0x3dcccccdu);
  expect_bits("tiny", u.tiny, 7136);  // 1e-41 in units of 2^-149
  expect_bits("infinite", u.infinite, 0x7f800000u);
  expect_bits("unset", u.unset, 0);
  expect_equal("least", u.least, -2147483648.0);
  expect_equal("most", u.most, 4294967295.0);
  expect_equal("flags", u.flag && !u.flags[0] && u.flags[1], true);
  expect_equal("tint", u.tint == decltype(u.tint){{{{1, 1, 1}}, {{2, 3, 4}}}}, true);
  expect_equal("grid", u.grid == decltype(u.grid){{{{1, 2}}, {{3, 4}}}}, true);
  expect_equal("columns", u.columns == decltype(u.columns){{{{1, 2}}, {{3, 4}}, {{5, 6}}}}, true);
  expect_equal("solo.colour", u.solo.colour == std::array<float, 3>{7, 8, 9}, true);
  expect_equal("solo.inner[0].on", u.solo.inner[0].on, false);
  expect_equal("solo.inner[1].on", u.solo.inner[1].on, true);
  expect_equal("solo.inner[1].turn[1].y", u.solo.inner[1].turn[1][1], 1);
  expect_equal("solo.count[1]", u.solo.count[1], -2);
  expect_equal("lights[0].colour.x", u.lights[0].colour[0], 0);
  expect_equal("lights[0].count[1]", u.lights[0].count[1], 3);
  expect_equal("lights[1].colour.z", u.lights[1].colour[2], 12);
  expect_equal("lights[1].inner[0].turn[0].x", u.lights[1].inner[0].turn[0][0], 2);
  expect_equal("lights[1].inner[1].on", u.lights[1].inner[1].on, false);

  const initial::Outputs out = initial::shade(u, initial::Inputs{});
  expect_equal("sums.y", out.sums[1], 1 + 100 - 1);
  expect_equal("sums.z", out.sums[2], 4 + 3 + 6);
  expect_equal("sums.w", out.sums[3], 9 + 1 + 2 + 5);
  expect_equal("sums.z in another unit", sum_elsewhere(), 4 + 3 + 6);
}

// GLSL's names stay where they can; the others get underscores.
void check_names() {
  names::Uniforms u;
  u.lights[1].lights.lights_struct = {0, 1, 0};
  u.lights[1].lights_struct = 2;
  u.lights_struct = 3;
  u.new__ = 4;
  u.new_ = 5;
  u.EOF_ = 1;
  u.stdin_ = 2;
  u.INT_MAX_ = 3;
  u.M_PI_ = 4;
  u.INFINITY_ = 5;
  u.errno_ = 6;
  u.linux_ = 1e6f;
  u.MVP = 7;
  const names::Outputs out = names::shade(u, names::Inputs{.x = 1});
  expect_equal("discarded", out.discarded, false);
  expect_equal("discarded_", out.discarded_, 54321);
  expect_equal("NAN_", out.NAN_, 7654321);
  expect_equal("discarded", names::shade(u, names::Inputs{.x = -1}).discarded, true);
}

}  // namespace

int main() {
  check_types();
  check_refusals();
  check_quads<float>();
  check_quads<double>();
  check_initial_values();
  check_names();
  expect_equal("clamped in another unit", clamped_elsewhere(7), 1);
  expect_equal("tone in a library", warm_tone(3), 4);
  expect_equal("tone in another library", cold_tone(3), 300);
  expect_equal("<string.h> beside a shader's string.h", length_elsewhere("four"), 4);
  expect_equal("a variant", narrow::shade({}, narrow::Inputs{}).taps, 3);
  expect_equal("another variant", wide::shade({}, wide::Inputs{}).taps, 500);
  expect_equal("bits", bits_only::shade({}, {.word = std::bit_cast<std::uint32_t>(1.5f)}).value, 1.5);
  return failures;
}

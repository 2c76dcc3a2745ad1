#include "golden/compare_frames.h"

#include <doctest/doctest.h>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace twinshade {
namespace {

// Every pixel covered but the bottom row; ids by column, a smooth depth and colour.
Frame sample_frame(std::uint32_t width = 16, std::uint32_t height = 8) {
  Frame frame;
  frame.width = width, frame.height = height;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const bool covered = y > 0;
      frame.coverage.push_back(covered);
      frame.primitive_id.push_back(covered ? x / 4 : kNoPrimitive);
      frame.depth.push_back(covered ? 0.25f + 0.01f * float(x) : 1.0f);
      for (int c = 0; c < 4; ++c) frame.color.push_back(covered ? 0.1f * float(x + 1) + float(y) + float(c) : 0.0f);
    }
  return frame;
}

std::size_t at(const Frame& frame, std::uint32_t x, std::uint32_t y) { return std::size_t(y) * frame.width + x; }

float next(float v, int steps) {
  for (int i = 0; i < steps; ++i) v = std::nextafter(v, std::numeric_limits<float>::infinity());
  return v;
}

void capture(Frame& frame) {
  const std::size_t pixels = frame.coverage.size();
  frame.attribute_names = {"v_uv.x", "v_uv.y"};
  frame.attribute_scalars = {Scalar::f32, Scalar::f32};
  frame.attributes.resize(2 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) frame.attributes[i] = float(i), frame.attributes[pixels + i] = -float(i);
}

}  // namespace

TEST_CASE("a frame equals itself") {
  const Frame a = sample_frame();
  const Comparison c = compare_frames(a, a);
  CHECK(c.equal());
  CHECK(c.shaded_pixels == 16 * 7);
  CHECK(c.max_ulp == 0);
  CHECK_FALSE(c.first.has_value());
  CHECK(c.ulp_histogram[0] == 16 * 7 * 4);
}

TEST_CASE("integers are compared by their bits, whatever floats those would be") {
  Frame a = sample_frame();
  const std::size_t i = at(a, 3, 2);
  REQUIRE(a.coverage[i]);
  a.color[4 * i] = std::bit_cast<float>(0xff80c0ffu);  // a NaN, as packed colours are
  Frame b = a;
  b.color[4 * i] = std::bit_cast<float>(0xff80c101u);
  CHECK(compare_frames(a, b).equal());
  a.color_scalar = b.color_scalar = Scalar::u32;
  Comparison c = compare_frames(a, b);
  CHECK(c.pixels_differ == 1);
  CHECK(c.denormal_only == 0);
  REQUIRE(c.first.has_value());
  CHECK(c.first->a == double(0xff80c0ffu));
  CHECK(c.first->ulp == 2);

  a.color_scalar = b.color_scalar = Scalar::i32;
  a.color[4 * i] = std::bit_cast<float>(1);
  b.color[4 * i] = 0;  // no denormal that was flushed
  c = compare_frames(a, b);
  CHECK(c.pixels_differ == 1);
  CHECK(c.denormal_only == 0);
  CHECK(c.max_ulp == 1);
  a.color[4 * i] = std::bit_cast<float>(-2147483647 - 1);
  b.color[4 * i] = std::bit_cast<float>(2147483647);
  CHECK(compare_frames(a, b).max_ulp == 0xffffffffu);
  CHECK(compare_frames(a, b).first->a == -2147483648.0);
}

TEST_CASE("ULP distance counts representable floats") {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const float a = std::bit_cast<float>(std::uint32_t(random()) & 0xbfffffffu);  // finite, far from overflow
    const int steps = int(random() % 50);
    CAPTURE(a);
    CHECK(ulp_distance(a, next(a, steps)) == std::uint64_t(steps));
    CHECK(ulp_distance(next(a, steps), a) == ulp_distance(a, next(a, steps)));
  }
  const float tiny = std::numeric_limits<float>::denorm_min();
  CHECK(ulp_distance(-tiny, tiny) == 2);
  CHECK(ulp_distance(0.0f, -0.0f) == 0);
  CHECK(ulp_distance(-1.0f, 1.0f) == 2ull * 0x3f800000u);
  CHECK(ulp_distance(NAN, -NAN) == 0);
  CHECK(ulp_distance(NAN, 1.0f) == UINT64_MAX);
}

TEST_CASE("NaN is one class, zeros of different sign are different bits") {
  Frame a = sample_frame(), b = a;
  a.color[at(a, 3, 3) * 4] = std::bit_cast<float>(0x7fc00000u);
  b.color[at(a, 3, 3) * 4] = std::bit_cast<float>(0xffc01234u);
  CHECK(compare_frames(a, b).equal());
  a.color[at(a, 4, 3) * 4] = 0.0f;
  b.color[at(a, 4, 3) * 4] = -0.0f;
  const Comparison c = compare_frames(a, b);
  CHECK(c.pixels_differ == 1);
  CHECK(c.max_ulp == 0);
  REQUIRE(c.first);
  CHECK(c.first->a_bits == 0);
  CHECK(c.first->b_bits == 0x80000000u);
}

TEST_CASE("the first layer that differs is named, and its first pixel from the top left") {
  const Frame a = sample_frame();
  Frame b = a;
  b.color[at(b, 2, 7) * 4 + 1] = next(b.color[at(b, 2, 7) * 4 + 1], 3);
  Comparison c = compare_frames(a, b);
  REQUIRE(c.first);
  CHECK(c.first->layer == "color");
  CHECK(c.first->component == 1);
  CHECK(c.first->ulp == 3);
  CHECK(c.max_ulp == 3);

  b.depth[at(b, 5, 2)] = next(b.depth[at(b, 5, 2)], 1);
  b.depth[at(b, 1, 4)] = next(b.depth[at(b, 1, 4)], 1);
  c = compare_frames(a, b);
  CHECK(c.first->layer == "depth");
  CHECK(c.first->x == 1);
  CHECK(c.first->y == 4);
  CHECK(c.depth_differs == 2);

  b.primitive_id[at(b, 9, 1)] = 77;
  c = compare_frames(a, b);
  CHECK(c.first->layer == "id");
  CHECK(c.first->b == 77);

  b.coverage[at(b, 0, 0)] = 1;
  c = compare_frames(a, b);
  CHECK(c.first->layer == "coverage");
  CHECK(c.shaded_pixels == 16 * 7 + 1);
  CHECK(c.coverage_differs == 1);
  CHECK(c.id_differs == 1);
  CHECK(c.depth_differs == 2);
  CHECK(c.pixels_differ == 5);
}

TEST_CASE("a pixel differing in many components counts once") {
  const Frame a = sample_frame();
  Frame b = a;
  for (int k = 0; k < 4; ++k) b.color[at(b, 2, 2) * 4 + k] += 1;
  b.depth[at(b, 2, 2)] += 0.5f;
  CHECK(compare_frames(a, b).pixels_differ == 1);
}

TEST_CASE("only flushed denormals are counted apart, and not hidden") {
  const float tiny = std::numeric_limits<float>::denorm_min() * 100;
  Frame a = sample_frame(), b = a;
  a.color[at(a, 2, 2) * 4] = tiny, b.color[at(a, 2, 2) * 4] = 0.0f;
  a.color[at(a, 3, 2) * 4] = tiny, b.color[at(a, 3, 2) * 4] = 0.0f;
  b.color[at(a, 3, 2) * 4 + 1] += 1;                                      // and an ordinary difference beside it
  a.color[at(a, 4, 2) * 4] = tiny, b.color[at(a, 4, 2) * 4] = -2 * tiny;  // both sides denormal
  const Comparison c = compare_frames(a, b);
  CHECK(c.pixels_differ == 3);
  CHECK(c.denormal_only == 1);
}

TEST_CASE("differing attributes come before the colour that they change, with the inputs") {
  Frame a = sample_frame();
  capture(a);
  Frame b = a;
  const std::size_t pixel = at(a, 6, 5), pixels = a.coverage.size();
  b.attributes[pixels + pixel] = next(b.attributes[pixels + pixel], 2);
  b.color[pixel * 4] += 1;
  const Comparison c = compare_frames(a, b);
  CHECK(c.attributes_differ == 1);
  CHECK(c.pixels_differ == 1);
  REQUIRE(c.first);
  CHECK(c.first->layer == "attributes");
  CHECK(c.first->component == 1);
  REQUIRE(c.first->inputs.size() == 2);
  CHECK(c.first->inputs[0].name == "v_uv.x");
  CHECK(c.first->inputs[0].bits == std::bit_cast<std::uint32_t>(float(pixel)));
}

TEST_CASE("attributes of uncovered pixels mean nothing") {
  Frame a = sample_frame();
  capture(a);
  Frame b = a;
  b.attributes[at(b, 3, 0)] = 1e9f;
  CHECK(compare_frames(a, b).equal());
}

TEST_CASE("shading is compared only where the first frame covers") {
  const Frame a = sample_frame();
  Frame b = a;
  b.coverage.assign(b.coverage.size(), 1);
  b.primitive_id.assign(b.primitive_id.size(), 0);
  b.depth.assign(b.depth.size(), 0.5f);
  b.color[at(b, 3, 0) * 4] = 9;  // not covered by a
  CHECK(compare_frames(a, b, CompareScope::shaded_by_a).equal());
  b.color[at(b, 3, 1) * 4] = 9;
  CHECK(compare_frames(a, b, CompareScope::shaded_by_a).pixels_differ == 1);
}

TEST_CASE("the worst are the eight largest, sorted; the histogram counts every component") {
  const Frame a = sample_frame();
  Frame b = a;
  for (std::uint32_t x = 0; x < 16; ++x) {
    float& v = b.color[at(b, x, 3) * 4];
    v = next(v, int(x) + 1);
  }
  const Comparison c = compare_frames(a, b);
  REQUIRE(c.worst.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) CHECK(c.worst[i].ulp == 16 - i);
  CHECK(c.max_ulp == 16);
  CHECK(c.ulp_histogram[1] == 1);  // 1
  CHECK(c.ulp_histogram[2] == 2);  // 2, 3
  CHECK(c.ulp_histogram[3] == 4);  // 4 .. 7
  CHECK(c.ulp_histogram[4] == 8);  // 8 .. 15
  CHECK(c.ulp_histogram[5] == 1);  // 16
  CHECK(std::accumulate(c.ulp_histogram.begin(), c.ulp_histogram.end(), std::uint64_t(0)) == c.shaded_pixels * 4);
}

TEST_CASE("uncovered pixels are compared too: what was cleared must have stayed so") {
  const Frame a = sample_frame();
  Frame b = a;
  b.color[at(b, 3, 0) * 4 + 3] = 1;
  CHECK(compare_frames(a, b).pixels_differ == 1);
  CHECK(compare_frames(a, b).max_ulp == 0);  // of shaded pixels only
}

TEST_CASE("within a tolerance are frames of the same surfaces, whose floats are near each other") {
  const Frame a = sample_frame();
  const std::size_t pixel = at(a, 6, 3);
  const auto with = [&](auto change) {
    Frame b = a;
    change(b);
    return b;
  };
  CHECK(within_ulp(a, a, 0));
  const Frame colour = with([&](Frame& b) { b.color[pixel * 4 + 2] = next(b.color[pixel * 4 + 2], 3); });
  CHECK(within_ulp(a, colour, 3));
  CHECK_FALSE(within_ulp(a, colour, 2));
  const Frame depth = with([&](Frame& b) { b.depth[pixel] = next(b.depth[pixel], 5); });
  CHECK(within_ulp(a, depth, 5));
  CHECK_FALSE(within_ulp(a, depth, 4));
  const Frame cleared = with([&](Frame& b) { b.color[at(b, 3, 0) * 4 + 3] = 1; });
  CHECK_FALSE(within_ulp(a, cleared, 1000));
  constexpr std::uint64_t kAny = 0xffffffffu;
  CHECK_FALSE(within_ulp(a, with([&](Frame& b) { b.coverage[pixel] = 0; }), kAny));
  CHECK_FALSE(within_ulp(a, with([&](Frame& b) { ++b.primitive_id[pixel]; }), kAny));
  const Frame nan = with([&](Frame& b) { b.color[pixel * 4] = NAN; });
  CHECK_FALSE(within_ulp(a, nan, kAny));
  CHECK(within_ulp(nan, nan, 0));
}

TEST_CASE("integers are within no tolerance but their own value") {
  Frame a = sample_frame();
  a.color_scalar = Scalar::u32;
  Frame b = a;
  b.color[at(a, 2, 2) * 4] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(a.color[at(a, 2, 2) * 4]) + 1);
  CHECK_FALSE(within_ulp(a, b, 100));
  CHECK(within_ulp(a, a, 0));
}

}  // namespace twinshade

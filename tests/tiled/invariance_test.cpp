// The frame does not depend on how the work is cut up: lanes, instruction set, threads, tile size.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "base/parallel.h"
#include "cpu_shaders/machine.h"
#include "raster/tiled/tiled_renderer.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

struct Threads {
  explicit Threads(int count) { set_thread_count(count); }
  ~Threads() { set_thread_count(0); }
};

std::string hash(const Bundle& bundle, const ShaderModule& module, DrawOptions options) {
  options.capture_attributes = true;
  const Frame frame = draw_tiled(bundle, module, options);
  // Attributes count as well, where they mean something.
  Frame all = frame;
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  for (std::size_t i = 0; i < frame.attributes.size(); ++i)
    all.color.push_back(frame.coverage[i % pixels] ? frame.attributes[i] : 0);
  for (const double c : frame.color64)
    for (const float half : std::bit_cast<std::array<float, 2>>(c)) all.color.push_back(half);
  return frame_hash(all);
}

}  // namespace

TEST_CASE("a frame's hash takes all NaNs for one, but no integers") {
  Frame a;
  a.width = a.height = 1;
  a.color.resize(4);
  a.color[2] = std::bit_cast<float>(0xff80c0ffu);
  Frame b = a;
  b.color[2] = std::bit_cast<float>(0xff80c101u);
  CHECK(frame_hash(a) == frame_hash(b));
  a.color_scalar = b.color_scalar = Scalar::u32;
  CHECK(frame_hash(a) != frame_hash(b));
}

TEST_CASE("lanes and instruction sets give the same bits") {
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    for (const ShaderModule* module : {&test::echo_module(), &test::built_ins_module(), &test::discard_module(),
                                       &test::frag_depth_module(), &test::side_effect_module()}) {
      Bundle bundle = test::torture_bundle(333, 205, 1500, 1);
      bundle.buffers.push_back({"counter", true, std::vector<std::byte>(4)});
      CAPTURE(module->name);
      CAPTURE(int(mode));
      DrawOptions options;
      options.attributes = mode;
      options.isa = Isa::baseline;
      options.number = Number::lanes4;
      const std::string expected = hash(bundle, *module, options);
      for (const ShaderEntry entry : test::entries_of(nullptr, nullptr)) {
        if (entry.isa > machine_isa() || entry.number == Number::float64) continue;
        CAPTURE(int(entry.isa));
        CAPTURE(int(entry.number));
        options.isa = entry.isa;
        options.number = entry.number;
        CHECK(hash(bundle, *module, options) == expected);
      }
    }
}

TEST_CASE("shading whole quads changes nothing for shaders without derivatives, in order or not") {
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    for (const ShaderModule* module :
         {&test::echo_module(), &test::built_ins_module(), &test::discard_module(), &test::frag_depth_module()}) {
      const Bundle bundle = test::torture_bundle(177, 131, 900, 9);
      ShaderModule quads = *module;
      quads.uses_derivatives = true;
      CAPTURE(module->name);
      CAPTURE(int(mode));
      DrawOptions options;
      options.attributes = mode;
      for (const ShaderEntry entry : test::entries_of(nullptr, nullptr)) {
        if (entry.isa > machine_isa()) continue;
        CAPTURE(int(entry.isa));
        CAPTURE(int(entry.number));
        options.isa = entry.isa;
        options.number = entry.number;
        CHECK(hash(bundle, quads, options) == hash(bundle, *module, options));
      }
    }
}

TEST_CASE("thread counts and tile sizes give the same bits") {
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    for (const ShaderModule* module : {&test::echo_module(), &test::built_ins_module(), &test::discard_module(),
                                       &test::frag_depth_module(), &test::derivatives_module()}) {
      const Bundle bundle = test::torture_bundle(517, 130, 5000, 2);
      CAPTURE(module->name);
      DrawOptions options;
      options.attributes = mode;
      const std::string expected = hash(bundle, *module, options);
      for (const int threads : {1, 2, 7})
        for (const int tile_size : {16, 32, 64, 128}) {
          CAPTURE(threads);
          CAPTURE(tile_size);
          const Threads scope(threads);
          options.tile_size = tile_size;
          CHECK(hash(bundle, *module, options) == expected);
        }
    }
}

TEST_CASE("derivatives are differences within a quad of the attribute's plane") {
  // One triangle over the whole frame, v_value.x = x / 64 of the frame's 64 pixels, v_value.y = y / 64: flat in depth.
  Bundle bundle = test::empty_bundle(64, 64);
  float positions[12] = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
  test::Random random(1);
  test::add_triangle(bundle, positions, random);
  test::finish(bundle);
  std::vector<float>& values = bundle.attributes[0].values;
  const float corners[3][2] = {{0, 0}, {2, 0}, {0, 2}};
  for (std::size_t v = 0; v < 3; ++v) {
    values[4 * v] = corners[v][0] + corners[v][1];
    values[4 * v + 1] = corners[v][1];
  }
  ShaderModule in_order = test::derivatives_module();
  in_order.discards = true;
  for (const ShaderModule* module : {&test::derivatives_module(), &std::as_const(in_order)}) {
    const Frame frame = draw_tiled(bundle, *module, {});
    for (std::size_t p = 0; p < 64 * 64; ++p) {
      CHECK(frame.color[4 * p] == doctest::Approx(1.0 / 64).epsilon(1e-4));
      CHECK(frame.color[4 * p + 1] == doctest::Approx(1.0 / 64).epsilon(1e-4));
      CHECK(frame.color[4 * p + 2] == doctest::Approx((double(p % 64) + double(p / 64) + 1) / 64).epsilon(1e-4));
    }
  }
}

TEST_CASE("without derivatives there are no helpers but those that fill up a tile's last vector, in order or not") {
  const Bundle bundle = test::torture_bundle(160, 128, 500, 6);
  ShaderModule in_order = test::helpers_module();
  in_order.discards = true;
  for (const ShaderModule* module : {&test::helpers_module(), &std::as_const(in_order)}) {
    const Frame frame = draw_tiled(bundle, *module, {});
    float most = 0;
    for (std::size_t p = 0; p < frame.coverage.size(); ++p)
      if (frame.coverage[p]) most = std::max(most, frame.color[4 * p + 3]);
    CHECK(most < 16);
  }
}

TEST_CASE("tiles are large where each thread has many, unless what the shader writes depends on their size") {
  const auto tile_size = [](std::uint32_t width, std::uint32_t height, int threads, const ShaderModule& module) {
    const Threads scope(threads);
    Bundle bundle = test::inside_bundle(width, height, 1, 1);
    bundle.buffers.push_back({"counter", true, std::vector<std::byte>(4)});
    for (const auto& [key, value] : draw_tiled(bundle, module, {}).provenance)
      if (key == "tile_size") return value;
    return std::string();
  };
  CHECK(tile_size(1024, 512, 1, test::echo_module()) == "128");
  CHECK(tile_size(1023, 384, 1, test::echo_module()) == "64");
  CHECK(tile_size(1024, 512, 2, test::echo_module()) == "64");
  CHECK(tile_size(1024, 512, 1, test::side_effect_module()) == "64");
}

TEST_CASE("drawing again gives the same frame") {
  Bundle bundle = test::torture_bundle(200, 100, 300, 3);
  bundle.buffers.push_back({"counter", true, std::vector<std::byte>(4)});
  DrawOptions once, often;
  often.repeat = 5;
  often.warmup = 1;
  for (const ShaderModule* module : {&test::echo_module(), &test::side_effect_module()})
    CHECK(hash(bundle, *module, often) == hash(bundle, *module, once));
}

TEST_CASE("seven threads are asked for and seven distinct threads shade tiles") {
  const Threads scope(7);
  float full[12] = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
  test::Random random(1);
  Bundle bundle = test::empty_bundle(640, 320);
  test::add_triangle(bundle, full, random);
  test::finish(bundle);
  // A scheduler on a busy machine may wake nobody for as long as the first thread waits: ask again.
  std::uint32_t most = 0;
  for (int attempt = 0; attempt < 3 && most < 7; ++attempt)
    most = std::max(most, draw_tiled(bundle, test::meeting_module(7), {}).distinct_threads);
  CHECK(most == 7);
}

TEST_CASE("float64 draws the same visibility") {
  const Bundle bundle = test::torture_bundle(300, 200, 1500, 4);
  DrawOptions options;
  const Frame a = draw_tiled(bundle, test::built_ins_module(), options);
  options.number = Number::float64;
  const Frame b = draw_tiled(bundle, test::built_ins_module(), options);
  CHECK(a.primitive_id == b.primitive_id);
  CHECK(a.depth == b.depth);
  CHECK(a.coverage == b.coverage);
  std::size_t different = 0;
  for (std::size_t p = 0; p < a.coverage.size(); ++p) {
    if (!a.coverage[p]) continue;
    different += a.color[4 * p] != b.color[4 * p] || a.color[4 * p + 1] != b.color[4 * p + 1];
    CHECK(b.color64[4 * p] == double(a.primitive_id[p]));
  }
  CHECK(different == 0);
}

// float64's frames are stored pixel by pixel, others by superblocks, whose rows begin anywhere but at widths of 4 n.
TEST_CASE("every pixel of a frame is stored, whatever its width") {
  for (const std::uint32_t width : {173u, 174u, 175u, 176u}) {
    CAPTURE(width);
    const Bundle bundle = test::torture_bundle(width, 70, 300, 6);
    DrawOptions options;
    options.number = Number::float64;
    const Frame expected = draw_tiled(bundle, test::built_ins_module(), options);
    for (const Number number : {Number::scalar, Number::lanes8}) {
      options.number = number;
      const Frame frame = draw_tiled(bundle, test::built_ins_module(), options);
      CHECK(frame.primitive_id == expected.primitive_id);
      CHECK(frame.coverage == expected.coverage);
      CHECK(frame.depth == expected.depth);
      std::size_t different = 0;  // the primitive's number and facing; what follows is rounded otherwise
      for (std::size_t i = 0; i < frame.color.size(); ++i)
        different += i % 4 < 2 && frame.color[i] != expected.color[i];
      CHECK(different == 0);
    }
  }
}

TEST_CASE("frames without ids and coverage have the same colours and depth") {
  for (const std::uint32_t width : {192u, 173u}) {  // whole superblocks, and pixels one by one
    const Bundle bundle = test::torture_bundle(width, 96, 300, 5);
    for (const ShaderModule* module : {&test::echo_module(), &test::helpers_module(), &test::discard_module()})
      for (const Number number : {Number::lanes8, Number::float64}) {
        CAPTURE(module->name);
        CAPTURE(int(number));
        DrawOptions options;
        options.number = number;
        const Frame whole = draw_tiled(bundle, *module, options);
        options.visibility = false;
        const Frame frame = draw_tiled(bundle, *module, options);
        CHECK(frame.primitive_id.empty());
        CHECK(frame.coverage.empty());
        CHECK(std::memcmp(frame.color.data(), whole.color.data(), whole.color.size() * sizeof(float)) == 0);
        CHECK(frame.depth == whole.depth);
        REQUIRE(frame.color64.size() == whole.color64.size());
        CHECK(std::equal(frame.color64.begin(), frame.color64.end(), whole.color64.begin(), [](double x, double y) {
          return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
        }));
      }
  }
}

TEST_CASE("an unknown tile size is the user's mistake") {
  DrawOptions options;
  options.tile_size = 48;
  CHECK_THROWS_WITH(draw_tiled(test::inside_bundle(8, 8, 1, 1), test::echo_module(), options),
                    "tile size 48 is not 16, 32, 64 or 128");
}

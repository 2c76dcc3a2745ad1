// Shaders with what kernels cannot say: swizzles, memory, textures, built-ins. Expected values are worked out here by
// hand or by arithmetic on the inputs, never by running GLSL.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "shader_checks.h"

namespace twinshade {
SHADER(swizzles)
SHADER(discards)
SHADER(memory)
SHADER(block_structs)
SHADER(buffers)
SHADER(textures)
SHADER(builtins)
SHADER(functions)
SHADER(globals)
SHADER(language)
SHADER(names)
SHADER(whole_arrays)

namespace {

template <class... Values>
void put(std::vector<std::byte>& bytes, std::size_t offset, Values... values) {
  if (bytes.size() < offset + 4 * sizeof...(values)) bytes.resize(offset + 4 * sizeof...(values));
  std::size_t at = offset;
  ((std::memcpy(&bytes[at], &values, 4), at += 4), ...);
}
template <class T>
T get(const std::vector<std::byte>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, &bytes.at(offset), sizeof value);
  return value;
}

}  // namespace

TEST_CASE("swizzles are read and written, whole, masked and by index") {
  Invocations in;
  in.input = [](const std::string& name, std::uint32_t c, std::uint32_t i) -> double {
    return name == "k" ? i % 4 : (i % 7) + 10.0 * c;
  };
  for (Number number : kAll) {
    const Answer answer = RUN(swizzles, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const double x = i % 7, y = x + 10, z = x + 20, w = x + 30;
      const double plain[] = {w, z, x, y};
      double written[] = {z, 2 * y, x, 3 * w};
      if (x > 3) written[1] = 30, written[2] = 20, written[3] = 10;
      written[0] += 100;
      double dynamic[] = {x, y, z, w};
      const std::uint32_t k = i % 4;
      dynamic[k] = 7;
      dynamic[(k + 1) % 4] += 7;
      if (x > 3) dynamic[k] = -1;
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "plain", c, i, plain[c], number);
        check_value(answer, "written", c, i, written[c], number);
        check_value(answer, "dynamic", c, i, dynamic[c], number);
      }
    }
  }
}

TEST_CASE("discard keeps what must stay, loops of discarded invocations end, helpers write nothing") {
  Invocations in;
  in.input = small_integers;
  in.live = [](std::uint32_t i) { return i % 5 != 0; };
  for (Number number : kAll) {
    const Answer answer = RUN(discards, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i);
      const bool kept = i % 5 != 0 && a != 3 && !(b == 5 && a == 2) && a + b <= 11 && !(a == 0 && b < 3) && a < 6 &&
                        b != 6 && !(b == 7 && a > 0);
      CHECK_MESSAGE(answer.kept[i] == kept, "invocation ", i, " on ", number_name(number));
      if (!kept) continue;
      check_value(answer, "answer", 0, i, a, number);
      check_value(answer, "answer", 1, i, b, number);
      check_value(answer, "answer", 2, i, b == 5 ? 1 : 0, number);
      check_value(answer, "answer", 3, i, a + 3, number);
    }
  }
}

TEST_CASE("uniforms and uniform blocks are read by constant, uniform and varying index") {
  Invocations in;
  in.input = small_integers;
  for (int k = 0; k < 3; ++k) {
    const std::string light = "lights[" + std::to_string(k) + "].";
    const float f = static_cast<float>(k);
    in.uniforms[light + "colour"] = {f, f + 0.5f, f + 0.75f};
    in.uniforms[light + "power"] = {f * 8};
    in.uniforms[light + "on"] = {k == 1 ? 0.0f : 1.0f};
    in.uniforms[light + "range"] = {f * 100, f * 100 + 1};
  }
  in.uniforms["tall"] = {1, 2, 3, 4, 5, 6};
  in.uniforms["pair"] = {1, 2, 3, 4, 5, 6, 7, 8};
  in.uniforms["weights"] = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f};
  in.uniforms["codes"] = {7, 8, 9};
  in.uniforms["enabled"] = {1};
  auto& small =
      in.buffers["Small"];  // std140 by hand: first 0, second 16, list 32 + 16 i, m 80 + 16 column, rows 128 + 16 row
  put(small, 0, 2.0f);
  put(small, 16, 1.0f, 10.0f, 100.0f);
  for (int k = 0; k < 3; ++k) put(small, 32 + 16 * static_cast<std::size_t>(k), static_cast<float>(k) * 4.0f);
  for (int c = 0; c < 3; ++c) {
    const float f = static_cast<float>(c) * 10;
    put(small, 80 + 16 * static_cast<std::size_t>(c), f, f + 1, f + 2);
  }
  put(small, 128, 1.0f, 2.0f), put(small, 144, 3.0f, 4.0f), put(small, 160, 5.0f, 6.0f);
  small.resize(192);
  auto& large = in.buffers["Large"];
  for (int k = 0; k < 300; ++k) {
    const float f = static_cast<float>(k);
    put(large, 16 * static_cast<std::size_t>(k), f, -f, f + 0.5f, 1.0f);
  }
  for (Number number : kAll) {
    const Answer answer = RUN(memory, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i);
      check_value(answer, "uniforms_out", 0, i, a % 3 + 0.5 + 8, number);
      check_value(answer, "uniforms_out", 1, i, (1 + 2 * 3 + 5 * b) * 100 + 2 + 2 * 4 + 6 * b, number);
      check_value(answer, "uniforms_out", 2, i, b % 5 + 0.5 + (a % 2 * 4 + 3 + b % 2), number);
      check_value(answer, "uniforms_out", 3, i, (b % 3 == 1 ? 0 : 201) + 9 + 0.5, number);
      check_value(answer, "block_out", 0, i, 2 + a % 3 * 4, number);
      check_value(answer, "block_out", 1, i, 12, number);
      check_value(answer, "block_out", 2, i, b % 3 * 10 + a % 3, number);
      check_value(answer, "block_out", 3, i, (1 + 30 + 500) * 10 + (2 + 40 + 600), number);
      const int row = a * 8 + b;
      check_value(answer, "large_out", 0, i, row + 299, number);
      check_value(answer, "large_out", 1, i, -row - 299, number);
      check_value(answer, "large_out", 2, i, row + 299 + 1, number);
      check_value(answer, "large_out", 3, i, 2, number);
    }
  }
}

TEST_CASE("structs of blocks are chosen and compared like others, though they have a layout and no bools") {
  Invocations in;
  in.input = small_integers;
  auto& lights = in.buffers["Lights"];  // std140 by hand: 16 bytes each, power 0, range 8
  for (int k = 0; k < 4; ++k) {
    const auto f = static_cast<float>(k + 1);
    put(lights, 16 * static_cast<std::size_t>(k), f, 0.0f, f * 10, f * 100);
  }
  auto& switches = in.buffers["Switches"];  // 16 bytes each: value 0, on 4, both 8; any bit is true
  put(switches, 0, 1.0f, 1, 0, 1), put(switches, 16, 1.0f, 1, 0, 0), put(switches, 32, 2.0f, 0, 0, 1);
  put(switches, 48, 1.0f, 1, 0, 8);
  for (Number number : kAll) {
    const Answer answer = RUN(block_structs, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i), y = a > 3 ? 4 : b % 3 + 1, listed[] = {4, y, 3};
      check_value(answer, "chosen", 0, i, y * 101, number);
      check_value(answer, "chosen", 1, i, 3, number);
      check_value(answer, "chosen", 2, i, a > 3 ? 20 : a, number);
      check_value(answer, "chosen", 3, i, a > 5 ? b % 3 + 1 : listed[b % 3], number);
      check_value(answer, "equal", 0, i, a % 3 == 0, number);
      check_value(answer, "equal", 1, i, a % 3 != b % 3, number);
      check_value(answer, "equal", 2, i, a % 3 != 2, number);
      check_value(answer, "equal", 3, i, b > 3 ? a % 3 != 1 : 1, number);
    }
  }
}

TEST_CASE("storage buffers: runtime lengths, masked stores, atomics, nothing outside") {
  for (Number number : kFloats) {
    Invocations in;
    in.input = small_integers;
    in.live = [](std::uint32_t i) { return i != 9; };
    auto& items =
        in.buffers["Items"];  // std430: offset 0; items from 16, stride 48: position 0, tag 12, frame 16, spare 32
    put(items, 0, 2);
    constexpr int kItems = 10;
    for (int k = 0; k < kItems; ++k) {
      const std::size_t at = 16 + 48 * static_cast<std::size_t>(k);
      const float f = static_cast<float>(k);
      put(items, at, f, f + 0.25f, f + 0.5f, k * 7, 1.0f, 2.0f, f * 3, 4.0f, f + 1000, f + 2000, 0.0f, 0.0f);
    }
    auto& counters = in.buffers["Counters"];  // total 0, seen 4.., smallest 36, tail 40 ..
    counters.resize(40 + 4 * 12);
    auto& grid = in.buffers["Grid"];
    grid.resize(64 * 16);
    const Answer answer = RUN(buffers, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i), row = a * 8 + b, item = (row + 2) % kItems;
      if (!answer.kept[i]) continue;
      check_value(answer, "answer", 0, i, item, number);
      check_value(answer, "answer", 1, i, item + 0.25, number);
      check_value(answer, "answer", 2, i, item * 3, number);
      check_value(answer, "answer", 3, i, a + (b % 2 == 0 ? 1000 : 2000), number);
      const int numbers[] = {item * 7, kItems, 64, 12};
      for (std::size_t c = 0; c < 4; ++c) check_value(answer, "numbers", c, i, numbers[c], number);
      const bool written = b < 4 && i != 9;
      CHECK(get<float>(grid, 16 * static_cast<std::size_t>(row) + 4) ==
            (written ? static_cast<float>(b) + 0.5f : 0.0f));
    }
    CHECK(get<std::uint32_t>(counters, 0) == 62);  // all but the helper and the one that discards
    CHECK(get<std::uint32_t>(counters, 4 + 4 * 2) == 28);
    CHECK(get<std::uint32_t>(counters, 4 + 4 * 7) == 21);  // b == 7 discarded
    CHECK(get<std::uint32_t>(counters, 4 + 4 * 1) == 27);  // b == 1 is the helper
    CHECK(get<std::int32_t>(counters, 36) == -7);
    for (std::uint32_t b = 0; b < 7; ++b) CHECK(get<std::uint32_t>(counters, 40 + 4 * b) == 56 + b);
    CHECK(get<std::uint32_t>(counters, 40 + 4 * 7) == 0);
  }
}

TEST_CASE("textures: texelFetch, texture, sizes, sampler arrays and parameters") {
  Invocations in;
  in.input = small_integers;
  const auto image = [](int width, int height, int layers, float base, TextureKind kind) {
    Invocations::Image made{width, height, layers, {}, kind};
    for (int k = 0; k < width * height * layers; ++k) {
      const float f = base + static_cast<float>(k);
      made.texels.insert(made.texels.end(), {f, f + 0.25f, f + 0.5f, f + 0.75f});
    }
    return made;
  };
  in.textures["single"] = image(4, 2, 1, 0, TextureKind::two_d);
  in.textures["layered"] = image(2, 2, 3, 100, TextureKind::two_d_array);
  in.textures["several[0]"] = image(8, 8, 1, 200, TextureKind::two_d);
  in.textures["several[1]"] = image(2, 1, 1, 300, TextureKind::two_d);
  in.textures["around"] = image(1, 1, 6, 400, TextureKind::cube);
  for (Number number : kAll) {
    const Answer answer = RUN(textures, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i), texel = (b & 1) * 4 + (a & 3);
      const double fetched[] = {texel + 0.25, 300.0 + (b & 1), 100 + a % 3 * 4 + 2.5, 4 + 2};
      const double sampled[] = {static_cast<double>(texel), 100 + 8 + 1, 200.5, a > 3 ? 404.0 : 405.0};
      const double sizes[] = {4, 2, 3, 18};
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "fetched", c, i, fetched[c], number);
        check_value(answer, "sampled", c, i, sampled[c], number);
        check_value(answer, "sizes", c, i, sizes[c], number);
      }
    }
  }
}

TEST_CASE("built-in variables, derivatives on quads, depth") {
  Invocations in;
  in.input = [](const std::string&, std::uint32_t, std::uint32_t i) -> double { return i < 32 ? 1.0 : -1.0; };
  CHECK(twinshade_module_shader_builtins.writes_depth);
  CHECK(twinshade_module_shader_builtins.uses_derivatives);
  CHECK(twinshade_module_shader_builtins.uses_frag_coord);
  for (Number number : kAll) {
    const Answer answer = RUN(builtins, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const double x = pixel_x(i) + 0.5, y = pixel_y(i) + 0.5;
      check_value(answer, "answer", 0, i, x, number);
      check_value(answer, "answer", 1, i, y, number);
      check_value(answer, "answer", 2, i, i % 3 != 0 ? 1 : 2, number);
      check_value(answer, "answer", 3, i, i / 4, number);
      // plane^2 across the row of the quad: (p + 3)^2 - p^2, p at its left pixel.
      const double left = (std::floor(x / 2) * 2 + 0.5) * 3 + y * 5;
      const double slopes[] = {3, 5, 8, 6 * left + 9};
      for (std::size_t c = 0; c < 4; ++c) check_value(answer, "slopes", c, i, i < 32 ? slopes[c] : 0, number);
      const double depth = y > 3 ? 0.75 : 0.125 + x * 0.01;
      CHECK(std::fabs(answer.depth[i] - depth) < 1e-6);
    }
  }
}

TEST_CASE("built-in functions and bit casts; bit casts leave no float64 entry and say why") {
  Invocations in;
  in.input = [](const std::string& name, std::uint32_t c, std::uint32_t i) -> double {
    return name == "k" ? i % 8 : 0.25 * (i % 13) + c;
  };
  const std::string reason = twinshade_module_shader_functions.no_float64_reason;
  CHECK(reason.find("functions.frag:20: floatBitsToInt") != std::string::npos);
  CHECK(twinshade_entry_count_shader_functions_baseline == 4);
  for (Number number : kFloats) {
    const Answer answer = RUN(functions, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const double x = 0.25 * (i % 13), y = x + 1, z = x + 2;
      const int k = static_cast<int>(i % 8);
      const double t = std::min(y / 4, 1.0);
      const double rounding[] = {std::floor(x) + std::ceil(y) * 10 + std::trunc(z) * 100,
                                 std::nearbyint(x) + y - std::floor(y), x - std::trunc(x) + std::trunc(x) * 10,
                                 x - 3 * std::floor(x / 3)};
      const double choosing[] = {std::min(x, 2.0) + std::max(y, 1.0), std::min(z, 1.0),
                                 x * 0.75 + y * 0.25 + (x < 2 ? 0 : 1), t * t * (3 - 2 * t) + 1 + z};
      const double geometry[] = {x + 2 * y + 3 * z, y, 9, -y};
      const int integers[] = {__builtin_popcount(static_cast<unsigned>(k) * 5),
                              k == 7   ? 3
                              : k >= 3 ? 2
                              : k >= 1 ? 1
                                       : 0,
                              __builtin_ctz(static_cast<unsigned>(k + 8)),
                              (k * 37 >> 2 & 7) - (k * 37 >> 4 & 1 ? 8 : 0) + (k << 4)};
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "rounding", c, i, rounding[c], number, 1e-5);
        check_value(answer, "choosing", c, i, choosing[c], number, 1e-5);
        check_value(answer, "geometry", c, i, geometry[c], number, 1e-5);
        check_value(answer, "integers", c, i, integers[c], number);
      }
      const float fx = static_cast<float>(x), fy = static_cast<float>(-y);
      std::int32_t bits_x, bits_y;
      std::memcpy(&bits_x, &fx, 4), std::memcpy(&bits_y, &fy, 4);
      check_value(answer, "bits", 0, i, bits_x, number);
      check_value(answer, "bits", 1, i, bits_y, number);
      if (k != 0) check_value(answer, "bits", 2, i, k, number);  // 0 or a denormal, kept or flushed
      check_value(answer, "bits", 3, i, 0x0080ff00, number);
      check_value(answer, "matrices", 0, i, 1, number, 1e-4);
      check_value(answer, "matrices", 1, i, 0, number, 1e-4);
      check_value(answer, "matrices", 2, i, 3 * y, number, 1e-5);
      check_value(answer, "matrices", 3, i, 4 * x - y, number, 1e-5);
    }
  }
}

TEST_CASE("arrays that are looked up by lane are values too") {
  Invocations in;
  in.input = small_integers;
  in.uniforms["pairs"] = {1, 2, 3, 4, 5, 6};
  in.uniforms["codes"] = {7, 8, 9};
  const int table[] = {3, -1, 4, 1, -5}, codes[] = {7, 8, 9};
  for (Number number : kAll) {
    const Answer answer = RUN(whole_arrays, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), own[] = {a, 2, 2};
      check_value(answer, "answer", 0, i, table[a % 5] + codes[a % 3] * 10 + (2 + a % 3 * 2) * 100, number);
      check_value(answer, "answer", 1, i, (a > 2 ? codes : own)[a % 3] * 10 + 1, number);
      check_value(answer, "answer", 2, i, a > 4 ? (1 + a) * 10 + 9 : 14, number);
      check_value(answer, "answer", 3, i, a > 4 ? 5 : 45, number);
    }
  }
}

TEST_CASE("globals under masks, input arrays and matrices, several outputs") {
  Invocations in;
  in.input = [](const std::string& name, std::uint32_t c, std::uint32_t i) -> double {
    if (name == "a") return small_a(i);
    if (name == "frame") return c;
    return ((i * 7 + c * 5) % 9) * 0.5;
  };
  for (Number number : kAll) {
    const Answer answer = RUN(globals, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i);
      const auto sample = [&](int element, std::uint32_t c) {
        return ((i * 7 + (3 * static_cast<std::uint32_t>(element) + c) * 5) % 9) * 0.5;
      };
      double state = 1;
      int counter = 0;
      for (int k = 0; k < 3; ++k) {
        const double by = sample(k, 1);
        if (by > 2)
          state += by;
        else
          state -= by * 2, ++counter;
        if (k == a) break;
      }
      check_value(answer, "single", 0, i, state + sample(a % 3, 0), number);
      const int sign = a > 4 ? -1 : 1;
      check_value(answer, "pair", 0, i, sign * a, number);
      check_value(answer, "pair", 1, i, sign * counter, number);
      const double list[] = {2 + (a % 2 == 0 ? 1.0 : 0), 3 + (a % 2 == 0 ? 2.0 : 0), a % 2 == 1 ? 1.0 : 0,
                             a % 2 == 1 ? 2.0 : 0};
      for (std::size_t c = 0; c < 4; ++c) check_value(answer, "list", c, i, list[c], number);
    }
  }
}

TEST_CASE("input blocks, functions of two results, initialised uniforms, arrays of blocks and texture forms") {
  Invocations in;
  in.input = [](const std::string& name, std::uint32_t c, std::uint32_t i) -> double {
    if (name == "surface[0].a" || name == "surface[1].a") return small_a(i);
    if (name == "surface[0].b" || name == "surface[1].b") return small_b(i);
    if (name == "surface[0].uv") return i * 0.75 + c;
    if (name == "surface[1].uv") return 100.0 * c + i;
    if (name == "scale") return 0.5;
    if (name == "probe.at") return 10.0 * c + i;
    if (name == "probe.weights") return 7.0 + c;
    if (name == "grid[0]") return 1.0 + c;
    if (name == "grid[1]") return 4.0 + c;
    CHECK(name == "edge");
    return 0.25;
  };
  for (std::uint32_t k = 0; k < twinshade_module_shader_language.uniform_count; ++k) {
    const ShaderUniform& u = twinshade_module_shader_language.uniforms[k];
    REQUIRE_MESSAGE(u.initial != nullptr, u.name);
    const std::uint32_t words = u.columns * u.rows * (u.array_length == 0 ? 1u : u.array_length);
    for (std::uint32_t w = 0; w < words; ++w) {
      float value;
      std::memcpy(&value, &u.initial[w], 4);
      in.uniforms[u.name].push_back(u.scalar == Scalar::i32 ? static_cast<float>(static_cast<int>(u.initial[w]))
                                                            : value);
    }
  }
  put(in.buffers["Tint[0]"], 0, 1.0f, 2.0f, 3.0f, 4.0f);
  put(in.buffers["Tint[1]"], 0, 10.0f, 20.0f, 30.0f, 40.0f);
  // Texel x, y: red 1 + x + 4 y, green ten times that.
  Invocations::Image map{4, 2, 1, {}};
  for (int t = 0; t < 8; ++t)
    for (float v : {1.0f + static_cast<float>(t), 10.0f + 10.0f * static_cast<float>(t), 0.0f, 0.0f})
      map.texels.push_back(v);
  in.textures["map"] = map;
  for (int k = 0; k < 4; ++k) {
    auto& image = in.textures["nested[" + std::to_string(k / 2) + "][" + std::to_string(k % 2) + "]"];
    image = {1, 1, 1, {static_cast<float>(k), 0, 0, 0}};
  }
  for (Number number : kAll) {
    for (const char* name : {"Sums[0]", "Sums[1]"}) in.buffers[name].assign(40, std::byte{0});
    const Answer answer = RUN(language, number, in);
    CHECK(get<std::uint32_t>(in.buffers["Sums[0]"], 0) == 0);
    CHECK(get<std::uint32_t>(in.buffers["Sums[1]"], 0) == in.count);
    for (std::size_t k = 0; k < 8; ++k) CHECK(get<std::uint32_t>(in.buffers["Sums[1]"], 4 + 4 * k) == 100 + k);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i);
      const double inputs[] = {100.0 + i, 7.5 + (b & 1), 20.0 + i, 6.0 + (a & 1) * 3 + 1 + b % 3 + 0.25};
      int e;
      const double part = std::frexp(i * 0.75, &e);
      const double split[] = {part, static_cast<double>(e), i * 0.75, -1};
      const std::uint64_t sum = 4294967290u + std::uint64_t(a), product = (0x80000000u + std::uint64_t(a)) * 6;
      std::uint32_t wide[] = {static_cast<std::uint32_t>(sum + (sum >> 32) * 1000),
                              static_cast<std::uint32_t>(a - b + (a < b ? 1 : 0)),
                              static_cast<std::uint32_t>(product >> 32), static_cast<std::uint32_t>(product)};
      if (a > 3) {
        wide[0] = a * b == 0 ? 0 : ~0u;
        wide[1] = static_cast<std::uint32_t>(-a * b);
      }
      const double defaults[] = {2.5, 3, -7.0 + (b & 1 ? 4 : 2), 12};
      // Of the four texels round the middle: (1, 1), (2, 1), (2, 0), (1, 0); one to the left for the red ones.
      const double gathered[] = {60 + 5000, 70 + 6000, 30 + 2000, 20 + 1000};
      const double forms[] = {7, 1, 3, 11};
      const double macros[] = {a + 0.5, 1, 2, 0.5};
      const bool truths[] = {a != 0, (b & 1) != 0, (a & 2) != 0, b != 0};
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "truths", c, i, truths[c], number);
        check_value(answer, "loops", c, i, 2 + 10.0 * (a + 1 + (c == 3 ? 3 : 0)), number);
        check_value(answer, "macros", c, i, macros[c], number);
        check_value(answer, "inputs_out", c, i, inputs[c], number);
        check_value(answer, "split", c, i, split[c], number);
        check_value(answer, "wide", c, i, wide[c], number);
        check_value(answer, "defaults", c, i, defaults[c], number);
        check_value(answer, "gathered", c, i, gathered[c], number);
        check_value(answer, "forms", c, i, forms[c], number);
        check_value(answer, "edges", c, i, 10 + 80000, number);  // the map is clamped: four times its corner
      }
    }
  }
}

TEST_CASE("names that mean something else in C++ are a shader's own") {
  Invocations in;
  in.input = [](const std::string& name, std::uint32_t, std::uint32_t i) {
    return static_cast<double>(name == "p" ? small_a(i) : small_b(i));
  };
  in.uniforms["shader_data"] = {7};
  in.uniforms["shade_call"] = {8};
  for (Number number : kAll) {
    in.buffers["Counts"].assign(4, std::byte{0});
    const Answer answer = RUN(names, number, in);
    CHECK(get<std::uint32_t>(in.buffers["Counts"], 0) == 6 * in.count);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int p = small_a(i), q = small_b(i), odd = q & 1;
      const double structs[] = {p + 10.0 * (p + 1), p + 20.0, 7 + 10.0 * p + 300,
                                odd ? 1 + 30 + 100.0 * p : 2 + 40 + 100.0 * p};
      const int column = q % 3, row = p % 3;
      const double cell = (column == 1 && row == 2 ? 5 : 0) + (row == 1 && column == 2 ? 1 : 0);
      const double others[] = {2.0 * p * q, 8, 10, cell};
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "structs", c, i, structs[c], number);
        check_value(answer, "others", c, i, others[c], number);
      }
    }
  }
}

}  // namespace twinshade

// Functions served by the runtime are held to their own translation: the same GLSL with the names changed is not
// served.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
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

// Several layers and several textures at once; layers past the last one; texels near and far apart from lane to lane.
constexpr const char* kSeveral = R"(
#define FETCHED_LAYERS 2
#include "exact/fetch_layers.glsl"
uniform sampler2DArray maps;
uniform sampler2DArray left;
uniform sampler2DArray right;
in vec2 uv;
in float layer;
out vec4 first[2];
out vec4 both[2];
out vec4 both_at_layer[2];
void main() {
  ExactTaps taps = exact_taps_clamp(uv, textureSize(maps, 0).xy);
  exact_fetch_layers(maps, taps, first);
  taps = exact_taps_repeat(uv, textureSize(left, 0).xy);
  mat2x4 two = exact_fetch_pair(left, right, taps, 1);
  mat2x4 two_varying = exact_fetch_pair(left, right, taps, int(layer));
  for (int i = 0; i < 2; ++i) {
    both[i] = two[i];
    both_at_layer[i] = two_varying[i];
  }
}
)";

// Sums of two taps, of three layers and of three from each of three on: all there; some before the first or past the
// last one; alike for all lanes.
constexpr const char* kPicked = R"(
#include "exact/bilinear.glsl"
uniform sampler2DArray maps;
in vec2 uv;
in float layer;
out vec3 inside[12];
out vec3 beyond[12];
out vec3 one_for_all[12];
void main() {
  ExactTaps low = exact_taps_clamp(uv, textureSize(maps, 0).xy);
  ExactTaps high = exact_taps_clamp(uv.yx, textureSize(maps, 0).xy);
  ExactTaps alike = exact_taps_clamp(vec2(0.3, 0.6), textureSize(maps, 0).xy);
  int i = int(layer);
  vec3 ones[3];
  exact_fetch_ones(maps, low, high, ivec3(i, 7 - i, 1), ones);
  for (int k = 0; k < 3; ++k) inside[k] = ones[k];
  exact_fetch_ones(maps, high, low, ivec3(i * 3, -i, i + 6), ones);
  for (int k = 0; k < 3; ++k) beyond[k] = ones[k];
  exact_fetch_ones(maps, alike, low, ivec3(5, 0, 3), ones);
  for (int k = 0; k < 3; ++k) one_for_all[k] = ones[k];
  mat3 threes[3];
  exact_fetch_threes(maps, low, high, ivec3(i, 5 - i, 1), threes);
  for (int k = 0; k < 9; ++k) inside[3 + k] = threes[k / 3][k % 3];
  exact_fetch_threes(maps, high, low, ivec3(i * 3, -i, 6), threes);
  for (int k = 0; k < 9; ++k) beyond[3 + k] = threes[k / 3][k % 3];
  exact_fetch_threes(maps, alike, low, ivec3(5, 0, 3), threes);
  for (int k = 0; k < 9; ++k) one_for_all[3 + k] = threes[k / 3][k % 3];
}
)";

// All layers of a map.
std::string layers_text(int count) {
  return "#define FETCHED_LAYERS " + std::to_string(count) + R"(
#include "exact/fetch_layers.glsl"
uniform sampler2DArray maps;
in vec2 uv;
in float layer;
out vec4 layers[FETCHED_LAYERS];
void main() {
  exact_fetch_layers(maps, exact_taps_clamp(uv + layer, textureSize(maps, 0).xy), layers);
}
)";
}

// Maps of one layer and of several, the last one among them.
constexpr const char* kMaps = R"(
#include "sphere_map/dual_paraboloid.glsl"
uniform sampler2DArray maps;
in vec2 uv;
in float layer;
out vec4 one;
out vec4 by_lane;
void main() {
  SphereMapTaps taps = sphere_map_taps(vec3(uv - 0.5, layer - 1.5), textureSize(maps, 0).x);
  one = sphere_map_fetch(maps, taps, 4, 3);
  by_lane = sphere_map_fetch(maps, taps, 4, int(layer));
}
)";

// The colours of all layers of a map, and sums of two, whose texels are near where those of uv are.
std::string colors_text(int count) {
  return "#define FETCHED_COLORS " + std::to_string(count) + R"(
#include "exact/fetch_colors.glsl"
uniform sampler2DArray maps;
in vec2 uv;
in float layer;
out vec3 colors[FETCHED_COLORS];
out vec3 sums[FETCHED_COLORS];
out vec3 near[FETCHED_COLORS];
out vec3 one_for_all[FETCHED_COLORS];
void main() {
  ExactTaps taps = exact_taps_clamp(uv, textureSize(maps, 0).xy);
  exact_fetch_colors(maps, taps, colors);
  exact_fetch_colors(maps, taps, exact_taps_clamp(vec2(uv.y, layer), textureSize(maps, 0).xy), sums);
  exact_fetch_colors(maps, taps, exact_taps_clamp(uv.yx, textureSize(maps, 0).xy), near);
  exact_fetch_colors(maps, exact_taps_clamp(vec2(0.3, 0.6), textureSize(maps, 0).xy), taps, one_for_all);
}
)";
}

// The colours of the first maps of those that there are; of maps that are not whole fives, differ from lane to lane, or
// lie beyond the last layer.
std::string map_colors_text(int count) {
  return R"(
#include "sphere_map/dual_paraboloid.glsl"
#define SPHERE_MAP_COLORS )" +
         std::to_string(count) + R"(
#include "sphere_map/fetch_colors.glsl"
uniform sampler2DArray maps;
in vec2 uv;
in float layer;
out vec3 whole[SPHERE_MAP_COLORS];
out vec3 uneven[SPHERE_MAP_COLORS];
out vec3 beyond[SPHERE_MAP_COLORS];
out vec3 by_lane[SPHERE_MAP_COLORS];
void main() {
  SphereMapTaps taps = sphere_map_taps(vec3(uv - 0.5, layer - 1.5), textureSize(maps, 0).x);
  sphere_map_fetch_colors(maps, taps, textureSize(maps, 0).z / SPHERE_MAP_LAYERS, whole);
  sphere_map_fetch_colors(maps, taps, 3, uneven);
  sphere_map_fetch_colors(maps, taps, 20, beyond);
  sphere_map_fetch_colors(maps, taps, int(layer) * 5, by_lane);
}
)";
}

std::vector<float> random_rows(std::size_t rows, float spread) {
  std::vector<float> inputs(3 * rows);
  Random random(7);
  const float special[] = {0.0f, -0.0f, 1.0f, 0.5f, -0.5f, 1e30f, -1e30f, INFINITY, -INFINITY, NAN, 0x1p-140f};
  for (std::size_t i = 0; i < rows; ++i) {
    const auto pick = [&] {
      return spread > 0.1f && random.bits() % 8 == 0 ? special[random.bits() % 11]
                                                     : random.uniform(0.5f - spread, 0.5f + spread);
    };
    inputs[i] = pick();
    inputs[rows + i] = pick();
    inputs[2 * rows + i] = random.uniform(0, 2.99f);
  }
  return inputs;
}

// Runs `text` as it is and with `name` renamed, which the runtime does not serve, and compares bits. The latter reads
// the same texels by views of its own, as scalars: that lanes give those bits, too, the translator's tests say, and
// compiling it for each takes half the time of all.
void check_served(const std::string& text, const std::string& name, const std::vector<float>& inputs,
                  std::span<const TextureView> views, std::span<const TextureView> views_as_written,
                  std::initializer_list<Number> numbers = {Number::lanes4, Number::lanes8, Number::lanes16}) {
  const std::string renamed = "#define " + name + " fetch_as_written\n" + text;
  const auto calls_runtime = [&](const std::string& source) {
    return translate(resolve_shader("fetch", source, "fetch.frag")).cpp.find("served::" + name + "<") !=
           std::string::npos;
  };
  REQUIRE(calls_runtime(text));
  REQUIRE(!calls_runtime(renamed));
  const std::size_t rows = inputs.size() / 3;
  const auto written = RowShader("fetch_as_written", renamed, Number::scalar).run(inputs, rows, views_as_written);
  for (const Number number : numbers) {
    const auto served = RowShader("served_fetch", text, number).run(inputs, rows, views);
    REQUIRE(served.size() == written.size());
    std::size_t differ = 0, first = 0;
    for (std::size_t i = 0; i < served.size(); ++i) {
      const bool both_nan = std::isnan(served[i]) && std::isnan(written[i]);
      if (!both_nan && bits_of(served[i]) != bits_of(written[i]) && differ++ == 0) first = i;
    }
    CHECK_MESSAGE(differ == 0, name, ", lanes of number ", static_cast<int>(number), ": ", differ, " differ; uv ",
                  hex(inputs[first % rows]), " ", hex(inputs[rows + first % rows]), " component ", first / rows, " is ",
                  hex(served[first]), ", written ", hex(written[first]));
  }
}
void check_served(const std::string& text, const std::string& name, const std::vector<float>& inputs,
                  std::span<const TextureView> views) {
  check_served(text, name, inputs, views, views);
}

// Copies of array textures as the renderer lays them out for several reads at once.
struct SideBySide {
  std::vector<float> texels;
  TextureView layers(const TextureView& from) {
    const std::ptrdiff_t padded = (from.layers + 3) / 4 * 4;
    texels.resize(static_cast<std::size_t>(from.width * from.height * padded * 4));
    for (std::ptrdiff_t y = 0; y < from.height; ++y)
      for (std::ptrdiff_t x = 0; x < from.width; ++x)
        for (std::ptrdiff_t l = 0; l < padded; ++l)
          std::copy_n(from.texels + std::min<std::ptrdiff_t>(l, from.layers - 1) * from.layer_pitch +
                          y * from.row_pitch + x * 4,
                      4, texels.data() + ((y * from.width + x) * padded + l) * 4);
    TextureView view = from;
    view.texels = texels.data();
    view.texel_pitch = padded * 4;
    view.row_pitch = view.texel_pitch * from.width;
    view.layer_pitch = 4;
    return view;
  }
  TextureView colors(const TextureView& from) {
    const std::ptrdiff_t filled = from.layers % 5 == 1 ? from.layers : (from.layers + 4) / 5 * 5;
    const std::ptrdiff_t pitch = filled / 5 * 16 + filled % 5 * 8;
    texels.assign(static_cast<std::size_t>(from.width * from.height * pitch), NAN);
    for (std::ptrdiff_t y = 0; y < from.height; ++y)
      for (std::ptrdiff_t x = 0; x < from.width; ++x)
        for (std::ptrdiff_t l = 0; l < filled; ++l)
          std::copy_n(from.texels + std::min<std::ptrdiff_t>(l, from.layers - 1) * from.layer_pitch +
                          y * from.row_pitch + x * 4,
                      3, texels.data() + (y * from.width + x) * pitch + l / 5 * 16 + l % 5 * 3);
    TextureView view = from;
    view.texels = texels.data();
    view.texel_pitch = pitch;
    view.row_pitch = view.texel_pitch * from.width;
    view.layer_pitch = 3;
    return view;
  }
  std::pair<TextureView, TextureView> pair(const TextureView& a, const TextureView& b) {
    texels.resize(static_cast<std::size_t>(a.width * a.height * a.layers * 8));
    float* to = texels.data();
    for (std::ptrdiff_t l = 0; l < a.layers; ++l)
      for (std::ptrdiff_t y = 0; y < a.height; ++y)
        for (std::ptrdiff_t x = 0; x < a.width; ++x)
          for (const TextureView* from : {&a, &b})
            to = std::copy_n(from->texels + l * from->layer_pitch + y * from->row_pitch + x * 4, 4, to);
    TextureView left = a, right = b;
    left.texels = texels.data();
    right.texels = texels.data() + 4;
    for (TextureView* view : {&left, &right}) {
      view->texel_pitch = 8;
      view->row_pitch = a.width * 8;
      view->layer_pitch = view->row_pitch * a.height;
    }
    return {left, right};
  }
};

}  // namespace

TEST_CASE("the served bilinear filter gives the bits of its GLSL, for every lane count") {
  const TextureView views[2] = {test_texture(0), test_texture(3)};
  check_served(kFetches, "exact_fetch", random_rows(20000, 1.0f), views);
}

TEST_CASE("fetches of several layers or textures give the bits of their GLSL, side by side in memory or not") {
  const TextureView& array = test_texture(3);
  SideBySide four, two;
  const TextureView together = four.layers(array);
  const auto [left, right] = two.pair(array, array);
  for (const float spread : {1.0f, 0.01f})  // 0.01: all lanes of a group at the same texels
    for (const char* name : {"exact_fetch_layers", "exact_fetch_pair"}) {
      CAPTURE(spread);
      const auto inputs = random_rows(4000, spread);
      check_served(kSeveral, name, inputs, std::array{array, array, array});
      check_served(kSeveral, name, inputs, std::array{together, left, right});
    }
}

// An array texture of `layers` layers, all of its numbers different.
struct ManyLayers {
  static constexpr std::int32_t kWidth = 4;
  std::vector<float> texels;
  TextureView view = test_texture(3);
  explicit ManyLayers(std::int32_t layers)
      : texels(std::size_t{kWidth} * kWidth * static_cast<std::size_t>(layers) * 4) {
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(i) * 0.37f - 9;
    view.texels = texels.data();
    view.width = view.height = kWidth;
    view.layers = layers;
    view.row_pitch = kWidth * 4;
    view.layer_pitch = view.row_pitch * kWidth;
  }
};

TEST_CASE(
    "fetches of three layers and of three times three give the bits of their GLSL, side by side in memory or not, all "
    "there or not") {
  const ManyLayers array(8), few(2);
  SideBySide layers;
  const TextureView together = layers.layers(array.view);
  for (const TextureView& view : {array.view, together, few.view})
    for (const float spread : {1.0f, 0.001f})
      for (const char* name : {"exact_fetch_ones", "exact_fetch_threes"})
        check_served(kPicked, name, random_rows(4000, spread), std::array{view});
}

TEST_CASE("fetches of sphere maps give the bits of their GLSL, side by side in memory or not") {
  const ManyLayers array(8);
  SideBySide four;
  const TextureView together = four.layers(array.view);
  for (const TextureView& view : {array.view, together})
    for (const float spread : {1.0f, 0.001f})
      check_served(kMaps, "sphere_map_fetch", random_rows(4000, spread), std::array{view});
}

TEST_CASE("fetches of all layers give the bits of their GLSL, side by side in memory or not, all there or not") {
  for (const std::int32_t layers : {1, 3, 8})
    for (const int count : {3, 5}) {  // of registers of 16: a half and a quarter; one and a quarter
      CAPTURE(layers);
      CAPTURE(count);
      const ManyLayers array(layers);
      SideBySide four;
      const TextureView together = four.layers(array.view);
      for (const TextureView& view : {array.view, together})
        check_served(layers_text(count), "exact_fetch_layers", random_rows(1000, 1.0f), std::array{view});
    }
}

TEST_CASE(
    "fetches of all layers' colours give the bits of their GLSL, side by side in memory or not, all there or not") {
  // One line and a layer that is left, two lines, four; few and many for broadcasts.
  for (const auto& count_and_spread : {std::pair(6, 1.0f), {6, 0.001f}, {9, 0.001f}, {17, 0.001f}})
    for (const std::int32_t layers : {1, 6, 9, 10, 20}) {
      const int count = count_and_spread.first;
      const float spread = count_and_spread.second;
      CAPTURE(count);
      CAPTURE(layers);
      const ManyLayers array(layers);
      SideBySide fives;
      const TextureView together = fives.colors(array.view);
      for (const TextureView& view : {array.view, together}) {
        const auto inputs = random_rows(1000, spread);
        const auto numbers = {Number::lanes4, Number::lanes8, Number::lanes16, Number::scalar};
        check_served(colors_text(count), "exact_fetch_colors", inputs, std::array{view}, std::array{array.view},
                     numbers);
        check_served(map_colors_text(count), "sphere_map_fetch_colors", inputs, std::array{view},
                     std::array{array.view}, numbers);
      }
    }
}

TEST_CASE("in double the colours of all layers are sums in double, side by side in memory or not") {
  const ManyLayers array(9);
  SideBySide fives;
  const TextureView together = fives.colors(array.view);
  constexpr std::uint32_t kColors = 12;
  const ShaderModule& module =
      load_module(resolve_shader("colors_in_double", colors_text(kColors), "colors_in_double.frag"), Number::float64);
  const auto entry = std::find_if(module.entries, module.entries + module.entry_count,
                                  [](const ShaderEntry& e) { return e.number == Number::float64; });
  REQUIRE(entry != module.entries + module.entry_count);
  constexpr std::uint32_t kRows = 16, kOutputs = 4 * 3 * kColors * kRows;
  REQUIRE(module.output_components * kRows == kOutputs);
  struct alignas(64) Arrays {
    double inputs[3 * kRows], outputs[kOutputs], frag_coord[4 * kRows], depth[kRows];
    std::uint32_t live[kRows], front[kRows], id[kRows], kept[kRows];
  };
  const auto run = [&](const TextureView& view) {
    Arrays a{};
    for (std::uint32_t i = 0; i < kRows; ++i) {
      a.inputs[i] = 0.3 + 0.01 * i;
      a.inputs[kRows + i] = 0.7;
      a.inputs[2 * kRows + i] = i % 3;
      a.live[i] = ~0u;
    }
    entry->shade(ShaderData{nullptr, &view, nullptr},
                 ShadeCall{kRows, kRows, a.inputs, a.frag_coord, a.live, a.front, a.id, a.outputs, a.depth, a.kept});
    return std::vector<double>(a.outputs, a.outputs + kOutputs);
  };
  const auto apart = run(array.view);
  CHECK(apart == run(together));
  // Layer 7, green, first row: between texels 0 and 1 of rows 2 and 3. The taps' weights are in double, too.
  const auto texel = [](int x, int y) {
    return static_cast<double>(static_cast<float>(((7 * 4 + y) * 4 + x) * 4 + 1) * 0.37f - 9);
  };
  const double u = 0.3 * 4 - 0.5, v = 0.7 * 4 - 0.5 - 2;
  const double expected =
      (texel(0, 2) * (1 - u) + texel(1, 2) * u) * (1 - v) + (texel(0, 3) * (1 - u) + texel(1, 3) * u) * v;
  CHECK(std::fabs(apart[(7 * 3 + 1) * kRows] - expected) < 1e-12);
}

TEST_CASE("the reflection says how the layers of a sampler should lie, and how many are read") {
  const auto map = [](const std::string& main) {
    const auto reflection = translate(resolve_shader("order",
                                                     "#define FETCHED_COLORS 5\n#define FETCHED_LAYERS 2\n"
                                                     "#include \"exact/fetch_colors.glsl\"\n"
                                                     "#include \"exact/fetch_layers.glsl\"\n"
                                                     "uniform sampler2DArray maps;\nin vec2 uv;\nout vec4 color;\n"
                                                     "vec3 colors[5];\nvec4 layers[2];\nmat3 threes[3];\n"
                                                     "void five(sampler2DArray of, ExactTaps taps) {\n"
                                                     "  exact_fetch_colors(of, taps, colors);\n}\n" +
                                                         main,
                                                     "order.frag"))
                                .reflection;
    return reflection.resources.at(0);
  };
  const auto order = [&](const std::string& main) { return map(main).layer_order; };
  const std::string taps = "void main() {\n  ExactTaps taps = exact_taps_clamp(uv, textureSize(maps, 0).xy);\n";
  const std::string five = taps + "  five(maps, taps);\n";
  CHECK(order(taps + "color = exact_fetch(maps, taps, 0); }\n") == LayerOrder::apart);
  CHECK(order(taps + "exact_fetch_layers(maps, taps, layers); color = layers[1]; }\n") == LayerOrder::together);
  const std::string threes = "exact_fetch_threes(maps, taps, taps, ivec3(0), threes); color.rgb = threes[0][1]; }\n";
  CHECK(order(taps + threes) == LayerOrder::together);
  CHECK(order(taps + "vec3 ones[3]; exact_fetch_ones(maps, taps, taps, ivec3(0), ones); color.rgb = ones[1]; }\n") ==
        LayerOrder::together);
  CHECK(order(taps + "exact_fetch_colors(maps, taps, taps, colors); color.rgb = colors[1]; }\n") ==
        LayerOrder::colors_together);
  CHECK(order(five + "color = vec4(colors[1], 1.0); }\n") == LayerOrder::colors_together);
  // Alpha, or a single layer, can only be read in the other orders.
  CHECK(order(five + "color = exact_fetch(maps, taps, 0); }\n") == LayerOrder::apart);
  CHECK(order(five + "color = texelFetch(maps, ivec3(0), 0); }\n") == LayerOrder::apart);
  CHECK(order(five + "color = texture(maps, vec3(uv, 0.0)); }\n") == LayerOrder::apart);
  CHECK(order(five + threes) == LayerOrder::together);

  const std::string two = taps + "exact_fetch_layers(maps, taps, layers); color = layers[1];\n";
  CHECK(map(two + "}\n").layers_read == 2);
  CHECK(map(two + "color *= textureSize(maps, 0).z; }\n").layers_read == 2);
  // All may be read.
  CHECK(map(two + "color += exact_fetch(maps, taps, 7); }\n").layers_read == 0);
  CHECK(map(two + "five(maps, taps); color.rgb += colors[1]; }\n").layers_read == 0);
  CHECK(map(two + threes).layers_read == 0);
  CHECK(map(five + "color = vec4(colors[1], 1.0); }\n").layers_read == 0);
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

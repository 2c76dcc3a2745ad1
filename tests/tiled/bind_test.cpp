// What a shader asks for and a bundle lacks is named.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "base/error.h"
#include "raster/tiled/bind.h"
#include "raster/tiled/tiled_renderer.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

// A module that only asks.
struct Wishes {
  std::vector<ShaderVariable> inputs;
  std::vector<ShaderUniform> uniforms;
  std::vector<ShaderResource> resources;
  std::uint32_t input_components = 0, uniform_bytes = 0, textures = 0, buffers = 0;

  ShaderModule module() const {
    ShaderModule m{};
    m.abi_version = kAbiVersion;
    m.name = "wishes";
    m.inputs = inputs.data();
    m.input_count = std::uint32_t(inputs.size());
    m.input_components = input_components;
    m.uniforms = uniforms.data();
    m.uniform_count = std::uint32_t(uniforms.size());
    m.uniform_bytes = uniform_bytes;
    m.resources = resources.data();
    m.resource_count = std::uint32_t(resources.size());
    m.texture_count = textures;
    m.buffer_count = buffers;
    return m;
  }
};

std::string complaint(const Bundle& bundle, const Wishes& wishes, AttributeMode mode = AttributeMode::exact) {
  try {
    tiled::bind(bundle, wishes.module(), mode);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("missing and mistyped inputs are named with what the bundle has") {
  const Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  Wishes wishes;
  wishes.input_components = 4;
  wishes.inputs = {{"v_normal", Scalar::f32, 1, 3, 0, false, false, -1, 0}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": input \"v_normal\" is not in the bundle; the bundle has v_value, v_key");
  wishes.inputs = {{"v_value", Scalar::f32, 1, 3, 0, false, false, -1, 0}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": input \"v_value\" is declared vec3, but the bundle's attribute is vec4");
  wishes.inputs = {{"v_key", Scalar::i32, 1, 1, 0, true, false, -1, 0}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": input \"v_key\" is declared int, but the bundle's attribute is uint");
  wishes.inputs = {{"v_value", Scalar::f32, 1, 4, 0, false, true, -1, 0}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": input \"v_value\" is noperspective, which only native attributes have: draw with "
        "--attributes native");
  CHECK(complaint(bundle, wishes, AttributeMode::native) == "");
}

TEST_CASE("elements of input arrays and columns of input matrices are attributes of their own") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  for (const char* name : {"a[0]", "a[1]", "m[0]", "m[1]"}) {
    Attribute attribute{name, Scalar::f32, 2, {}};
    for (int i = 0; i < 6; ++i) attribute.values.push_back(float(name[0]) + float(name[2] - '0') * 10 + float(i));
    bundle.attributes.push_back(attribute);
  }
  Wishes wishes;
  wishes.input_components = 8;
  wishes.inputs = {{"m", Scalar::f32, 2, 2, 0, false, false, -1, 0}, {"a", Scalar::f32, 1, 2, 2, false, false, -1, 4}};
  const tiled::BoundDraw bound = tiled::bind(bundle, wishes.module(), AttributeMode::exact);
  CHECK(bound.component_names ==
        std::vector<std::string>{"m[0].x", "m[0].y", "m[1].x", "m[1].y", "a[0].x", "a[0].y", "a[1].x", "a[1].y"});
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t c = 0; c < 8; ++c)
      CHECK(bound.vertex_inputs[8 * v + c] == float(c < 4 ? 'm' : 'a') + float(c / 2 % 2) * 10 + float(2 * v + c % 2));
}

TEST_CASE("uniforms land at their offsets and strides") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  bundle.uniforms.push_back({"light.colour", Scalar::f32, 1, 3, 0, {1, 2, 3}});
  bundle.uniforms.push_back({"k[0]", Scalar::f32, 2, 2, 2, {1, 2, 3, 4, 5, 6, 7, 8}});
  bundle.uniforms.push_back({"n", Scalar::i32, 1, 1, 0, {std::bit_cast<float>(-7)}});
  Wishes wishes;
  wishes.uniforms = {{"light.colour", Scalar::f32, 1, 3, 0, 16, 0, 0},
                     {"k", Scalar::f32, 2, 2, 2, 32, 32, 16},
                     {"n", Scalar::i32, 1, 1, 0, 0, 0, 0}};
  wishes.uniform_bytes = 96;
  const tiled::BoundDraw bound = tiled::bind(bundle, wishes.module(), AttributeMode::exact);
  const auto at = [&](std::size_t offset) {
    std::uint32_t bits;
    std::memcpy(&bits, &bound.uniforms[offset], 4);
    return bits;
  };
  CHECK(at(0) == std::uint32_t(-7));
  CHECK(std::bit_cast<float>(at(24)) == 3);
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(std::bit_cast<float>(at(32 + i / 4 * 32 + i / 2 % 2 * 16 + i % 2 * 4)) == float(i + 1));

  wishes.uniforms[1].array_length = 3;
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": uniform \"k\" is declared mat2x2[3], but the bundle's is mat2x2[2]");
  wishes.uniforms = {{"exposure", Scalar::f32, 1, 1, 0, 0, 0, 0}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": uniform \"exposure\" is not in the bundle and has no initial value: write \"uniform "
        "float exposure = 1.0;\" (in GLSL ES \"const float exposure = 1.0;\"); the bundle has light.colour, k[0], n");
  wishes.uniforms = {{"tint", Scalar::i32, 1, 3, 0, 0, 0, 0}};
  CHECK(complaint(bundle, wishes).find("write \"uniform ivec3 tint = ivec3(1);\"") != std::string::npos);
  wishes.uniforms = {{"sun.tint", Scalar::f32, 1, 3, 0, 0, 0, 0}};
  CHECK(
      complaint(bundle, wishes).find("no initial value: give it one in the shader (in GLSL ES make it a constant); ") !=
      std::string::npos);
}

TEST_CASE("textures and buffers must be of the kind and size that the shader declares") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  Texture texture;
  texture.name = "albedo";
  texture.width = texture.height = 1;
  texture.texels = {1, 2, 3, 4};
  bundle.textures.push_back(texture);
  bundle.buffers.push_back({"Block", false, std::vector<std::byte>(16)});
  Wishes wishes;
  wishes.textures = wishes.buffers = 1;
  wishes.resources = {{"albedo", ResourceKind::sampler_cube, 0, 0, true}};
  CHECK(complaint(bundle, wishes) == "shader \"wishes\": samplerCube \"albedo\" does not fit the bundle's 2D texture");
  wishes.resources = {{"normals", ResourceKind::sampler_2d, 0, 0, true}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": texture \"normals\" is not in the bundle; the bundle has albedo");
  wishes.resources = {{"Block", ResourceKind::storage_buffer, 0, 4, true}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": storage buffer \"Block\": the bundle's buffer of that name is a uniform block");
  wishes.resources = {{"Block", ResourceKind::uniform_block, 0, 32, true}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": uniform block \"Block\" needs 32 bytes, but the bundle's has 16");
  wishes.resources = {{"Other", ResourceKind::uniform_block, 0, 32, true}};
  CHECK(complaint(bundle, wishes) ==
        "shader \"wishes\": uniform block \"Other\" is not in the bundle; the bundle has Block");
}

TEST_CASE("a number that the module has no code for is refused with its reason") {
  static constexpr ShaderEntry kOnly{Isa::baseline, Number::lanes4, nullptr};
  ShaderModule module = test::echo_module();
  module.entries = &kOnly;
  module.entry_count = 1;
  module.no_float64_reason = "tone.frag:12: floatBitsToInt";
  DrawOptions options;
  options.number = Number::float64;
  CHECK_THROWS_WITH(draw_tiled(test::inside_bundle(8, 8, 1, 1), module, options),
                    "shader \"echo\" has no code for float64: tone.frag:12: floatBitsToInt");
}

TEST_CASE("texels of large textures that are read at inputs are asked for ahead") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  const auto add = [&](const char* name, std::uint32_t size, Wrap wrap) {
    Texture texture;
    texture.name = name;
    texture.kind = TextureKind::two_d_array;
    texture.wrap = wrap;
    texture.width = texture.height = size, texture.layers = 1;
    texture.texels.resize(std::size_t(size) * size * 4);
    bundle.textures.push_back(std::move(texture));
  };
  add("large", 256, Wrap::repeat);
  add("small", 32, Wrap::repeat);
  add("clamped", 256, Wrap::clamp_to_edge);
  add("computed", 256, Wrap::repeat);
  add("first", 256, Wrap::repeat);
  add("second", 256, Wrap::repeat);
  Wishes wishes;
  wishes.textures = 6;
  const auto array = ResourceKind::sampler_2d_array;
  const LayerOrder apart = LayerOrder::apart;
  wishes.resources = {
      {"large", array, 0, 0, true, apart, -1, 3, 5},   {"small", array, 1, 0, true, apart, -1, 3, 5},
      {"clamped", array, 2, 0, true, apart, -1, 3, 5}, {"computed", array, 3, 0, true, apart, -1, -1, -1},
      {"first", array, 4, 0, true, apart, 5, 7, -1},   {"second", array, 5, 0, true, apart, -1, 7, -1}};
  const auto asked = [&] { return tiled::bind(bundle, wishes.module(), AttributeMode::exact).ahead; };
  const std::vector<TexelsAhead> ahead = asked();
  REQUIRE(ahead.size() == 3);
  CHECK(ahead[0].texture == 0);
  CHECK(ahead[0].coordinates == 3);
  CHECK(ahead[0].layer == 5);
  CHECK(ahead[1].texture == 2);
  CHECK(ahead[2].texture == 4);  // the second's texels lie beside the first's
  CHECK(ahead[2].coordinates == 7);
  CHECK(ahead[2].layer == -1);

  bundle.textures[5].width = 128, bundle.textures[5].height = 512;  // another shape: not beside it
  CHECK(asked().size() == 4);
  wishes.resources[0].layer_order = wishes.resources[2].layer_order = LayerOrder::together;  // 16 floats a texel
  CHECK(asked().size() == 3);                                                                // but the clamped one's

  // 128 KiB: the layers that lie together count once.
  Texture& clamped = bundle.textures[2];
  clamped.width = clamped.height = 32, clamped.layers = 8;
  clamped.texels.resize(std::size_t{32} * 32 * 8 * 4);
  CHECK(asked().size() == 2);
}

TEST_CASE("textures that are read together lie side by side, every texel where the views say") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  const auto add = [&](const char* name, std::uint32_t layers) {
    Texture texture;
    texture.name = name;
    texture.kind = TextureKind::two_d_array;
    texture.width = 3, texture.height = 2, texture.layers = layers;
    for (std::uint32_t i = 0; i < 3 * 2 * layers * 4; ++i)
      texture.texels.push_back(float(i) + 1000.0f * float(bundle.textures.size()));
    bundle.textures.push_back(std::move(texture));
  };
  add("coefficients", 6);
  add("albedo", 2);
  add("normals", 2);
  Wishes wishes;
  wishes.textures = 3;
  wishes.resources = {{"coefficients", ResourceKind::sampler_2d_array, 0, 0, true, LayerOrder::together, -1},
                      {"albedo", ResourceKind::sampler_2d_array, 1, 0, true, LayerOrder::apart, 2},
                      {"normals", ResourceKind::sampler_2d_array, 2, 0, true, LayerOrder::apart, -1}};
  const auto texel = [](const TextureView& view, std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t layer) {
    return view.texels + layer * view.layer_pitch + y * view.row_pitch + x * view.texel_pitch;
  };
  const tiled::BoundDraw bound = tiled::bind(bundle, wishes.module(), AttributeMode::exact);
  for (std::size_t t = 0; t < 3; ++t) {
    const TextureView& view = bound.textures[t];
    for (std::ptrdiff_t layer = 0; layer < view.layers; ++layer)
      for (std::ptrdiff_t y = 0; y < 2; ++y)
        for (std::ptrdiff_t x = 0; x < 3; ++x)
          for (std::ptrdiff_t c = 0; c < 4; ++c)
            CHECK(texel(view, x, y, layer)[c] ==
                  bundle.textures[t].texels[std::size_t(((layer * 2 + y) * 3 + x) * 4 + c)]);
  }
  CHECK(bound.textures[0].layer_pitch == 4);
  CHECK(bound.textures[0].texel_pitch == 32);  // eight layers: the last one is there three times
  CHECK(*texel(bound.textures[0], 2, 1, 7) == *texel(bound.textures[0], 2, 1, 5));
  CHECK(bound.textures[2].texels == bound.textures[1].texels + 4);
  for (const std::uint32_t read : {2u, 3u, 6u, 7u}) {
    wishes.resources[0].layers_read = read;
    const TextureView view = tiled::bind(bundle, wishes.module(), AttributeMode::exact).textures[0];
    CHECK(view.layers == 6);
    CHECK(view.texel_pitch == (read == 2 ? 8 : read == 3 ? 16 : 32));
  }
  wishes.resources[0].layers_read = 0;

  wishes.resources[0].layer_order = LayerOrder::colors_together;
  add("more_coefficients", 7);
  const auto check_colors = [&](std::size_t texture, std::ptrdiff_t pitch, std::ptrdiff_t filled) {
    wishes.resources[0].name = bundle.textures[texture].name.c_str();
    const tiled::BoundDraw fives = tiled::bind(bundle, wishes.module(), AttributeMode::exact);
    const TextureView& view = fives.textures[0];
    CHECK(view.layer_pitch == 3);
    CHECK(view.texel_pitch == pitch);
    for (std::ptrdiff_t layer = 0; layer < filled; ++layer)
      for (std::ptrdiff_t y = 0; y < 2; ++y)
        for (std::ptrdiff_t x = 0; x < 3; ++x)
          for (std::ptrdiff_t c = 0; c < 3; ++c)
            CHECK(
                view.texels[y * view.row_pitch + x * pitch + layer / 5 * 16 + layer % 5 * 3 + c] ==
                bundle.textures[texture]
                    .texels[std::size_t(((std::min<std::ptrdiff_t>(layer, view.layers - 1) * 2 + y) * 3 + x) * 4 + c)]);
  };
  check_colors(0, 24, 6);   // the sixth layer by itself, whole registers of eight
  check_colors(3, 32, 10);  // ten layers: the last one is there four times
  wishes.resources[0].name = "coefficients";

  bundle.textures[2].width = 2, bundle.textures[2].height = 3;  // another size: left as it is
  const tiled::BoundDraw apart = tiled::bind(bundle, wishes.module(), AttributeMode::exact);
  CHECK(apart.textures[1].texels == bundle.textures[1].texels.data());
}

TEST_CASE("rows of textures are not a power of two apart, every texel where the views say") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  const auto add = [&](const char* name, std::uint32_t width, std::uint32_t layers, std::uint32_t height = 3) {
    Texture texture{};
    texture.name = name;
    texture.kind = TextureKind::two_d_array;
    texture.width = width;
    texture.height = height;
    texture.layers = layers;
    for (std::uint32_t i = 0; i < width * height * layers * 4; ++i) texture.texels.push_back(float(i));
    bundle.textures.push_back(texture);
  };
  add("alone", 128, 2, 128);
  add("small", 128, 2, 127);
  add("odd", 140, 2);
  add("albedo", 64, 2);
  add("normals", 64, 2);
  add("layers", 64, 3);
  add("colors", 64, 5);
  Wishes wishes;
  wishes.textures = 7;
  for (std::uint32_t i = 0; i < 7; ++i)
    wishes.resources.push_back({bundle.textures[i].name.c_str(), ResourceKind::sampler_2d_array, i, 0, false,
                                i == 5   ? LayerOrder::together
                                : i == 6 ? LayerOrder::colors_together
                                         : LayerOrder::apart,
                                i == 3 ? 4 : -1});
  const tiled::BoundDraw bound = tiled::bind(bundle, wishes.module(), AttributeMode::exact);
  const std::ptrdiff_t lines[7] = {41, 32, 35, 41, 41, 73, 73};  // of 16 floats, from row to row
  for (std::size_t i = 0; i < 7; ++i) {
    CAPTURE(i);
    const TextureView& view = bound.textures[i];
    CHECK(view.row_pitch == 16 * lines[i]);
    CHECK((view.texels == bundle.textures[i].texels.data()) == (i == 1 || i == 2));  // left as they are
    for (std::ptrdiff_t layer = 0; layer < view.layers; ++layer)
      for (std::ptrdiff_t y = 0; y < view.height; ++y)
        for (std::ptrdiff_t x = 0; x < view.width; ++x)
          REQUIRE(view.texels[layer * view.layer_pitch + y * view.row_pitch + x * view.texel_pitch] ==
                  bundle.textures[i].texels[std::size_t(((layer * view.height + y) * view.width + x) * 4)]);
  }
}

TEST_CASE("a texture whose texels have no 32-bit places is refused before it is read") {
  Bundle bundle = test::inside_bundle(8, 8, 1, 1);
  Texture texture{};
  texture.name = "huge";
  texture.kind = TextureKind::two_d_array;
  texture.width = texture.height = 16384;
  texture.layers = 9;  // 36 GiB, not there
  bundle.textures.push_back(texture);
  Wishes wishes;
  wishes.textures = 1;
  wishes.resources.push_back({"huge", ResourceKind::sampler_2d_array, 0, 0, false, LayerOrder::colors_together});
  CHECK_THROWS_WITH_AS(tiled::bind(bundle, wishes.module(), AttributeMode::exact),
                       "shader \"wishes\": texture \"huge\" takes more than 32 GiB, beyond which texels have no "
                       "addresses: make it smaller",
                       UserError);
}

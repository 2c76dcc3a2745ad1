// Uniforms, blocks, storage buffers and textures by name, and what is said when one is missing.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "base/error.h"
#include "raster/gl/gl_renderer.h"
#include "tests/gl/test_bundles.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;
using test::error_of;
using test::shader;

namespace {

Renderer& renderer() {
  static const auto one = make_gl_renderer(GlBackend::egl);
  return *one;
}

// Colour of pixel (0, 0).
std::vector<float> color_of(const Bundle& bundle, const std::string& text, AttributeMode mode = AttributeMode::exact) {
  DrawOptions options;
  options.attributes = mode;
  const Frame frame = renderer().draw(bundle, shader(text), options);
  return {frame.color.begin(), frame.color.begin() + 4};
}

Uniform uniform(const std::string& name, Scalar scalar, std::uint32_t columns, std::uint32_t rows, std::uint32_t length,
                std::vector<float> values) {
  return {name, scalar, columns, rows, length, std::move(values)};
}

std::vector<std::byte> bytes_of(const std::vector<float>& values) {
  std::vector<std::byte> bytes(values.size() * 4);
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

using Color = std::vector<float>;

}  // namespace

TEST_CASE("uniforms of every type arrive by name") {
  Bundle bundle = test::quad(4, 4);
  bundle.uniforms = {
      uniform("f", Scalar::f32, 1, 1, 0, {1.5f}),
      uniform("v", Scalar::f32, 1, 3, 0, {1, 2, 3}),
      uniform("k", Scalar::f32, 1, 2, 3, {1, 2, 3, 4, 5, 6}),
      uniform("m", Scalar::f32, 3, 3, 0, {1, 2, 3, 4, 5, 6, 7, 8, 9}),
      uniform("m23", Scalar::f32, 2, 3, 0, {1, 2, 3, 4, 5, 6}),
      uniform("i", Scalar::i32, 1, 2, 0, {std::bit_cast<float>(0xfffffffdu), std::bit_cast<float>(7)}),
      uniform("u", Scalar::u32, 1, 1, 0, {std::bit_cast<float>(0x80000001u)}),
      uniform("b", Scalar::boolean, 1, 3, 0,
              {std::bit_cast<float>(1), std::bit_cast<float>(0), std::bit_cast<float>(1)}),
      uniform("light.color", Scalar::f32, 1, 3, 0, {7, 8, 9}),
      uniform("light.power", Scalar::f32, 1, 1, 0, {10}),
      uniform("lights[0].color", Scalar::f32, 1, 3, 0, {0, 0, 0}),
      uniform("lights[0].power", Scalar::f32, 1, 1, 0, {0}),
      uniform("lights[1].color", Scalar::f32, 1, 3, 0, {0, 0, 0}),
      uniform("lights[1].power", Scalar::f32, 1, 1, 0, {11}),
  };
  const std::string declarations =
      "uniform float f; uniform vec3 v; uniform vec2 k[3]; uniform mat3 m; uniform mat2x3 m23; uniform ivec2 i; "
      "uniform uint u;\n"
      "uniform bvec3 b; struct Light { vec3 color; float power; }; uniform Light light; uniform Light lights[2];\nout "
      "vec4 c;\n";
  const auto value = [&](const std::string& expression) {
    return color_of(bundle, declarations + "void main() { c = " + expression + "; }\n");
  };
  CHECK(value("vec4(f, v)") == Color{1.5f, 1, 2, 3});
  CHECK(value("vec4(k[0], k[2])") == Color{1, 2, 5, 6});
  CHECK(value("vec4(m[1], m[2][0])") == Color{4, 5, 6, 7});
  CHECK(value("vec4(m23[1], m23[0][1])") == Color{4, 5, 6, 2});
  CHECK(value("vec4(i, u == 0x80000001u, 0)") == Color{-3, 7, 1, 0});
  CHECK(value("vec4(b, 0)") == Color{1, 0, 1, 0});
  CHECK(value("vec4(light.color, lights[1].power)") == Color{7, 8, 9, 11});
}

TEST_CASE("a uniform whose path is longer than any one name may be arrives") {
  const std::string variable(600, 'v'), member(600, 'm');
  Bundle bundle = test::quad(4, 4);
  bundle.uniforms = {uniform(variable + "." + member, Scalar::f32, 1, 1, 0, {1.5f})};
  CHECK(color_of(bundle, "struct S { float " + member + "; };\nuniform S " + variable +
                             ";\nout vec4 c;\nvoid main() { c = vec4(" + variable + "." + member + "); }") ==
        Color{1.5f, 1.5f, 1.5f, 1.5f});
}

TEST_CASE("blocks and storage buffers arrive by block name") {
  Bundle bundle = test::quad(4, 4);
  bundle.buffers = {{"Params", false, bytes_of({1, 2, 3, 4, 5, 0, 0, 0})}, {"Table", true, bytes_of({10, 20, 30})}};
  CHECK(color_of(bundle,
                 "layout(std140) uniform Params { vec4 a; float b; } params;\n"
                 "layout(std430, binding = 5) readonly buffer Table { float t[]; };\nout vec4 c;\n"
                 "void main() { c = vec4(params.a.w, params.b, t[2], float(t.length())); }\n") == Color{4, 5, 30, 3});
}

TEST_CASE("storage buffers start from the bundle's content in every draw") {
  Bundle bundle = test::quad(1, 1);
  bundle.buffers = {{"Counter", true, bytes_of({std::bit_cast<float>(41)})}};
  const std::string text =
      "buffer Counter { uint count; };\nout vec4 c;\nvoid main() { c = vec4(float(atomicAdd(count, 1u))); }\n";
  CHECK(color_of(bundle, text)[0] == 41);
  CHECK(color_of(bundle, text)[0] == 41);
}

TEST_CASE("textures arrive by name: 2D, array, cube, arrays of samplers") {
  Bundle bundle = test::quad(4, 4);
  std::vector<float> texels, cube;
  for (int i = 0; i < 2 * 2 * 2 * 4; ++i) texels.push_back(float(i));
  for (int i = 0; i < 6 * 4; ++i) cube.push_back(float(i));
  const std::vector<float> one(texels.begin(), texels.begin() + 16);
  bundle.textures = {{"flat_map", TextureKind::two_d, 2, 2, 1, Filter::linear, Wrap::repeat, one},
                     {"layered", TextureKind::two_d_array, 2, 2, 2, Filter::nearest, Wrap::clamp_to_edge, texels},
                     {"sky", TextureKind::cube, 1, 1, 6, Filter::nearest, Wrap::clamp_to_edge, cube},
                     {"maps[0]", TextureKind::two_d, 1, 1, 1, Filter::nearest, Wrap::repeat, {1, 1, 1, 1}},
                     {"maps[1]", TextureKind::two_d, 1, 1, 1, Filter::nearest, Wrap::repeat, {2, 2, 2, 2}}};
  const std::string declarations =
      "uniform sampler2D flat_map; uniform sampler2DArray layered; uniform samplerCube sky; uniform sampler2D "
      "maps[2];\nout vec4 c;\n";
  const auto value = [&](const std::string& expression) {
    return color_of(bundle, declarations + "void main() { c = " + expression + "; }\n");
  };
  CHECK(value("texelFetch(flat_map, ivec2(1, 0), 0)") == Color{4, 5, 6, 7});
  CHECK(value("texelFetch(layered, ivec3(0, 1, 1), 0)") == Color{24, 25, 26, 27});
  CHECK(value("textureLod(sky, vec3(0, -1, 0), 0.0)") == Color{12, 13, 14, 15});
  CHECK(value("vec4(texture(maps[0], vec2(0)).x, texture(maps[1], vec2(0)).x, 0, 0)") == Color{1, 2, 0, 0});
  CHECK(value("textureLod(flat_map, vec2(0.5), 0.0)") == Color{6, 7, 8, 9});
  CHECK(value("textureLod(flat_map, vec2(1.25, -0.75), 0.0)") == Color{0, 1, 2, 3});
}

TEST_CASE("what is missing or of another type is named, with what the bundle has") {
  Bundle bundle = test::quad(4, 4);
  bundle.uniforms = {uniform("f", Scalar::f32, 1, 1, 0, {1}), uniform("k", Scalar::f32, 1, 1, 2, {1, 2})};
  bundle.textures = {{"map", TextureKind::two_d, 1, 1, 1, Filter::nearest, Wrap::repeat, {1, 1, 1, 1}}};
  bundle.buffers = {{"Params", false, bytes_of({1})}};
  const auto error = [&](const std::string& text) {
    return error_of([&] { color_of(bundle, "out vec4 c;\n" + text); });
  };
  CHECK(error("uniform vec3 g;\nvoid main() { c = vec4(g, 1); }\n") ==
        "test.frag: uniform g (vec3) is not in the bundle, which has: f, k; it has no initial value: write \"uniform "
        "vec3 "
        "g = vec3(1.0);\" (in GLSL ES \"const vec3 g = vec3(1.0);\")");
  CHECK(error("uniform vec3 f;\nvoid main() { c = vec4(f, 1); }\n") ==
        "test.frag: uniform f (vec3) is float in the bundle");
  CHECK(error("uniform float k[3];\nvoid main() { c = vec4(k[2]); }\n") ==
        "test.frag: uniform k (float) is an array of at least 3, but has 2 array elements in the bundle");
  CHECK(error("uniform sampler2D nope;\nvoid main() { c = texelFetch(nope, ivec2(0), 0); }\n") ==
        "test.frag: sampler2D nope is not in the bundle, which has: map");
  CHECK(error("uniform samplerCube map;\nvoid main() { c = texture(map, vec3(1)); }\n") ==
        "test.frag: samplerCube map is a sampler2D texture in the bundle");
  CHECK(error("uniform Nope { vec4 a; };\nvoid main() { c = a; }\n") ==
        "test.frag: uniform block Nope is not in the bundle, which has: Params");
  CHECK(error("uniform Params { vec4 a, b; };\nvoid main() { c = a + b; }\n") ==
        "test.frag: uniform block Params needs 32 bytes, but has 4 in the bundle");
  CHECK(error("in vec3 v_normal;\nvoid main() { c = vec4(v_normal, 1); }\n") ==
        "test.frag:2: input v_normal (vec3) is not in the bundle, which has: v_uv");
  CHECK(error("in vec3 v_uv;\nvoid main() { c = vec4(v_uv, 1); }\n") ==
        "test.frag:2: input v_uv (vec3) is vec2 in the bundle");
  CHECK(error("in vec3 unused;\nuniform float also_unused;\nvoid main() { c = vec4(1); }\n").empty());
}

TEST_CASE("the driver's complaint names the author's file and line") {
  const Bundle bundle = test::quad(4, 4);
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    CHECK(error_of([&] {
            color_of(bundle, "out vec4 c;\nin vec2 v_uv;\n\nvoid main() { c = vec4(v_uv, undeclared, 1); }\n", mode);
          }).find("test.frag:4") == 0);
}

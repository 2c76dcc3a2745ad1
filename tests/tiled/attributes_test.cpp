// The rasterizer's evaluation of exact attributes is its translation from GLSL, bit for bit.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "cpu_shaders/load/load.h"
#include "cpu_shaders/machine.h"
#include "raster/tiled/tiled_renderer.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

// Vertices no longer shared, and each triangle's vertex data as flat attributes of all three.
Bundle with_flat_vertex_data(const Bundle& bundle) {
  Bundle flat = bundle;
  const std::size_t vertices = bundle.indices.size();
  flat.clip_positions.clear();
  for (Attribute& attribute : flat.attributes) attribute.values.clear();
  for (const char* name : {"p0", "p1", "p2"}) flat.attributes.push_back({name, Scalar::f32, 4, {}});
  flat.attributes.push_back({"a", Scalar::f32, 3, {}});
  for (std::size_t i = 0; i < vertices; ++i) {
    flat.indices[i] = std::uint32_t(i);
    const auto append = [](std::vector<float>& to, const std::vector<float>& from, std::size_t vertex, std::size_t n) {
      to.insert(to.end(), from.begin() + std::ptrdiff_t(vertex * n), from.begin() + std::ptrdiff_t((vertex + 1) * n));
    };
    append(flat.clip_positions, bundle.clip_positions, bundle.indices[i], 4);
    append(flat.attributes[0].values, bundle.attributes[0].values, bundle.indices[i], 4);
    append(flat.attributes[1].values, bundle.attributes[1].values, bundle.indices[i], 1);
    for (std::size_t v = 0; v < 3; ++v) {
      const std::uint32_t vertex = bundle.indices[i / 3 * 3 + v];
      append(flat.attributes[2 + v].values, bundle.clip_positions, vertex, 4);
      flat.attributes[5].values.push_back(bundle.attributes[0].values[vertex * 4]);
    }
  }
  const auto [width, height] = viewport_size(bundle.width, bundle.height);
  flat.uniforms.push_back({"ndc_scale", Scalar::f32, 1, 2, 0, {2.0f / float(width), 2.0f / float(height)}});
  return flat;
}

}  // namespace

TEST_CASE("exact attributes, depth, 1 / w and facing are those of exact/attributes.glsl") {
  const Bundle bundle = with_flat_vertex_data(test::torture_bundle(400, 300, 2500, 31));
  const ShaderSource source = load_shader(TWINSHADE_SOURCE_DIR "/shaders/host/attributes_probe.frag");
  struct Variant {
    Isa isa;
    Number number;
  };
  for (const Variant variant : {Variant{Isa::baseline, Number::lanes4},
                                {Isa::baseline, Number::scalar},
                                {Isa::baseline, Number::float64},
                                {Isa::avx2, Number::lanes8},
                                {Isa::avx512, Number::lanes16}}) {
    if (variant.isa > machine_isa()) continue;
    CAPTURE(int(variant.number));
    DrawOptions options;
    options.isa = variant.isa;
    options.number = variant.number;
    const Frame ours = draw_tiled(bundle, test::exact_values_module(), options);
    const Frame glsl = draw_tiled(bundle, load_module(source, variant.number, variant.isa), options);
    REQUIRE(ours.primitive_id == glsl.primitive_id);
    std::size_t different = 0, compared = 0;
    for (std::size_t p = 0; p < ours.coverage.size(); ++p)
      for (std::size_t c = 0; c < 4 && ours.coverage[p]; ++c) {
        const auto same = [](float a, float b) {
          return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
        };
        const float computed = glsl.color[4 * p + c];
        different += !same(ours.color[4 * p + c], computed);
        ++compared;
        // What decided the depth test is what the shader computes.
        if (c == 1 && variant.number != Number::float64) different += !same(ours.depth[p], computed);
      }
    CHECK(different == 0);
    CHECK(compared > 100000);
  }
}

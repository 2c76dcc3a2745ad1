// A shader module's inputs, uniforms, textures and buffers joined by name with those of a bundle.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "raster/renderer.h"
#include "raster/tiled/aligned.h"

namespace twinshade::tiled {

enum class Interpolation : std::uint8_t { smooth, linear, flat };  // linear: noperspective

struct BoundDraw {
  // Shader inputs of all vertices, interleaved: component c of vertex v at [v * input_components + c].
  std::vector<float> vertex_inputs;
  std::uint32_t input_components = 0;
  std::vector<Interpolation> interpolation;  // of each component
  std::vector<Scalar> input_scalars;         // of each component
  std::vector<std::string> component_names;  // "v_uv.x" ...

  std::vector<std::byte> uniforms;
  std::vector<TextureView> textures;  // their texels are the bundle's or laid out anew
  std::vector<AlignedArray<float>> laid_out;
  std::vector<TexelsAhead> ahead;
  std::vector<std::vector<std::byte>> buffer_bytes;  // copies: what a shader writes is gone after the draw
  std::vector<std::string> buffer_names;
  std::vector<BufferView> buffers;

  // The output that becomes Frame::color.
  std::uint32_t color_first = 0, color_components = 0;
  Scalar color_scalar = Scalar::f32;

  // Before drawing another frame: undoes what the shader wrote.
  void reset_buffers(const Bundle& bundle);
  ShaderData data() const { return {uniforms.data(), textures.data(), buffers.data()}; }
};

// output: as DrawOptions::output. UserError naming what the shader asks for and what the bundle has, where they do not
// fit.
BoundDraw bind(const Bundle& bundle, const ShaderModule& module, AttributeMode mode, std::uint32_t output = 0);

}  // namespace twinshade::tiled

// The shaders around a user's fragment shader: the vertex shader, and a main() that fills inputs and writes what a
// frame holds.
#pragma once

#include "raster/gl/fragment_rewrite.h"
#include "raster/gl/protocol.h"
#include "raster/renderer.h"

namespace twinshade::gl {

// Where the fragment shader's inputs come from.
enum class Supply {
  exact,      // vertex data in buffer textures, by shaders/exact/attributes.glsl
  varyings,   // GL's own interpolation
  texels,     // what the CPU captured, by texelFetch (softpipe)
  rows,       // rows of a table, one a fragment, by texelFetch: see row_grid.h
  row_quads,  // the same, one a 2 x 2 quad; two lines of the grid stand side by side, so that the frame is no higher
};

// File number that driver logs show for generated lines, so that they are not taken for the author's.
inline constexpr int kGeneratedFile = 1000;

// Names between generated shaders and the worker.
inline constexpr const char* kPositions = "twinshade_positions";     // one texel a vertex
inline constexpr const char* kVertexData = "twinshade_vertex_data";  // one texel a float: positions, then attributes
inline constexpr const char* kIndices = "twinshade_indices";
inline constexpr const char* kPositionBlock = "twinshade_Positions";  // the same as storage buffers (softpipe)
inline constexpr const char* kIndexBlock = "twinshade_Indices";
inline constexpr const char* kNdcScale = "twinshade_ndc_scale";
inline constexpr const char* kBases = "twinshade_base";  // float index of each leaf's values in the vertex data
inline constexpr const char* kCpuIds = "twinshade_cpu_ids";
inline constexpr const char* kCpuAttributes = "twinshade_cpu_attributes";

// Vertex attributes that carry leaves beside the position; with more, the vertex shader pulls from a buffer texture.
inline constexpr std::size_t kMostVertexAttributes = 15;

class ShaderGenerator {
 public:
  // glsl_version: 450, or 330 with extensions for softpipe. written_out: what is generated, too, has its divisions as
  // shaders/exact/written_out.glsl.
  ShaderGenerator(const ShaderSource& source, const FragmentShader& shader, std::vector<Input> inputs, Supply supply,
                  int glsl_version, bool written_out = false);

  // Named as the author does; as are the results.
  std::vector<InputLeaf> leaves() const;
  std::vector<std::string> component_names() const;  // as Frame::attribute_names
  std::vector<std::string> result_names() const;  // of what result() captures: kKept, then outputs, then gl_FragDepth
  Geometry geometry() const;

  // What the frame's colour is (DrawOptions::output), and the type of its components.
  void choose_output(std::uint32_t location) { output_ = int(location); }
  Scalar color_scalar() const;
  std::vector<Scalar> component_scalars() const;  // as Frame::attribute_scalars

  ProgramText frame() const;                       // colour and primitive id
  ProgramText timed() const;                       // colour only
  ProgramText prepass() const;                     // depth only
  ProgramText capture(std::uint32_t first) const;  // components [first, first + 4 * kCaptureTargets)
  ProgramText result(std::uint32_t first) const;   // the same of what the user's main() leaves behind

 private:
  std::string head() const;
  std::string fragment(const std::string& outputs, const std::string& before_user, const std::string& after_user) const;
  std::string covered_pixel() const;
  std::string row_pixel() const;
  std::string fill() const;
  struct ChosenOutput {
    const Output* output = nullptr;  // none: the shader has none
    std::uint32_t element = 0;       // of an array
  };
  ChosenOutput chosen_output() const;
  std::string color_expression() const;
  std::string vertex() const;
  bool needs_triangle() const;
  bool draws_rows() const;
  struct Component {
    std::string name, bits;  // a GLSL expression of type uint
  };
  std::vector<Component> results() const;

  const ShaderSource& source_;
  const FragmentShader& shader_;
  std::vector<Input> inputs_;
  Supply supply_;
  int glsl_version_;
  bool written_out_;
  int output_ = 0;  // location
  std::vector<InputLeaf> leaves_;
};

// Every vecN that inputs are made of, in order.
std::vector<InputLeaf> leaves_of(const std::vector<Input>& inputs);

// The result that is 1 where the shader did not discard.
inline constexpr const char* kKept = "twinshade_kept";

}  // namespace twinshade::gl

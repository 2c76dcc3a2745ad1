// The requests that a worker serves and its answers.
#pragma once

#include "bundle/bundle.h"
#include "raster/gl/wire.h"

namespace twinshade::gl {

struct ProgramText {
  std::string vertex, fragment;
  std::string compute = {};  // if not empty: alone

  void write(WireWriter& out) const { out.put(vertex), out.put(fragment), out.put(compute); }
  void read(WireReader& in) { in.get(vertex), in.get(fragment), in.get(compute); }
};

// One vecN of per-vertex data (an input, an element of an array, a column of a matrix), under its name in the bundle.
struct InputLeaf {
  std::string name;  // also a GLSL expression: "v_uv", "c[3]", "m[1]"
  Scalar scalar = Scalar::f32;
  std::uint32_t components = 1;

  void write(WireWriter& out) const { out.put(name), out.put(scalar), out.put(components); }
  void read(WireReader& in) { in.get(name), in.get(scalar), in.get(components); }
};

// The bundle's big parts, in shared memory: see bundle_image.h.
struct ImageTexture {
  std::string name;
  TextureKind kind;
  std::uint32_t width, height, layers;
  Filter filter;
  Wrap wrap;
  std::uint64_t offset;

  void write(WireWriter& out) const {
    out.put(name), out.put(kind), out.put(width), out.put(height), out.put(layers), out.put(filter), out.put(wrap),
        out.put(offset);
  }
  void read(WireReader& in) {
    in.get(name), in.get(kind), in.get(width), in.get(height), in.get(layers), in.get(filter), in.get(wrap),
        in.get(offset);
  }
};

struct ImageBuffer {
  std::string name;
  bool storage;
  std::uint64_t offset, size;

  void write(WireWriter& out) const { out.put(name), out.put(storage), out.put(offset), out.put(size); }
  void read(WireReader& in) { in.get(name), in.get(storage), in.get(offset), in.get(size); }
};

struct ImageAttribute {
  std::string name;
  std::uint32_t components;
  std::uint64_t first;  // float index into the vertex data, whose first 4 * vertex_count floats are the clip positions

  void write(WireWriter& out) const { out.put(name), out.put(components), out.put(first); }
  void read(WireReader& in) { in.get(name), in.get(components), in.get(first); }
};

struct ImageIndex {
  std::uint64_t vertex_count = 0, vertex_floats = 0, index_count = 0;
  std::uint64_t vertices = 0, indices = 0,
                drawn_indices = 0;  // offsets; drawn_indices: non-finite triangles made empty
  std::vector<ImageAttribute> attributes;
  std::vector<ImageTexture> textures;
  std::vector<ImageBuffer> buffers;

  void write(WireWriter& out) const {
    out.put(vertex_count), out.put(vertex_floats), out.put(index_count);
    out.put(vertices), out.put(indices), out.put(drawn_indices);
    out.put(attributes), out.put(textures), out.put(buffers);
  }
  void read(WireReader& in) {
    in.get(vertex_count), in.get(vertex_floats), in.get(index_count);
    in.get(vertices), in.get(indices), in.get(drawn_indices);
    in.get(attributes), in.get(textures), in.get(buffers);
  }
};

struct UniformValue {
  std::string name;
  Scalar scalar;
  std::uint32_t columns, rows, array_length;
  std::vector<float> values;

  void write(WireWriter& out) const {
    out.put(name), out.put(scalar), out.put(columns), out.put(rows), out.put(array_length), out.put(values);
  }
  void read(WireReader& in) {
    in.get(name), in.get(scalar), in.get(columns), in.get(rows), in.get(array_length), in.get(values);
  }
};

enum class Geometry : std::uint8_t {
  attributes,   // triangles; one vertex attribute per leaf behind the position
  pulled,       // triangles; shaders read vertex data from buffer textures
  full_screen,  // one triangle over the frame; the shader reads `cpu` pixels
  rows,         // the same; the frame is a grid of rows, and only captures are drawn
};

// Where the parts of a frame lie in the shared memory of a draw, in bytes. Planes of `cpu` pixels (full_screen) lie
// behind what the worker writes.
struct FrameLayout {
  std::uint64_t color = 0, depth = 0, id = 0, attributes = 0, cpu_id = 0, cpu_attributes = 0, size = 0;
};
std::uint64_t storage_bytes(const ImageIndex& image);  // of all storage buffers as a dispatch gives them back
FrameLayout frame_layout(std::uint64_t pixels, std::uint64_t components, bool full_screen);
// Geometry::rows: inputs in cpu_attributes, results in attributes.
FrameLayout row_layout(std::uint64_t pixels, std::uint64_t components, std::uint64_t results);

// Or a dispatch: `frame` is a compute shader, run over `groups` work groups, and the image's storage buffers come back
// in the shared memory, one after another in their order, each from a multiple of 64 bytes on.
struct DrawRequest {
  std::uint32_t groups[3] = {0, 0, 0};
  std::uint32_t width = 0, height = 0;
  bool cull_back_faces = false;
  Geometry geometry = Geometry::attributes;
  std::vector<InputLeaf> leaves;
  std::uint32_t components = 0;       // of all leaves
  std::uint32_t results = 0;          // Geometry::rows: components that the captures write
  ProgramText frame;                  // writes colour (attachment 0) and primitive id (1)
  std::vector<ProgramText> captures;  // each writes the next kCaptureTargets * 4 components to RGBA32UI attachments
  ProgramText timed;                  // colour only; used if `timing`
  ProgramText prepass;                // depth only; used if `prepass_wanted`
  bool timing = false, prepass_wanted = false;
  std::int32_t repeat = 1, warmup = 0;
  double time_limit_seconds = 60;
  std::vector<UniformValue> uniforms;
  std::vector<std::string> initialized;  // uniforms of which the shader has values and the bundle none
  bool new_image = false;
  ImageIndex image;  // if new_image

  void write(WireWriter& out) const;
  void read(WireReader& in);
};

inline constexpr std::uint32_t kCaptureTargets = 4;

enum class Outcome : std::uint8_t {
  ok,
  user_error,     // text: what is missing or mismatched
  backend_error,  // text: why the driver cannot
  glsl_error,     // text: the driver's log of the fragment shader
};

struct DrawReply {
  Outcome outcome = Outcome::ok;
  std::string text;
  std::vector<std::pair<std::string, double>> milliseconds;
  std::vector<std::pair<std::string, std::string>> provenance;

  void write(WireWriter& out) const { out.put(outcome), out.put(text), out.put(milliseconds), out.put(provenance); }
  void read(WireReader& in) { in.get(outcome), in.get(text), in.get(milliseconds), in.get(provenance); }
};

}  // namespace twinshade::gl

#include "raster/gl/generated_shaders.h"

#include <algorithm>

#include "cpu_shaders/rewrite/make_exact.h"
#include "cpu_shaders/source/output_locations.h"
#include "cpu_shaders/source/preprocess.h"
#include "raster/gl/author_names.h"
#include "raster/gl/extended_products.h"
#include "raster/row_grid.h"

namespace twinshade::gl {
namespace {

const char kComponent[] = "xyzw";

std::string number(std::size_t value) { return std::to_string(value); }

std::string attribute_functions_text(bool written_out) {
  ShaderSource source = resolve_shader("attributes", "#include \"exact/attributes.glsl\"\n", "shaders/generated.glsl");
  if (written_out) {
    source.text += "\nvoid main() {}\n";  // make_exact takes whole shaders
    source = make_exact(source, ExactScope::written_out).source;
    source.text.resize(source.text.rfind("void"));
  }
  const TokenList tokens = tokenize(source);
  std::string functions;  // without its #line: in a driver's log these are generated lines
  for (const Token& token : tokens.tokens) {
    bool own = token.text == "ExactBarycentrics";
    for (const char* prefix : {"exact_", "written_", "WRITTEN_"}) own = own || token.text.rfind(prefix, 0) == 0;
    functions += (token.before.empty() ? "" : " ") + std::string(own ? kPrefix : "") + token.text;
  }
  return functions + "\n";
}

// shaders/exact/attributes.glsl under names that a user's shader cannot have.
const std::string& attribute_functions(bool written_out) {
  if (written_out) {
    static const std::string text = attribute_functions_text(true);
    return text;
  }
  static const std::string text = attribute_functions_text(false);
  return text;
}

std::string component(const InputLeaf& leaf, std::uint32_t c) {
  return leaf.components == 1 ? leaf.name : leaf.name + "." + kComponent[c];
}

std::string as_bits(const InputLeaf& leaf, std::uint32_t c) {
  const std::string value = component(leaf, c);
  return leaf.scalar == Scalar::f32 ? "floatBitsToUint(" + value + ")" : "uint(" + value + ")";
}

std::string from_bits(Scalar scalar, const std::string& bits) {
  return scalar == Scalar::f32 ? "uintBitsToFloat(" + bits + ")" : scalar == Scalar::i32 ? "int(" + bits + ")" : bits;
}

std::string glsl_type(const InputLeaf& leaf) {
  const std::string prefix = leaf.scalar == Scalar::f32 ? "" : leaf.scalar == Scalar::i32 ? "i" : "u";
  if (leaf.components > 1) return prefix + "vec" + number(leaf.components);
  return leaf.scalar == Scalar::f32 ? "float" : leaf.scalar == Scalar::i32 ? "int" : "uint";
}

// Vertex data, shared by the exact fragment shader and the pulling vertex shader. Buffer textures rather than storage
// buffers: llvmpipe loads nothing from those in the uncovered pixels of a 2 x 2 quad, which derivatives need.
std::string vertex_data(std::size_t leaf_count) {
  return "uniform usamplerBuffer " + std::string(kVertexData) + ";\nuniform int " + kBases + "[" +
         number(std::max<std::size_t>(leaf_count, 1)) +
         "];\n"
         "uint twinshade_bits(int base, int vertex, int components, int c) {\n"
         "  return texelFetch(twinshade_vertex_data, base + vertex * components + c).x;\n"
         "}\n";
}

struct CaptureText {
  std::string outputs, stores;  // declarations, statements
};

// uint expressions values[first] ... to RGBA32UI attachments, four to each.
CaptureText capture_text(const std::vector<std::string>& values, std::uint32_t first) {
  CaptureText text;
  for (std::uint32_t target = 0; target < kCaptureTargets && first + target * 4 < values.size(); ++target) {
    const std::string name = "twinshade_capture" + number(target);
    text.outputs += "layout(location = " + number(target) + ") out uvec4 " + name + ";\n";
    text.stores += "  " + name + " = uvec4(";
    for (std::uint32_t c = 0; c < 4; ++c) {
      const std::size_t index = first + target * 4 + c;
      text.stores += (c == 0 ? "" : ", ") + (index < values.size() ? values[index] : "0u");
    }
    text.stores += ");\n";
  }
  return text;
}

}  // namespace

std::vector<InputLeaf> leaves_of(const std::vector<Input>& inputs) {
  std::vector<InputLeaf> leaves;
  for (const Input& input : inputs)
    for (std::uint32_t element = 0; element < std::max(input.array_length, 1u); ++element)
      for (std::uint32_t column = 0; column < input.columns; ++column) {
        std::string name = input.name;
        if (input.array_length != 0) name += "[" + number(element) + "]";
        if (input.columns != 1) name += "[" + number(column) + "]";
        leaves.push_back({name, input.scalar, input.rows});
      }
  return leaves;
}

ShaderGenerator::ShaderGenerator(const ShaderSource& source, const FragmentShader& shader, std::vector<Input> inputs,
                                 Supply supply, int glsl_version, bool written_out)
    : source_(source),
      shader_(shader),
      inputs_(std::move(inputs)),
      supply_(supply),
      glsl_version_(glsl_version),
      written_out_(written_out),
      leaves_(leaves_of(inputs_)) {}

std::vector<InputLeaf> ShaderGenerator::leaves() const {
  std::vector<InputLeaf> leaves = leaves_;
  for (InputLeaf& leaf : leaves) leaf.name = author_name(leaf.name);
  return leaves;
}

std::vector<std::string> ShaderGenerator::component_names() const {
  std::vector<std::string> names;
  for (const InputLeaf& leaf : leaves())
    for (std::uint32_t c = 0; c < leaf.components; ++c) names.push_back(component(leaf, c));
  return names;
}

Geometry ShaderGenerator::geometry() const {
  if (supply_ == Supply::texels) return Geometry::full_screen;
  if (draws_rows()) return Geometry::rows;
  if (supply_ == Supply::exact || leaves_.size() > kMostVertexAttributes) return Geometry::pulled;
  return Geometry::attributes;
}

// softpipe has GLSL 3.30 and the rest by extensions; an unknown one there is a warning only.
std::string ShaderGenerator::head() const {
  std::string head = "#version " + std::to_string(glsl_version_) + " core\n";
  if (glsl_version_ == 330)
    for (const char* extension :
         {"ARB_gpu_shader5", "ARB_shader_storage_buffer_object", "ARB_shading_language_420pack",
          "ARB_explicit_uniform_location", "ARB_shading_language_packing", "ARB_arrays_of_arrays",
          "ARB_shader_image_load_store", "ARB_texture_query_levels", "ARB_enhanced_layouts", "EXT_shader_integer_mix"})
      head += "#extension GL_" + std::string(extension) + " : enable\n";
  if (!source_.es)  // what ES shaders ask for is part of desktop GLSL 4.50
    for (const std::string& extension : shader_.extensions) head += extension + "\n";
  // Blocks that name no layout have the translation's: a driver's own would be as it likes.
  return head + "#line 1 " + number(kGeneratedFile) + "\nlayout(std140) uniform;\n" +
         (glsl_version_ == 330 ? "" : "layout(std430) buffer;\n");
}

bool ShaderGenerator::needs_triangle() const {
  return supply_ == Supply::exact || (supply_ == Supply::texels && shader_.uses_fragment_position);
}

bool ShaderGenerator::draws_rows() const { return supply_ == Supply::rows || supply_ == Supply::row_quads; }

// Which pixel of the CPU's frame to shade. softpipe takes the element that a store with a variable index goes to from
// the first pixel of a quad, wherever that one is: a pixel that left the shader early would send the others' loops
// astray. So pixels that the CPU did not cover shade a covered pixel of their quad, if there is one, and are discarded
// in the end. Where the shader writes to memory they are discarded at once.
std::string ShaderGenerator::covered_pixel() const {
  std::string text =
      "  ivec2 twinshade_pixel = ivec2(gl_FragCoord.xy);\n"
      "  uint twinshade_id = texelFetch(twinshade_cpu_ids, twinshade_pixel, 0).x;\n"
      "  twinshade_covered = twinshade_id != 0xffffffffu;\n";
  if (shader_.has_storage) return text + "  if (!twinshade_covered) discard;\n";
  return text +
         "  ivec2 twinshade_last = textureSize(twinshade_cpu_ids, 0) - 1;\n"
         "  for (int k = 1; k < 4; ++k) {\n"
         "    ivec2 twinshade_other = min(ivec2(gl_FragCoord.xy) ^ ivec2(k & 1, k >> 1), twinshade_last);\n"
         "    uint twinshade_other_id = texelFetch(twinshade_cpu_ids, twinshade_other, 0).x;\n"
         "    bool twinshade_taken = twinshade_id == 0xffffffffu && twinshade_other_id != 0xffffffffu;\n"
         "    twinshade_pixel = twinshade_taken ? twinshade_other : twinshade_pixel;\n"
         "    twinshade_id = twinshade_taken ? twinshade_other_id : twinshade_id;\n"
         "  }\n"
         "  if (twinshade_id == 0xffffffffu) discard;\n";
}

// Where a row's inputs are, and its place on the grid. softpipe takes the element that a store goes to from the first
// pixel of a quad, whichever row that is: there all four pixels are one row.
std::string ShaderGenerator::row_pixel() const {
  const std::string built_ins =
      "  twinshade_FrontFacing = true;\n"
      "  twinshade_PrimitiveID = 0;\n";
  if (supply_ == Supply::rows)
    return "  ivec2 twinshade_pixel = ivec2(gl_FragCoord.xy);\n"
           "  twinshade_FragCoord = vec4(gl_FragCoord.xy, 0.5, 1.0);\n" +
           built_ins;
  const std::string width = number(kGridWidth);
  return "  ivec2 twinshade_quad = ivec2(gl_FragCoord.xy) / 2, twinshade_pixel = twinshade_quad * 2;\n"
         "  ivec2 twinshade_place = ivec2(twinshade_quad.x % " +
         width + ", twinshade_pixel.y + twinshade_quad.x / " + width +
         ");\n"
         "  twinshade_FragCoord = vec4(vec2(twinshade_place) + 0.5, 0.5, 1.0);\n" +
         built_ins;
}

// Statements that give every input its value, and the built-ins that depend on it.
std::string ShaderGenerator::fill() const {
  if (supply_ == Supply::varyings) return "";
  std::string text;
  if (supply_ == Supply::texels)
    text += covered_pixel() + "  twinshade_PrimitiveID = int(twinshade_id);\n";
  else if (draws_rows())
    text += row_pixel();
  else
    text += "  twinshade_PrimitiveID = gl_PrimitiveID;\n";
  if (needs_triangle()) {
    text +=
        "  int twinshade_v[3];\n  vec4 twinshade_p[3];\n"
        "  for (int k = 0; k < 3; ++k) {\n"
        "    twinshade_v[k] = int(twinshade_index(twinshade_PrimitiveID * 3 + k));\n"
        "    twinshade_p[k] = uintBitsToFloat(twinshade_position(uint(twinshade_v[k])));\n"
        "  }\n"
        "  precise vec2 twinshade_ndc = gl_FragCoord.xy * twinshade_ndc_scale - 1.0;\n"
        "  twinshade_ExactBarycentrics twinshade_b =\n"
        "      twinshade_exact_barycentrics(twinshade_p[0], twinshade_p[1], twinshade_p[2], twinshade_ndc);\n"
        "  twinshade_FragCoord = vec4(gl_FragCoord.xy, twinshade_b.depth, twinshade_b.reciprocal_w);\n"
        "  twinshade_FrontFacing = twinshade_b.front_facing;\n";
  }
  if (supply_ == Supply::exact) text += "  gl_FragDepth = twinshade_b.depth;\n";

  std::size_t leaf_number = 0, plane = 0;
  for (const Input& input : inputs_) {
    const bool flat = input.interpolation == "flat";
    for (const InputLeaf& leaf : leaves_of({input})) {
      const std::string base = "twinshade_base[" + number(leaf_number++) + "]";
      for (std::uint32_t c = 0; c < leaf.components; ++c, ++plane) {
        const auto at = [&](int corner) {
          return from_bits(leaf.scalar, "twinshade_bits(" + base + ", twinshade_v[" + number(std::size_t(corner)) +
                                            "], " + number(leaf.components) + ", " + number(c) + ")");
        };
        std::string value;
        if (supply_ == Supply::texels || draws_rows())
          value = from_bits(leaf.scalar,
                            "texelFetch(twinshade_cpu_attributes, ivec3(twinshade_pixel, " + number(plane) + "), 0).x");
        else if (flat)
          value = at(2);  // the provoking vertex is the last
        else
          value = "twinshade_exact_interpolate(" + at(0) + ", " + at(1) + ", " + at(2) + ", twinshade_b.weight)";
        text += "  " + component(leaf, c) + " = " + value + ";\n";
      }
    }
  }
  return text;
}

std::string ShaderGenerator::fragment(const std::string& outputs, const std::string& before_user,
                                      const std::string& after_user) const {
  std::string text = head();
  if (supply_ == Supply::exact)
    text += vertex_data(leaves_.size()) + "uniform usamplerBuffer " + kPositions + ", " + kIndices +
            ";\nuint twinshade_index(int i) { return texelFetch(twinshade_indices, i).x; }\n"
            "uvec4 twinshade_position(uint vertex) { return texelFetch(twinshade_positions, int(vertex)); }\n";
  else if (needs_triangle())  // softpipe's buffer textures hold 65,536 texels only
    text += "layout(std430) readonly buffer " + std::string(kPositionBlock) +
            " { uvec4 twinshade_position_list[]; };\nlayout(std430) readonly buffer " + kIndexBlock +
            " { uint twinshade_index_list[]; };\nuint twinshade_index(int i) { return twinshade_index_list[i]; }\n"
            "uvec4 twinshade_position(uint vertex) { return twinshade_position_list[vertex]; }\n";
  if (needs_triangle()) text += "uniform vec2 twinshade_ndc_scale;\n" + attribute_functions(written_out_);
  if (supply_ == Supply::texels) text += "uniform usampler2D twinshade_cpu_ids;\nbool twinshade_covered;\n";
  if (supply_ == Supply::texels || draws_rows()) text += "uniform usampler2DArray twinshade_cpu_attributes;\n";
  if (supply_ != Supply::varyings)
    text += "vec4 twinshade_FragCoord;\nbool twinshade_FrontFacing;\nint twinshade_PrimitiveID;\n";
  if (shader_.extended_products) text += extended_product_functions();
  text += "#line 1 0\n" + shader_.text;
  text += "\n#line 1 " + number(kGeneratedFile) + "\n" + outputs + "void main() {\n" + fill() + before_user;
  for (const std::string& function : shader_.initializers) text += "  " + function + "();\n";
  text += "  " + std::string(kUserMain) + "();\n" + after_user;
  if (supply_ == Supply::texels) text += "  if (!twinshade_covered) discard;\n";
  return text + "}\n";
}

// The output at a location, or the first.
ShaderGenerator::ChosenOutput ShaderGenerator::chosen_output() const {
  if (shader_.outputs.empty()) return {};
  ChosenOutput chosen{&shader_.outputs.front(), 0};
  const auto count = [](const Output& output) { return std::max(1, int(output.array_length)); };
  const auto consider = [&](const Output& output, int first) {
    if (output_ >= first && output_ < first + count(output)) chosen = {&output, std::uint32_t(output_ - first)};
  };
  OutputLocations locations;
  for (const Output& output : shader_.outputs) {
    if (output.location < 0) continue;
    locations.take(output.location, count(output));
    consider(output, output.location);
  }
  for (const Output& output : shader_.outputs)
    if (output.location < 0) consider(output, locations.take_lowest(count(output)));
  return chosen;
}

Scalar ShaderGenerator::color_scalar() const {
  const ChosenOutput chosen = chosen_output();
  return chosen.output != nullptr ? chosen.output->scalar : Scalar::f32;
}

std::vector<Scalar> ShaderGenerator::component_scalars() const {
  std::vector<Scalar> scalars;
  for (const InputLeaf& leaf : leaves_) scalars.insert(scalars.end(), leaf.components, leaf.scalar);
  return scalars;
}

// The output as the frame keeps it: missing components 0, integers by bit pattern.
std::string ShaderGenerator::color_expression() const {
  const auto [output, element] = chosen_output();
  if (output == nullptr) return "vec4(0.0)";
  std::string text = "vec4(";
  for (std::uint32_t c = 0; c < 4; ++c) {
    std::string value = "0.0";
    if (c < output->components) {
      value = output->name + (output->array_length != 0 ? "[" + number(element) + "]" : "") +
              (output->components > 1 ? std::string(".") + kComponent[c] : "");
      if (output->scalar == Scalar::i32) value = "intBitsToFloat(" + value + ")";
      if (output->scalar == Scalar::u32) value = "uintBitsToFloat(" + value + ")";
    }
    text += (c == 0 ? "" : ", ") + value;
  }
  return text + ")";
}

std::string ShaderGenerator::vertex() const {
  if (supply_ == Supply::texels || draws_rows())
    return "#version 330 core\n"
           "void main() {\n"
           "  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
           "}\n";
  std::string text = "#version 450 core\nlayout(location = 0) in vec4 twinshade_position;\n";
  std::string body = "  gl_Position = twinshade_position;\n";
  if (supply_ == Supply::varyings) {
    const bool pulled = geometry() == Geometry::pulled;
    if (pulled) text += vertex_data(leaves_.size());
    for (const Input& input : inputs_) {
      text += input.interpolation + (input.interpolation.empty() ? "" : " ") +
              (input.per_sample ? "sample out " : "out ") + input.type + " " + input.name;
      text += (input.array_length == 0 ? "" : "[" + number(input.array_length) + "]") + ";\n";
    }
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      const InputLeaf& leaf = leaves_[i];
      if (!pulled) {
        const std::string name = "twinshade_leaf" + number(i);
        text += "layout(location = " + number(i + 1) + ") in " + glsl_type(leaf) + " " + name + ";\n";
        body += "  " + leaf.name + " = " + name + ";\n";
        continue;
      }
      for (std::uint32_t c = 0; c < leaf.components; ++c)
        body += "  " + component(leaf, c) + " = " +
                from_bits(leaf.scalar, "twinshade_bits(twinshade_base[" + number(i) + "], gl_VertexID, " +
                                           number(leaf.components) + ", " + number(c) + ")") +
                ";\n";
    }
  }
  return text + "void main() {\n" + body + "}\n";
}

ProgramText ShaderGenerator::frame() const {
  const std::string id = supply_ == Supply::varyings ? "uint(gl_PrimitiveID)" : "uint(twinshade_PrimitiveID)";
  return {vertex(),
          fragment("layout(location = 0) out vec4 twinshade_color;\nlayout(location = 1) out uint twinshade_id_out;\n",
                   "", "  twinshade_color = " + color_expression() + ";\n  twinshade_id_out = " + id + ";\n")};
}

ProgramText ShaderGenerator::timed() const {
  return {vertex(), fragment("layout(location = 0) out vec4 twinshade_color;\n", "",
                             "  twinshade_color = " + color_expression() + ";\n")};
}

ProgramText ShaderGenerator::prepass() const {
  FragmentShader empty;
  empty.text = "void " + std::string(kUserMain) + "() {}\n";
  const ShaderGenerator depth_only(source_, empty, {}, supply_, glsl_version_);
  return {depth_only.vertex(), depth_only.fragment("", "", "")};
}

std::vector<ShaderGenerator::Component> ShaderGenerator::results() const {
  std::vector<Component> components;
  if (shader_.discards) components.push_back({kKept, "1u"});
  for (const Output& output : shader_.outputs)
    for (std::uint32_t element = 0; element < std::max(output.array_length, 1u); ++element) {
      const std::string index = output.array_length == 0 ? "" : "[" + number(element) + "]";
      const InputLeaf leaf{output.name + index, output.scalar, output.components};
      for (std::uint32_t c = 0; c < leaf.components; ++c) components.push_back({component(leaf, c), as_bits(leaf, c)});
    }
  if (shader_.writes_depth) components.push_back({"gl_FragDepth", "floatBitsToUint(gl_FragDepth)"});
  return components;
}

std::vector<std::string> ShaderGenerator::result_names() const {
  std::vector<std::string> names;
  for (const Component& component : results()) names.push_back(author_name(component.name));
  return names;
}

ProgramText ShaderGenerator::result(std::uint32_t first) const {
  std::vector<std::string> values;
  for (const Component& component : results()) values.push_back(component.bits);
  const CaptureText text = capture_text(values, first);
  return {vertex(), fragment(text.outputs, "", text.stores)};
}

ProgramText ShaderGenerator::capture(std::uint32_t first) const {
  std::vector<std::string> values;
  for (const InputLeaf& leaf : leaves_)
    for (std::uint32_t c = 0; c < leaf.components; ++c) values.push_back(as_bits(leaf, c));
  const CaptureText text = capture_text(values, first);
  return {vertex(), fragment(text.outputs, text.stores, "")};
}

}  // namespace twinshade::gl

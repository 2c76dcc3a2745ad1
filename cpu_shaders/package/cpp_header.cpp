#include "cpu_shaders/package/cpp_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/hash.h"
#include "cpu_shaders/package/declaration_order.h"
#include "cpu_shaders/package/value_tree.h"

namespace twinshade {
namespace {

// A value is an `in`, `out` or uniform: scalar, vector (columns 1) or matrix.
template <class Value>
std::string glsl_type(const Value& value) {
  static constexpr const char* kScalars[] = {"float", "int", "uint", "bool"};
  static constexpr const char* kPrefixes[] = {"", "i", "u", "b"};
  if (value.columns > 1) {
    const std::string name = "mat" + std::to_string(value.columns);
    return value.columns == value.rows ? name : name + "x" + std::to_string(value.rows);
  }
  if (value.rows > 1) return std::string(kPrefixes[int(value.scalar)]) + "vec" + std::to_string(value.rows);
  return kScalars[int(value.scalar)];
}

// real: what GLSL's float becomes. Vectors are arrays, matrices arrays of columns.
template <class Value>
std::string cpp_type(const Value& value, const std::string& real) {
  const std::string scalars[] = {real, "std::int32_t", "std::uint32_t", "bool"};
  std::vector<std::uint32_t> extents;
  if (value.columns > 1) extents.push_back(value.columns);
  if (value.rows > 1) extents.push_back(value.rows);
  return in_arrays(scalars[int(value.scalar)], extents);
}

// Exactly this value.
std::string float_literal(std::uint32_t bits) {
  const float value = std::bit_cast<float>(bits);
  if (!std::isfinite(value)) return "std::bit_cast<float>(" + std::to_string(bits) + "u)";
  char text[32];
  std::string literal(text, std::to_chars(text, text + sizeof text, value).ptr);
  if (literal.find_first_of(".e") == std::string::npos) literal += ".0";
  return literal + "f";
}

std::string literal(Scalar scalar, std::uint32_t bits) {
  switch (scalar) {
    case Scalar::i32:
      return bits == 0x80000000u ? "-2147483647 - 1" : std::to_string(std::int32_t(bits));
    case Scalar::u32:
      return std::to_string(bits) + "u";
    case Scalar::boolean:
      return bits != 0 ? "true" : "false";
    default:
      return float_literal(bits);
  }
}

// What the shader gives a uniform, in the braces of cpp_type's arrays; empty where that is zero.
std::string initial_value(const ReflectedUniform& u) {
  if (std::all_of(u.initial.begin(), u.initial.end(), [](std::uint32_t word) { return word == 0; })) return "";
  std::vector<std::string> values;
  for (const std::uint32_t word : u.initial) values.push_back(literal(u.scalar, word));
  // From the innermost arrays outwards: as many values become one.
  const auto join = [&](std::size_t count) {
    std::vector<std::string> arrays;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k % count == 0) arrays.emplace_back();
      arrays.back() += (k % count == 0 ? "{{" : ", ") + values[k] + (k % count == count - 1 ? "}}" : "");
    }
    values = arrays;
  };
  if (u.rows > 1) join(u.rows);
  if (u.columns > 1) join(u.columns);
  if (u.array_length > 0) join(u.array_length);
  return values[0];
}

const char* sampler_name(ResourceKind kind) {
  if (kind == ResourceKind::sampler_2d_array) return "sampler2DArray";
  return kind == ResourceKind::sampler_cube ? "samplerCube" : "sampler2D";
}
const char* texture_kind(ResourceKind kind) {
  if (kind == ResourceKind::sampler_2d_array) return "two_d_array";
  return kind == ResourceKind::sampler_cube ? "cube" : "two_d";
}
bool is_block(ResourceKind kind) { return kind == ResourceKind::uniform_block || kind == ResourceKind::storage_buffer; }

std::vector<ValueNode> uniform_tree(const Reflection& reflection) {
  std::vector<ValueNode> nodes;
  for (const ReflectedUniform& u : reflection.uniforms)
    add_value(nodes, u.name, u.array_length, cpp_type(u, "float"), glsl_type(u), initial_value(u));
  for (const ReflectedResource& r : reflection.resources) {
    if (r.kind == ResourceKind::uniform_block)
      add_value(nodes, r.name, 0, "std::span<const std::byte>",
                "uniform block, " + std::to_string(r.minimum_size) + " bytes as GLSL lays them out:");
    else if (r.kind == ResourceKind::storage_buffer)
      add_value(nodes, r.name, 0, "std::span<std::byte>",
                "buffer, at least " + std::to_string(r.minimum_size) + " bytes as GLSL lays them out:");
    else
      add_value(nodes, r.name, 0, "twinshade::TextureView", sampler_name(r.kind));
  }
  name_members(nodes, {});
  return nodes;
}

// own: members beside the variables.
std::vector<ValueNode> variable_tree(const std::vector<ReflectedVariable>& variables,
                                     const std::vector<std::string>& own) {
  std::vector<ValueNode> nodes;
  for (const ReflectedVariable& v : variables)
    add_value(nodes, v.name, v.array_length, cpp_type(v, "Real"), glsl_type(v));
  name_members(nodes, own);
  return nodes;
}

class HeaderWriter {
 public:
  HeaderWriter(const std::string& name, const Translation& translation, const ShaderSource& source,
               const std::vector<std::string>& isas)
      : name_(name),
        identifier_(translation.identifier),
        reflection_(translation.reflection),
        file_(std::filesystem::path(source.files[0]).filename().string()),
        order_(declared_names(source.text)),
        isas_(isas),
        uniforms_(in_order(uniform_tree(reflection_))),
        inputs_(in_order(variable_tree(reflection_.inputs, {}))),
        outputs_(
            in_order(variable_tree(reflection_.outputs, reflection_.discards ? std::vector<std::string>{"discarded"}
                                                                             : std::vector<std::string>{}))) {}

  std::string header() const {
    const Reflection& r = reflection_;
    std::string text =
        "// " + name_ + ": made by twinshade from " + file_ +
        "; changes are lost. Vectors are std::array, matrices std::array of columns.\n"
        "// All calls are safe from several threads at once; they throw std::invalid_argument where a texture or block "
        "is missing or\n// the spans differ in length.\n"
        "#pragma once\n\n#include <array>\n#include <bit>\n#include <cstddef>\n#include <cstdint>\n#include <span>\n\n"
        "#include \"cpu_shaders/package/shader_types.h\"\n\n" +
        macros_aside() + open_namespaces() + "\n";
    text +=
        "// The same for all invocations; in float in double calls too. Textures and blocks stay the caller's.\nstruct "
        "Uniforms {\n" +
        declare_values(uniforms_, "  ") + "};\n\n";
    text += "// Of one invocation. Real: float or double.\ntemplate <class Real>\nstruct BasicInputs {\n" +
            declare_values(inputs_, "  ");
    if (r.uses_frag_coord) text += "  std::array<Real, 4> gl_FragCoord{};\n";
    if (r.uses_front_facing) text += "  bool gl_FrontFacing = true;\n";
    if (r.uses_primitive_id) text += "  std::int32_t gl_PrimitiveID = 0;\n";
    text += "};\ntemplate <class Real>\nstruct BasicOutputs {\n" + declare_values(outputs_, "  ");
    if (r.writes_depth) text += "  Real gl_FragDepth{};\n";
    if (r.discards) text += "  bool discarded = false;  // the others are then 0\n";
    text += "};\nusing Inputs = BasicInputs<float>;\nusing Outputs = BasicOutputs<float>;\n\n";
    text += one_comment() + "Outputs shade(const Uniforms& uniforms, const Inputs& inputs);\n";
    text += many_comment() +
            "void shade(const Uniforms& uniforms, std::span<const Inputs> inputs, std::span<Outputs> outputs);\n\n";
    if (has_double()) {
      text +=
          "// The same shader in double.\nusing InputsDouble = BasicInputs<double>;\nusing OutputsDouble = "
          "BasicOutputs<double>;\n"
          "OutputsDouble shade(const Uniforms& uniforms, const InputsDouble& inputs);\n"
          "void shade(const Uniforms& uniforms, std::span<const InputsDouble> inputs, std::span<OutputsDouble> "
          "outputs);\n\n";
    } else {
      text += "// Not in double: " + r.no_float64_reason + "\n\n";
    }
    return text + close_namespaces() + macros_back();
  }

  std::string calls() const {
    std::string text = "// " + name_ + ": calls of " + name_ + ".h, made by twinshade from " + file_ + "\n#include \"" +
                       name_ + ".h\"\n\n#include \"cpu_shaders/package/call.h\"\n\nnamespace twinshade {\n";
    for (const std::string& isa : isas_)
      text +=
          "extern const ShaderEntry " + entries(isa) + "[];\nextern const std::uint32_t " + entry_count(isa) + ";\n";
    text += "}  // namespace twinshade\n\n";
    for (const std::string& name : names()) text += "#undef " + name + "\n";  // a header above may have it as a macro
    text += "\n" + open_namespaces() + "namespace {\n\nnamespace package = twinshade::package;\n\n";
    text += bound_struct() + rows_struct() + entry_functions();
    text += "}  // namespace\n\n" + definitions("Inputs", "Outputs", "float", "Number::scalar", "widest()");
    if (has_double())
      text += definitions("InputsDouble", "OutputsDouble", "double", "Number::float64",
                          "scalar(twinshade::Number::float64)");
    return text + close_namespaces();
  }

 private:
  std::vector<ValueNode> in_order(std::vector<ValueNode> nodes) const {
    const auto place = [&](const ValueNode& node) { return std::find(order_.begin(), order_.end(), node.name); };
    std::stable_sort(nodes.begin(), nodes.end(),
                     [&](const ValueNode& a, const ValueNode& b) { return place(a) < place(b); });
    return nodes;
  }

  // What the author may have called as some macro is called that headers before this one define.
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto* nodes : {&uniforms_, &inputs_, &outputs_}) add_names(*nodes, names);
    return names;
  }
  std::string macros_aside() const {
    std::string text;
    for (const std::string& name : names()) text += "#pragma push_macro(\"" + name + "\")\n#undef " + name + "\n";
    return text.empty() ? "" : "// A macro that the program has must not replace a member's name.\n" + text + "\n";
  }
  std::string macros_back() const {
    std::string text;
    for (const std::string& name : names()) text += "#pragma pop_macro(\"" + name + "\")\n";
    return text.empty() ? "" : "\n" + text;
  }

  bool has_double() const { return reflection_.no_float64_reason.empty(); }
  // The inner one tells shaders of one name apart that are linked into one program.
  std::string open_namespaces() const { return "namespace " + name_ + " {\ninline namespace " + identifier_ + " {\n"; }
  std::string close_namespaces() const {
    return "}  // namespace " + identifier_ + "\n}  // namespace " + name_ + "\n";
  }
  std::string entries(const std::string& isa) const { return "twinshade_entries_" + identifier_ + "_" + isa; }
  std::string entry_count(const std::string& isa) const { return "twinshade_entry_count_" + identifier_ + "_" + isa; }

  std::string one_comment() const {
    return reflection_.uses_derivatives ? "// One invocation, alone in its quad: derivatives are 0.\n"
                                        : "// One invocation.\n";
  }
  std::string many_comment() const {
    return std::string("// As many outputs as inputs, by the widest registers of this processor.") +
           (reflection_.uses_derivatives ? " Invocations 4q .. 4q + 3 are the quad (x, y) (x + 1, y)\n// (x, y + 1) (x "
                                           "+ 1, y + 1) that derivatives "
                                           "are taken in.\n"
                                         : "\n");
  }

  std::string bound_struct() const {
    const Reflection& r = reflection_;
    std::string text =
        "// Uniforms as the shader reads them.\nstruct Bound {\n  explicit Bound([[maybe_unused]] const Uniforms& u) "
        "{\n";
    for (const ReflectedUniform& u : r.uniforms) text += write_uniform(u);
    for (const ReflectedResource& resource : r.resources) {
      const std::string value = "u." + cpp_path(uniforms_, resource.name),
                        shown = "\"" + name_ + ": " + resource.name + "\"";
      const std::string slot = "[" + std::to_string(resource.slot) + "] = ";
      if (is_block(resource.kind))
        text += "    buffers" + slot + "package::checked_buffer(" + value + ", " +
                std::to_string(resource.minimum_size) + ", " + shown + ");\n";
      else
        text += "    textures" + slot + "package::checked_texture(" + value +
                ", twinshade::TextureKind::" + texture_kind(resource.kind) + ", " + shown + ");\n";
    }
    const auto array = [](std::uint32_t count) { return "[" + std::to_string(count == 0 ? 1 : count) + "] = {};\n"; };
    return text +
           "  }\n  twinshade::ShaderData data() const { return {uniforms, textures, buffers}; }\n\n"
           "  alignas(16) std::byte uniforms" +
           array(r.uniform_bytes) + "  twinshade::TextureView textures" + array(r.texture_count) +
           "  twinshade::BufferView buffers" + array(r.buffer_count) + "};\n\n";
  }

  std::string write_uniform(const ReflectedUniform& u) const {
    std::string strides;
    if (u.array_length > 0) strides += std::to_string(u.array_stride) + ", ";
    if (u.columns > 1) strides += std::to_string(u.matrix_stride) + ", ";
    return "    {\n      constexpr std::uint32_t strides[] = {" + strides +
           "4};\n      package::write_uniform(uniforms + " + std::to_string(u.offset) + ", strides, u." +
           cpp_path(uniforms_, u.name) + ");\n    }\n";
  }

  std::string rows_struct() const {
    const Reflection& r = reflection_;
    std::string text =
        "template <class Real>\nstruct Rows {\n  using real = Real;\n  using Inputs = BasicInputs<Real>;\n"
        "  using Outputs = BasicOutputs<Real>;\n  static constexpr std::uint32_t kInputs = " +
        std::to_string(r.input_components) + ", kOutputs = " + std::to_string(r.output_components) +
        ";\n  static constexpr bool kUsesDerivatives = " + (r.uses_derivatives ? "true" : "false") + ";\n";
    text +=
        "  template <class Block>\n  static void put([[maybe_unused]] Block& block, [[maybe_unused]] std::size_t row, "
        "[[maybe_unused]] const Inputs& in) {\n";
    for (const ReflectedVariable& v : r.inputs)
      text += "    block.put(" + std::to_string(v.first_component) + ", row, in." + cpp_path(inputs_, v.name) + ");\n";
    if (r.uses_frag_coord) text += "    block.put_frag_coord(row, in.gl_FragCoord);\n";
    if (r.uses_front_facing) text += "    block.front_facing[row] = in.gl_FrontFacing ? ~0u : 0;\n";
    if (r.uses_primitive_id) text += "    block.primitive_id[row] = std::uint32_t(in.gl_PrimitiveID);\n";
    text +=
        "  }\n  template <class Block>\n  static void get([[maybe_unused]] const Block& block, [[maybe_unused]] "
        "std::size_t "
        "row, [[maybe_unused]] Outputs& out) {\n";
    if (r.discards)
      text +=
          "    if (block.kept[row] == 0) {\n      out = Outputs{};\n      out.discarded = true;\n      return;\n    "
          "}\n    out.discarded = false;\n";
    for (const ReflectedVariable& v : r.outputs)
      text +=
          "    block.get(" + std::to_string(v.first_component) + ", row, out." + cpp_path(outputs_, v.name) + ");\n";
    if (r.writes_depth) text += "    out.gl_FragDepth = block.frag_depth[row];\n";
    return text + "  }\n};\n\n";
  }

  std::string entry_functions() const {
    std::string lists;
    for (const std::string& isa : isas_)
      lists +=
          (lists.empty() ? "{twinshade::" : ", {twinshade::") + entries(isa) + ", twinshade::" + entry_count(isa) + "}";
    return "twinshade::ShadeFunction scalar(twinshade::Number number) {\n  return package::find_entry({" + lists +
           "}, number);\n}\n"
           "twinshade::ShadeFunction widest() {\n  static const twinshade::ShadeFunction best = "
           "package::widest_entry({" +
           lists + "});\n  return best;\n}\n\n";
  }

  static std::string definitions(const std::string& in, const std::string& out, const std::string& real,
                                 const std::string& number, const std::string& many) {
    return out + " shade(const Uniforms& uniforms, const " + in + "& inputs) {\n  return package::shade_one<Rows<" +
           real + ">>(scalar(twinshade::" + number +
           "), Bound(uniforms).data(), inputs);\n}\nvoid shade(const Uniforms& uniforms, std::span<const " + in +
           "> inputs, std::span<" + out + "> outputs) {\n  package::shade_rows<Rows<" + real + ">>(" + many +
           ", Bound(uniforms).data(), inputs, outputs);\n}\n\n";
  }

  const std::string &name_, &identifier_;
  const Reflection& reflection_;
  const std::string file_;
  const std::vector<std::string> order_;
  const std::vector<std::string>& isas_;
  const std::vector<ValueNode> uniforms_, inputs_, outputs_;
};

}  // namespace

std::string package_identifier(const std::string& name, const ShaderSource& source,
                               const std::vector<std::string>& isas) {
  Sha256 hash;
  hash.add(source_hash(source));
  for (const std::string& file : source.files) hash.add('\n' + file);
  for (const std::string& isa : isas) hash.add('\n' + isa);
  constexpr std::size_t kDigits = 16;
  return name + "_" + hash.hex().substr(0, kDigits);
}

CppHeader cpp_header(const std::string& name, const Translation& translation, const ShaderSource& source,
                     const std::vector<std::string>& isas) {
  if (source.stage == ShaderStage::compute)
    throw UserError(
        source.files[0] +
        ": a compute shader (.comp) has no inputs and outputs to make a header of: only fragment shaders do");
  const HeaderWriter writer(name, translation, source, isas);
  return {writer.header(), writer.calls()};
}

}  // namespace twinshade

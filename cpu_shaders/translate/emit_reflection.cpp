#include "cpu_shaders/translate/emit_reflection.h"

#include "cpu_shaders/translate/writer.h"

namespace twinshade::spirv {
namespace {

const char* boolean(bool b) { return b ? "true" : "false"; }

std::string scalar_name(Scalar s) {
  switch (s) {
    case Scalar::i32:
      return "Scalar::i32";
    case Scalar::u32:
      return "Scalar::u32";
    case Scalar::boolean:
      return "Scalar::boolean";
    default:
      return "Scalar::f32";
  }
}

std::string kind_name(ResourceKind k) {
  switch (k) {
    case ResourceKind::uniform_block:
      return "ResourceKind::uniform_block";
    case ResourceKind::storage_buffer:
      return "ResourceKind::storage_buffer";
    case ResourceKind::sampler_2d_array:
      return "ResourceKind::sampler_2d_array";
    case ResourceKind::sampler_cube:
      return "ResourceKind::sampler_cube";
    default:
      return "ResourceKind::sampler_2d";
  }
}

std::string initial_words(std::size_t uniform, const std::vector<std::uint32_t>& words) {
  std::string text = "constexpr std::uint32_t kInitial" + std::to_string(uniform) + "[] = {";
  for (std::size_t k = 0; k < words.size(); ++k) text += (k == 0 ? "" : ", ") + std::to_string(words[k]) + "u";
  return text + "};\n";
}

std::string compute_fields(const Reflection& r) {
  if (r.local_size[0] == 0) return "";
  std::string sizes;
  for (std::uint32_t size : r.local_size) sizes += (sizes.empty() ? "" : ", ") + std::to_string(size);
  return ",\n    /*local_size*/ {" + sizes + "}, /*shared_bytes*/ " + std::to_string(r.shared_bytes) +
         ", /*uses_barrier*/ " + boolean(r.uses_barrier);
}

// So that several translations can share a unit.
std::string own_namespace(const std::string& id) { return "shader_" + id + "::"; }

// A shared object has one module; linked objects leave their entries to whoever joins them.
std::string entries_text(const Reflection& r, const std::string& id) {
  std::string t = "#undef TWINSHADE_ENTRIES\n#undef TWINSHADE_ENTRY_COUNT\n";
  t += "#if defined(TWINSHADE_SHARED_OBJECT)\n#define TWINSHADE_ENTRIES entries\n#define TWINSHADE_ENTRY_COUNT "
       "entry_count\n#else\n";
  t += "#define TWINSHADE_ENTRIES TWINSHADE_JOIN(twinshade_entries_" + id + "_, TWINSHADE_ISA)\n";
  t += "#define TWINSHADE_ENTRY_COUNT TWINSHADE_JOIN(twinshade_entry_count_" + id + "_, TWINSHADE_ISA)\n#endif\n";
  t += "extern const ShaderEntry TWINSHADE_ENTRIES[];\nextern const std::uint32_t TWINSHADE_ENTRY_COUNT;\n";
  t += "const ShaderEntry TWINSHADE_ENTRIES[] = {\n";
  const auto entry = [&](int bit, const std::string& number, const std::string& policy) {
    t += "#if TWINSHADE_NUMBERS & " + std::to_string(bit) + "\n    {Isa(TWINSHADE_ISA_NUMBER), Number::" + number +
         ", shade_all<" + own_namespace(id) + "Shader, " + policy + ">},\n#endif\n";
  };
  const std::string scalar = r.uses_derivatives ? "Quad" : "Scalar";
  entry(1, "lanes4", "Lanes<4>");
  entry(2, "lanes8", "Lanes<8>");
  entry(4, "lanes16", "Lanes<16>");
  entry(8, "scalar", scalar + "32");
  if (r.no_float64_reason.empty()) entry(16, "float64", scalar + "64");
  t += "    {Isa(TWINSHADE_ISA_NUMBER), Number::scalar, nullptr}};  // the end, not counted\n";
  t += "const std::uint32_t TWINSHADE_ENTRY_COUNT = sizeof TWINSHADE_ENTRIES / sizeof *TWINSHADE_ENTRIES - 1;\n\n";
  return t;
}

}  // namespace

std::string reflection_text(const Reflection& r, const ShaderSource& source, const std::string& id,
                            bool code_elsewhere) {
  std::string t;
  const auto table = [&](const std::string& type, const std::string& name, const std::vector<std::string>& rows) {
    if (rows.empty()) return;
    t += "constexpr " + type + " " + name + "[] = {\n";
    for (const std::string& row : rows) t += "    {" + row + "},\n";
    t += "};\n";
  };
  const auto variables = [](const std::vector<ReflectedVariable>& all) {
    std::vector<std::string> rows;
    for (const auto& v : all)
      rows.push_back(quoted(v.name) + ", " + scalar_name(v.scalar) + ", " + std::to_string(v.columns) + ", " +
                     std::to_string(v.rows) + ", " + std::to_string(v.array_length) + ", " + boolean(v.flat) + ", " +
                     boolean(v.noperspective) + ", " + std::to_string(v.location) + ", " +
                     std::to_string(v.first_component));
    return rows;
  };
  table("ShaderVariable", "kInputs", variables(r.inputs));
  table("ShaderVariable", "kOutputs", variables(r.outputs));
  std::vector<std::string> uniforms, resources;
  for (std::size_t k = 0; k < r.uniforms.size(); ++k) {
    const auto& u = r.uniforms[k];
    if (!u.initial.empty()) t += initial_words(k, u.initial);
    uniforms.push_back(quoted(u.name) + ", " + scalar_name(u.scalar) + ", " + std::to_string(u.columns) + ", " +
                       std::to_string(u.rows) + ", " + std::to_string(u.array_length) + ", " +
                       std::to_string(u.offset) + ", " + std::to_string(u.array_stride) + ", " +
                       std::to_string(u.matrix_stride) + (u.initial.empty() ? "" : ", kInitial" + std::to_string(k)));
  }
  for (const auto& x : r.resources)
    resources.push_back(quoted(x.name) + ", " + kind_name(x.kind) + ", " + std::to_string(x.slot) + ", " +
                        std::to_string(x.minimum_size) + ", " + boolean(x.read_only) + ", " + "LayerOrder(" +
                        std::to_string(int(x.layer_order)) + ")" + ", " + std::to_string(x.beside) + ", " +
                        std::to_string(x.coordinates) + ", " + std::to_string(x.layer) + ", " +
                        std::to_string(x.layers_read));
  table("ShaderUniform", "kUniforms", uniforms);
  table("ShaderResource", "kResources", resources);

  const std::string own = own_namespace(id);
  t += "}  // namespace\n}  // namespace shader_" + id + "\n}  // namespace TWINSHADE_ISA_NAMESPACE\n\n";
  if (!code_elsewhere) t += entries_text(r, id);
  const auto array = [&](bool empty, const char* name) {
    return empty ? std::string("nullptr, 0") : own + name + ", sizeof " + own + name + " / sizeof *" + own + name;
  };
  const auto module = [&](const std::string& entries) {
    std::string m = "    kAbiVersion,\n    " + quoted(source.name) + ",\n    " + quoted(source_hash(source)) + ",\n";
    m += "    " + array(r.inputs.empty(), "kInputs") + ", " + std::to_string(r.input_components) + ",\n";
    m += "    " + array(r.outputs.empty(), "kOutputs") + ", " + std::to_string(r.output_components) + ",\n";
    m += "    " + array(r.uniforms.empty(), "kUniforms") + ", " + std::to_string(r.uniform_bytes) + ",\n";
    m += "    " + array(r.resources.empty(), "kResources") + ", " + std::to_string(r.texture_count) + ", " +
         std::to_string(r.buffer_count) + ",\n";
    m += "    /*discards*/ " + std::string(boolean(r.discards)) + ", /*writes_depth*/ " + boolean(r.writes_depth) +
         ", /*has_side_effects*/ " + boolean(r.has_side_effects) + ", /*uses_derivatives*/ " +
         boolean(r.uses_derivatives) + ",\n    /*uses_frag_coord*/ " + boolean(r.uses_frag_coord) +
         ", /*uses_front_facing*/ " + boolean(r.uses_front_facing) + ", /*uses_primitive_id*/ " +
         boolean(r.uses_primitive_id) + ", /*uses_helper_invocation*/ " + boolean(r.uses_helper_invocation) + ",\n";
    m += "    " + (r.no_float64_reason.empty() ? std::string("nullptr") : quoted(r.no_float64_reason)) + ",\n    " +
         entries + compute_fields(r) + "};\n";
    return m;
  };
  if (code_elsewhere) {
    t += "#if TWINSHADE_ISA_NUMBER == 0\n";
  } else {
    t += "#if defined(TWINSHADE_SHARED_OBJECT)\n";
    t += "extern \"C\" __attribute__((visibility(\"default\"))) const ShaderModule twinshade_shader_module;\n";
    t += "const ShaderModule twinshade_shader_module = {\n" + module("TWINSHADE_ENTRIES, TWINSHADE_ENTRY_COUNT");
    t += "#elif TWINSHADE_ISA_NUMBER == 0\n";
  }
  t += "extern const ShaderModule twinshade_module_" + id + ";\n";
  t += "const ShaderModule twinshade_module_" + id + " = {\n" + module("nullptr, 0");
  t += "#endif\n\n}  // namespace twinshade\n";
  return t;
}

}  // namespace twinshade::spirv

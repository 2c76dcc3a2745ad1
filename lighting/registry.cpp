#include "lighting/registry.h"

#include "lighting/driver_source.h"

#include <array>

#include "base/error.h"
#include "base/names.h"

namespace twinshade {
namespace {

constexpr TechniqueInfo kTechniques[] = {
#define BASIS(name, file, domain, count, linear, projection, reads, source) \
  {#name, #file, true, Domain::domain, count, linear, Projection::projection, source, Reads::reads},
#define TECHNIQUE(name, file, shows, source)                                                           \
  {#name,  #file,      false,  Domain::hemisphere,      0,     false,       Projection::least_squares, \
   source, Reads::all, "none", VisibilityWeights::none, false, Shows::shows},
#define VISIBILITY(name, file, weights, count, mean, tables, source)                                 \
  {#name,  #file,      false,   Domain::hemisphere,         count, false, Projection::least_squares, \
   source, Reads::all, #tables, VisibilityWeights::weights, mean},
#include "lighting/registry.def"
#undef BASIS
#undef TECHNIQUE
#undef VISIBILITY
};

// A direction with a NaN counts as the zero vector, for which every basis has a value.
constexpr const char* kDefinedDirection =
    "vec3 defined_direction() {\n"
    "  bool defined = direction.x == direction.x && direction.y == direction.y && direction.z == direction.z;\n"
    "  return defined ? direction : vec3(0.0);\n"
    "}\n";

// What follows "BASIS_COUNT =" up to the semicolon, blanks apart; empty where there is no such thing.
std::string basis_count(const std::string& glsl) {
  constexpr std::string_view kName = "BASIS_COUNT", kBlanks = " \t";
  for (std::size_t at = glsl.find(kName); at != glsl.npos; at = glsl.find(kName, at + 1)) {
    const std::size_t sign = glsl.find_first_not_of(kBlanks, at + kName.size());
    if (sign == glsl.npos || glsl[sign] != '=' || glsl[sign + 1] == '=') continue;
    const std::size_t from = glsl.find_first_not_of(kBlanks, sign + 1), to = glsl.find_first_of(";\n", from);
    return from == glsl.npos ? "" : glsl.substr(from, to - from);
  }
  return "";
}

// A basis' shader, whose BASIS_COUNT must be the registry's count: bundles hold as many coefficients as the one says,
// the shader reads as many as the other.
ShaderSource require_count(const TechniqueInfo& technique, ShaderSource source) {
  const std::string count = basis_count(source.text), expected = std::to_string(technique.count);
  if (technique.is_basis && count != expected)
    throw UserError("basis/" + std::string(technique.file) + ": BASIS_COUNT is " +
                    (count.empty() ? "not there" : count) + ", but BASIS(" + std::string(technique.name) +
                    ", ...) in lighting/registry.def has a count of " + expected + ": write the same number in both");
  return source;
}

}  // namespace

std::span<const TechniqueInfo> techniques() { return kTechniques; }

const TechniqueInfo& find_technique(std::string_view name) {
  for (const TechniqueInfo& technique : kTechniques)
    if (technique.name == name) return technique;
  std::vector<std::string> names;
  for (const TechniqueInfo& technique : kTechniques) names.emplace_back(technique.name);
  throw UserError(unknown_name_message("technique", std::string(name), names));
}

std::string_view storage_name(CoefficientStorage storage) {
  constexpr std::string_view kNames[] = {"lightmap", "vertex", "volume"};
  return kNames[int(storage)];
}

std::string_view texture_packing_name(TexturePacking packing) {
  return packing == TexturePacking::dx9 ? "dx9" : "layers";
}

TexturePacking find_texture_packing(const std::string& name) {
  for (const TexturePacking packing : {TexturePacking::layers, TexturePacking::dx9})
    if (name == texture_packing_name(packing)) return packing;
  throw UserError(unknown_name_message("packing", name, {"layers", "dx9"}));
}

bool can_read(const TechniqueInfo& technique, CoefficientStorage storage) {
  if (!technique.is_basis || technique.domain == Domain::hemisphere) return storage != CoefficientStorage::volume;
  return technique.domain == Domain::either || storage == CoefficientStorage::volume;
}

bool reads_sphere_map(const TechniqueInfo& technique) {
  return technique.weights != VisibilityWeights::none && technique.tables != "none";
}

std::string visibility_name(const TechniqueInfo& technique) {
  return technique.weights == VisibilityWeights::sh    ? "visibility_sh"
         : technique.weights == VisibilityWeights::pca ? "visibility_pca" + std::to_string(technique.count)
                                                       : "visibility_ambient";
}

std::string light_tables_name(const TechniqueInfo& technique, const SphereMapInfo& map) {
  const bool components = technique.weights == VisibilityWeights::pca;
  return "tables_" + std::string(technique.tables) + (components ? std::to_string(technique.count) : "") + "_" +
         std::string(map.name);
}

namespace {

// A technique's shader before its includes are resolved.
struct Unresolved {
  std::string name, text, shown;  // shown: in messages

  ShaderSource resolve(const std::vector<std::string>& include_folders) const {
    return resolve_shader(name, text, shown, {include_folders});
  }
};

Unresolved visibility_text(const TechniqueInfo& technique, CoefficientStorage storage, const SphereMapInfo& map,
                           TexturePacking packing) {
  TWINSHADE_CHECK_EQ(technique.weights == VisibilityWeights::none, false);
  const bool vertex = storage == CoefficientStorage::vertex, mapped = reads_sphere_map(technique);
  const bool packed = packing == TexturePacking::dx9 && (mapped || !vertex);
  std::string text = vertex ? "#define TWINSHADE_VERTEX_COEFFICIENTS 1\n" : "";
  text += "#define VISIBILITY " + visibility_name(technique) + "\n";
  text += "#define VISIBILITY_COUNT " + std::to_string(technique.count) + "\n";
  text += "#define VISIBILITY_MEAN " + std::to_string(int(technique.has_mean)) + "\n";
  text += "#include \"technique/surface_world.glsl\"\n";
  text += "#include \"technique/visibility_" +
          std::string(vertex   ? "vertex"
                      : packed ? "lightmap_packed"
                               : "lightmap") +
          ".glsl\"\n";
  if (mapped) {
    text += "#define LIGHT_TABLES " + light_tables_name(technique, map) + "\n";
    text += "#include \"sphere_map/" + std::string(map.file) + "\"\n";
    text += "#include \"technique/light_tables_" + std::string(packed ? "packed" : "layers") + ".glsl\"\n";
  }
  text += "#include \"technique/" + std::string(technique.file) + "\"\n";
  text += "#include \"technique/irradiance_main.glsl\"\n";
  const std::string name = std::string(technique.name) + (mapped ? "_" + std::string(map.name) : "");
  return {name + (vertex ? "_vertex" : "") + (packed ? "_packed" : ""), text, std::string(technique.name)};
}

Unresolved technique_text(const TechniqueInfo& technique, CoefficientStorage storage, const SphereMapInfo& map) {
  const std::string name(technique.name), file(technique.file);
  if (!can_read(technique, storage))
    throw UserError("technique " + name + " does not read its coefficients from " +
                    (storage == CoefficientStorage::volume ? "an irradiance volume" : "lightmaps or vertices"));
  if (technique.weights != VisibilityWeights::none)
    return visibility_text(technique, storage, map, TexturePacking::layers);
  const bool vertex = storage == CoefficientStorage::vertex, volume = storage == CoefficientStorage::volume;
  std::string text = vertex ? "#define TWINSHADE_VERTEX_COEFFICIENTS 1\n" : "";
  if (technique.is_basis) {
    text += "#define COEFFICIENTS " + std::string(volume ? "volume_" : "coefficients_") + name + "\n";
    text += "#define COEFFICIENT_COUNT " + std::to_string(technique.count) + "\n";
    if (volume) text += "#define COEFFICIENTS_PICKED " + std::to_string(int(technique.reads == Reads::some)) + "\n";
    const bool flat = technique.projection == Projection::value_at_normal;  // whatever the mapped normal is
    text += "#include \"technique/" +
            std::string(volume ? "surface_world"
                        : flat ? "surface_flat"
                               : "surface") +
            ".glsl\"\n";
    text += "#include \"technique/coefficients_" +
            std::string(volume   ? "volume"
                        : vertex ? "vertex"
                                 : "lightmap") +
            ".glsl\"\n";
    text += "#include \"basis/" + file + "\"\n";
    text += "#include \"technique/irradiance_main.glsl\"\n";
  } else {
    text += "#include \"technique/" + file + "\"\n";
  }
  return {name + (vertex ? "_vertex" : volume ? "_volume" : ""), text, name};
}

}  // namespace

ShaderSource visibility_source(const TechniqueInfo& technique, CoefficientStorage storage, const SphereMapInfo& map,
                               TexturePacking packing) {
  return visibility_text(technique, storage, map, packing).resolve({});
}

ShaderSource technique_source(const TechniqueInfo& technique, CoefficientStorage storage,
                              const std::vector<std::string>& include_folders) {
  return require_count(technique, technique_text(technique, storage, sphere_maps().front()).resolve(include_folders));
}

ShaderSource driver_source(const TechniqueInfo& technique, CoefficientStorage storage, const SphereMapInfo& map) {
  Unresolved unresolved = technique_text(technique, storage, map);
  unresolved.text.insert(0, "#define precise\n");
  return unresolved.resolve({"builtin:driver"});
}

ShaderSource basis_values_source(const TechniqueInfo& technique, const std::vector<std::string>& include_folders) {
  const std::string name(technique.name);
  if (!technique.is_basis || !technique.linear) throw UserError("technique " + name + " is not a linear basis");
  const std::string text =
      "#define COEF(i) vec3(0.0)\n"  // basis_irradiance is not called, only basis_value
      "#include \"basis/" +
      std::string(technique.file) +
      "\"\n"
      "in vec3 direction;\n"
      "out float value[BASIS_COUNT];\n" +
      kDefinedDirection +
      "void main() {\n"
      "  vec3 n = defined_direction();\n"
      "  for (int i = 0; i < BASIS_COUNT; ++i) value[i] = basis_value(i, n);\n"
      "}\n";
  return require_count(technique, resolve_shader(name + "_values", text, name + "_values", {include_folders}));
}

ShaderSource basis_irradiance_source(const TechniqueInfo& technique, const std::vector<std::string>& include_folders) {
  const std::string name(technique.name);
  if (!technique.is_basis) throw UserError("technique " + name + " is not a basis");
  const std::string text =
      "in vec3 direction;\n"
      "in vec3 coefficients[" +
      std::to_string(technique.count) +
      "];\n"
      "out vec3 irradiance;\n"
      "out float reads;\n"
      "int coefficients_read = 0;\n"
      "vec3 read_coefficient(int i) {\n"
      "  ++coefficients_read;\n"
      "  return coefficients[i];\n"
      "}\n"
      "#define COEF(i) read_coefficient(i)\n"
      "#include \"basis/" +
      std::string(technique.file) + "\"\n" + kDefinedDirection +
      "void main() {\n"
      "  irradiance = basis_irradiance(defined_direction());\n"
      "  reads = float(coefficients_read);\n"
      "}\n";
  return require_count(technique, resolve_shader(name + "_irradiance", text, name + "_irradiance", {include_folders}));
}

}  // namespace twinshade

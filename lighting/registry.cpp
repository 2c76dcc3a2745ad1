#include "lighting/registry.h"

#include <array>

#include "base/error.h"
#include "base/names.h"

namespace twinshade {
namespace {

constexpr TechniqueInfo kTechniques[] = {
#define BASIS(name, file, domain, count, linear, projection, source) \
  {#name, #file, true, Domain::domain, count, linear, Projection::projection, source},
#define TECHNIQUE(name, file, source) \
  {#name, #file, false, Domain::hemisphere, 0, false, Projection::least_squares, source},
#include "lighting/registry.def"
#undef BASIS
#undef TECHNIQUE
};

}  // namespace

std::span<const TechniqueInfo> techniques() { return kTechniques; }

const TechniqueInfo& find_technique(std::string_view name) {
  for (const TechniqueInfo& technique : kTechniques)
    if (technique.name == name) return technique;
  std::vector<std::string> names;
  for (const TechniqueInfo& technique : kTechniques) names.emplace_back(technique.name);
  throw UserError(unknown_name_message("technique", std::string(name), names));
}

ShaderSource technique_source(const TechniqueInfo& technique, CoefficientStorage storage) {
  const std::string name(technique.name), file(technique.file);
  const bool vertex = storage == CoefficientStorage::vertex;
  std::string text = vertex ? "#define TWINSHADE_VERTEX_COEFFICIENTS 1\n" : "";
  if (technique.is_basis) {
    text += "#define COEFFICIENTS coefficients_" + name + "\n";
    text += "#define COEFFICIENT_COUNT " + std::to_string(technique.count) + "\n";
    text += "#include \"technique/surface.glsl\"\n";
    text += "#include \"technique/coefficients_" + std::string(vertex ? "vertex" : "lightmap") + ".glsl\"\n";
    text += "#include \"basis/" + file + "\"\n";
    text += "#include \"technique/irradiance_main.glsl\"\n";
  } else {
    text += "#include \"technique/" + file + "\"\n";
  }
  return resolve_shader(vertex ? name + "_vertex" : name, text, name);
}

ShaderSource basis_values_source(const TechniqueInfo& technique) {
  const std::string name(technique.name);
  if (!technique.is_basis || !technique.linear) throw UserError("technique " + name + " is not a linear basis");
  const std::string text =
      "#define COEF(i) vec3(0.0)\n"  // basis_irradiance is not called, only basis_value
      "#include \"basis/" +
      std::string(technique.file) +
      "\"\n"
      "in vec3 direction;\n"
      "out float value[BASIS_COUNT];\n"
      "void main() {\n"
      "  for (int i = 0; i < BASIS_COUNT; ++i) value[i] = basis_value(i, direction);\n"
      "}\n";
  return resolve_shader(name + "_values", text, name + "_values");
}

}  // namespace twinshade

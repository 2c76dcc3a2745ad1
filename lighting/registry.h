// The only list of bases and techniques (registry.def). Compare, bench, list and the build iterate over it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

enum class Domain { hemisphere, sphere };
// How irradiance becomes coefficients of a linear basis: see registry.def.
enum class Projection { least_squares, truncation, value_at_normal };
// Where a technique's shader reads its coefficients: a sampler2DArray over lightmap UVs, or vertex attributes.
enum class CoefficientStorage { lightmap, vertex };

struct TechniqueInfo {
  std::string_view name;
  std::string_view file;  // under shaders/basis/ (bases) or shaders/technique/
  bool is_basis;
  Domain domain;          // bases
  int count;              // coefficients per channel; 0 where not a basis of its own
  bool linear;            // bases
  Projection projection;  // linear bases
  std::string_view source;
};

std::span<const TechniqueInfo> techniques();
// UserError with the nearest names where there is none.
const TechniqueInfo& find_technique(std::string_view name);

// The whole fragment shader: for a basis, surface inputs + coefficient storage + basis file + main. Name: "h4" or
// "h4_vertex". Coefficients of basis b: texture "coefficients_b" (lightmap; layer = coefficient) or attributes
// "coefficients_b[i]" (vertex).
ShaderSource technique_source(const TechniqueInfo& technique, CoefficientStorage storage);

// For the host: `in vec3 direction` to `out float value[BASIS_COUNT]`, the functions of a linear basis. UserError where
// the technique is none.
ShaderSource basis_values_source(const TechniqueInfo& technique);

}  // namespace twinshade

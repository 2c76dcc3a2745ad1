// The only list of bases and techniques (registry.def). Compare, bench, list and the build iterate over it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cpu_shaders/shader_source.h"
#include "lighting/sphere_maps.h"

namespace twinshade {

// hemisphere: normals of tangent space, z up. sphere: normals of world space. either: as where its coefficients lie.
enum class Domain { hemisphere, sphere, either };
// How irradiance becomes coefficients: see registry.def.
enum class Projection {
  least_squares,
  truncation,
  value_at_normal,
  through_sh3,
  window_hanning,
  window_lanczos,
  window_minimum,
  nonnegative,
  luma_chroma,
  irradiance_sh2,
  zonal,
  ambient_highlight
};
// Where a technique's shader reads its coefficients: a sampler2DArray over lightmap UVs, vertex attributes (both of
// tangent space), or an irradiance volume, a grid of probes over the scene (world space).
enum class CoefficientStorage { lightmap, vertex, volume };
std::string_view storage_name(CoefficientStorage storage);  // as on the command line

// How weights and tables of visibility techniques lie in textures. layers: in texture arrays. dx9: four values a texel
// in one ordinary texture each, lightmaps and the layers of sphere maps side by side, as hardware without texture
// arrays needs them; the same bits are drawn.
enum class TexturePacking { layers, dx9 };
std::string_view texture_packing_name(TexturePacking packing);
// UserError with the nearest names where there is none.
TexturePacking find_texture_packing(const std::string& name);

// What a technique of precomputed visibility stores.
enum class VisibilityWeights { none, sh, pca, ambient };

// What a technique's picture is of: a surface's light, or what the rasterizer can do.
enum class Shows { light, raster };

// Of a basis' coefficients, at one normal: whether COEF(i) occurs with an i that depends on the normal.
enum class Reads { all, some };

struct TechniqueInfo {
  std::string_view name;
  std::string_view file;  // under shaders/basis/ (bases) or shaders/technique/
  bool is_basis;
  Domain domain;          // bases
  int count;              // RGB coefficients, as COEF numbers them, or weights of visibility; else 0
  bool linear;            // bases: each channel a sum of coefficients times basis_value
  Projection projection;  // bases
  std::string_view source;
  Reads reads = Reads::all;          // bases
  std::string_view tables = "none";  // of visibility techniques: kind of L x H tables
  VisibilityWeights weights = VisibilityWeights::none;
  bool has_mean = false;
  Shows shows = Shows::light;
};

std::span<const TechniqueInfo> techniques();
// UserError with the nearest names where there is none.
const TechniqueInfo& find_technique(std::string_view name);

// Whether a technique can be drawn with coefficients stored so.
bool can_read(const TechniqueInfo& technique, CoefficientStorage storage);

// The whole fragment shader: for a basis, surface inputs + coefficient storage + basis file + main. Name: "h4",
// "h4_vertex" or "sh3_volume". Coefficients of basis b: texture "coefficients_b" (lightmap; layer = coefficient),
// attributes "coefficients_b[i]" (vertex), or texture "volume_b" (technique/coefficients_volume.glsl says which probe
// is where).
// include_folders: searched for the basis' file before the built-in ones, for techniques that are not in the registry.
// UserError, here and from the host's below, where the file's BASIS_COUNT is not the technique's count.
ShaderSource technique_source(const TechniqueInfo& technique, CoefficientStorage storage,
                              const std::vector<std::string>& include_folders = {});

// Visibility techniques. Names of what their shaders read: texture (lightmap; layer q: weights 4q to 4q + 3) or
// attributes (vertex; "visibility_sh[q]"), and the texture of L x H tables. Those of components have their count in
// the name: fewer are not the first of more.
bool reads_sphere_map(const TechniqueInfo& technique);
std::string visibility_name(const TechniqueInfo& technique);
std::string light_tables_name(const TechniqueInfo& technique, const SphereMapInfo& map);
// The whole fragment shader, "unc3_cube", "unc3_cube_vertex" or "unc3_cube_packed"; technique_source gives it for the
// first sphere map, in layers.
ShaderSource visibility_source(const TechniqueInfo& technique, CoefficientStorage storage, const SphereMapInfo& map,
                               TexturePacking packing = TexturePacking::layers);

// For the host: `in vec3 direction` to `out float value[BASIS_COUNT]`, the functions of a linear basis. UserError where
// the technique is none. A direction with a NaN counts as the zero vector, here and below.
ShaderSource basis_values_source(const TechniqueInfo& technique, const std::vector<std::string>& include_folders = {});

// For the host, any basis: `in vec3 direction; in vec3 coefficients[BASIS_COUNT]` to `out vec3 irradiance; out float
// reads`, what basis_irradiance gives and how often it read a coefficient.
ShaderSource basis_irradiance_source(const TechniqueInfo& technique,
                                     const std::vector<std::string>& include_folders = {});

}  // namespace twinshade

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "base/parallel.h"
#include "base/words.h"
#include "lighting/bake.h"
#include "lighting/camera.h"
#include "lighting/material_textures.h"
#include "lighting/projection.h"
#include "lighting/radiance_basis.h"
#include "lighting/shader_code.h"

namespace twinshade {
namespace {

std::string coefficients_name(const TechniqueInfo& basis, CoefficientStorage storage) {
  return (storage == CoefficientStorage::volume ? "volume_" : "coefficients_") + std::string(basis.name);
}

// The bases whose coefficients the techniques' shaders read from a storage.
std::vector<const TechniqueInfo*> bases_in_use(const std::vector<LitTechnique>& wanted, CoefficientStorage storage) {
  std::vector<std::string> codes;
  for (const LitTechnique& lit : wanted)
    if (lit.storage == storage) codes.push_back(code_of(technique_source(*lit.technique, storage).text));
  std::vector<const TechniqueInfo*> bases;
  for (const TechniqueInfo& basis : techniques()) {
    const std::string name = coefficients_name(basis, storage);
    if (basis.is_basis &&
        std::any_of(codes.begin(), codes.end(), [&](const std::string& code) { return contains_word(code, name); }))
      bases.push_back(&basis);
  }
  return bases;
}

// Coefficient i of channel c of a cell at [(i * cells + cell) * stride + c].
std::vector<float> coefficients(const LightBake& light, const TechniqueInfo& basis, std::size_t stride) {
  const std::size_t numbers = std::size_t(light.radiance_count) * 3;
  const std::size_t cells = std::size_t(light.width) * light.height, count = std::size_t(basis.count);
  std::vector<float> values(count * cells * stride, 0.0f);
  if (basis.projection == Projection::value_at_normal && !light.irradiance.empty()) {
    for (std::size_t cell = 0; cell < cells; ++cell)
      for (int c = 0; c < 3; ++c) values[cell * stride + c] = light.irradiance[cell * 3 + c];
    return values;
  }
  const Projector projector(basis, light.radiance_count);
  constexpr std::size_t kCellsOfBlock = 256;
  parallel_for((cells + kCellsOfBlock - 1) / kCellsOfBlock, [&](std::size_t block, int) {
    const std::size_t first = block * kCellsOfBlock, length = std::min(kCellsOfBlock, cells - first);
    const float* from = light.sh.data() + first * numbers;
    const std::vector<double> radiance(from, from + length * numbers);
    std::vector<double> projected(length * count * 3);
    projector.project(radiance.data(), projected.data(), length);
    for (std::size_t cell = 0; cell < length; ++cell)
      for (std::size_t i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c)
          values[(i * cells + first + cell) * stride + c] = float(projected[(cell * count + i) * 3 + c]);
  });
  return values;
}

void add_coefficient_texture(Bundle& bundle, const LightBake& light, const TechniqueInfo& basis) {
  Texture texture;
  texture.name = coefficients_name(basis, light.storage);
  texture.kind = TextureKind::two_d_array;
  texture.width = light.width, texture.height = light.height, texture.layers = std::uint32_t(basis.count);
  texture.texels = coefficients(light, basis, 4);
  for (std::size_t i = 3; i < texture.texels.size(); i += 4) texture.texels[i] = 1;
  bundle.textures.push_back(std::move(texture));
}

void add_volume_uniforms(Bundle& bundle, const LightBake& light) {
  const auto vector = [&](const char* name, const glm::vec3& v) {
    bundle.uniforms.push_back({name, Scalar::f32, 1, 3, 0, {v.x, v.y, v.z}});
  };
  vector("volume_origin", light.volume_origin);
  vector("volume_scale", light.volume_scale);
  Uniform size{"volume_size", Scalar::i32, 1, 3, 0, {}};
  for (int axis = 0; axis < 3; ++axis) size.values.push_back(std::bit_cast<float>(std::int32_t(light.volume[axis])));
  bundle.uniforms.push_back(std::move(size));
}

void add_coefficient_attributes(Bundle& bundle, const LightBake& light, const TechniqueInfo& basis) {
  const std::vector<float> values = coefficients(light, basis, 3);
  const std::size_t length = std::size_t(light.width) * 3;
  for (int i = 0; i < basis.count; ++i) {
    const auto first = values.begin() + std::ptrdiff_t(i * length);
    bundle.attributes.push_back({fmt::format("coefficients_{}[{}]", basis.name, i), Scalar::f32, 3,
                                 std::vector<float>(first, first + std::ptrdiff_t(length))});
  }
}

template <class Vector>
Attribute attribute(const char* name, const std::vector<Vector>& values, std::size_t vertices) {
  Attribute out{name, Scalar::f32, std::uint32_t(Vector::length()), {}};
  out.values.assign(vertices * Vector::length(), 0.0f);
  for (std::size_t v = 0; v < std::min(vertices, values.size()); ++v)
    for (int c = 0; c < Vector::length(); ++c) out.values[v * Vector::length() + c] = values[v][c];
  return out;
}

Attribute material_attribute(const Scene& scene, std::size_t vertices) {
  std::vector<std::int32_t> material(vertices, 0);
  for (std::size_t t = 0; t < std::min(scene.triangle_count(), scene.triangle_materials.size()); ++t)
    for (int k = 0; k < 3; ++k) material[scene.indices[3 * t + k]] = std::int32_t(scene.triangle_materials[t]);
  Attribute out{"v_material", Scalar::i32, 1, {}};
  for (const std::int32_t value : material) out.values.push_back(std::bit_cast<float>(value));
  return out;
}

std::vector<float> clip_positions(const Scene& scene, const FrameOptions& options) {
  std::vector<float> clip;
  if (!scene.clip_positions.empty()) {
    for (const glm::vec4& p : scene.clip_positions) clip.insert(clip.end(), {p.x, p.y, p.z, p.w});
  } else {
    const CameraTransform camera(options.camera, double(options.width) / options.height);
    for (const glm::vec3& p : scene.positions) {
      const glm::dvec4 c = camera.clip(glm::dvec3(p));
      clip.insert(clip.end(), {float(c.x), float(c.y), float(c.z), float(c.w)});
    }
  }
  fit_to_viewport(clip, options.width, options.height);
  return clip;
}

// The coefficients of one storage and what its shaders read beside them.
void add_light(Bundle& bundle, const LightBake& light, const std::vector<const TechniqueInfo*>& bases) {
  if (light.storage == CoefficientStorage::volume) add_volume_uniforms(bundle, light);
  for (const TechniqueInfo* basis : bases) {
    if (light.storage == CoefficientStorage::vertex)
      add_coefficient_attributes(bundle, light, *basis);
    else
      add_coefficient_texture(bundle, light, *basis);
  }
}

// Light's notes, each once; under its storage's name where another light says otherwise.
void add_notes(Bundle& bundle, const LightBake& light) {
  for (const auto& [key, value] : light.notes) {
    const std::string* before = bundle.find_note(key);
    if (!before)
      bundle.notes.emplace_back(key, value);
    else if (*before != value)
      bundle.notes.emplace_back(fmt::format("{}_{}", storage_name(light.storage), key), value);
  }
}

}  // namespace

Bundle make_bundle(const Scene& scene, std::span<const LightBake> lights, const std::vector<LitTechnique>& wanted,
                   const FrameOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
    throw UserError("frame size: " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                    " is not within 1x1 to 16384x16384");
  Bundle bundle;
  bundle.width = options.width, bundle.height = options.height;
  bundle.clip_positions = clip_positions(scene, options);
  bundle.indices = scene.indices;
  const std::size_t vertices = bundle.vertex_count();

  bundle.attributes.push_back(attribute("v_uv", scene.uvs, vertices));
  bundle.attributes.push_back(material_attribute(scene, vertices));
  bundle.attributes.push_back(attribute("v_position", scene.positions, vertices));
  bundle.attributes.push_back(attribute("v_normal", scene.normals, vertices));
  bundle.attributes.push_back(attribute("v_tangent", scene.tangents, vertices));
  if (!scene.lightmap_uvs.empty())
    bundle.attributes.push_back(attribute("v_lightmap_uv", scene.lightmap_uvs, vertices));
  bundle.textures.push_back(albedo_maps(scene, options.albedo));
  bundle.textures.push_back(normal_maps(scene, options.normal_map));

  std::string storages;
  for (const CoefficientStorage storage :
       {CoefficientStorage::lightmap, CoefficientStorage::vertex, CoefficientStorage::volume}) {
    for (const LightBake& light : lights) {
      if (light.storage != storage) continue;
      if (storage == CoefficientStorage::vertex) TWINSHADE_CHECK_EQ(std::size_t(light.width), vertices);
      add_light(bundle, light, bases_in_use(wanted, storage));
      add_notes(bundle, light);
      storages += fmt::format("{}{}", storages.empty() ? "" : " ", storage_name(storage));
    }
  }
  bundle.notes.emplace_back("coefficients", storages);
  std::string names;
  const TechniqueInfo* last = nullptr;
  for (const LitTechnique& lit : wanted) {
    if (lit.technique != last) names += fmt::format("{}{}", names.empty() ? "" : " ", lit.technique->name);
    last = lit.technique;
  }
  bundle.notes.emplace_back("techniques", names);
  bundle.notes.emplace_back("albedo", options.albedo ? "1" : "0");
  bundle.notes.emplace_back("normal_map", options.normal_map ? "1" : "0");
  return bundle;
}

Bundle make_bundle(const Scene& scene, const LightBake& light, const std::vector<const TechniqueInfo*>& wanted,
                   const FrameOptions& options) {
  std::vector<LitTechnique> lit;
  for (const TechniqueInfo* technique : wanted) lit.push_back({technique, light.storage});
  return make_bundle(scene, {&light, 1}, lit, options);
}

}  // namespace twinshade

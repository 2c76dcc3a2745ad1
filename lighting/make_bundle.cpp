#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>

#include "base/error.h"
#include "base/parallel.h"
#include "lighting/bake.h"
#include "lighting/camera.h"
#include "lighting/material_textures.h"
#include "lighting/projection.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

bool contains_word(const std::string& text, const std::string& word) {
  const auto part_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if ((at == 0 || !part_of_word(text[at - 1])) &&
        (at + word.size() == text.size() || !part_of_word(text[at + word.size()])))
      return true;
  return false;
}

// The bases whose coefficients the techniques' shaders read.
std::vector<const TechniqueInfo*> bases_in_use(const std::vector<const TechniqueInfo*>& wanted,
                                               CoefficientStorage storage) {
  std::vector<std::string> texts;
  for (const TechniqueInfo* technique : wanted) texts.push_back(technique_source(*technique, storage).text);
  std::vector<const TechniqueInfo*> bases;
  for (const TechniqueInfo& basis : techniques()) {
    const std::string name = "coefficients_" + std::string(basis.name);
    if (basis.is_basis &&
        std::any_of(texts.begin(), texts.end(), [&](const std::string& text) { return contains_word(text, name); }))
      bases.push_back(&basis);
  }
  return bases;
}

// Coefficient i of channel c of a cell at [(i * cells + cell) * stride + c].
std::vector<float> coefficients(const LightBake& light, const TechniqueInfo& basis, std::size_t stride) {
  const Projector projector(basis, kRadianceCount);
  const std::size_t cells = std::size_t(light.width) * light.height, count = std::size_t(basis.count);
  std::vector<float> values(count * cells * stride, 0.0f);
  constexpr std::size_t kBlock = 256;
  parallel_for((cells + kBlock - 1) / kBlock, [&](std::size_t block, int) {
    const std::size_t first = block * kBlock, length = std::min(kBlock, cells - first);
    const float* from = light.sh.data() + first * kRadianceCount * 3;
    const std::vector<double> radiance(from, from + length * kRadianceCount * 3);
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
  texture.name = "coefficients_" + std::string(basis.name);
  texture.kind = TextureKind::two_d_array;
  texture.width = light.width, texture.height = light.height, texture.layers = std::uint32_t(basis.count);
  texture.texels = coefficients(light, basis, 4);
  for (std::size_t i = 3; i < texture.texels.size(); i += 4) texture.texels[i] = 1;
  bundle.textures.push_back(std::move(texture));
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

}  // namespace

Bundle make_bundle(const Scene& scene, const LightBake& light, const std::vector<const TechniqueInfo*>& wanted,
                   const FrameOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
    throw UserError("frame size: " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                    " is not within 1x1 to 16384x16384");
  Bundle bundle;
  bundle.width = options.width, bundle.height = options.height;
  bundle.clip_positions = clip_positions(scene, options);
  bundle.indices = scene.indices;
  const std::size_t vertices = bundle.vertex_count();
  const bool per_vertex = light.storage == CoefficientStorage::vertex;
  if (per_vertex) TWINSHADE_CHECK_EQ(std::size_t(light.width), vertices);

  bundle.attributes.push_back(attribute("v_uv", scene.uvs, vertices));
  bundle.attributes.push_back(material_attribute(scene, vertices));
  bundle.attributes.push_back(attribute("v_position", scene.positions, vertices));
  if (!per_vertex) bundle.attributes.push_back(attribute("v_lightmap_uv", scene.lightmap_uvs, vertices));
  bundle.textures.push_back(albedo_maps(scene, options.albedo));
  bundle.textures.push_back(normal_maps(scene, options.normal_map));
  for (const TechniqueInfo* basis : bases_in_use(wanted, light.storage)) {
    if (per_vertex)
      add_coefficient_attributes(bundle, light, *basis);
    else
      add_coefficient_texture(bundle, light, *basis);
  }

  bundle.notes = light.notes;
  bundle.notes.emplace_back("coefficients", per_vertex ? "vertex" : "lightmap");
  std::string names;
  for (const TechniqueInfo* technique : wanted) names += fmt::format("{}{}", names.empty() ? "" : " ", technique->name);
  bundle.notes.emplace_back("techniques", names);
  bundle.notes.emplace_back("albedo", options.albedo ? "1" : "0");
  bundle.notes.emplace_back("normal_map", options.normal_map ? "1" : "0");
  return bundle;
}

}  // namespace twinshade

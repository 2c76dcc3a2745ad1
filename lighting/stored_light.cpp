#include "lighting/stored_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/words.h"
#include "lighting/shader_code.h"

namespace twinshade {
namespace {

std::size_t cells_of_layer(const Texture& texture) { return std::size_t(texture.width) * texture.height; }

void copy_uniforms(StoredLight& light, const Bundle& bundle, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const Uniform* uniform = bundle.find_uniform(name)) light.uniforms.push_back(*uniform);
}

void add_columns(StoredLight& light, std::size_t cells, std::size_t columns) {
  light.numbers += cells * columns;
  light.columns += columns;
}

// RGB of every basis whose coefficients the shader names.
void add_coefficients(StoredLight& light, const Bundle& bundle, const LitTechnique& lit) {
  const std::string code = code_of(technique_source(*lit.technique, lit.storage).text);
  const bool volume = lit.storage == CoefficientStorage::volume;
  const auto is_read = [&](const std::string& name) {
    return name.starts_with(volume ? "volume_" : "coefficients_") && contains_word(code, name);
  };
  if (lit.storage == CoefficientStorage::vertex) {
    for (const Attribute& attribute : bundle.attributes) {
      if (!is_read(attribute.name.substr(0, attribute.name.find('[')))) continue;
      light.attributes.push_back(attribute);
      add_columns(light, bundle.vertex_count(), attribute.components);
    }
    return;
  }
  for (const Texture& texture : bundle.textures) {
    if (!is_read(texture.name)) continue;
    light.textures.push_back(texture);
    add_columns(light, cells_of_layer(texture), texture.layers * 3);
  }
  if (volume) copy_uniforms(light, bundle, {"volume_origin", "volume_scale", "volume_size"});
}

// Techniques may share weights, which are then those of the one that reads most: the first ones are kept, as if there
// were no other.
void add_weights(StoredLight& light, const Bundle& bundle, const LitTechnique& lit) {
  const std::string name = visibility_name(*lit.technique);
  const std::size_t count = std::size_t(lit.technique->count), quads = (count + 3) / 4, last = count - (quads - 1) * 4;
  const auto clear_unread = [&](std::vector<float>& values, std::size_t from) {
    for (std::size_t i = from; i < values.size(); ++i)
      if (i % 4 >= last) values[i] = 0;
  };
  if (lit.storage == CoefficientStorage::vertex) {
    for (std::size_t quad = 0; quad < quads; ++quad) {
      const Attribute* attribute = bundle.find_attribute(fmt::format("{}[{}]", name, quad));
      TWINSHADE_CHECK_EQ(attribute != nullptr, true);
      light.attributes.push_back(*attribute);
    }
    clear_unread(light.attributes.back().values, 0);
    add_columns(light, bundle.vertex_count(), count);
    return;
  }
  const Texture* texture = bundle.find_texture(name);
  TWINSHADE_CHECK_EQ(texture != nullptr, true);
  TWINSHADE_CHECK_LE(quads, std::size_t(texture->layers));
  const std::size_t cells = cells_of_layer(*texture);
  light.textures.push_back({texture->name,
                            texture->kind,
                            texture->width,
                            texture->height,
                            std::uint32_t(quads),
                            texture->filter,
                            texture->wrap,
                            {}});
  light.textures.back().texels.assign(texture->texels.begin(),
                                      texture->texels.begin() + std::ptrdiff_t(quads * cells * 4));
  clear_unread(light.textures.back().texels, (quads - 1) * cells * 4);
  add_columns(light, cells, count);
}

void add_tables(StoredLight& light, const Bundle& bundle, const TechniqueInfo& technique, const SphereMapInfo& map) {
  const Texture* texture = bundle.find_texture(light_tables_name(technique, map));
  TWINSHADE_CHECK_EQ(texture != nullptr, true);
  light.textures.push_back(*texture);
  const int rows = technique.tables == "preconv" ? 1 : technique.count + int(technique.has_mean);
  add_columns(light, cells_of_layer(*texture), std::size_t(rows * map.layers * 3));
}

// Values of `columns` side by side.
void round_values(float* values, std::size_t count, int columns, TexelStorage storage) {
  const std::vector<float> stored = through_storage(std::vector<double>(values, values + count), columns, storage);
  std::copy(stored.begin(), stored.end(), values);
}

}  // namespace

std::uint64_t StoredLight::bytes(TexelStorage storage) const {
  std::uint64_t whole = 0;
  for (const Uniform& uniform : uniforms) whole += uniform.values.size() * 4;
  switch (storage) {
    case TexelStorage::float32:
      return whole + numbers * 4;
    case TexelStorage::half:
      return whole + numbers * 2;
    case TexelStorage::unorm8:
      return whole + numbers + columns * 8;
  }
  return whole;
}

StoredLight stored_light(const Bundle& bundle, const LitTechnique& lit, const SphereMapInfo* map) {
  StoredLight light;
  if (lit.technique->weights == VisibilityWeights::none) {
    add_coefficients(light, bundle, lit);
  } else {
    add_weights(light, bundle, lit);
    if (reads_sphere_map(*lit.technique)) {
      TWINSHADE_CHECK_EQ(map != nullptr, true);
      add_tables(light, bundle, *lit.technique, *map);
    } else {
      copy_uniforms(light, bundle,
                    {lit.technique->weights == VisibilityWeights::sh ? "light_sh2" : "light_components"});
    }
  }
  TWINSHADE_CHECK_LE(std::uint64_t(1), light.numbers);
  return light;
}

StoredLight through_storage(const StoredLight& light, TexelStorage storage) {
  StoredLight stored = light;
  if (storage == TexelStorage::float32) return stored;
  for (Texture& texture : stored.textures)
    parallel_for(texture.layers, [&](std::size_t layer, int) {
      const std::size_t count = cells_of_layer(texture) * 4;
      round_values(texture.texels.data() + layer * count, count, 4, storage);
    });
  parallel_for(stored.attributes.size(), [&](std::size_t i, int) {
    Attribute& attribute = stored.attributes[i];
    round_values(attribute.values.data(), attribute.values.size(), int(attribute.components), storage);
  });
  return stored;
}

RelitBundle::RelitBundle(Bundle scene)
    : bundle_(std::move(scene)),
      textures_(bundle_.textures.size()),
      attributes_(bundle_.attributes.size()),
      uniforms_(bundle_.uniforms.size()) {}

const Bundle& RelitBundle::lit_by(const StoredLight& light) {
  const auto exchange = [](auto& parts, std::size_t own, const auto& others) {
    parts.erase(parts.begin() + std::ptrdiff_t(own), parts.end());
    parts.insert(parts.end(), others.begin(), others.end());
  };
  exchange(bundle_.textures, textures_, light.textures);
  exchange(bundle_.attributes, attributes_, light.attributes);
  exchange(bundle_.uniforms, uniforms_, light.uniforms);
  return bundle_;
}

}  // namespace twinshade

#include "lighting/visibility_bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/portable_math.h"
#include "lighting/light_tables.h"
#include "lighting/radiance_basis.h"
#include "lighting/visibility_textures.h"

namespace twinshade {
namespace {

constexpr double kMostTableBytes = 0x1p31;
constexpr const char* kPackingNote = "visibility_packing";
constexpr std::size_t kAluCosine = 9;  // coefficients that visibility_pca_alu.glsl convolves

std::size_t square(int order) { return std::size_t(order) * std::size_t(order); }

template <class Vector>
void add_attribute(Bundle& bundle, const char* name, const std::vector<Vector>& values) {
  if (bundle.find_attribute(name)) return;
  Attribute out{name, Scalar::f32, std::uint32_t(Vector::length()), {}};
  for (const Vector& value : values)
    for (int c = 0; c < Vector::length(); ++c) out.values.push_back(value[c]);
  out.values.resize(bundle.vertex_count() * Vector::length(), 0.0f);
  bundle.attributes.push_back(std::move(out));
}

class Adder {
 public:
  Adder(Bundle& bundle, std::span<const VisibilityBake> bakes, std::span<const double> radiance,
        std::span<const LitTechnique> wanted, const VisibilityLighting& options)
      : bundle_(bundle), bakes_(bakes), radiance_(radiance), options_(options) {
    for (const LitTechnique& lit : wanted)
      if (lit.technique->weights != VisibilityWeights::none) wanted_.push_back(lit);
  }

  void run() {
    if (std::any_of(wanted_.begin(), wanted_.end(),
                    [](const LitTechnique& lit) { return lit.technique->weights == VisibilityWeights::pca; }))
      components_.emplace(bakes_[0], options_.order, options_.metric,
                          options_.metric_light.empty() ? radiance_ : std::span<const double>(options_.metric_light));
    for (const VisibilityBake& bake : bakes_)
      for (const auto& [name, technique] : most_by_name(bake.storage)) add_weights(bake, name, *technique);
    for (const LitTechnique& lit : wanted_) {
      if (reads_sphere_map(*lit.technique))
        for (const SphereMapInfo* map : options_.maps) add_tables(*lit.technique, *map);
      else
        add_uniforms(*lit.technique);
    }
  }

 private:
  // What to store: techniques that read one texture or attribute share it, made for the one that reads most of it.
  std::map<std::string, const TechniqueInfo*> most_by_name(CoefficientStorage storage) const {
    std::map<std::string, const TechniqueInfo*> most;
    for (const LitTechnique& lit : wanted_) {
      if (lit.storage != storage) continue;
      const auto [found, is_new] = most.try_emplace(visibility_name(*lit.technique), lit.technique);
      if (lit.technique->count > found->second->count) found->second = lit.technique;
    }
    return most;
  }

  // values[cell * count + i]
  std::vector<float> weights_of(const VisibilityBake& bake, VisibilityWeights weights, std::size_t count) {
    if (weights == VisibilityWeights::ambient) return bake.ambient;
    if (weights == VisibilityWeights::pca) return components_->weights(bake, count);
    std::vector<float> values(bake.cells() * count);
    for (std::size_t cell = 0; cell < bake.cells(); ++cell)
      std::copy_n(bake.sh.data() + cell * kVisibilityCount, count, values.data() + cell * count);
    return values;
  }

  void add_weights(const VisibilityBake& bake, const std::string& name, const TechniqueInfo& technique) {
    const auto count = std::size_t(technique.count);
    const std::vector<float> exact = weights_of(bake, technique.weights, count);
    const std::vector<float> values = through_storage({exact.begin(), exact.end()}, int(count), options_.storage);
    const std::size_t cells = bake.cells(), quads = (count + 3) / 4;
    const auto weight = [&](std::size_t cell, std::size_t i) { return i < count ? values[cell * count + i] : 0.0f; };
    if (bake.storage == CoefficientStorage::vertex) {
      for (std::size_t quad = 0; quad < quads; ++quad) {
        Attribute attribute{fmt::format("{}[{}]", name, quad), Scalar::f32, 4, std::vector<float>(cells * 4)};
        for (std::size_t i = 0; i < cells * 4; ++i) attribute.values[i] = weight(i / 4, quad * 4 + i % 4);
        bundle_.attributes.push_back(std::move(attribute));
      }
      return;
    }
    bundle_.textures.push_back(weights_texture(name, bake.width, quads, options_.packing, weight));
  }

  // Light times the mean and the components that a technique reads, as SH of the components' order.
  std::vector<double> light_times_components(const TechniqueInfo& technique) {
    return light_times_vectors(radiance_, components_->rows(std::size_t(technique.count)), options_.order);
  }

  void add_tables(const TechniqueInfo& technique, const SphereMapInfo& map) {
    const std::string name = light_tables_name(technique, map);
    if (bundle_.find_texture(name)) return;
    int order = kHighestOrder;
    std::vector<double> products;
    if (technique.tables == "pca") {
      order = options_.order;
      products = light_times_components(technique);
    } else if (technique.tables == "preconv") {
      // Light as it is: all is visible
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < square(order); ++k) products.push_back(radiance_[k * 3 + c]);
    } else {
      order = int(std::lround(std::sqrt(double(technique.count))));
      products = light_times_harmonics(radiance_, order);
    }
    const int width = table_width(map, options_);
    const double bytes = double(products.size()) / double(square(order)) / 3 * map.texels(width) * 16;
    if (bytes > kMostTableBytes)
      throw UserError(fmt::format("map width {}: tables {} would take {:.1f} GiB, more than {:.0f}; make it smaller",
                                  width, name, bytes * 0x1p-30, kMostTableBytes * 0x1p-30));
    const LightTableMap tables(map, width, order);
    bundle_.textures.push_back(
        light_table_texture(name, tables.tables(products), map, width, technique.has_mean, options_.packing));
  }

  void add_uniforms(const TechniqueInfo& technique) {
    if (technique.weights == VisibilityWeights::sh) {
      if (bundle_.find_uniform("light_sh2")) return;
      Uniform light{"light_sh2", Scalar::f32, 1, 3, 4, {}};
      for (std::size_t i = 0; i < 12; ++i) light.values.push_back(float(radiance_[i]));
      bundle_.uniforms.push_back(std::move(light));
      return;
    }
    if (bundle_.find_uniform("light_components")) return;
    const std::vector<double> products = light_times_components(technique);
    const std::size_t n = square(options_.order), rows = std::size_t(technique.count) + 1;
    Uniform light{"light_components", Scalar::f32, 1, 3, std::uint32_t(rows * kAluCosine), {}};
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t k = 0; k < kAluCosine; ++k)
        for (std::size_t c = 0; c < 3; ++c)
          light.values.push_back(k < n ? float(products[(row * 3 + c) * n + k]) : 0.0f);
    bundle_.uniforms.push_back(std::move(light));
  }

  Bundle& bundle_;
  const std::span<const VisibilityBake> bakes_;
  const std::span<const double> radiance_;
  const VisibilityLighting& options_;
  std::vector<LitTechnique> wanted_;
  std::optional<VisibilityComponents> components_;
};

}  // namespace

int table_width(const SphereMapInfo& map, const VisibilityLighting& options) {
  int width = options.map_width == 0 ? map.usual_width() : options.map_width;
  for (int i = 0; i < options.map_halvings; ++i) width = SphereMapInfo::half(width);
  return width;
}

void add_visibility(Bundle& bundle, const Scene& scene, std::span<const VisibilityBake> bakes,
                    std::span<const double> radiance, std::span<const LitTechnique> wanted,
                    const VisibilityLighting& options) {
  if (options.order < 2 || options.order > kHighestOrder)
    throw UserError(fmt::format("visibility order {}: must be from 2 to {}", options.order, kHighestOrder));
  TWINSHADE_CHECK_EQ(radiance.size(), square(kHighestOrder) * 3);
  if (!options.metric_light.empty()) TWINSHADE_CHECK_EQ(options.metric_light.size(), radiance.size());
  if (bakes.empty()) return;
  add_attribute(bundle, "v_normal", scene.normals);
  add_attribute(bundle, "v_tangent", scene.tangents);
  for (const VisibilityBake& bake : bakes) {
    if (bake.storage == CoefficientStorage::lightmap)
      add_attribute(bundle, "v_lightmap_uv", scene.lightmap_uvs);
    else
      TWINSHADE_CHECK_EQ(bake.cells(), bundle.vertex_count());
  }
  Adder(bundle, bakes, radiance, wanted, options).run();

  for (const VisibilityBake& bake : bakes)
    for (const auto& [key, value] : bake.notes)
      bundle.notes.emplace_back(fmt::format("{}_{}", storage_name(bake.storage), key), value);
  std::vector<std::string_view> maps;
  std::vector<int> widths;
  for (const SphereMapInfo* map : options.maps) maps.push_back(map->name), widths.push_back(table_width(*map, options));
  bundle.notes.emplace_back("maps", fmt::format("{}", fmt::join(maps, " ")));
  bundle.notes.emplace_back("map_width", fmt::format("{}", fmt::join(widths, " ")));
  bundle.notes.emplace_back("visibility_order", std::to_string(options.order));
  bundle.notes.emplace_back("pca_metric", std::string(pca_metric_name(options.metric)));
  bundle.notes.emplace_back("visibility_storage", std::string(texel_storage_name(options.storage)));
  bundle.notes.emplace_back(kPackingNote, std::string(texture_packing_name(options.packing)));
}

TexturePacking texture_packing(const Bundle& bundle) {
  const std::string* note = bundle.find_note(kPackingNote);
  return note ? find_texture_packing(*note) : TexturePacking::layers;
}

}  // namespace twinshade

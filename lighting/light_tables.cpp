#include "lighting/light_tables.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/error.h"
#include "cpu_shaders/machine.h"
#include "lighting/light_table_kernel.h"
#include "lighting/radiance_basis.h"
#include "lighting/sh_product.h"
#include "lighting/sphere_map_grid.h"

namespace twinshade {
namespace {

using light_table::kBlock;

light_table::Kernel kernel() {
#if defined(__x86_64__)
  if (machine_isa() == Isa::avx512) return light_table::kernel_of_avx512();
  if (machine_isa() == Isa::avx2) return light_table::kernel_of_avx2();
#endif
  return light_table::kernel_of_baseline();
}

bool runs(const std::uint32_t* texels, std::int64_t step) {
  for (std::size_t i = 1; i < kBlock; ++i)
    if (std::int64_t(texels[i]) - std::int64_t(texels[i - 1]) != step) return false;
  return true;
}

}  // namespace

std::vector<double> light_times_vectors(std::span<const double> light, std::span<const double> vectors, int order) {
  const std::size_t n = std::size_t(order) * std::size_t(order), rows = vectors.size() / n;
  TWINSHADE_CHECK_LE(3 * n, light.size());
  std::vector<double> products(rows * 3 * n, 0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<double> matrix = sh_product_matrix(light.subspan(c), 3, order);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k < n; ++k) products[(r * 3 + c) * n + k] += vectors[r * n + j] * matrix[j * n + k];
  }
  return products;
}

std::vector<double> light_times_harmonics(std::span<const double> light, int order) {
  const std::size_t n = std::size_t(order) * std::size_t(order);
  TWINSHADE_CHECK_LE(3 * n, light.size());
  std::vector<double> products(n * 3 * n);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<double> matrix = sh_product_matrix(light.subspan(c), 3, order);
    for (std::size_t j = 0; j < n; ++j) std::copy_n(matrix.data() + j * n, n, products.data() + (j * 3 + c) * n);
  }
  return products;
}

LightTableMap::LightTableMap(const SphereMapInfo& map, int width, int order)
    : map_(map), width_(width), order_(order), texels_(0) {
  TWINSHADE_CHECK_LE(1, order);
  TWINSHADE_CHECK_LE(order, 6);
  const SphereMapGrid grid(map, width);
  texels_ = std::size_t(grid.texels());
  const std::array<double, kMostRadianceCount> cosine = clamped_cosine_factors();
  for (const int parity : {0, 1}) {
    for (int l = 0, k = 0; l < order; ++l)
      for (int m = -l; m <= l; ++m, ++k)
        if (cosine[std::size_t(k)] != 0 && (l + m + 2 * l) % 2 == parity) functions_.push_back(k);
    if (parity == 0) even_ = functions_.size();
  }

  // Each texel that looks up, with one that looks at its mirror image
  const std::vector<glm::dvec3> normals = grid.directions();
  std::map<std::tuple<double, double, double>, std::vector<std::uint32_t>> below;
  const auto key = [](const glm::dvec3& n) { return std::tuple(n.x + 0.0, n.y + 0.0, std::abs(n.z)); };
  for (std::size_t t = normals.size(); t-- > 0;)
    if (normals[t].z < 0) below[key(normals[t])].push_back(std::uint32_t(t));
  std::vector<std::uint8_t> taken(normals.size(), 0);
  for (std::uint32_t t = 0; t < normals.size(); ++t) {
    if (!(normals[t].z >= 0)) continue;
    const auto entry = below.find(key(normals[t]));
    upper_.push_back(t);
    lower_.push_back(t);
    if (entry != below.end() && !entry->second.empty()) {
      lower_.back() = entry->second.back();
      entry->second.pop_back();
      taken[lower_.back()] = 1;
    }
  }
  for (std::uint32_t t = 0; t < normals.size(); ++t)
    if (!(normals[t].z >= 0) && !taken[t]) {
      upper_.push_back(t);
      lower_.push_back(t);
    }
  while (upper_.size() % kBlock != 0) {
    upper_.push_back(upper_.back());
    lower_.push_back(lower_.back());
  }
  for (std::size_t b = 0; b < upper_.size(); b += kBlock)
    layout_.push_back(std::uint8_t((runs(&upper_[b], 1) ? light_table::kUpperRuns : 0) |
                                   (runs(&lower_[b], 1) ? light_table::kLowerRunsUp : 0) |
                                   (runs(&lower_[b], -1) ? light_table::kLowerRunsDown : 0)));

  std::vector<glm::dvec3> looking;
  for (const std::uint32_t t : upper_) looking.push_back(normals[t]);
  const std::vector<double> values = radiance_basis(looking, kMostRadianceCount);
  cosine_.resize(functions_.size() * upper_.size());
  for (std::size_t f = 0; f < functions_.size(); ++f)
    for (std::size_t i = 0; i < upper_.size(); ++i) {
      const std::size_t k = std::size_t(functions_[f]);
      cosine_[f * upper_.size() + i] = float(values[i * kMostRadianceCount + k] * cosine[k]);
    }
}

LightTables LightTableMap::tables(std::span<const double> products) const {
  LightTables tables;
  tables.rows = products.size() / (3 * std::size_t(order_) * std::size_t(order_));
  tables.texels = texels_;
  tables.values.resize(tables.rows * 3 * texels_);
  fill(products, tables);
  return tables;
}

void LightTableMap::fill(std::span<const double> products, LightTables& tables) const {
  const std::size_t n = std::size_t(order_) * std::size_t(order_), rows = tables.rows;
  TWINSHADE_CHECK_EQ(products.size(), rows * 3 * n);
  TWINSHADE_CHECK_EQ(tables.values.size(), rows * 3 * texels_);
  std::vector<float> used(rows * 3 * functions_.size());
  for (std::size_t row = 0; row < rows * 3; ++row)
    for (std::size_t f = 0; f < functions_.size(); ++f)
      used[row * functions_.size() + f] = float(products[row * n + std::size_t(functions_[f])]);
  kernel().fill({used.data(), rows, even_, functions_.size() - even_, cosine_.data(), upper_.data(), lower_.data(),
                 layout_.data(), layout_.size(), texels_, tables.values.data()});
}

void blend_tables(const LightTables& a, const LightTables& b, float part, LightTables& out) {
  TWINSHADE_CHECK_EQ(a.values.size(), b.values.size());
  TWINSHADE_CHECK_EQ(a.values.size(), out.values.size());
  kernel().blend(a.values.data(), b.values.data(), part, out.values.data(), out.values.size());
}

LightTables blend_tables(const LightTables& a, const LightTables& b, float part) {
  LightTables out{a.rows, a.texels, std::vector<float>(a.values.size())};
  blend_tables(a, b, part, out);
  return out;
}

}  // namespace twinshade

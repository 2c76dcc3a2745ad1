// Tables of L x H: what light gives for each visibility function, by the normal, on a sphere map. Irradiance is then
// the sum of a surface's visibility coefficients times the table's colours towards its normal. Iwanicki and Sloan,
// Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, sections 3.1 to 3.3.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "lighting/sphere_maps.h"

namespace twinshade {

// Light L (radiance, real SH: light[j * 3 + c], at least order^2 of them) times functions V_r of the direction
// (vectors[r * order^2 + j]), as SH of the same order: products[(r * 3 + c) * order^2 + k].
std::vector<double> light_times_vectors(std::span<const double> light, std::span<const double> vectors, int order);
// The same where V_r is the r-th spherical harmonic, r < order^2: the product matrix of the light.
std::vector<double> light_times_harmonics(std::span<const double> light, int order);

// Colours by row and texel of a sphere map: values[(row * 3 + c) * texels + texel].
struct LightTables {
  std::size_t rows = 0, texels = 0;
  std::vector<float> values;
};

// The normals of a sphere map's texels and the clamped cosine around each, as SH. Thread-safe once made.
class LightTableMap {
 public:
  // order: 1 to 6. UserError where the width is not 1 to 4096 or the tables' texels are too many for memory.
  LightTableMap(const SphereMapInfo& map, int width, int order);

  const SphereMapInfo& map() const { return map_; }
  int width() const { return width_; }
  int order() const { return order_; }
  std::size_t texels() const { return texels_; }

  // The integral over the sphere of products_r times the clamped cosine about each texel's normal, for each row r of
  // products[(r * 3 + c) * order^2 + k]. In float: sums in a fixed order, whatever the instruction set.
  LightTables tables(std::span<const double> products) const;
  // The same into tables made before.
  void fill(std::span<const double> products, LightTables& tables) const;

 private:
  const SphereMapInfo& map_;
  int width_, order_;
  std::size_t texels_;
  // Functions that the clamped cosine has (l = 0, 1 and even l): those even in z (l + m even), then those odd in z
  std::vector<int> functions_;
  std::size_t even_ = 0;
  // Texels of the upper hemisphere and their mirror images below (itself where there is none), in blocks
  std::vector<std::uint32_t> upper_, lower_;
  std::vector<std::uint8_t> layout_;  // of each block: how upper_ and lower_ run
  std::vector<float> cosine_;         // [function in functions_][texel in upper_]
};

// a + (b - a) * part, 0 <= part <= 1: light that moves between two environments. Equal sizes.
LightTables blend_tables(const LightTables& a, const LightTables& b, float part);
void blend_tables(const LightTables& a, const LightTables& b, float part, LightTables& out);

}  // namespace twinshade

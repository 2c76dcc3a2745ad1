// From radiance or samples of irradiance to the coefficients that a basis stores, and back. The rule is the registry's
// (Projection), the functions are those of the basis' GLSL in double.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"
#include "lighting/registry.h"

namespace twinshade {

// Coefficients of irradiance from radiance as real SH. Thread-safe after construction, which is the expensive part;
// what it computes is kept for the process.
class Projector {
 public:
  // radiance_count: 25 (l <= 4; of the tangent hemisphere: lightmaps, vertices) or 36 (l <= 5; of the sphere: volumes).
  // UserError where `basis` is no basis or cannot be fitted.
  Projector(const TechniqueInfo& basis, int radiance_count);
  ~Projector();
  Projector(Projector&&) noexcept;
  Projector& operator=(Projector&&) noexcept;

  // radiance[j * 3 + c] to coefficients[i * 3 + c], i < basis.count. Finite radiance gives finite coefficients;
  // radiance without energy gives zeros, and a direction that does not matter where one is stored.
  void project(const double* radiance, double* coefficients) const;
  // The same for `cells` of them, one after the other: faster for bases whose shader has to be run.
  void project(const double* radiance, double* coefficients, std::size_t cells) const;

  class Rule;

 private:
  std::shared_ptr<const Rule> rule_;
};

// Coefficients from samples of irradiance: the weighted least-squares fit (least_squares, truncation; then windowed
// where the rule says so; with no coefficient below zero for nonnegative; in YCoCg for luma_chroma), else the rule of
// the basis applied to radiance. Over the whole sphere with solid angles as weights, truncation is the same as least
// squares.
class SampleProjector {
 public:
  // Unit directions, and a weight (solid angle, say) for each. UserError where a direction is zero or not finite, a
  // weight negative or not finite, or the directions are too few to tell the basis' functions apart.
  SampleProjector(const TechniqueInfo& basis, std::span<const glm::dvec3> directions, std::span<const double> weights);
  ~SampleProjector();
  SampleProjector(SampleProjector&&) noexcept;
  SampleProjector& operator=(SampleProjector&&) noexcept;

  // irradiance[p * 3 + c] at direction p. radiance_sh[j * 3 + c], j < 36: real SH of the radiance, for bases that are
  // made from it (value_at_normal, through_sh3, irradiance_sh2, zonal, ambient_highlight), else it may be empty.
  // Returns coefficients[i * 3 + c]. UserError where a sample is not finite or radiance is missing.
  std::vector<double> project(std::span<const double> irradiance, std::span<const double> radiance_sh) const;

  class Rule;

 private:
  std::unique_ptr<const Rule> rule_;
};

// Irradiance [p * 3 + c] at directions, by the basis' own GLSL in `number` (float64, or scalar: as the shader computes
// it in float). coefficients[i * 3 + c].
std::vector<double> reconstruct(const TechniqueInfo& basis, std::span<const double> coefficients,
                                std::span<const glm::dvec3> directions, Number number = Number::float64);

}  // namespace twinshade

// How samples of irradiance become coefficients: what Projector and SampleProjector share.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "lighting/registry.h"
#include "lighting/windows.h"

namespace twinshade {

// Coefficients from irradiance at fixed directions, samples[p * 3 + c], and, where the fit needs it, radiance as real
// SH, radiance[j * 3 + c], of which l <= 1 is read. coefficients[i * 3 + c].
class SampleFit {
 public:
  virtual ~SampleFit() = default;
  virtual void solve(const double* samples, const double* radiance, double* coefficients) const = 0;
};

// A fit of which moments of the samples are enough: sums over the directions of weight * function * irradiance.
class MomentFit : public SampleFit {
 public:
  virtual int moment_count() const = 0;
  virtual void moments(const double* samples, double* moments) const = 0;
  virtual void solve(const double* moments, double* coefficients) const = 0;
  void solve(const double* samples, const double* radiance, double* coefficients) const final;
};

// Weighted least squares over the directions: linear bases, without bounds or, where the projection is `nonnegative`,
// with no coefficient below zero; and luma_chroma, where the basis gives a linear function of all numbers of its
// coefficients together, whatever they mean, and the error is measured in YCoCg. UserError where the functions depend
// on each other over the directions.
std::unique_ptr<const MomentFit> make_moment_fit(const TechniqueInfo& basis, std::span<const glm::dvec3> directions,
                                                 std::span<const double> weights);

// Ambient and highlight: coefficient 2 is the unit direction that luminance comes from (its l = 1; up where it has
// none), 0 and 1 the colours, least squares over the directions with neither below zero.
std::unique_ptr<const SampleFit> make_ambient_highlight_fit(const TechniqueInfo& basis,
                                                            std::span<const glm::dvec3> directions,
                                                            std::span<const double> weights);

// Unit direction of the luminance (Rec. 709) of a signal in real SH, sh[j * 3 + c]: its l = 1. Zero where that is 0.
glm::dvec3 luminance_axis(const double* sh);

// Multiplies band l of sh[j * 3 + c], l <= 2.
void apply_window(double* sh, const BandFactors& factors);

}  // namespace twinshade

// How bases of the hemisphere take a signal: by least squares over its samples, or from its radiance.
#pragma once

#include "experiments/hemisphere_signals.h"
#include "lighting/projection.h"
#include "lighting/quadrature.h"

namespace twinshade {

// For chosen_bases: bases with a linear form over the hemisphere.
std::string why_not_hemispherical(const TechniqueInfo& basis);

class HemisphereFit {
 public:
  // points: where signals are sampled and fitted.
  HemisphereFit(const TechniqueInfo& basis, const Quadrature& points);

  const TechniqueInfo& basis() const { return basis_; }
  const Matrix& functions() const { return functions_; }  // [point][function]
  bool fits_samples() const { return basis_.projection == Projection::least_squares; }

  // Coefficients [function][signal].
  Matrix coefficients(const SignalBlock& block) const;
  // Of bases that are not fitted to samples: from 25 SH of radiance and the irradiance at the normal (0, 0, 1).
  std::vector<double> from_radiance(const std::vector<double>& radiance, double flat) const;

 private:
  const TechniqueInfo& basis_;
  Projector projector_;
  Matrix functions_, solution_;  // solution [function][point]: least squares over the points
};

// What a basis makes of one impulse, and the integral of the squared error over the hemisphere. All integrals run over
// the lune that the impulse lights: its horizon is a kink, which a quadrature of the hemisphere smears.
struct ImpulseFit {
  Eigen::VectorXd coefficients;
  double squared_error = 0;
};
std::vector<ImpulseFit> fit_impulses(const HemisphereFit& fit, const Impulses& impulses);

}  // namespace twinshade

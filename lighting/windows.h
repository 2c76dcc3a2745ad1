// Windows against ringing: band l of irradiance in spherical harmonics is multiplied by a factor that falls with l
// (Iwanicki and Sloan, Ambient Dice, EGSR 2017, eq. 8; Sloan, Stupid Spherical Harmonics Tricks, GDC 2008,
// "windowing").
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "lighting/registry.h"

namespace twinshade {

// Factors of l = 0, 1, 2 for order 3, w being where the window ends: w = 3, the first band that is left out.
//   Hanning  (1 + cos(pi l / w)) / 2: 1, 3/4, 1/4
//   Lanczos  sin(pi l / w) / (pi l / w): 1, 0.827, 0.413
using BandFactors = std::array<double, 3>;
BandFactors hanning_window(double width = 3);
BandFactors lanczos_window(double width = 3);

// Sloan, Deringing Spherical Harmonics, SIGGRAPH Asia Technical Briefs 2017: the Lanczos factors to the fourth power,
// whose width is searched for. Half of the cosine lobe's amplitude in l = 1 is left at width 3, where irradiance of any
// light that is not negative is positive; none is taken away at infinite width. strength = 1 / width.
BandFactors minimum_window(double strength);

// The weakest minimum_window, one for all channels (so that hues stay), under which no channel's irradiance falls below
// zero anywhere in a domain: for lightmaps and vertices the tangent hemisphere's normals, else the sphere.
class MinimumWindow {
 public:
  explicit MinimumWindow(Domain domain);

  // sh[j * 3 + c]: irradiance, l <= 2. Between 0 (nothing to do) and 1/3, which is also the answer where no window
  // would do (negative light). Channels without light are left aside.
  double strength(const double* sh) const;

 private:
  // Irradiance of a channel as a polynomial of the direction: constant + linear . n + n . (quadratic n).
  struct Polynomial {
    double constant;
    glm::dvec3 linear;
    glm::dmat3 quadratic;
  };
  // Bands 1 and 2 of a channel at a direction, over the constant.
  struct Place {
    double band1, band2;
  };
  Polynomial polynomial(const double* sh, int channel) const;
  glm::dvec3 descend(const Polynomial& channel, const BandFactors& factors, glm::dvec3 n) const;

  bool hemisphere_;
  std::vector<glm::dvec3> directions_;
  double constant_;          // SH 0
  glm::dvec3 linear_[3];     // SH 1 to 3
  glm::dmat3 quadratic_[5];  // SH 4 to 8
};

}  // namespace twinshade

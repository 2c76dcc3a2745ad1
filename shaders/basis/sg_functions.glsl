// Spherical Gaussians as a linear basis of irradiance: exp(s (cosine - 1)) about fixed axes that are evenly distributed (each set
// has the largest smallest angle there is, Tammes' problem), all of one sharpness s = 2.133: that of the Gaussian nearest to
// a clamped cosine. Pettineo, SG Series and Baking Lab, 2016; Wang, Ren, Gong, Snyder and Guo, All-Frequency Rendering of
// Dynamic, Spatially-Varying Reflectance, 2009. A smaller s has a lower least-squares error, down to 0, where the lobes
// become polynomials; but their coefficients grow large, of both signs, as the lobes come to differ little.
#include "exact/exp2.glsl"

float sg_lobe(float cosine) {
  precise float exponent = (cosine - 1.0) * 3.07726852;  // 2.133/ln 2
  return exact_exp2(exponent);
}

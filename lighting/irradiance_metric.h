// How much a difference of visibility matters to irradiance under one light: the square of the difference that it
// makes, integrated over normals. With it as the metric of principal components a few keep what the light shows; those
// of plain visibility (NMV section 3.2) serve any light and keep what no light shows as well.
#pragma once

#include <span>
#include <vector>

namespace twinshade {

// light: radiance, real SH, [j * 3 + channel], at least order^2 functions. For visibility as order^2 coefficients v the
// irradiance about a normal n is sum_j A_j Y_j(n) sum_i v_i P_ij, P the light's product matrix of each channel (NMV
// section 3.1) and A the clamped cosine; so the integral of its square over all n, the channels added, is v' M v, M_ik
// = sum over channels and j of A_j^2 P_ij P_kj. [i * order^2 + k], symmetric. What no normal shows keeps a millionth of
// the mean weight, so that M is positive definite; of black light: identity.
std::vector<double> irradiance_metric(std::span<const double> light, int order);

}  // namespace twinshade

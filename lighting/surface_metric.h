// How much a difference of visibility matters to irradiance under any light, on surfaces that face one way: what lies
// below a surface its normals never show, and what grazes it hardly. Components fitted by these metrics
// (lighting/weighted_components.h) spend little on that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace twinshade {

// Which way surfaces face, in groups: the cells of a cube map of normals. By cell, of normals[cell * 3 + c]; without
// length: any group.
inline constexpr std::size_t kSurfaceGroups = 6 * 9 * 9;
std::vector<std::uint16_t> surface_groups(std::span<const float> normals);

// A metric for each group, facing the weighted mean of its cells' normals (its middle, where no cell counts):
// [(group * order^2 + i) * order^2 + k], symmetric, positive definite. cell_weights: as of principal_components.
// Irradiance about a normal n is l' P v, of light l and visibility v as real SH of `order` (1 to 6), P the product
// matrix of the clamped cosine about n (NMV section 3.1). So P P is the mean of its square over lights whose
// coefficients are independent and alike, and the metric the mean of that over normals about the group's, as far as
// normal maps tilt them. Every difference keeps a few hundredths of the mean weight: normals may tilt further, and
// between cells visibility is interpolated.
std::vector<double> surface_metrics(std::span<const float> normals, std::span<const float> cell_weights, int order);

}  // namespace twinshade

// Where the rows of a table lie on a grid of fragments, the same on every machine: four rows in a sequence are a 2 x 2
// quad, so that derivatives are taken between the same rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace twinshade {

inline constexpr std::uint32_t kGridWidth = 64;  // fixed, so that a row's place does not depend on how many there are
inline constexpr std::size_t kMostGridRows = std::size_t{kGridWidth} * 16384;

// Of row i; y upwards.
constexpr std::array<std::uint32_t, 2> grid_pixel(std::size_t row) {
  const std::size_t quad = row / 4, quads_across = kGridWidth / 2;
  return {std::uint32_t(quad % quads_across * 2 + row % 2), std::uint32_t(quad / quads_across * 2 + row / 2 % 2)};
}

constexpr std::uint32_t grid_height(std::size_t rows) {
  return std::uint32_t((rows + 2 * kGridWidth - 1) / (2 * kGridWidth) * 2);
}

}  // namespace twinshade

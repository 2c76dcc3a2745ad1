// What is left of values after they have been stored in texels.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twinshade {

// unorm8: 255 steps between the least and the greatest value of a column, each column with its own range.
enum class TexelStorage { float32, half, unorm8 };

std::string_view texel_storage_name(TexelStorage storage);
// UserError with the nearest names where there is none.
TexelStorage find_texel_storage(const std::string& name);

// values: [row * columns + column], finite. Rounded to nearest, ties to even (unorm8: up).
std::vector<float> through_storage(const std::vector<double>& values, int columns, TexelStorage storage);

// The nearest IEEE half; beyond 65504 infinite, denormals kept.
float round_to_half(double value);

}  // namespace twinshade

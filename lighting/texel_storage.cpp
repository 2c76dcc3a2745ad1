#include "lighting/texel_storage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/names.h"

namespace twinshade {

std::string_view texel_storage_name(TexelStorage storage) {
  return storage == TexelStorage::float32 ? "float32" : storage == TexelStorage::half ? "half" : "unorm8";
}

TexelStorage find_texel_storage(const std::string& name) {
  std::vector<std::string> names;
  for (const TexelStorage storage : {TexelStorage::float32, TexelStorage::half, TexelStorage::unorm8}) {
    names.emplace_back(texel_storage_name(storage));
    if (names.back() == name) return storage;
  }
  throw UserError(unknown_name_message("storage", name, names));
}

float round_to_half(double value) {
  const double magnitude = std::fabs(value);
  if (!(magnitude < 65520)) return magnitude >= 65520 ? float(std::copysign(HUGE_VAL, value)) : float(value);
  int exponent = 0;
  std::frexp(magnitude, &exponent);
  const int last = std::max(exponent - 11, -24);  // of eleven bits; denormals have fewer
  return float(std::ldexp(std::nearbyint(std::ldexp(value, -last)), last));
}

std::vector<float> through_storage(const std::vector<double>& values, int columns, TexelStorage storage) {
  std::vector<float> stored(values.size());
  if (storage != TexelStorage::unorm8) {
    for (std::size_t i = 0; i < values.size(); ++i)
      stored[i] = storage == TexelStorage::half ? round_to_half(values[i]) : float(values[i]);
    return stored;
  }
  const std::size_t width = std::size_t(columns);
  for (std::size_t column = 0; column < width; ++column) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = column; i < values.size(); i += width)
      low = std::min(low, values[i]), high = std::max(high, values[i]);
    const double range = high - low;
    for (std::size_t i = column; i < values.size(); i += width)
      stored[i] =
          range > 0 ? float(low + range * (std::floor((values[i] - low) / range * 255 + 0.5) / 255)) : float(low);
  }
  return stored;
}

}  // namespace twinshade

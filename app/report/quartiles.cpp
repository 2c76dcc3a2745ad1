#include "app/report/quartiles.h"

#include <algorithm>

#include "base/error.h"

namespace twinshade {

Quartiles quartiles(std::vector<double> values) {
  TWINSHADE_CHECK_LT(0u, values.size());
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) {
    const double place = fraction * double(values.size() - 1);
    const auto below = std::size_t(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (values[above] - values[below]) * (place - double(below));
  };
  return {at(0.25), at(0.5), at(0.75)};
}

}  // namespace twinshade

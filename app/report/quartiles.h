// Median and quartiles of a few timings.
#pragma once

#include <vector>

namespace twinshade {

struct Quartiles {
  double q1 = 0, median = 0, q3 = 0;
};

// By linear interpolation between order statistics (Hyndman and Fan's definition 7, that of R and NumPy). values: at
// least one.
Quartiles quartiles(std::vector<double> values);

}  // namespace twinshade

// doctest::Approx adds 1 to the magnitude that its epsilon is relative to: for small numbers that is no comparison at
// all.
#pragma once

#include <doctest/doctest.h>

namespace twinshade::test {

inline doctest::Approx relative(double expected, double epsilon) {
  return doctest::Approx(expected).epsilon(epsilon).scale(0);
}

}  // namespace twinshade::test

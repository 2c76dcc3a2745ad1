#include "app/report/quartiles.h"

#include <doctest/doctest.h>

namespace twinshade {

TEST_CASE("quartiles interpolate between order statistics, whatever the order given") {
  const Quartiles five = quartiles({5, 1, 4, 2, 3});
  CHECK(five.q1 == 2);
  CHECK(five.median == 3);
  CHECK(five.q3 == 4);
  const Quartiles four = quartiles({4, 3, 2, 1});
  CHECK(four.q1 == doctest::Approx(1.75));
  CHECK(four.median == doctest::Approx(2.5));
  CHECK(four.q3 == doctest::Approx(3.25));
}

TEST_CASE("one timing is its own quartiles") {
  const Quartiles one = quartiles({7});
  CHECK(one.q1 == 7);
  CHECK(one.median == 7);
  CHECK(one.q3 == 7);
}

}  // namespace twinshade

#include "experiments/pareto.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace twinshade;

namespace {

using Places = std::vector<std::size_t>;

Places frontier(const std::vector<double>& cost, const std::vector<double>& error) {
  return pareto_frontier(cost, error);
}

}  // namespace

TEST_CASE("what another choice is better than in one thing and as good in the other is not on the frontier") {
  CHECK(frontier({3, 1, 2, 2}, {1, 5, 4, 2}) == Places{1, 3, 0});
  CHECK(frontier({1, 2}, {4, 4}) == Places{0});
  CHECK(frontier({1, 1}, {4, 3}) == Places{1});
  CHECK(frontier({}, {}).empty());
}

TEST_CASE("choices that are alike are all on the frontier") {
  CHECK(frontier({2, 1, 2, 1}, {1, 3, 1, 3}) == Places{1, 3, 0, 2});
}

TEST_CASE("what has no number is not on the frontier") {
  CHECK(frontier({1, 2, std::nan(""), 3}, {std::nan(""), 4, 1, 3}) == Places{1, 3});
}

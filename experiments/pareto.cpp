#include "experiments/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"

namespace twinshade {

std::vector<std::size_t> pareto_frontier(std::span<const double> cost, std::span<const double> error) {
  TWINSHADE_CHECK_EQ(cost.size(), error.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cost.size(); ++i)
    if (!std::isnan(cost[i]) && !std::isnan(error[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(cost[a], error[a], a) < std::tuple(cost[b], error[b], b);
  });
  std::vector<std::size_t> frontier;
  for (const std::size_t i : order) {
    const bool equal = !frontier.empty() && cost[i] == cost[frontier.back()] && error[i] == error[frontier.back()];
    if (frontier.empty() || equal || error[i] < error[frontier.back()]) frontier.push_back(i);
  }
  return frontier;
}

}  // namespace twinshade

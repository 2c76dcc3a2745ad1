// Which of many choices are worth having when two things count.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace twinshade {

// The Pareto frontier: the choices of which no other is as good in both and better in one, lower being better. Those
// with a NaN are not on it. In order of cost. cost, error: as many.
std::vector<std::size_t> pareto_frontier(std::span<const double> cost, std::span<const double> error);

}  // namespace twinshade

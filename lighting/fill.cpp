// Breadth first: each round fills every empty cell beside a filled one with the mean of those of its neighbours that
// were filled before the round. First the receivers, among themselves, then the gutters around them.
#include "lighting/fill.h"

#include <algorithm>

namespace twinshade {
namespace {

std::vector<std::uint8_t> cells_that_receive(const Receivers& receivers) {
  std::vector<std::uint8_t> receives;
  for (const std::uint32_t receiver : receivers.receiver_of_cell) receives.push_back(receiver != kNoReceiver);
  return receives;
}

}  // namespace

template <class Neighbours>
FillPlan FillPlan::grow(const std::vector<std::uint8_t>& known, const std::vector<std::uint8_t>& receives, int gutter,
                        const Neighbours& neighbours) {
  FillPlan plan;
  std::vector<std::uint8_t> state(known);  // 0 empty, 1 filled, 2 waiting for this round
  std::vector<std::uint32_t> frontier, next;
  const auto is_receiver = [&](std::uint32_t cell) { return receives[cell] != 0; };

  // Fills cells beside the frontier and makes them the next frontier
  const auto round = [&](const auto& wanted) {
    next.clear();
    for (const std::uint32_t cell : frontier)
      neighbours(cell, [&](std::uint32_t other) {
        if (state[other] != 0 || !wanted(other)) return;
        state[other] = 2;
        next.push_back(other);
      });
    std::sort(next.begin(), next.end());
    for (const std::uint32_t cell : next) {
      const std::uint32_t first = std::uint32_t(plan.sources_.size());
      neighbours(cell, [&](std::uint32_t other) {
        if (state[other] == 1) plan.sources_.push_back(other);
      });
      plan.steps_.push_back({cell, first, std::uint32_t(plan.sources_.size()) - first});
    }
    for (const std::uint32_t cell : next) state[cell] = 1;
    frontier.swap(next);
  };

  for (std::uint32_t cell = 0; cell < known.size(); ++cell)
    if (known[cell]) frontier.push_back(cell);
  while (!frontier.empty()) round(is_receiver);

  frontier.clear();
  for (std::uint32_t cell = 0; cell < receives.size(); ++cell) {
    if (!receives[cell]) continue;
    state[cell] = 1;
    frontier.push_back(cell);
  }
  for (int step = 0; step < gutter; ++step) round([&](std::uint32_t cell) { return !is_receiver(cell); });
  return plan;
}

FillPlan FillPlan::grid(const std::vector<std::uint8_t>& known, const glm::ivec3& size) {
  const std::uint32_t steps[] = {1, std::uint32_t(size.x), std::uint32_t(size.x) * std::uint32_t(size.y)};
  return grow(known, std::vector<std::uint8_t>(known.size(), 1), 0, [&](std::uint32_t cell, const auto& visit) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t place = cell / steps[axis] % std::uint32_t(size[axis]);
      if (place > 0) visit(cell - steps[axis]);
      if (place + 1 < std::uint32_t(size[axis])) visit(cell + steps[axis]);
    }
  });
}

FillPlan FillPlan::lightmap(const std::vector<std::uint8_t>& known, const Receivers& receivers, int gutter) {
  const std::int64_t width = receivers.width, height = receivers.height;
  return grow(known, cells_that_receive(receivers), gutter, [=](std::uint32_t cell, const auto& visit) {
    const std::int64_t x = cell % width, y = cell / width;
    for (std::int64_t j = std::max<std::int64_t>(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
      for (std::int64_t i = std::max<std::int64_t>(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
        if (i != x || j != y) visit(std::uint32_t(j * width + i));
  });
}

FillPlan FillPlan::vertices(const std::vector<std::uint8_t>& known, const Receivers& receivers, const Scene& scene) {
  // Neighbours by vertex, each once, ascending
  std::vector<std::vector<std::uint32_t>> adjacent(receivers.width);
  for (std::size_t corner = 0; corner < scene.indices.size(); ++corner) {
    const std::size_t base = corner - corner % 3;
    for (std::size_t k = 1; k < 3; ++k)
      adjacent[scene.indices[corner]].push_back(scene.indices[base + (corner % 3 + k) % 3]);
  }
  for (std::vector<std::uint32_t>& list : adjacent) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return grow(known, cells_that_receive(receivers), 0, [&](std::uint32_t cell, const auto& visit) {
    for (const std::uint32_t other : adjacent[cell])
      if (other != cell) visit(other);
  });
}

void FillPlan::apply(std::span<float> cells, std::size_t stride) const {
  for (const Step& step : steps_) {
    for (std::size_t k = 0; k < stride; ++k) {
      double sum = 0;
      for (std::uint32_t s = 0; s < step.source_count; ++s) sum += cells[sources_[step.first_source + s] * stride + k];
      cells[step.cell * stride + k] = float(sum / step.source_count);
    }
  }
}

}  // namespace twinshade

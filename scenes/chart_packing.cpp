// Skyline packing, bottom-left rule (J. Jylanki, A thousand ways to pack the bin, 2010), the tallest first; the density
// of texels is found by bisection.
#include "scenes/chart_packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/error.h"

namespace twinshade {
namespace {

struct Step {
  std::uint32_t x, y, width;  // the skyline is at y over [x, x + width)
};

std::uint32_t texels(double metres, double per_metre) {
  return std::max(2u, std::uint32_t(std::ceil(metres * per_metre)));
}

// Lowest y at which a rectangle of `width` can stand with its left edge at skyline step `first`; none if it leaves the
// atlas.
std::optional<std::uint32_t> resting_height(const std::vector<Step>& skyline, std::size_t first, std::uint32_t width,
                                            std::uint32_t limit) {
  if (skyline[first].x + width > limit) return std::nullopt;
  std::uint32_t y = 0, covered = 0;
  for (std::size_t i = first; covered < width; ++i) {
    y = std::max(y, skyline[i].y);
    covered += skyline[i].width;
  }
  return y;
}

void raise(std::vector<Step>& skyline, std::uint32_t x, std::uint32_t width, std::uint32_t y) {
  std::vector<Step> next;
  for (const Step& step : skyline) {
    const std::uint32_t end = step.x + step.width;
    if (step.x < x) next.push_back({step.x, step.y, std::min(end, x) - step.x});
    if (step.x <= x && x < end) next.push_back({x, y, width});
    if (end > x + width) {
      const std::uint32_t start = std::max(step.x, x + width);
      next.push_back({start, step.y, end - start});
    }
  }
  skyline = std::move(next);
}

std::optional<std::vector<ChartPlace>> try_pack(const std::vector<ChartSize>& charts, double per_metre) {
  std::vector<ChartPlace> places(charts.size());
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < charts.size(); ++i)
    places[i] = {0, 0, texels(charts[i].width, per_metre), texels(charts[i].height, per_metre)};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (places[a].height != places[b].height) return places[a].height > places[b].height;
    if (places[a].width != places[b].width) return places[a].width > places[b].width;
    return a < b;
  });
  // Each chart carries its gutter at its right and top; the atlas has one more gutter at its left and bottom.
  constexpr std::uint32_t kLimit = kChartAtlasSize - kChartGutter;
  std::vector<Step> skyline = {{0, 0, kLimit}};
  for (std::size_t index : order) {
    ChartPlace& place = places[index];
    const std::uint32_t width = place.width + kChartGutter, height = place.height + kChartGutter;
    std::uint32_t best_y = kLimit, best_x = 0;
    for (std::size_t i = 0; i < skyline.size(); ++i) {
      const std::optional<std::uint32_t> y = resting_height(skyline, i, width, kLimit);
      if (y && *y + height <= kLimit && *y < best_y) best_y = *y, best_x = skyline[i].x;
    }
    if (best_y == kLimit) return std::nullopt;
    raise(skyline, best_x, width, best_y + height);
    place.x = best_x + kChartGutter;
    place.y = best_y + kChartGutter;
  }
  return places;
}

}  // namespace

std::vector<ChartPlace> pack_charts(const std::vector<ChartSize>& charts) {
  double area = 0;
  for (const ChartSize& chart : charts) area += chart.width * chart.height;
  std::optional<std::vector<ChartPlace>> best = try_pack(charts, 0);
  if (!best) throw UserError("lightmap: too many charts for an atlas of 512 x 512 texels");
  double low = 0, high = kChartAtlasSize / std::sqrt(std::max(area, 1e-12));
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    if (auto places = try_pack(charts, middle)) {
      best = std::move(places);
      low = middle;
    } else {
      high = middle;
    }
  }
  return *best;
}

}  // namespace twinshade

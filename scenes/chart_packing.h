// Places rectangular charts side by side in a square lightmap.
#pragma once

#include <cstdint>
#include <vector>

namespace twinshade {

// Lightmaps are laid out for this many texels each way: at this size charts are whole texels with kChartGutter texels
// between them. At 2^k times this size the layout is as good; at smaller sizes gutters shrink in proportion.
inline constexpr std::uint32_t kChartAtlasSize = 512;
inline constexpr std::uint32_t kChartGutter = 2;

struct ChartSize {
  double width, height;  // metres
};

struct ChartPlace {
  std::uint32_t x, y, width, height;  // texels of kChartAtlasSize
};

// As many texels per metre as fit, the same for all charts; each chart at least 2 x 2 texels. Deterministic.
// UserError where not even the smallest charts fit.
std::vector<ChartPlace> pack_charts(const std::vector<ChartSize>& charts);

}  // namespace twinshade

#include "lighting/sphere_map_grid.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "base/error.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"

namespace twinshade {
namespace {

constexpr std::size_t kBlock = 16384;  // rows a call, so that columns stay in the cache

}  // namespace

SphereMapGrid::SphereMapGrid(const SphereMapInfo& map, int width)
    : map_(map),
      width_(width),
      directions_(load_module(sphere_map_direction_source(map), Number::float64)),
      taps_(load_module(sphere_map_taps_source(map), Number::float64)) {
  if (width < 1 || width > 4096)
    throw UserError("width of sphere map " + std::string(map.name) + ": " + std::to_string(width) +
                    " is not within 1 to 4096");
}

std::vector<glm::dvec3> SphereMapGrid::directions(Number number) const {
  const std::size_t w = std::size_t(width_), rows = std::size_t(texels());
  std::vector<glm::dvec3> directions(rows);
  std::vector<double> inputs;
  for (std::size_t first = 0; first < rows; first += kBlock) {
    const std::size_t count = std::min(kBlock, rows - first);
    inputs.assign(4 * count, double(width_));
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t texel = first + i;
      inputs[i] = double(texel % w);
      inputs[count + i] = double(texel / w % w);
      inputs[2 * count + i] = double(texel / w / w);
    }
    const std::vector<double> columns = run_module(directions_, number, inputs, count);
    for (std::size_t i = 0; i < count; ++i)
      directions[first + i] = {columns[i], columns[count + i], columns[2 * count + i]};
  }
  return directions;
}

std::vector<SphereMapTaps> SphereMapGrid::taps(std::span<const glm::dvec3> directions, Number number) const {
  std::vector<SphereMapTaps> taps(directions.size());
  std::vector<double> inputs;
  for (std::size_t first = 0; first < directions.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, directions.size() - first);
    inputs.assign(4 * count, double(width_));
    for (std::size_t i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) inputs[c * count + i] = directions[first + i][c];
    const std::vector<double> columns = run_module(taps_, number, inputs, count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t t = 0; t < 4; ++t) {
        const double x = columns[3 * t * count + i], y = columns[(3 * t + 1) * count + i],
                     layer = columns[(3 * t + 2) * count + i];
        taps[first + i].texel[t] = std::uint32_t((layer * width_ + y) * width_ + x);
        taps[first + i].weight[t] = columns[(12 + t) * count + i];
      }
  }
  return taps;
}

int SphereMapGrid::distinct_texels() const {
  std::vector<std::tuple<double, double, double>> sorted;
  for (const glm::dvec3& d : directions()) sorted.emplace_back(d.x + 0.0, d.y + 0.0, d.z + 0.0);  // -0 becomes 0
  std::sort(sorted.begin(), sorted.end());
  return int(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

}  // namespace twinshade

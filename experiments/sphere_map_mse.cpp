// How well sphere maps hold smooth functions: the mean squared error of reading spherical harmonics back from maps that
// store them at texel centres, over random directions, against the number of texels. Iwanicki and Sloan, Normal Mapping
// with Low-Frequency Precomputed Visibility, JGT 2012, appendix A and figure 8.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "experiments/bases.h"
#include "experiments/chart.h"
#include "experiments/sphere_map_drawing.h"
#include "golden/compare_frames.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/sphere_map_grid.h"
#include "lighting/texel_storage.h"

namespace twinshade {
namespace {

constexpr int kFunctions = kHighestOrder * kHighestOrder;
constexpr int kDefaultPoints = 1000000, kDefaultDrawnPoints = 65536;
constexpr std::size_t kBlock = 4096;
constexpr int kSlopeFrom = 300;  // texels: where the slopes of the figure begin to be straight
constexpr int kDefaultWidths[] = {2, 4, 8, 9, 14, 16, 21, 32, 64};
constexpr int kDefaultOrders[] = {3, 6};
constexpr TexelStorage kStorages[] = {TexelStorage::float32, TexelStorage::half, TexelStorage::unorm8};
constexpr std::size_t kStorageCount = std::size(kStorages);

enum PointDomain : std::uint64_t { kPointHeight = 64, kPointAzimuth };

using Sums = std::array<double, kFunctions>;

struct StoredMap {
  SphereMapGrid grid;
  std::vector<float> texels[kStorageCount];  // [texel * kFunctions + function], as they come back from storage
};

// Directions first to first + count of `points`: one in each of as many zones of equal area, anywhere in it.
std::vector<glm::dvec3> random_directions(std::uint64_t seed, std::size_t points, std::size_t first,
                                          std::size_t count) {
  std::vector<glm::dvec3> directions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double z =
        2 * ((double(first + i) + unit_real(random_bits(seed, kPointHeight, first + i))) / double(points)) - 1;
    const double phi = 2 * portable::kPi * unit_real(random_bits(seed, kPointAzimuth, first + i));
    const double radius = std::sqrt(1 - z * z);
    directions[i] = {radius * portable::cos(phi), radius * portable::sin(phi), z};
  }
  return directions;
}

bool is_octahedral(const SphereMapInfo& map) { return map.layers == 1; }

// Sorted, for rows that do not repeat.
void each_once(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<StoredMap> stored_maps(const ExperimentOptions& options, const TechniqueInfo& harmonics) {
  std::vector<const SphereMapInfo*> maps;
  for (const std::string& name : options.maps)
    if (const SphereMapInfo* map = &find_sphere_map(name); std::find(maps.begin(), maps.end(), map) == maps.end())
      maps.push_back(map);
  if (maps.empty())
    for (const SphereMapInfo& map : sphere_maps()) maps.push_back(&map);
  std::vector<int> widths = options.widths;
  if (widths.empty()) widths.assign(std::begin(kDefaultWidths), std::end(kDefaultWidths));

  std::vector<StoredMap> stored;
  for (const SphereMapInfo* map : maps) {
    std::vector<int> of_map;
    // An octahedron folded along its texels has texels on its corners where the width is odd
    for (const int width : widths) of_map.push_back(is_octahedral(*map) ? width | 1 : width);
    each_once(of_map);
    for (const int width : of_map) {
      stored.push_back({SphereMapGrid(*map, width), {}});
      const std::vector<double> exact = basis_values(harmonics, stored.back().grid.directions());
      for (std::size_t s = 0; s < kStorageCount; ++s)
        stored.back().texels[s] = through_storage(exact, kFunctions, kStorages[s]);
    }
  }
  return stored;
}

void add_errors(const std::vector<SphereMapTaps>& taps, const std::vector<float>& texels,
                const std::vector<double>& exact, Sums& sums) {
  for (std::size_t p = 0; p < taps.size(); ++p) {
    const SphereMapTaps& t = taps[p];
    const float* a = texels.data() + std::size_t(t.texel[0]) * kFunctions;
    const float* b = texels.data() + std::size_t(t.texel[1]) * kFunctions;
    const float* c = texels.data() + std::size_t(t.texel[2]) * kFunctions;
    const float* d = texels.data() + std::size_t(t.texel[3]) * kFunctions;
    const double* reference = exact.data() + p * kFunctions;
    for (int k = 0; k < kFunctions; ++k) {
      const double error =
          ((a[k] * t.weight[0] + b[k] * t.weight[1]) + (c[k] * t.weight[2] + d[k] * t.weight[3])) - reference[k];
      sums[std::size_t(k)] += error * error;
    }
  }
}

// Sums of squared errors of each function, [map * kStorageCount + storage].
std::vector<Sums> squared_errors(const std::vector<StoredMap>& maps, const TechniqueInfo& harmonics,
                                 const ExperimentOptions& options, std::size_t points) {
  const std::size_t blocks = (points + kBlock - 1) / kBlock, columns = maps.size() * kStorageCount;
  std::vector<std::vector<Sums>> parts(blocks);
  parallel_for(blocks, [&](std::size_t block, int) {
    const std::size_t first = block * kBlock;
    const std::vector<glm::dvec3> directions =
        random_directions(options.seed, points, first, std::min(kBlock, points - first));
    const std::vector<double> exact = basis_values(harmonics, directions);
    parts[block].assign(columns, Sums{});
    for (std::size_t m = 0; m < maps.size(); ++m) {
      const std::vector<SphereMapTaps> taps = maps[m].grid.taps(directions);
      for (std::size_t s = 0; s < kStorageCount; ++s)
        add_errors(taps, maps[m].texels[s], exact, parts[block][m * kStorageCount + s]);
    }
  });
  std::vector<Sums> sums(columns, Sums{});
  for (const std::vector<Sums>& part : parts)
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t k = 0; k < kFunctions; ++k) sums[c][k] += part[c][k];
  return sums;
}

// The same directions for every machine, as floats, and what is to be read there.
struct DrawnPoints {
  std::vector<glm::vec3> directions;
  std::vector<double> exact;

  DrawnPoints(std::uint64_t seed, std::size_t points, const TechniqueInfo& harmonics) {
    std::vector<glm::dvec3> rounded;
    for (const glm::dvec3& d : random_directions(seed, points, 0, points)) {
      directions.emplace_back(d);
      rounded.emplace_back(directions.back());
    }
    exact = basis_values(harmonics, rounded);
  }

  Sums squared_errors(const std::vector<float>& reads) const {
    Sums sums{};
    for (std::size_t i = 0; i < reads.size(); ++i) {
      const double error = reads[i] - exact[i];
      sums[i % kFunctions] += error * error;
    }
    return sums;
  }
};

// How reads differ from those of the first machine by the written-out filter: how many, by how much and by how many
// ULP.
std::vector<Cell> differences(const std::vector<float>& a, const std::vector<float>& b) {
  std::int64_t different = 0;
  double largest = 0;
  std::uint64_t ulp = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i])) continue;
    ++different;
    largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
    ulp = std::max(ulp, ulp_distance(a[i], b[i]));
  }
  return {different, number_cell(largest), ulp == UINT64_MAX ? Cell() : Cell(std::int64_t(ulp))};
}

const char* filter_name(MapFilter filter) {
  return filter == MapFilter::written_out ? "written_out" : filter == MapFilter::driver ? "driver" : "driver_seamless";
}

std::vector<MapFilter> filters_of(const SphereMapInfo& map, const std::string& machine, bool driver) {
  if (!driver) return {MapFilter::written_out};
  if (!map.is_cube() || machine == "cpu") return {MapFilter::written_out, MapFilter::driver};
  return {MapFilter::written_out, MapFilter::driver, MapFilter::driver_seamless};
}

// Of the straight line through log(mse) against log(texels); NaN with fewer than two points.
double slope(const Series& series) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (series.x[i] < kSlopeFrom) continue;
    const double x = portable::log(series.x[i]), y = portable::log(series.y[i]);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Drawing chart(const Rows& rows, int order, bool drawn) {
  LineChart chart;
  chart.title = "Error of sphere maps for spherical harmonics of order " + std::to_string(order);
  chart.subtitle = "mean squared error over the functions and the sphere, texels in float; slope: from 300 texels on";
  chart.x = {"texels stored", true, {}, {}};
  chart.y = {"mean squared error", true, {}, {}};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows.number(r, "order") != order || std::get<std::string>(rows.at(r, "storage")) != "float32") continue;
    std::string name = std::get<std::string>(rows.at(r, "map"));
    if (drawn) {
      // Written-out filters read the same on every machine: one line is enough
      const std::string &machine = std::get<std::string>(rows.at(r, "machine")),
                        &filter = std::get<std::string>(rows.at(r, "filter"));
      if (filter != filter_name(MapFilter::written_out)) {
        name += ", " + machine + " " + filter;
      } else if (machine != std::get<std::string>(rows.at(0, "machine"))) {
        if (rows.number(r, "values_differ") == 0) continue;
        name += ", " + machine;
      }
    }
    const auto found = std::find_if(chart.series.begin(), chart.series.end(),
                                    [&](const Series& series) { return series.label == name; });
    Series& series = found != chart.series.end() ? *found : chart.series.emplace_back(Series{name, {}, {}, true});
    series.x.push_back(rows.number(r, "stored_texels"));
    series.y.push_back(rows.number(r, "mse"));
  }
  for (Series& series : chart.series) {
    const double s = slope(series);
    if (std::isfinite(s)) series.label += fmt::format(" (slope {:.2f})", s);
  }
  return draw(chart);
}

}  // namespace

ExperimentResult run_sphere_map_mse(const ExperimentOptions& options) {
  std::vector<int> orders = options.orders;
  if (orders.empty()) orders.assign(std::begin(kDefaultOrders), std::end(kDefaultOrders));
  for (const int order : orders)
    if (order < 1 || order > kHighestOrder)
      throw UserError("order " + std::to_string(order) + " is not within 1 to " + std::to_string(kHighestOrder));
  each_once(orders);
  const TechniqueInfo& harmonics = find_technique("sh6");
  const bool drawn = !options.on.empty();
  const std::size_t points = std::size_t(options.samples > 0 ? options.samples
                                         : drawn             ? kDefaultDrawnPoints
                                                             : kDefaultPoints);
  const std::vector<StoredMap> maps = stored_maps(options, harmonics);

  std::vector<std::string> columns = {"map", "width", "order", "storage", "stored_texels", "used_texels", "mse"};
  if (drawn) columns.insert(columns.end(), {"machine", "filter", "values_differ", "max_difference", "max_ulp"});
  ExperimentResult result{Rows(columns), {}, {}};
  const auto add_rows = [&](const StoredMap& map, std::size_t storage, const Sums& sums,
                            const std::vector<Cell>& more) {
    for (const int order : orders) {
      double sum = 0;
      for (int k = 0; k < order * order; ++k) sum += sums[std::size_t(k)];
      std::vector<Cell> cells = {std::string(map.grid.map().name),
                                 std::int64_t(map.grid.width()),
                                 std::int64_t(order),
                                 std::string(texel_storage_name(kStorages[storage])),
                                 std::int64_t(map.grid.texels()),
                                 std::int64_t(map.grid.distinct_texels()),
                                 sum / (order * order) / double(points)};
      cells.insert(cells.end(), more.begin(), more.end());
      result.rows.add(std::move(cells));
    }
  };
  if (drawn) {
    const DrawnPoints looks(options.seed, points, harmonics);
    for (const StoredMap& map : maps)
      for (std::size_t s = 0; s < kStorageCount; ++s) {
        options.progress(std::string(map.grid.map().name) + " " + std::to_string(map.grid.width()));
        std::vector<float> first;
        for (const std::string& machine : options.on) {
          for (const MapFilter filter : filters_of(map.grid.map(), machine, options.driver_filters)) {
            const std::vector<float> reads =
                draw_reads(machine, options.draw, map.grid, filter, map.texels[s], kFunctions, looks.directions);
            if (first.empty()) first = reads;
            std::vector<Cell> cells = {machine, std::string(filter_name(filter))};
            for (Cell& cell : differences(first, reads)) cells.push_back(std::move(cell));
            add_rows(map, s, looks.squared_errors(reads), cells);
          }
        }
      }
    result.notes.push_back(
        "values_differ, max_difference, max_ulp: against what the first machine reads by the written-out filter");
    if (options.driver_filters)
      result.notes.push_back("driver_seamless: cubes only, and not on the cpu, whose texture() ends at a face's edge");
  } else {
    const std::vector<Sums> sums = squared_errors(maps, harmonics, options, points);
    for (std::size_t m = 0; m < maps.size(); ++m)
      for (std::size_t s = 0; s < kStorageCount; ++s) add_rows(maps[m], s, sums[m * kStorageCount + s], {});
  }
  result.notes.push_back("used_texels: stored ones less those that look where another one does (equators, folds)");
  if (std::any_of(maps.begin(), maps.end(), [](const StoredMap& map) { return is_octahedral(map.grid.map()); }))
    result.notes.push_back("octahedral maps have odd widths: even ones are raised by one");
  if (options.pictures)
    for (const int order : orders)
      result.pictures.push_back({"sphere-map-mse-order-" + std::to_string(order), chart(result.rows, order, drawn)});
  return result;
}

}  // namespace twinshade

#include "scenes/chart_packing.h"

#include <doctest/doctest.h>

#include <random>

#include "tests/scenes/temporary_folder.h"

using namespace twinshade;

TEST_CASE("charts lie in the atlas with gutters between them, in true proportion") {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<ChartSize> charts;
    const std::size_t count = 1 + random() % 200;
    for (std::size_t i = 0; i < count; ++i)
      charts.push_back({0.05 + double(random() % 500) / 50, 0.05 + double(random() % 300) / 100});
    const std::vector<ChartPlace> places = pack_charts(charts);
    REQUIRE(places.size() == charts.size());
    std::uint64_t used = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const ChartPlace& a = places[i];
      CHECK(a.x >= kChartGutter);
      CHECK(a.y >= kChartGutter);
      CHECK(a.x + a.width + kChartGutter <= kChartAtlasSize);
      CHECK(a.y + a.height + kChartGutter <= kChartAtlasSize);
      CHECK(a.width >= 2);
      CHECK(a.height >= 2);
      used += std::uint64_t(a.width) * a.height;
      for (std::size_t j = 0; j < i; ++j) {
        const ChartPlace& b = places[j];
        const bool apart = a.x >= b.x + b.width + kChartGutter || b.x >= a.x + a.width + kChartGutter ||
                           a.y >= b.y + b.height + kChartGutter || b.y >= a.y + a.height + kChartGutter;
        CHECK(apart);
      }
    }
    if (count > 20) CHECK(double(used) > 0.55 * kChartAtlasSize * kChartAtlasSize);
  }
}

TEST_CASE("more charts than the atlas holds are refused") {
  CHECK(user_error([] { pack_charts(std::vector<ChartSize>(20000, {1, 1})); }).find("lightmap") == 0);
}

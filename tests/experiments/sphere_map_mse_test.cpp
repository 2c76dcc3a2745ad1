// The experiment sphere-map-mse against figure 8 of Normal Mapping with Low-Frequency Precomputed Visibility, computed
// anew with other code.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "experiments/experiment.h"
#include "tests/relative.h"

namespace twinshade {
namespace {

struct Published {
  const char* map;
  int width;
  double order3, order6;
};

constexpr Published kPublished[] = {{"dual_orthographic", 4, 0.0148496684, 0.0632354866},
                                    {"dual_orthographic", 9, 0.00257710227, 0.0162215675},
                                    {"dual_orthographic", 16, 0.000881865459, 0.00531552983},
                                    {"dual_paraboloid", 4, 0.00742354214, 0.0537073099},
                                    {"dual_paraboloid", 9, 0.000293995687, 0.0040648117},
                                    {"dual_paraboloid", 16, 3.41413031e-05, 0.00045466988},
                                    {"cube_dx9", 4, 0.000602792183, 0.00591559283},
                                    {"cube_dx9", 16, 5.16780999e-06, 4.21765272e-05},
                                    {"cube", 4, 0.000336713387, 0.00499379159},
                                    {"cube", 16, 1.71947587e-06, 2.7286342e-05}};

ExperimentResult measure(int samples, const std::vector<int>& widths) {
  ExperimentOptions options;
  options.samples = samples;
  options.widths = widths;
  options.pictures = false;
  return run_sphere_map_mse(options);
}

double mse(const Rows& rows, const std::string& map, int width, int order, const std::string& storage = "float32") {
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (std::get<std::string>(rows.at(r, "map")) == map && rows.number(r, "width") == width &&
        rows.number(r, "order") == order && std::get<std::string>(rows.at(r, "storage")) == storage)
      return rows.number(r, "mse");
  return std::nan("");
}

}  // namespace

TEST_CASE("errors of sphere maps are those of the published figure") {
  const Rows rows = measure(1000000, {4, 9, 16}).rows;
  for (const Published& p : kPublished) {
    CAPTURE(p.map);
    CAPTURE(p.width);
    CHECK(mse(rows, p.map, p.width, 3) == test::relative(p.order3, 0.005));
    CHECK(mse(rows, p.map, p.width, 6) == test::relative(p.order6, 0.005));
  }
  // 96 texels in a cube, 98 in a dual map; 384 and 392
  const Rows alike = measure(50000, {4, 7, 8, 14}).rows;
  for (const int order : {3, 6}) {
    for (const auto& [cube, dual] : std::map<int, int>{{4, 7}, {8, 14}}) {
      CHECK(mse(alike, "cube", cube, order) < mse(alike, "cube_dx9", cube, order));
      CHECK(mse(alike, "cube", cube, order) < mse(alike, "dual_paraboloid", dual, order));
      CHECK(mse(alike, "cube", cube, order) < mse(alike, "dual_orthographic", dual, order));
      CHECK(mse(alike, "cube_dx9", cube, order) < mse(alike, "dual_paraboloid", dual, order));
    }
    CHECK(mse(alike, "cube", 8, order, "half") == test::relative(mse(alike, "cube", 8, order), 0.01));
    CHECK(mse(alike, "cube", 8, order, "unorm8") > mse(alike, "cube", 8, order));
  }
}

TEST_CASE("errors of sphere maps do not depend on the number of threads") {
  set_thread_count(1);
  const std::string alone = measure(20000, {5}).rows.csv();
  set_thread_count(7);
  CHECK(measure(20000, {5}).rows.csv() == alone);
  set_thread_count(0);
}

TEST_CASE("what is named twice is measured once, and odd widths are spoken of where there are octahedra") {
  ExperimentOptions options;
  options.samples = 100;
  options.pictures = false;
  options.widths = {4, 4};
  options.orders = {6, 3, 3};
  for (const char* map : {"cube", "octahedral"}) {
    options.maps = {map, map};
    const ExperimentResult result = run_sphere_map_mse(options);
    CHECK(result.rows.size() == 2 * 3);  // orders, storages
    CHECK((result.notes.back().find("octahedral") != std::string::npos) == (map == std::string("octahedral")));
  }
}

TEST_CASE("sphere-map-mse names what it cannot measure") {
  ExperimentOptions options;
  options.orders = {7};
  CHECK_THROWS_WITH_AS(run_sphere_map_mse(options), "order 7 is not within 1 to 6", UserError);
  options.orders = {3};
  options.maps = {"cubes"};
  CHECK_THROWS_AS(run_sphere_map_mse(options), UserError);
}

}  // namespace twinshade

// What L x H tables cost on one core: one set of order 6 on a cube map of 32 x 32 x 6 texels, and the blend of two sets
// for 24 principal components and their mean.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "lighting/light_tables.h"
#include "lighting/random.h"

namespace {

using namespace twinshade;

// Median of 101 runs, milliseconds.
template <class Body>
double milliseconds(const Body& body) {
  std::vector<double> times;
  for (int run = 0; run < 101; ++run) {
    const auto start = std::chrono::steady_clock::now();
    body();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + 50, times.end());
  return times[50];
}

std::vector<double> random_numbers(std::size_t count, std::uint64_t seed) {
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = unit_real(random_bits(seed, 0, i)) - 0.5;
  return numbers;
}

}  // namespace

int main() {
  constexpr int kOrder = 6;
  constexpr std::size_t kCount = 36, kRows = 25;
  const LightTableMap map(find_sphere_map("cube"), 32, kOrder);
  const std::vector<double> light = random_numbers(3 * kCount, 1);
  LightTables tables = map.tables(light_times_harmonics(light, kOrder));
  fmt::print("light times harmonics, order 6             {:.3f} ms\n",
             milliseconds([&] { light_times_harmonics(light, kOrder); }));
  fmt::print("one set of tables, order 6, 32 x 32 x 6    {:.3f} ms\n",
             milliseconds([&] { map.fill(light_times_harmonics(light, kOrder), tables); }));

  const std::vector<double> components = random_numbers(kRows * kCount, 2);
  const LightTables a = map.tables(light_times_vectors(light, components, kOrder));
  const LightTables b = map.tables(light_times_vectors(random_numbers(3 * kCount, 3), components, kOrder));
  LightTables blended = a;
  fmt::print("tables of 24 components and their mean     {:.3f} ms\n",
             milliseconds([&] { map.fill(light_times_vectors(light, components, kOrder), blended); }));
  fmt::print("blend of two sets of these                 {:.3f} ms\n",
             milliseconds([&] { blend_tables(a, b, 0.3f, blended); }));
}

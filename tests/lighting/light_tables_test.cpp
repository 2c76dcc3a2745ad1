#include "lighting/light_tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/error.h"
#include "cpu_shaders/machine.h"
#include "lighting/light_table_kernel.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"
#include "lighting/sh_product.h"
#include "lighting/sphere_map_grid.h"

namespace twinshade {
namespace {

// Two functions of order 3 and their product, computed independently.
constexpr double kA[] = {1, 1 / 2., 1 / 3., 1 / 4., 1 / 5., 1 / 6., 1 / 7., 1 / 8., 1 / 9.};
constexpr double kB[] = {0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7, -0.8, 0.9};
constexpr double kProduct[] = {
    0.02820947917738836,   -0.19928166786306667, 0.03625413096372611,   -0.0853889709658551,    0.02144109752121389,
    -0.1717811453741815,   0.21591417996431264,  -0.2393474473706499,   0.2198306710694187,     0.10693241122153858,
    -0.0766398722327841,   0.05233961444997503,  0.15187556622580198,   -0.05249811517499424,   0.07694766288432142,
    -0.006659715387475177, 0.056159651181047945, -0.002388271673512695, -0.0045471929257841675, 0.018354528966209822,
    0.06447880954831448,   -0.00508047696660446, 0.03220664307867807,   0.010161861826514447,   0};
// Integral of a b and the clamped cosine about (2, 3, 6) / 7, all of order 3.
constexpr double kIntegral = 0.3306371543527806;

std::vector<double> random_light(int order, std::uint64_t seed) {
  std::vector<double> light(std::size_t(order * order) * 3);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = 2 * unit_real(random_bits(seed, 0, i)) - 1;
  return light;
}

// Sum over k of products_k times the cosine about n, in double.
double direct(std::span<const double> products, std::size_t row_channel, int order, const glm::dvec3& n) {
  const std::vector<double> y = radiance_basis({&n, 1}, kMostRadianceCount);
  const auto cosine = clamped_cosine_factors();
  const std::size_t count = std::size_t(order * order);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += products[row_channel * count + k] * cosine[k] * y[k];
  return sum;
}

}  // namespace

TEST_CASE("triple products: 25 of order 3, which fill 83 of 729 places") {
  const std::vector<TripleProduct>& products = sh_triple_products(3);
  CHECK(products.size() == 25);
  std::set<std::array<int, 3>> places;
  for (const auto& [i, j, k, value] : products) {
    std::array<int, 3> place = {i, j, k};
    do places.insert(place);
    while (std::next_permutation(place.begin(), place.end()));
  }
  CHECK(places.size() == 83);
  // Y_00 is a constant, sqrt(1/4pi)
  for (const auto& [i, j, k, value] : products)
    if (i == 0) CHECK(value == doctest::Approx(j == k ? 0.28209479177387814 : 0).epsilon(1e-7));
}

TEST_CASE("the product of two functions of order 3 is that of the published vectors") {
  std::vector<double> a(25, 0.0);
  std::copy(std::begin(kA), std::end(kA), a.begin());
  const std::vector<double> matrix = sh_product_matrix(a, 1, 5);
  for (std::size_t j = 0; j < 25; ++j) {
    double sum = 0;
    for (std::size_t k = 0; k < 9; ++k) sum += matrix[j * 25 + k] * kB[k];
    CHECK(std::fabs(sum - kProduct[j]) < 1e-6);
  }
}

TEST_CASE("light times visibility times cosine, by the rows of tables") {
  std::vector<double> light;
  for (const double value : kA) light.insert(light.end(), {value, 2 * value, 0.0});
  const glm::dvec3 n = glm::dvec3(2, 3, 6) / 7.0;
  const std::vector<double> products = light_times_harmonics(light, 3);
  double integral[3] = {};
  for (std::size_t j = 0; j < 9; ++j)
    for (std::size_t c = 0; c < 3; ++c) integral[c] += kB[j] * direct(products, j * 3 + c, 3, n);
  CHECK(std::fabs(integral[0] - kIntegral) < 1e-6);
  CHECK(std::fabs(integral[1] - 2 * kIntegral) < 1e-6);
  CHECK(integral[2] == 0);
  // One row that is the visibility itself says the same
  const std::vector<double> row = light_times_vectors(light, kB, 3);
  CHECK(std::fabs(direct(row, 0, 3, n) - kIntegral) < 1e-6);
}

TEST_CASE("a table's texel holds what its normal gives, on every map, order and width") {
  for (const SphereMapInfo& map : sphere_maps())
    for (const std::pair<int, int>& size : {std::pair(1, 3), {2, 4}, {3, 9}, {4, 16}, {6, 32}, {6, 33}, {5, 1}}) {
      const int order = size.first, width = size.second;
      CAPTURE(std::string(map.name));
      CAPTURE(order);
      CAPTURE(width);
      const std::vector<double> products = light_times_harmonics(random_light(order, 3), order);
      const LightTableMap table_map(map, width, order);
      const LightTables tables = table_map.tables(products);
      REQUIRE(tables.rows == std::size_t(order * order));
      const std::vector<glm::dvec3> normals = SphereMapGrid(map, width).directions();
      double worst = 0;
      for (std::size_t t = 0; t < normals.size(); t += 1 + normals.size() / 97)
        for (std::size_t row = 0; row < tables.rows * 3; row += 5)
          worst = std::max(
              worst, std::fabs(tables.values[row * tables.texels + t] - direct(products, row, order, normals[t])));
      CHECK(worst < 4e-6);
    }
}

TEST_CASE("looking a table up at a texel's centre reads that texel alone") {
  for (const SphereMapInfo& map : sphere_maps()) {
    const SphereMapGrid grid(map, 8);
    const std::vector<glm::dvec3> normals = grid.directions();
    const std::vector<SphereMapTaps> taps = grid.taps(normals);
    double worst = 0;
    for (std::size_t t = 0; t < normals.size(); ++t) {
      double elsewhere = 0;  // weight of texels that look another way
      for (std::size_t k = 0; k < 4; ++k)
        if (glm::length(normals[taps[t].texel[k]] - normals[t]) > 1e-6) elsewhere += taps[t].weight[k];
      worst = std::max(worst, elsewhere);
    }
    CAPTURE(std::string(map.name));
    CHECK(worst < 1e-6);
  }
}

#if defined(__x86_64__)
TEST_CASE("every instruction set gives the same tables") {
  using namespace light_table;
  constexpr std::size_t kRows = 3, kEven = 5, kOdd = 4, kBlocks = 3, kTexels = 2 * kBlocks * kBlock + 5;
  std::vector<float> products(kRows * 3 * (kEven + kOdd)), cosine((kEven + kOdd) * kBlocks * kBlock);
  for (std::size_t i = 0; i < products.size(); ++i) products[i] = float(unit_real(random_bits(1, 1, i)) - 0.5);
  for (std::size_t i = 0; i < cosine.size(); ++i) cosine[i] = float(unit_real(random_bits(1, 2, i)) - 0.5);
  // Upwards, downwards and anyhow
  std::vector<std::uint32_t> upper, lower;
  for (std::uint32_t i = 0; i < kBlocks * kBlock; ++i) {
    upper.push_back(i < 2 * kBlock ? i : 5 * kBlock + kBlock / 2 - i / 2 + (i % 2) * 12);
    lower.push_back(i < kBlock ? 2 * kBlock + i : i < 2 * kBlock ? 5 * kBlock - 1 - i : upper[i]);
  }
  const std::uint8_t layout[] = {kUpperRuns | kLowerRunsUp, kUpperRuns | kLowerRunsDown, 0};
  const auto filled = [&](const Kernel& kernel) {
    std::vector<float> values(kRows * 3 * kTexels, -1.0f);
    kernel.fill({products.data(), kRows, kEven, kOdd, cosine.data(), upper.data(), lower.data(), layout, kBlocks,
                 kTexels, values.data()});
    std::vector<float> blended(values.size());
    kernel.blend(values.data(), values.data() + 7, 0.3f, blended.data(), values.size() - 7);
    values.insert(values.end(), blended.begin(), blended.end());
    return values;
  };
  const std::vector<float> expected = filled(kernel_of_baseline());
  if (machine_isa() >= Isa::avx2) CHECK(filled(kernel_of_avx2()) == expected);
  if (machine_isa() >= Isa::avx512) CHECK(filled(kernel_of_avx512()) == expected);
}
#endif

TEST_CASE("tables of blended light are the blend of the tables") {
  const std::vector<double> a = random_light(4, 1), b = random_light(4, 2);
  std::vector<double> mixed;
  for (std::size_t i = 0; i < a.size(); ++i) mixed.push_back(a[i] + (b[i] - a[i]) * 0.25);
  const LightTableMap map(find_sphere_map("dual_paraboloid"), 16, 4);
  const LightTables blended =
      blend_tables(map.tables(light_times_harmonics(a, 4)), map.tables(light_times_harmonics(b, 4)), 0.25f);
  const LightTables expected = map.tables(light_times_harmonics(mixed, 4));
  double worst = 0;
  for (std::size_t i = 0; i < expected.values.size(); ++i)
    worst = std::max(worst, std::fabs(double(expected.values[i]) - blended.values[i]));
  CHECK(worst < 3e-6);
}

TEST_CASE("black light gives black tables; widths are checked") {
  const LightTableMap map(find_sphere_map("octahedral"), 5, 3);
  for (const float value : map.tables(light_times_harmonics(std::vector<double>(27, 0.0), 3)).values) CHECK(value == 0);
  CHECK_THROWS_AS(LightTableMap(find_sphere_map("cube"), 0, 3), UserError);
  CHECK_THROWS_AS(LightTableMap(find_sphere_map("cube"), 4097, 3), UserError);
}

}  // namespace twinshade

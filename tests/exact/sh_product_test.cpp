// Products of spherical harmonics, as techniques compute them.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/exact/shader_rows.h"

namespace twinshade {
namespace {

// Two functions of order 3 and the first nine coefficients of their product, computed independently.
const std::vector<double> kA = {1, 1 / 2., 1 / 3., 1 / 4., 1 / 5., 1 / 6., 1 / 7., 1 / 8., 1 / 9.};
const std::vector<double> kB = {0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7, -0.8, 0.9};
const std::vector<double> kProduct = {0.02820947917738836, -0.19928166786306667, 0.03625413096372611,
                                      -0.0853889709658551, 0.02144109752121389,  -0.1717811453741815,
                                      0.21591417996431264, -0.2393474473706499,  0.2198306710694187};
// The clamped cosine about (2, 3, 6) / 7, l <= 2.
const std::vector<double> kCosine = {0.8862269254527579,  -0.43856858911992364, 0.8771371782398472,
                                     -0.2923790594132824, 0.10507169765017756,  -0.31521509295053274,
                                     0.2982606002024931,  -0.21014339530035514, -0.043779874020907314};

}  // namespace

TEST_CASE("the GLSL product of order 3 is that of the published vectors") {
  const test::RowShader shader("product_3",
                               "#include \"sh/product_3.glsl\"\n"
                               "in vec3 a[9];\nin float b[9];\nout vec3 product[9];\n"
                               "void main() {\n  product = sh3_product(a, b);\n}\n");
  std::vector<float> inputs;
  for (const double value : kA) inputs.insert(inputs.end(), {float(value), float(-2 * value), 0.0f});
  inputs.insert(inputs.end(), kB.begin(), kB.end());
  const std::vector<float> product = shader.run(inputs, 1);
  REQUIRE(product.size() == 27);
  for (std::size_t k = 0; k < 9; ++k) {
    CAPTURE(k);
    CHECK(std::fabs(product[3 * k] - kProduct[k]) < 1e-6);
    CHECK(std::fabs(product[3 * k + 1] + 2 * kProduct[k]) < 2e-6);
    CHECK(product[3 * k + 2] == 0);
  }
}

TEST_CASE("the GLSL product of order 2 is that of order 3 where both functions have order 2, cut") {
  const test::RowShader shader("product_2",
                               "#include \"sh/product_2.glsl\"\n#include \"sh/product_3.glsl\"\n"
                               "in vec3 a[4];\nin vec4 b;\nout vec3 cut[4];\nout vec3 whole[4];\n"
                               "void main() {\n  cut = sh2_product(a, b);\n  vec3 a3[9];\n  float b3[9];\n"
                               "  for (int i = 0; i < 9; ++i) {\n    a3[i] = i < 4 ? a[i & 3] : vec3(0.0);\n"
                               "    b3[i] = 0.0;\n  }\n"
                               "  b3[0] = b.x;\n  b3[1] = b.y;\n  b3[2] = b.z;\n  b3[3] = b.w;\n"
                               "  vec3 product[9] = sh3_product(a3, b3);\n"
                               "  for (int i = 0; i < 4; ++i) whole[i] = product[i];\n}\n");
  std::vector<float> inputs;
  for (std::size_t k = 0; k < 4; ++k) inputs.insert(inputs.end(), {float(kA[k]), float(k) - 1.0f, 0.25f});
  inputs.insert(inputs.end(), kB.begin(), kB.begin() + 4);
  const std::vector<float> products = shader.run(inputs, 1);
  REQUIRE(products.size() == 24);
  for (std::size_t i = 0; i < 12; ++i) CHECK(products[i] == doctest::Approx(products[12 + i]).epsilon(1e-6));
}

TEST_CASE("the clamped cosine as SH is the published one") {
  const test::RowShader shader("clamped_cosine",
                               "#include \"sh/clamped_cosine.glsl\"\nin vec3 n;\nout float cosine[9];\n"
                               "void main() {\n  cosine = clamped_cosine_sh3(n);\n}\n");
  const std::vector<float> cosine = shader.run({2 / 7.0f, 3 / 7.0f, 6 / 7.0f}, 1);
  for (std::size_t k = 0; k < 9; ++k) CHECK(std::fabs(cosine[k] - kCosine[k]) < 1e-6);
}

}  // namespace twinshade

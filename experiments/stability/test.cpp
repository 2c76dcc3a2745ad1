#include "experiments/stability/test.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "experiments/directions.h"

namespace twinshade {
namespace {

constexpr int kHorizonNormals = 72;
constexpr double kMostJump = 1e-4, kMostCrease = 2;  // of the largest value

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  constexpr std::string_view kNames[] = {"", "ok", "poor", "fails"};
  return kNames[int(verdict)];
}

TestedBasis::TestedBasis(const TechniqueInfo& technique, std::uint64_t random_seed,
                         const std::vector<std::string>& include_folders)
    : basis(technique),
      seed(random_seed),
      fit(technique),
      tricky(tricky_normals(technique.domain)),
      in_float_(technique, Number::scalar, include_folders),
      in_double_(technique, Number::float64, include_folders) {}

std::vector<Finding> seam_findings(const Seams& seams) {
  Finding jump, crease;
  jump.test = crease.test = "jump";
  jump.measure = "value";
  jump.value = seams.jump;
  jump.unit = "of the largest";
  jump.verdict = within(seams.jump <= kMostJump);
  if (seams.jump > 0) jump.normal = seams.jump_at[0], jump.other_normal = seams.jump_at[1];
  crease.measure = "slope";
  crease.value = seams.crease;
  crease.unit = "of the largest a radian";
  crease.verdict = within(seams.crease <= kMostCrease);
  if (seams.crease > 0) crease.normal = seams.crease_at[0], crease.other_normal = seams.crease_at[1];
  return {jump, crease};
}

std::vector<double> TestedBasis::irradiance(Number number, const std::vector<double>& coefficients,
                                            std::span<const glm::dvec3> normals) const {
  const IrradianceModule& module = number == Number::float64 ? in_double_ : in_float_;
  return module.run(
      normals.size(), [&](std::size_t row) { return normals[row]; },
      [&](std::size_t, int i, int c) { return coefficients[std::size_t(i) * 3 + std::size_t(c)]; });
}

glm::dvec3 TestedBasis::inside(const glm::dvec3& n) const {
  if (!hemisphere() || n.z >= 0) return to_float(unit(n));
  const double length = std::sqrt(n.x * n.x + n.y * n.y);
  return to_float(length > 0 ? glm::dvec3(n.x / length, n.y / length, 0) : glm::dvec3(1, 0, 0));
}

std::vector<glm::dvec3> TestedBasis::normals(std::size_t count) const {
  std::vector<glm::dvec3> list;
  if (hemisphere())
    for (int k = 0; k < kHorizonNormals; ++k) {
      const double angle = 2 * portable::kPi * k / kHorizonNormals;
      list.push_back(to_float({portable::cos(angle), portable::sin(angle), 0}));
    }
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 n = lattice_direction(i, count);
    if (hemisphere()) {  // equal areas again: z from 0 to 1
      const double z = (n.z + 1) / 2, scale = std::sqrt((1 - z * z) / (1 - n.z * n.z));
      n = {n.x * scale, n.y * scale, z};
    }
    list.push_back(to_float(n));
  }
  return list;
}

}  // namespace twinshade

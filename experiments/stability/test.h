// What the tests of stability share: the basis that they test, and what they find.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/stability/light_fit.h"
#include "experiments/stability/seams.h"
#include "experiments/stability/tricky_inputs.h"
#include "lighting/irradiance_module.h"
#include "lighting/sphere_map_grid.h"

namespace twinshade {

enum class Verdict { none, ok, poor, fails };
std::string_view verdict_name(Verdict verdict);
inline Verdict within(bool good) { return good ? Verdict::ok : Verdict::poor; }
// The same of an irradiance inside the method's domain, where NaN is a failure.
inline Verdict judged(double irradiance, bool good) {
  return std::isfinite(irradiance) ? within(good) : Verdict::fails;
}

// The worst of one measure, with the input that it was found at.
struct Finding {
  std::string test, measure;
  double value = 0;  // not finite: there is none
  std::string unit;
  Verdict verdict = Verdict::none;
  std::string what;  // of the input, beside light and normal
  std::optional<glm::dvec3> light{}, normal{}, other_normal{};
  std::vector<double> coefficients{};  // [i * 3 + channel]
};

// Directions and coefficients are floats, so that what is found can be tried anywhere.
struct TestedBasis {
  // include_folders: searched for the basis' GLSL before the built-in files; coefficients are those of the built-in
  // one.
  TestedBasis(const TechniqueInfo& technique, std::uint64_t seed, const std::vector<std::string>& include_folders = {});

  bool hemisphere() const { return basis.domain == Domain::hemisphere; }
  // Irradiance [normal * 3 + channel] by the basis' GLSL.
  std::vector<double> irradiance(Number number, const std::vector<double>& coefficients,
                                 std::span<const glm::dvec3> normals) const;
  // About `count` unit normals (floats), evenly over the domain; of the hemisphere its horizon too.
  std::vector<glm::dvec3> normals(std::size_t count) const;
  // A direction of the domain, as floats: what is below the horizon of a hemisphere is moved onto it.
  glm::dvec3 inside(const glm::dvec3& n) const;

  const TechniqueInfo& basis;
  std::uint64_t seed;
  LightFit fit;
  std::vector<TrickyNormal> tricky;

 private:
  IrradianceModule in_float_, in_double_;
};

// A sphere map of its usual width, whose texels store their own directions.
struct TestedMap {
  explicit TestedMap(const SphereMapInfo& map);

  // What is read in these directions (floats): the directions themselves, were a map exact.
  std::vector<glm::dvec3> read(Number number, std::span<const glm::dvec3> normals) const;

  SphereMapGrid grid;
  std::vector<glm::dvec3> directions;  // of texels
  std::vector<TrickyNormal> tricky;
};

// The jump and the crease, in this order, with their normals.
std::vector<Finding> seam_findings(const Seams& seams);

// Tests, one file each; those of sphere maps are in sphere_maps.cpp. What a basis cannot be put to finds
// nothing.
std::vector<Finding> test_ringing(const TestedBasis& tested);
std::vector<Finding> test_constant(const TestedBasis& tested);
std::vector<Finding> test_finite(const TestedBasis& tested);
std::vector<Finding> test_rounding(const TestedBasis& tested);
std::vector<Finding> test_jump(const TestedBasis& tested);
std::vector<Finding> test_storage(const TestedBasis& tested);
std::vector<Finding> test_light(const TestedBasis& tested);
std::vector<Finding> test_conditioning(const TestedBasis& tested);

std::vector<Finding> test_map_constant(const TestedMap& tested);
std::vector<Finding> test_map_finite(const TestedMap& tested);
std::vector<Finding> test_map_rounding(const TestedMap& tested);
std::vector<Finding> test_map_jump(const TestedMap& tested);
std::vector<Finding> test_map_reading(const TestedMap& tested);

}  // namespace twinshade

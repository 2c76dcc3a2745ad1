// Jumps and creases of irradiance over the normal, under suns. (Exact irradiance has a crease, too: at a sun's horizon
// its slope changes by 1.)
#include "experiments/stability/seams.h"
#include "experiments/stability/test.h"

namespace twinshade {

std::vector<Finding> test_jump(const TestedBasis& tested) {
  const SeamSearch search(tested.tricky, tested.hemisphere(), [&](const glm::dvec3& n) { return tested.inside(n); });
  std::vector<Finding> worst = seam_findings({});
  for (const SmallLight& light :
       {unit_sun(unit({2, 3, 6})), unit_sun({1, 0, 0}),
        SmallLight{"a red sky and a blue sun", {0.3, 0.1, 0.1}, {{unit({-3, -4, 2}), {0.1, 0.3, 0.9}}}}}) {
    const std::vector<double> coefficients = tested.fit.coefficients(light);
    std::vector<Finding> found = seam_findings(search.find([&](std::span<const glm::dvec3> normals) {
      const std::vector<double> rgb = tested.irradiance(Number::scalar, coefficients, normals);
      std::vector<glm::dvec3> values;
      for (std::size_t i = 0; i < rgb.size(); i += 3) values.emplace_back(rgb[i], rgb[i + 1], rgb[i + 2]);
      return values;
    }));
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (!(found[k].value > worst[k].value)) continue;
      found[k].what = light.name;
      if (light.suns.size() == 1) found[k].light = light.suns[0].direction;
      found[k].coefficients = coefficients;
      worst[k] = std::move(found[k]);
    }
  }
  return worst;
}

}  // namespace twinshade

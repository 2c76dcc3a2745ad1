// Whether irradiance in float is always a finite number, over inputs that formulas trip over. Inputs inside the
// method's domain, where another answer is a fault of its own, are counted apart from those outside: normals (of other
// lengths, zero, below the horizon), and coefficients beyond halves. Of each the mildest input that fails is shown.
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "experiments/stability/test.h"

namespace twinshade {

std::vector<Finding> test_finite(const TestedBasis& tested) {
  std::vector<glm::dvec3> normals;
  for (const TrickyNormal& tricky : tested.tricky) normals.push_back(tricky.n);
  enum Kind { inside, normal, coefficients, kinds };
  Finding findings[kinds];
  std::size_t inputs[kinds] = {}, mildest[kinds] = {};
  for (const TrickyCoefficients& given : tricky_coefficients(tested.basis, tested.fit, tested.seed)) {
    const std::vector<double> values = tested.irradiance(Number::scalar, given.values, normals);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!given.inside && !tested.tricky[i].inside) continue;  // one at a time
      const Kind kind = !given.inside ? coefficients : !tested.tricky[i].inside ? normal : inside;
      ++inputs[kind];
      if (std::isfinite(values[i * 3]) && std::isfinite(values[i * 3 + 1]) && std::isfinite(values[i * 3 + 2]))
        continue;
      Finding& finding = findings[kind];
      // Coefficients come mildest first, and so do normals
      if (finding.value++ > 0 && (kind != normal || i >= mildest[kind])) continue;
      mildest[kind] = i;
      finding.what = given.what + "; " + tested.tricky[i].what;
      finding.normal = normals[i];
      finding.coefficients = given.values;
    }
  }
  constexpr const char* kMeasures[] = {"inside", "other normals", "large coefficients"};
  for (int kind = 0; kind < kinds; ++kind) {
    findings[kind].test = "finite";
    findings[kind].measure = kMeasures[kind];
    findings[kind].unit = fmt::format("of {} inputs", inputs[kind]);
  }
  findings[inside].verdict = findings[inside].value > 0 ? Verdict::fails : Verdict::ok;
  return {std::begin(findings), std::end(findings)};
}

}  // namespace twinshade

// Conditioning: the condition number of the Gram matrix of a linear basis on its domain. A fit loses up to log10 of it
// in digits, so in float (7 digits) coefficients of a badly conditioned basis are noise; they also grow large, of
// opposite signs.
#include "experiments/stability/test.h"
#include "lighting/linear_bases.h"

namespace twinshade {
namespace {

constexpr double kMostCondition = 1000;

}  // namespace

std::vector<Finding> test_conditioning(const TestedBasis& tested) {
  if (!tested.basis.linear) return {};
  Finding finding;
  finding.test = "conditioning";
  finding.measure = "condition";
  finding.value = condition_number(gram_matrix(tested.basis), tested.basis.count);
  finding.unit = "largest by smallest";
  finding.verdict = within(finding.value <= kMostCondition);
  return {finding};
}

}  // namespace twinshade

// Results in the forms that CI services read: JUnit XML, annotations of a log.
#pragma once

#include <string>
#include <vector>

#include "app/report/case_result.h"

namespace twinshade {

std::string junit_xml(const std::string& suite, const std::vector<CaseResult>& cases);

// What did not pass as workflow commands of GitHub Actions, a line each: it shows them beside the lines of the change.
std::string github_annotations(const std::vector<CaseResult>& cases);

}  // namespace twinshade

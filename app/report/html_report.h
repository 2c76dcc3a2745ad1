// A run's results as one page for people: what did not pass first, with pictures, the pixel and the line of GLSL.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/report/case_result.h"

namespace twinshade {

struct HtmlReport {
  std::string title;    // "twinshade golden check"
  std::string summary;  // lines below it; may be empty
  const std::vector<CaseResult>& cases;
  nlohmann::ordered_json provenance;
};

// So many cases have pictures: a page with hundreds of them would not open.
constexpr std::size_t kMostPictured = 24;

// An HTML document that needs nothing beside it, neither files nor scripts. Of a case that did not pass it reads the
// lines of GLSL that the case is about, where the file can be read. The same results are the same bytes but for the
// times in them.
std::string html_report(const HtmlReport& report);

}  // namespace twinshade

// --junit and --html of the verbs that judge.
#pragma once

#include "app/output.h"
#include "app/report/html_report.h"

namespace twinshade {

// Writes those that are asked for.
void write_reports(const Output& output, const HtmlReport& report);

}  // namespace twinshade

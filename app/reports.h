// --junit and --html of the verbs that judge.
#pragma once

#include "app/html_report.h"
#include "app/output.h"

namespace twinshade {

// Writes those that are asked for.
void write_reports(const Output& output, const HtmlReport& report);

}  // namespace twinshade

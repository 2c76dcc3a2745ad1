#include "app/report/reports.h"

#include "app/report/junit.h"

namespace twinshade {

void write_reports(const Output& output, const HtmlReport& report) {
  output.junit(junit_xml(report.title, report.cases));
  if (output.wants_html()) output.html(html_report(report));
}

}  // namespace twinshade

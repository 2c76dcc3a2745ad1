// JUnit: the schema that Jenkins and others agree on: https://github.com/testmoapp/junitxml
// GitHub: docs.github.com/actions/reference/workflow-commands-for-github-actions, "Setting an error message"
#include "app/report/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/utf8.h"

namespace twinshade {
namespace {

// A workflow command ends with its line, and a property of it with a comma.
std::string command_text(const std::string& text, bool property) {
  std::string result;
  for (const char c : text) {
    if (c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ',')))
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result;
}

// "./x" as services know it.
std::string plain(const std::string& path) { return path.rfind("./", 0) == 0 ? path.substr(2) : path; }

}  // namespace

std::string github_annotations(const std::vector<CaseResult>& cases) {
  std::string lines;
  for (const CaseResult& c : cases) {
    if (c.result == CaseResult::Result::passed) continue;
    const auto [file, line] = place_of(c);
    std::string properties;
    if (!file.empty()) properties += " file=" + command_text(plain(file), true);
    if (!file.empty() && line > 0) properties += fmt::format(",line={}", line);
    properties += (properties.empty() ? " title=" : ",title=") + command_text(plain(c.name), true);
    const std::string details = c.text.empty() ? c.message : c.message + "\n" + c.text;
    lines += "::error" + properties + "::" + command_text(details, false) + "\n";
  }
  return lines;
}

std::string junit_xml(const std::string& suite, const std::vector<CaseResult>& cases) {
  using Result = CaseResult::Result;
  const auto count = [&](Result result) {
    return std::count_if(cases.begin(), cases.end(), [&](const CaseResult& c) { return c.result == result; });
  };
  double seconds = 0;
  for (const CaseResult& c : cases) seconds += c.seconds;
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  xml +=
      fmt::format("<testsuites>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
                  xml_escaped(suite), cases.size(), count(Result::failed), count(Result::error), seconds);
  for (const CaseResult& c : cases) {
    xml += fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">", xml_escaped(suite),
                       xml_escaped(plain(c.name)), c.seconds);
    if (c.result != Result::passed) {
      const char* tag = c.result == Result::failed ? "failure" : "error";
      xml += fmt::format("\n<{0} message=\"{1}\">{2}</{0}>\n", tag, xml_escaped(c.message), xml_escaped(c.text));
    }
    xml += "</testcase>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace twinshade

// JUnit: the schema that Jenkins and others agree on: https://github.com/testmoapp/junitxml
// GitHub: docs.github.com/actions/reference/workflow-commands-for-github-actions, "Setting an error message"
#include "app/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <utility>

namespace twinshade {
namespace {

// XML 1.0 has no form at all for most control characters.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t' ? '?' : c;
  }
  return result;
}

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

// Where the message says it is: FILE:LINE: ...
std::optional<std::pair<std::string, int>> place_in(const std::string& message) {
  std::smatch match;
  if (!std::regex_search(message, match, std::regex("^([^:\\s]+):([0-9]{1,9}):"))) return std::nullopt;
  return std::pair(match[1].str(), std::stoi(match[2].str()));
}

}  // namespace

std::string github_annotations(const std::vector<JUnitCase>& cases) {
  std::string lines;
  for (const JUnitCase& c : cases) {
    if (c.result == JUnitCase::Result::passed) continue;
    const auto [file, line] = place_in(c.message).value_or(std::pair(c.file, c.line));
    std::string properties;
    if (!file.empty()) properties += " file=" + command_text(file, true);
    if (!file.empty() && line > 0) properties += fmt::format(",line={}", line);
    properties += (properties.empty() ? " title=" : ",title=") + command_text(c.name, true);
    const std::string details = c.text.empty() ? c.message : c.message + "\n" + c.text;
    lines += "::error" + properties + "::" + command_text(details, false) + "\n";
  }
  return lines;
}

std::string junit_xml(const std::string& suite, const std::vector<JUnitCase>& cases) {
  using Result = JUnitCase::Result;
  const auto count = [&](Result result) {
    return std::count_if(cases.begin(), cases.end(), [&](const JUnitCase& c) { return c.result == result; });
  };
  double seconds = 0;
  for (const JUnitCase& c : cases) seconds += c.seconds;
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  xml +=
      fmt::format("<testsuites>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
                  escaped(suite), cases.size(), count(Result::failed), count(Result::error), seconds);
  for (const JUnitCase& c : cases) {
    xml += fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">", escaped(suite), escaped(c.name),
                       c.seconds);
    if (c.result != Result::passed) {
      const char* tag = c.result == Result::failed ? "failure" : "error";
      xml += fmt::format("\n<{0} message=\"{1}\">{2}</{0}>\n", tag, escaped(c.message), escaped(c.text));
    }
    xml += "</testcase>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace twinshade

// JUnit: the schema that Jenkins and others agree on: https://github.com/testmoapp/junitxml
// GitHub: docs.github.com/actions/reference/workflow-commands-for-github-actions, "Setting an error message"
#include "app/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>

#include "base/utf8.h"

namespace twinshade {
namespace {

// What a document may not hold becomes U+FFFD.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : with_characters_alone(text)) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\r')
      result += "&#13;";
    else
      result += c;
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

// "./x" as services know it.
std::string plain(const std::string& path) { return path.rfind("./", 0) == 0 ? path.substr(2) : path; }

// Where the message says it is: FILE:LINE: ...; a file that is known may have colons and blanks in its name.
std::optional<std::pair<std::string, int>> place_in(const JUnitCase& c) {
  std::vector<std::string> known = c.files;
  known.push_back(c.file);
  const std::string* begun = nullptr;
  for (const std::string& file : known)
    if (!file.empty() && c.message.rfind(file + ":", 0) == 0 && (begun == nullptr || begun->size() < file.size()))
      begun = &file;
  std::smatch match;
  const std::string behind = begun == nullptr ? "" : c.message.substr(begun->size());
  if (begun != nullptr)
    return std::pair(*begun, std::regex_search(behind, match, std::regex("^:([0-9]{1,9}):")) ? std::stoi(match[1].str())
                             : *begun == c.file                                              ? c.line
                                                                                             : 0);
  if (!std::regex_search(c.message, match, std::regex("^([^:\\s]+):([0-9]{1,9}):"))) return std::nullopt;
  return std::pair(match[1].str(), std::stoi(match[2].str()));
}

}  // namespace

std::string github_annotations(const std::vector<JUnitCase>& cases) {
  std::string lines;
  for (const JUnitCase& c : cases) {
    if (c.result == JUnitCase::Result::passed) continue;
    const auto [file, line] = place_in(c).value_or(std::pair(c.file, c.line));
    std::string properties;
    if (!file.empty()) properties += " file=" + command_text(plain(file), true);
    if (!file.empty() && line > 0) properties += fmt::format(",line={}", line);
    properties += (properties.empty() ? " title=" : ",title=") + command_text(plain(c.name), true);
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
    xml += fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">", escaped(suite),
                       escaped(plain(c.name)), c.seconds);
    if (c.result != Result::passed) {
      const char* tag = c.result == Result::failed ? "failure" : "error";
      xml += fmt::format("\n<{0} message=\"{1}\">{2}</{0}>\n", tag, escaped(c.message), escaped(c.text));
    }
    xml += "</testcase>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace twinshade

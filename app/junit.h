// Results in the forms that CI services read: JUnit XML, annotations of a log.
#pragma once

#include <string>
#include <vector>

namespace twinshade {

struct JUnitCase {
  enum class Result { passed, failed, error };
  std::string name;
  Result result = Result::passed;
  std::string message;  // one line; failed, error
  std::string text;     // details
  double seconds = 0;
  std::string file = {};  // of the shader, where known; a message that begins with FILE:LINE: tells better
  int line = 0;           // from 1 on; 0: not known
  std::vector<std::string> files = {};  // that a message may begin with, beside `file`: their names may hold anything
};

std::string junit_xml(const std::string& suite, const std::vector<JUnitCase>& cases);

// What did not pass as workflow commands of GitHub Actions, a line each: it shows them beside the lines of the change.
std::string github_annotations(const std::vector<JUnitCase>& cases);

}  // namespace twinshade

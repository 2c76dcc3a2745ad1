// How one case of a run went: a shader, a frame, a row of frames compared. Reports are made from these.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace twinshade {

struct CaseResult {
  enum class Result { passed, failed, error };
  struct Picture {
    std::string label, png;  // the file's bytes
  };
  // Of one size, and the pixel that they are about.
  struct Pictures {
    std::uint32_t width = 0, height = 0;
    std::optional<std::uint32_t> x{}, y{};  // y downwards
    std::vector<Picture> list{};
  };

  std::string name;
  Result result = Result::passed;
  std::string message;  // one line; failed, error
  std::string text;     // details
  double seconds = 0;
  std::string file = {};  // of the shader, where known; a message that begins with FILE:LINE: tells better
  int line = 0;           // from 1 on; 0: not known
  std::vector<std::string> files = {};  // that a message may begin with, beside `file`: their names may hold anything
  Pictures pictures = {};               // of what did not pass, for a report that shows them
};

// The file and line that a result is about: what its message begins with (FILE:LINE: ...; a file that is known may have
// colons and blanks in its name), or its own. No file: empty; no line: 0.
std::pair<std::string, int> place_of(const CaseResult& c);

}  // namespace twinshade

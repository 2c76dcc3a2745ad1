// Where results, notes and JSON go.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/options.h"
#include "base/file.h"

namespace twinshade {

using Json = nlohmann::ordered_json;

// Results are read on stdout. When JSON or JUnit XML takes stdout (--json -, --junit -), text for people moves to
// stderr, so that what a program reads is that alone. UserError where stdout cannot be written.
class Output {
 public:
  // Refuses files that cannot be written before any work is done. junit_file: what --junit says, of verbs that have it.
  explicit Output(const CommonOptions& options, const std::string& junit_file = {});
  void text(const std::string& text) const;  // a result, as is
  void note(const std::string& line) const;  // "note: ..." on stderr, unless --quiet
  // What is being done, on stderr where that is a terminal, unless --quiet; the next output replaces it.
  void progress(const std::string& line) const;
  void json(const Json& json) const;         // to where --json says; nothing without it
  void junit(const std::string& xml) const;  // to where --junit says; nothing without it

 private:
  void clear_progress() const;

  const CommonOptions& options_;
  const std::string junit_file_;
  bool shows_progress_ = false;
  mutable bool progress_shown_ = false;
};

// Creates `folder` and those above it. UserError where that cannot be done or it cannot be written to.
void require_writable_folder(const std::string& folder);

// 1.25 and 0x1.4p+0; NaN with its bits.
std::string hex_float(float value);

}  // namespace twinshade

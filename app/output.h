// Where results, notes and JSON go.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/options.h"
#include "app/standard_output.h"
#include "base/file.h"

namespace twinshade {

using Json = nlohmann::ordered_json;

// Results are read on stdout. When a document takes stdout (--json -, --junit -, --html -), or a file (-o
// /dev/stdout), text for people moves to stderr, so that what a program reads is that alone. UserError where stdout
// cannot be written; files are written all the same.
class Output {
 public:
  // Refuses files that cannot be written, and one file for two results, before any work is done. reports: what
  // verbs that have them say. folder: what -o says, of verbs that make one: --json and reports may be in it before it
  // is there.
  explicit Output(const CommonOptions& options, const ReportOptions& reports = {}, const std::string& folder = {});
  // Says what files -o writes into its folder, by name: all that it may write, before any work. Refuses --json and
  // reports of those names; require_not_read then keeps what is read from being replaced by them.
  void claim(std::vector<std::string> names);
  // Where one of those goes; a name that was not claimed is a broken invariant.
  std::string claimed(const std::string& name) const;
  // Refuses to write over a file that the verb reads. `written`: what else it writes, beside --json, reports and
  // what is claimed.
  void require_not_read(const std::vector<std::string>& read, const std::string& written = {}) const;
  // Tells that -o writes `file`. Where that leads to stdout, text for people moves to stderr; --json -, --junit - and
  // --html - are refused then.
  void leave_stdout_to(const std::string& file);
  // Refuses a file in `folder` with this ending: the next run would take it for what is read there ("cases").
  void require_not_taken(const std::string& folder, const std::string& ending, const std::string& what) const;
  void text(const std::string& text) const;  // a result, as is
  void note(const std::string& line) const;  // "note: ..." on stderr, unless --quiet; each line once
  // What is being done, on stderr where that is a terminal, unless --quiet; the next output replaces it.
  void progress(const std::string& line) const;
  void json(const Json& json) const;  // to where --json says; nothing without it
  // The same of what there is so far, before more of it: to files alone, which the next one replaces.
  void json_so_far(const Json& json) const;
  void junit(const std::string& xml) const;  // to where --junit says; nothing without it
  bool wants_html() const { return !documents_[kHtml].file.empty(); }
  void html(const std::string& page) const;  // to where --html says; nothing without it

 private:
  struct Document {
    const char* option;
    std::string file;  // "-": stdout; empty: not asked for
  };
  static constexpr std::size_t kJUnit = 1, kHtml = 2;  // of documents_

  void clear_progress() const;
  bool claims(const std::string& file) const;  // whether -o writes it
  bool is_in_folder(const std::string& file) const;
  // A file's path, or - for stdout; empty: not asked for.
  void write_to(const std::string& file, const std::string& text) const;
  // What is said of a file, and the file; none for stdout.
  std::vector<std::pair<std::string, std::string>> files() const;
  bool document_on_stdout() const;
  ResultsInFiles results_in_files() const;

  const CommonOptions& options_;
  const std::array<Document, 3> documents_;
  const std::string folder_;        // -o; empty: none
  std::set<std::string> claimed_;   // names of files in it
  std::vector<std::string> links_;  // those that are links: what one leads to is replaced
  bool stdout_left_ = false;        // to what -o writes
  mutable std::set<std::string> noted_;
  bool shows_progress_ = false;
  mutable bool progress_shown_ = false;
};

// A shader's file and those that it includes, as far as they can be told: what is wrong with it is said elsewhere. A
// pipe can be read once only: alone.
std::vector<std::string> files_of_shader(const std::string& shader, const SourceOptions& options);

// UserError where nothing could be written into `folder`, which need not be there yet: to be asked before any work. A
// run that is refused leaves no folder: it is made with the first file.
void require_writable_folder(const std::string& folder);
// Creates `folder` and those above it where they are missing. UserError where that cannot be done.
void make_folder(const std::string& folder);

// A distance in ULP; null for UINT64_MAX, which is none: NaN on one side.
Json ulp_json(std::uint64_t ulp);

// 0x1.4p+0; NaN with its bits.
std::string hex_float(float value);

}  // namespace twinshade

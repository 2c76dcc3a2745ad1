// What golden update and golden check found: as tables, as JSON, as results of cases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/output.h"
#include "app/report/case_result.h"
#include "app/report/table.h"
#include "check/first_line.h"
#include "cpu_shaders/lint/lint.h"
#include "golden/compare_frames.h"
#include "golden/manifest.h"

namespace twinshade {

enum class GoldenResult {
  same,        // bit for bit
  within,      // no more off than --ulp says
  differs,     //
  no_image,    // the entry's image is missing
  damaged,     // the image cannot be read, or is not what the manifest says
  failed,      // it cannot be drawn: its scene, technique or shader is missing or wrong
  no_backend,  // a backend cannot draw
  // update
  added,
  changed,   // another frame than before, now kept
  restored,  // the image was missing or damaged
};

// What a frame is drawn from, where it is not what it was when the image was made.
struct GoldenChanges {
  bool drawing = false, bundle = false, shader = false;  // drawing: the options, of update
};

struct GoldenRow {
  std::string folder, name;
  std::string on;  // the backend; of update empty
  GoldenResult result = GoldenResult::same;
  std::string error;  // one line: why there is no image or no frame
  GoldenChanges changes;
  std::optional<Comparison> comparison;  // of the image and the frame, where both are there and of one size and type
  Json first_difference;                 // null where there is none
  std::uint64_t ulp = 0;                 // what is let pass
  std::string description;               // several lines, where they differ
  std::vector<LintFinding> findings;     // where they differ
  std::optional<FirstLine> first_line;   // where the CPU still draws the image, and this backend does not
  std::string golden_frame, frame;       // hashes; empty where there is none
  std::string shader_file;               // of a user's shader
  std::string written;                   // image, of update
  CaseResult::Pictures pictures;         // where they differ, for a report that shows them
  double seconds = 0;

  bool passes() const { return result == GoldenResult::same || result == GoldenResult::within; }
};

// Columns of the table that rows are written to as they are known. names: of all entries.
Table check_table(const std::vector<std::string>& names, const std::vector<std::string>& backends);
Table update_table(const std::vector<std::string>& names);
std::vector<std::string> check_cells(const GoldenRow& row);
std::vector<std::string> update_cells(const GoldenRow& row);

// Why a frame is another one than the image, as far as what it is drawn from tells.
std::string cause(const GoldenRow& row);
// Below the table: each failure's own words.
std::string failure_text(const GoldenRow& row);
// "11 of 12 the same, 1 within 4 ULP".
std::string check_summary(const std::vector<GoldenRow>& rows, std::uint64_t ulp);
std::string update_summary(const std::vector<GoldenRow>& rows);

Json golden_json(const GoldenRow& row);
std::vector<CaseResult> golden_results(const std::vector<GoldenRow>& rows);

}  // namespace twinshade

// What compare found, for people, as JSON and as results of cases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/output.h"
#include "app/report/case_result.h"
#include "check/first_line.h"
#include "cpu_shaders/lint/lint.h"
#include "golden/compare_frames.h"
#include "raster/renderer.h"

namespace twinshade {

// One line of the table: a shader on b, held to the reference a.
struct ComparedShader {
  AttributeMode attributes = AttributeMode::exact;
  std::string technique, light, map, a, b;
  std::string output;   // that colours are of, where the shader has several
  std::string failure;  // why there is no comparison
  Comparison comparison;
  std::string hash_a, hash_b;
  Json first_difference;
  std::string description;
  std::vector<LintFinding> findings;    // where they differ: what in the shader may explain it
  std::optional<FirstLine> first_line;  // where colours differ, exact attributes
  CaseResult::Pictures pictures;        // where they differ, for a report that shows them

  std::string name() const { return output.empty() ? technique : technique + ": " + output; }
  // Frames that should be one and are not: native attributes may differ, and so may denormals on softpipe, which keeps
  // them where the dialect flushes them.
  bool is_mismatch() const;
};

// Of the table's columns, in their order.
std::vector<std::string> compared_cells(const ComparedShader& row);
Json compared_json(const ComparedShader& row);
// shader_file: a user's, or empty.
std::vector<CaseResult> compared_results(const std::vector<ComparedShader>& rows, const std::string& shader_file);

}  // namespace twinshade

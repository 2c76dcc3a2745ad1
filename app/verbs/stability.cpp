// stability: where a method fails, how badly, with the input that shows it.
#include "experiments/stability/stability.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>
#include <memory>

#include "app/output.h"
#include "app/provenance.h"
#include "app/report/rows_output.h"
#include "app/report/table.h"
#include "base/file.h"

namespace twinshade {
namespace {

struct StabilityVerb {
  CommonOptions common;
  StabilityOptions options;
  std::string folder;
  bool long_table = false;

  int run();
  std::vector<std::string> own_files() const;
};

// What -I has: none of it is to be written over.
std::vector<std::string> StabilityVerb::own_files() const {
  std::vector<std::string> files;
  std::error_code code;
  if (!options.include_folder.empty())
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(options.include_folder) / "basis", code))
      files.push_back(entry.path().string());
  return files;
}

std::string text_of(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text ? *text : "";
}

std::string figure_text(const Rows& rows, std::size_t row, int digits) {
  const double value = rows.number(row, "value");
  if (!std::isfinite(value)) return "-";
  if (value == std::floor(value) && std::abs(value) < 1e9) return fmt::format("{:.0f}", value);  // counts among them
  return fmt::format("{:.{}g}", std::abs(value) < 1e-8 ? 0.0 : value, digits);
}

// A row for each method. What is poor has a star, what fails an exclamation mark.
std::string stability_summary(const Rows& rows) {
  struct Column {
    const char *heading, *test, *measure;
  };
  constexpr Column kColumns[] = {{"ringing", "ringing", "least"},
                                 {"peak", "ringing", "greatest"},
                                 {"constant", "constant", "least"},
                                 {"to", "constant", "greatest"},
                                 {"NaN", "finite", "inside"},
                                 {"rounding", "rounding", "largest"},
                                 {"jump", "jump", "value"},
                                 {"slope", "jump", "slope"},
                                 {"half", "storage", "half"},
                                 {"8 bits", "storage", "unorm8"},
                                 {"blend", "light", "blend"},
                                 {"change", "light", "change"},
                                 {"condition", "conditioning", "condition"},
                                 {"reading", "reading", "largest"}};
  std::vector<Column> columns;
  for (const Column& column : kColumns)
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (text_of(rows.at(row, "test")) == column.test && text_of(rows.at(row, "measure")) == column.measure) {
        columns.push_back(column);
        break;
      }
  Table table;
  table.column("method");
  for (const Column& column : columns) table.column(column.heading, Table::Align::right);
  for (std::size_t row = 0; row < rows.size();) {
    const std::string method = text_of(rows.at(row, "method"));
    std::vector<std::string> cells(columns.size() + 1);
    cells[0] = method;
    for (; row < rows.size() && text_of(rows.at(row, "method")) == method; ++row)
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (text_of(rows.at(row, "test")) != columns[c].test || text_of(rows.at(row, "measure")) != columns[c].measure)
          continue;
        const std::string verdict = text_of(rows.at(row, "verdict"));
        cells[c + 1] = figure_text(rows, row, 3) + (verdict == "poor" ? "*" : verdict == "fails" ? "!" : "");
      }
    table.row(std::move(cells));
  }
  return table.text();
}

// Without the columns that are for machines.
std::string stability_table(const Rows& rows) {
  Table table;
  for (const char* heading : {"method", "test", "measure"}) table.column(heading);
  table.column("value", Table::Align::right);
  for (const char* heading : {"unit", "verdict", "input"}) table.column(heading);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    table.row({text_of(rows.at(row, "method")), text_of(rows.at(row, "test")), text_of(rows.at(row, "measure")),
               figure_text(rows, row, 4), text_of(rows.at(row, "unit")), text_of(rows.at(row, "verdict")),
               text_of(rows.at(row, "input"))});
  }
  return table.text();
}

int StabilityVerb::run() {
  apply(common);
  if (options.methods == std::vector<std::string>{"all"}) options.methods.clear();
  Output output(common, {}, folder);
  if (!folder.empty()) {
    std::vector<std::string> names{"stability.csv"};
    for (const std::string& picture : stability_pictures())
      for (const std::string& name : picture_files(picture)) names.push_back(name);
    output.claim(names);
    require_writable_folder(folder);
  }
  output.require_not_read(own_files());
  options.seed = common.seed;
  options.pictures = !folder.empty();
  options.progress = [&](const std::string& line) { output.progress(line); };
  const ExperimentResult result = run_stability(options);

  const bool all_inputs = long_table || !options.methods.empty();
  output.text(all_inputs ? stability_table(result.rows) : stability_summary(result.rows));
  if (!all_inputs)
    output.note(
        "*: poor, !: fails; --long lists what shows it, and all measures; docs/stability.md says what they are");
  for (const std::string& note : result.notes) output.note(note);
  if (!folder.empty()) {
    make_folder(folder);
    write_file(output.claimed("stability.csv"), result.rows.csv());
    write_pictures(folder, result.pictures, output);
  }
  const bool failed = stability_fails(result.rows);
  output.json({{"provenance", Provenance(common).json()},
               {"rows", json_rows(result.rows)},
               {"notes", result.notes},
               {"fails", failed}});
  return failed ? 1 : 0;
}

}  // namespace

Verb add_stability(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "stability", "where a basis or sphere map fails, how badly, with the input that shows it: table, CSV, charts");
  const auto verb = std::make_shared<StabilityVerb>();
  command->add_option("technique", verb->options.methods, "bases and sphere maps to test (default: all)")
      ->delimiter(',')
      ->type_name("TECHNIQUE,...");
  std::string tests;
  for (const StabilityTestInfo& test : stability_tests())
    tests += fmt::format("\n  {}: {}", test.name, test.description);
  command->add_option("--test", verb->options.tests, "only these tests:" + tests)->delimiter(',')->type_name("T,...");
  command
      ->add_option(
          "-I,--include", verb->options.include_folder,
          "test GLSL of one's own: DIR/basis/h4.glsl in place of the built-in h4.glsl, with the coefficients of h4")
      ->each(require_include_folder)
      ->type_name("DIR");
  command->add_flag("--long", verb->long_table,
                    "a line for each measure, with the input that shows it (default where techniques are named)");
  command->add_option("-o,--output", verb->folder, "write stability.csv and charts into this folder")->type_name("DIR");
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

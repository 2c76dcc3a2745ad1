// stability: where a method fails, how badly, with the input that shows it.
#include "experiments/stability.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "app/output.h"
#include "app/provenance.h"
#include "app/rows_output.h"
#include "app/table.h"
#include "base/file.h"

namespace twinshade {
namespace {

struct StabilityVerb {
  CommonOptions common;
  StabilityOptions options;
  std::string folder;

  int run();
};

std::string text_of(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text ? *text : "";
}

// Without the columns that are for machines.
std::string stability_table(const Rows& rows) {
  Table table;
  for (const char* heading : {"method", "test", "measure"}) table.column(heading);
  table.column("value", Table::Align::right);
  for (const char* heading : {"unit", "verdict", "input"}) table.column(heading);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double value = rows.number(row, "value");
    table.row({text_of(rows.at(row, "method")), text_of(rows.at(row, "test")), text_of(rows.at(row, "measure")),
               std::isfinite(value) ? fmt::format("{:.4g}", value) : "-", text_of(rows.at(row, "unit")),
               text_of(rows.at(row, "verdict")), text_of(rows.at(row, "input"))});
  }
  return table.text();
}

int StabilityVerb::run() {
  apply(common);
  Output output(common, {}, folder);
  if (!folder.empty()) {
    std::vector<std::string> names{"stability.csv"};
    for (const std::string& picture : stability_pictures())
      for (const std::string& name : picture_files(picture)) names.push_back(name);
    output.claim(names);
    require_writable_folder(folder);
  }
  options.seed = common.seed;
  options.pictures = !folder.empty();
  options.progress = [&](const std::string& line) { output.progress(line); };
  const ExperimentResult result = run_stability(options);

  output.text(stability_table(result.rows));
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
      "stability", "where a basis fails, how badly, with the input that shows it: table, CSV, charts");
  const auto verb = std::make_shared<StabilityVerb>();
  command->add_option("technique", verb->options.methods, "bases to test (default: all)")->type_name("TECHNIQUE");
  std::string tests;
  for (const StabilityTestInfo& test : stability_tests())
    tests += fmt::format("\n  {}: {}", test.name, test.description);
  command->add_option("--test", verb->options.tests, "only these tests:" + tests)->delimiter(',')->type_name("T,...");
  command->add_option("-o,--output", verb->folder, "write stability.csv and charts into this folder")->type_name("DIR");
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

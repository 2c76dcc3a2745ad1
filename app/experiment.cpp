// experiment: what a basis or map costs in accuracy, as table, CSV, JSON and pictures.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/table.h"
#include "base/error.h"
#include "base/file.h"
#include "experiments/experiment.h"
#include "golden/pictures.h"

namespace twinshade {
namespace {

struct ExperimentVerb {
  CommonOptions common;
  ExperimentOptions options;
  std::string name, folder;
  bool csv = false;

  int run();
};

Json json_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  return nullptr;
}

std::string table_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return fmt::format("{:.7g}", *real);
  return "-";
}

Json json_rows(const Rows& rows) {
  Json list = Json::array();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Json row = Json::object();
    for (std::size_t c = 0; c < rows.columns().size(); ++c) row[rows.columns()[c]] = json_cell(rows[r][c]);
    list.push_back(std::move(row));
  }
  return list;
}

std::string table_text(const Rows& rows) {
  Table table;
  for (std::size_t c = 0; c < rows.columns().size(); ++c) {
    const bool text = rows.size() > 0 && std::holds_alternative<std::string>(rows[0][c]);
    table.column(rows.columns()[c], text ? Table::Align::left : Table::Align::right);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::string> cells;
    for (const Cell& cell : rows[r]) cells.push_back(table_cell(cell));
    table.row(std::move(cells));
  }
  return table.text();
}

void write_radiometric(const std::string& path, const RadiometricImage& image) {
  Frame frame;
  frame.width = image.width;
  frame.height = image.height;
  frame.color.resize(std::size_t(image.width) * image.height * 4);
  for (std::uint32_t y = 0; y < image.height; ++y)  // frames are y-up
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const float* from = image.rgb.data() + (std::size_t(y) * image.width + x) * 3;
      float* to = frame.color.data() + (std::size_t(image.height - 1 - y) * image.width + x) * 4;
      for (int c = 0; c < 3; ++c) to[c] = from[c];
      to[3] = 1;
    }
  write_picture(path, frame);
}

void write_pictures(const std::string& folder, const std::vector<Picture>& pictures, const Output& output) {
  for (const Picture& picture : pictures) {
    const std::string path = (std::filesystem::path(folder) / picture.name).string();
    output.progress("writing " + path);
    if (const auto* drawing = std::get_if<Drawing>(&picture.content)) {
      write_file(path + ".svg", drawing->svg());
      write_file(path + ".png", drawing->png());
    } else {
      write_radiometric(path + ".exr", std::get<RadiometricImage>(picture.content));
    }
  }
}

int ExperimentVerb::run() {
  const ExperimentInfo& experiment = find_experiment(name);
  if (!options.probes.empty() && !experiment.takes_probes)
    throw UserError("experiment " + name + " takes no probe, but '" + options.probes.front() + "' is given");
  apply(common);
  const Output output(common);
  if (!folder.empty()) require_writable_folder(folder);
  options.seed = common.seed;
  options.pictures = !folder.empty();
  if (!options.on.empty()) require_backends(options.on);
  Machines machines(CpuOptions(), true);
  options.draw = [&](const std::string& machine, const Bundle& bundle, const ShaderSource& source) {
    return machines.draw(machine, bundle, source, DrawOptions());
  };
  options.progress = [&](const std::string& line) { output.progress(name + ": " + line); };
  const ExperimentResult result = experiment.run(options);

  output.text(csv ? result.rows.csv() : table_text(result.rows));
  for (const std::string& note : result.notes) output.note(note);
  if (!folder.empty()) {
    write_file((std::filesystem::path(folder) / (name + ".csv")).string(), result.rows.csv());
    write_pictures(folder, result.pictures, output);
  }
  output.json({{"experiment", name},
               {"provenance", Provenance(common).json()},
               {"rows", json_rows(result.rows)},
               {"notes", result.notes}});
  return 0;
}

}  // namespace

Verb add_experiment(CLI::App& app) {
  CLI::App* command = app.add_subcommand("experiment", "how far off bases and maps are: table, CSV, chart");
  const auto verb = std::make_shared<ExperimentVerb>();
  std::string names;
  for (const ExperimentInfo& experiment : experiments())
    names += fmt::format("\n  {}: {}", experiment.name, experiment.description);
  command->add_option("name", verb->name, "which one:" + names)->required()->type_name("NAME");
  command
      ->add_option("probe", verb->options.probes,
                   "environments or lat-long .hdr/.exr files to measure on (default: the built-in ones)")
      ->type_name("PROBE");
  command->add_option("--basis,--technique", verb->options.bases, "only these bases")
      ->delimiter(',')
      ->type_name("B,...");
  command->add_option("--map", verb->options.maps, "only these sphere maps")->delimiter(',')->type_name("M,...");
  command->add_option("--map-width", verb->options.widths, "only these widths")->delimiter(',')->type_name("W,...");
  command->add_option("--order", verb->options.orders, "only these orders of spherical harmonics")
      ->delimiter(',')
      ->type_name("N,...");
  command
      ->add_option("--on", verb->options.on,
                   "sphere-map-mse: read the maps on these machines, by the shader itself, and compare the bits")
      ->delimiter(',')
      ->type_name("M,...");
  command
      ->add_option("--samples", verb->options.samples,
                   "random signals or points (default: as many as the published figures need)")
      ->check(CLI::Range(1, 100000000))
      ->type_name("N");
  command->add_flag("--relative", verb->options.relative, "errors relative to the signal as well");
  command->add_flag("--clamp-radiance", verb->options.clamp_radiance,
                    "accept probes with NaN, infinite or negative radiance");
  command->add_flag("--csv", verb->csv, "print comma-separated values instead of a table");
  command->add_option("-o", verb->folder, "write NAME.csv, NAME.svg, NAME.png and further pictures into this folder")
      ->type_name("DIR");
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

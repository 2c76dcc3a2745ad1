// What is common to the experiments: each measures something about every basis or map and gives rows, notes and
// pictures.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "experiments/drawing.h"
#include "raster/renderer.h"

namespace twinshade {

// monostate: the value is not defined (the notes say why); null in JSON, empty in CSV, "-" in the table.
using Cell = std::variant<std::monostate, std::string, std::int64_t, double>;

// A double as a cell: monostate where it is not finite, since JSON has neither NaN nor infinity.
Cell number_cell(double value);

class Rows {
 public:
  explicit Rows(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  // One cell a column.
  void add(std::vector<Cell> cells);

  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t size() const { return rows_.size(); }
  const std::vector<Cell>& operator[](std::size_t row) const { return rows_[row]; }
  // The cell of a row under a heading that must be there.
  const Cell& at(std::size_t row, std::string_view column) const;
  // The same as a number; NaN where the cell has none.
  double number(std::size_t row, std::string_view column) const;

  // As comma-separated values (RFC 4180, lines ended by \n), doubles with the 17 digits that bring back every bit.
  std::string csv() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

// Light or a map of the sphere as it is, RGB, row 0 at the top: written as EXR beside the drawings.
struct RadiometricImage {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;
};

struct Picture {
  std::string name;  // of its files, without an ending: "basis-imse", "basis-imse-sweep"
  std::variant<Drawing, RadiometricImage> content;
};

// Draws a bundle on a machine ("cpu", "egl", "osmesa").
using DrawFunction = std::function<Frame(const std::string& machine, const Bundle&, const ShaderSource&)>;

struct ExperimentOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> bases{};   // names from the registry; empty: every basis that the experiment can measure
  std::vector<std::string> maps{};    // the same of sphere maps
  std::vector<std::string> probes{};  // environments or lat-long .hdr/.exr files; empty: the built-in environments
  int samples = 0;                    // random signals or points; 0: as many as the published figures need
  bool relative = false;              // errors relative to the signal as well
  bool clamp_radiance = false;        // accept probes with NaN, infinite, negative or too large radiance
  std::vector<int> widths = {};       // of sphere maps; empty: those of the published figure
  std::vector<int> orders = {};       // of spherical harmonics; empty: those of the published figure
  DrawFunction draw = {};             // how machines draw; for sphere-map-mse where `on` names one, visibility-figures
  std::vector<std::string> on = {};   // machines that read sphere maps; empty: the host, in double
  bool driver_filters = false;        // with `on`: by the drivers' own filters as well
  bool pictures = true;               // false: rows only
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

struct ExperimentResult {
  Rows rows;
  std::vector<std::string> notes;  // one line each: what was skipped and why, what a value does not mean
  std::vector<Picture> pictures;
};

struct ExperimentInfo {
  std::string_view name;
  std::string_view description;
  bool takes_probes;
  // Of the options on the command line that choose what is measured, those that mean something to it, as "--basis".
  std::array<std::string_view, 6> options;
  // Names of all pictures that run() may give: what they would replace can be told before it runs.
  std::vector<std::string> (*pictures)(const ExperimentOptions&);
  // Independent of the number of threads: the same rows, bit by bit. UserError for names that do not exist, with the
  // nearest ones.
  ExperimentResult (*run)(const ExperimentOptions&);
};

std::span<const ExperimentInfo> experiments();
// UserError with the nearest names where there is none.
const ExperimentInfo& find_experiment(std::string_view name);

// One function an experiment, each in its own file; experiments.cpp lists them.
ExperimentResult run_basis_imse(const ExperimentOptions& options);
ExperimentResult run_frobenius(const ExperimentOptions& options);
ExperimentResult run_probe_rmse(const ExperimentOptions& options);
ExperimentResult run_sphere_map_mse(const ExperimentOptions& options);
ExperimentResult run_visibility_figures(const ExperimentOptions& options);
ExperimentResult run_wobble(const ExperimentOptions& options);
ExperimentResult run_figures(const ExperimentOptions& options);

}  // namespace twinshade

// Charts that one can read: line charts, bar charts, heat maps and scatter plots, as drawings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/drawing.h"

namespace twinshade {

// Colours that stay apart for colour-blind eyes too (Okabe and Ito, Color Universal Design, 2008, and two more), then
// the same ones again: series beyond the eighth are told apart by dashes as well.
Color series_color(std::size_t series);
std::vector<double> series_dashes(std::size_t series);

struct Axis {
  std::string title{};  // with its unit
  bool logarithmic = false;
  // Without them the axis spans the data. A logarithmic axis must span positive values.
  std::optional<double> low{}, high{};
  std::optional<int> most_decades{};  // of a logarithmic axis: what is smaller is shown as below it
  bool whole = false;                 // of what is counted: ticks are whole numbers
};

struct Series {
  std::string label;
  std::vector<double> x,
      y;                 // as many; where y is not finite, or negative on a logarithmic axis, the line has a gap
  bool markers = false;  // a disc at each point
};

struct LineChart {
  std::string title, subtitle;
  Axis x, y;
  std::vector<Series> series{};  // each labelled at its right end, in its colour
  double width = 900, height = 560;
};

// Rows of horizontal bars, or of dots: always on a logarithmic axis, where a bar has no honest beginning. Each series
// has dots of its own shape, so that those at one place are all seen.
struct BarChart {
  std::string title, subtitle;
  Axis value;
  std::vector<std::string> rows;
  struct Bars {
    std::string label;           // in the legend, where there is more than one
    std::vector<double> values;  // of each row; not finite: "-"
  };
  std::vector<Bars> bars;
  bool dots = false;
  double width = 900;
};

// Points with their names beside them, of a group each, and a line through some.
struct ScatterChart {
  std::string title, subtitle;
  Axis x, y;
  struct Point {
    std::string label;      // empty: it has no name
    double x = 0, y = 0;    // not shown where either is not finite, or not positive on a logarithmic axis
    std::size_t group = 0;  // of `groups`
  };
  std::vector<Point> points{};
  std::vector<std::string> groups{};   // in the legend
  std::string line{};                  // what the line is, in the legend; empty: there is none
  std::vector<std::size_t> on_line{};  // points, in order; each is joined to the next by a step: right, then down
  std::optional<double> limit{};       // a level of y, dashed, shown where the axis reaches it
  std::string limit_label{};
  double width = 1000, height = 720;
};

// Values as colours, with the number written into each cell.
struct HeatMap {
  std::string title, subtitle;
  std::vector<std::string> rows, columns;
  std::vector<double> values;  // [row * columns + column]; not finite: an empty cell
  bool logarithmic = false;    // of the colours
};

// What is below a logarithmic axis, zero included, is an arrow at its lower end, and a line below the chart says so.
Drawing draw(const LineChart& chart);
Drawing draw(const BarChart& chart);
Drawing draw(const HeatMap& chart);
Drawing draw(
    const ScatterChart& chart);  // scatter_chart.cpp; of the points on the line all names, of others where room is

// The colour of a value in [0, 1], from dark blue to yellow: about matplotlib's viridis (van der Walt and Smith, 2015).
Color heat_color(double value);

// A value with four significant digits, for people.
std::string short_number(double value);

}  // namespace twinshade

#include "experiments/stability/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "experiments/chart.h"
#include "experiments/stability/stability.h"

namespace twinshade {
namespace {

struct Dots {
  std::string_view test, measure, label;
};

struct Chart {
  std::string_view name, title, subtitle, axis;
  bool logarithmic;
  std::vector<Dots> dots;
};

const std::vector<Chart>& charts() {
  static const std::vector<Chart> list = {
      {"stability-ringing",
       "Ringing: what a unit sun becomes",
       "Over all directions of the sun and of the normal; exact would be 0 to 1.",
       "irradiance, of that facing the sun",
       false,
       {{"ringing", "least", "least"}, {"ringing", "greatest", "greatest"}}},
      {"stability-constant",
       "What constant light comes back as",
       "Over all normals; exact would be 1.",
       "irradiance, of the light's",
       false,
       {{"constant", "least", "least"}, {"constant", "greatest", "greatest"}}},
      {"stability-smoothness",
       "Seams and rounding",
       "Largest difference between neighbouring normals, and between float and double.",
       "of the largest irradiance",
       true,
       {{"jump", "value", "jump"}, {"rounding", "largest", "rounding"}}},
      {"stability-light",
       "Methods that are not linear in the light",
       "blend: averaged coefficients against averaged irradiance; change: what 1e-4 of the light does where two suns "
       "are opposite.",
       "of the largest irradiance",
       true,
       {{"light", "blend", "blend"}, {"light", "change", "change"}}},
      {"stability-storage",
       "Stored coefficients",
       "Largest error of irradiance where coefficients are rounded, over suns and a constant light.",
       "of the largest irradiance",
       true,
       {{"storage", "half", "half"}, {"storage", "unorm8", "8 bits"}}},
  };
  return list;
}

// In the unit of the chart.
double charted(const Rows& rows, std::size_t row) {
  double value = rows.number(row, "value");
  if (std::abs(value) < 1e-12) value = 0;  // rounding below zero would be left of an axis that begins there
  return rows.at(row, "unit") == Cell(std::string("2^-24")) ? value * 0x1p-24 : value;
}

}  // namespace

std::vector<std::string> stability_pictures() {
  std::vector<std::string> names;
  for (const Chart& chart : charts()) names.emplace_back(chart.name);
  return names;
}

std::vector<Picture> stability_charts(const Rows& rows) {
  std::vector<Picture> pictures;
  for (const Chart& kind : charts()) {
    BarChart chart;
    chart.title = kind.title;
    chart.subtitle = kind.subtitle;
    chart.value.title = kind.axis;
    chart.value.logarithmic = kind.logarithmic;
    if (kind.logarithmic) chart.value.most_decades = 6;
    chart.dots = true;
    for (const Dots& dots : kind.dots) chart.bars.push_back({std::string(dots.label), {}});
    bool any = false;
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t d = 0; d < kind.dots.size(); ++d) {
        const Dots& dots = kind.dots[d];
        if (rows.at(row, "test") != Cell(std::string(dots.test)) ||
            rows.at(row, "measure") != Cell(std::string(dots.measure)))
          continue;
        const std::string& method = std::get<std::string>(rows.at(row, "method"));
        if (chart.rows.empty() || chart.rows.back() != method) {
          chart.rows.push_back(method);
          for (BarChart::Bars& bars : chart.bars) bars.values.push_back(std::numeric_limits<double>::quiet_NaN());
        }
        chart.bars[d].values.back() = charted(rows, row);
        any = true;
      }
    if (any) pictures.push_back({std::string(kind.name), draw(chart)});
  }
  return pictures;
}

}  // namespace twinshade

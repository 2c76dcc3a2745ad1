#include "experiments/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/portable_math.h"
#include "experiments/chart_axis.h"
#include "experiments/chart_parts.h"

namespace twinshade {
namespace {

constexpr double kRowHeight = 22;
constexpr Color kSeriesColors[] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115},  {204, 121, 167},
                                   {230, 159, 0}, {0, 0, 0},    {86, 180, 233}, {128, 64, 20}};
constexpr std::size_t kSeriesColorCount = std::size(kSeriesColors);

// Keeps labels that want to be at `wanted` at least `gap` apart and within [low, high], each as near as its neighbours
// let it.
std::vector<double> spread_labels(const std::vector<double>& wanted, double gap, double low, double high) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  std::vector<double> place = wanted;
  for (int round = 0; round < 200; ++round)
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
      double &above = place[order[k]], &below = place[order[k + 1]];
      const double missing = gap - (below - above);
      if (missing <= 0) continue;
      above -= missing / 2;
      below += missing / 2;
    }
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = std::max(place[order[k]], low + gap * double(k));
  for (std::size_t k = order.size(); k-- > 0;)
    place[order[k]] = std::min(place[order[k]], high - gap * double(order.size() - 1 - k));
  return place;
}

std::vector<double> all_values(const std::vector<Series>& series, std::vector<double> Series::*member) {
  std::vector<double> values;
  for (const Series& s : series) values.insert(values.end(), (s.*member).begin(), (s.*member).end());
  return values;
}

// A regular polygon's outline; `corner`: in turns clockwise from the right, where its first corner is.
void outline(Drawing& drawing, Point center, double radius, int corners, double corner, Color color) {
  std::vector<Point> points;
  for (int k = 0; k <= corners; ++k) {
    const double angle = 2 * portable::kPi * (corner + double(k % corners) / corners);
    points.push_back({center.x + radius * portable::cos(angle), center.y + radius * portable::sin(angle)});
  }
  drawing.path(std::move(points), {color, 1.6, {}});
}

// A shape of each series' own: a small disc, and outlines through which it and each other can be seen. Where shapes
// begin anew, they do in other colours.
void draw_dot(Drawing& drawing, Point at, std::size_t series) {
  struct Outline {
    double radius;
    int corners;
    double corner;
  };
  constexpr Outline kOutlines[] = {{6, 24, 0}, {8.5, 4, 0.125}, {8.5, 3, 0.25}, {8.5, 3, 0.75},
                                   {9, 4, 0},  {4, 4, 0.125},   {9.5, 6, 0}};
  const Color color = series_color(series);
  static_assert(std::size(kOutlines) + 1 == kSeriesColorCount);
  if (const std::size_t shape = (series + series / kSeriesColorCount) % kSeriesColorCount; shape == 0)
    drawing.disc(at, 3.6, color);
  else
    outline(drawing, at, kOutlines[shape - 1].radius, kOutlines[shape - 1].corners, kOutlines[shape - 1].corner, color);
}

// Where the legend's entries begin: beside each other, in as many lines as that takes.
std::vector<Point> legend_places(const std::vector<BarChart::Bars>& bars, double left, double right) {
  std::vector<Point> places;
  double x = left, y = 74;
  for (const BarChart::Bars& entry : bars) {
    const double words = text_width(entry.label, kLabelSize);
    if (x > left && x + 17 + words > right) x = left, y += 20;
    places.push_back({x, y});
    x += 40 + words;
  }
  return places;
}

// Points with its tip to where the value is, out of the chart.
void draw_left_arrow(Drawing& drawing, Point tip, Color color) {
  drawing.polygon({tip, {tip.x + 8, tip.y - 4.5}, {tip.x + 8, tip.y + 4.5}}, color);
}
void draw_down_arrow(Drawing& drawing, Point tip, Color color) {
  drawing.polygon({tip, {tip.x - 4.5, tip.y - 8}, {tip.x + 4.5, tip.y - 8}}, color);
}

std::string below_note(const Scale& scale) {
  return fmt::format("arrow: below the axis, from 0 to {}", short_number(scale.low()));
}

void draw_series(Drawing& drawing, const Series& series, const Scale& x, const Scale& y, const Stroke& stroke) {
  std::vector<Point> piece;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool below = y.below(series.y[i]);
    if (!x.shows(series.x[i]) || !(below || y.shows(series.y[i]))) {
      drawing.path(std::exchange(piece, {}), stroke);
      continue;
    }
    piece.push_back({x.pixel(series.x[i]), y.pixel(below ? y.low() : series.y[i])});
    if (below)
      draw_down_arrow(drawing, {piece.back().x, piece.back().y + 8}, stroke.color);
    else if (series.markers)
      drawing.disc(piece.back(), 3.2, stroke.color);
  }
  drawing.path(std::move(piece), stroke);
}

}  // namespace

Color series_color(std::size_t series) { return kSeriesColors[series % kSeriesColorCount]; }

std::vector<double> series_dashes(std::size_t series) {
  const std::vector<double> kinds[] = {{}, {7, 3}, {2, 3}, {9, 3, 2, 3}};
  return kinds[series / kSeriesColorCount % std::size(kinds)];
}

Color heat_color(double value) {
  constexpr double kStops[][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double place = std::clamp(value, 0.0, 1.0) * 4;
  const int k = std::min(int(place), 3);
  const auto channel = [&](int c) {
    return static_cast<unsigned char>(kStops[k][c] + (kStops[k + 1][c] - kStops[k][c]) * (place - k) + 0.5);
  };
  return {channel(0), channel(1), channel(2)};
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return "-";
  return fmt::format("{:.4g}", value);
}

Drawing draw(const LineChart& chart) {
  std::vector<std::string> labels;
  for (const Series& series : chart.series) {
    TWINSHADE_CHECK_EQ(series.x.size(), series.y.size());
    labels.push_back(series.label);
  }
  // A sample of a line beside its label, where colours alone do not tell
  const double sample = chart.series.size() > kSeriesColorCount ? 34 : 0;
  const double left = 76, right = chart.width - 32 - sample - widest(labels, kLabelSize);
  const double top = 68, bottom = chart.height - 66;
  const std::vector<double> values = all_values(chart.series, &Series::y);
  const Scale x(chart.x, all_values(chart.series, &Series::x), left, right);
  const Scale y(chart.y, values, bottom, top);

  Drawing drawing(chart.width, chart.height);
  draw_titles(drawing, chart.title, chart.subtitle);
  draw_vertical_axis(drawing, y, chart.y.title, left, right, (top + bottom) / 2);
  draw_horizontal_axis(drawing, x, chart.x.title, top, bottom, (left + right) / 2);
  drawing.path({{left, top}, {left, bottom}, {right, bottom}}, {kFaint, 1, {}});

  std::vector<double> wanted, ends;
  std::vector<std::size_t> labelled;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const Series& series = chart.series[s];
    draw_series(drawing, series, x, y, {series_color(s), 2, series_dashes(s)});
    for (std::size_t i = series.x.size(); i-- > 0;)
      if (x.shows(series.x[i]) && y.shows(series.y[i])) {
        wanted.push_back(y.pixel(series.y[i]));
        ends.push_back(x.pixel(series.x[i]));
        labelled.push_back(s);
        break;
      }
  }
  const std::vector<double> place = spread_labels(wanted, kLabelSize + 3, top, bottom);
  for (std::size_t k = 0; k < labelled.size(); ++k) {
    const Color color = series_color(labelled[k]);
    drawing.line({ends[k] + 2, wanted[k]}, {right + 14, place[k]}, {color, 1, {}});
    if (sample > 0)
      drawing.line({right + 17, place[k]}, {right + 13 + sample, place[k]}, {color, 2, series_dashes(labelled[k])});
    drawing.text({right + 17 + sample, place[k] + 4}, chart.series[labelled[k]].label,
                 {.size = kLabelSize, .color = color});
  }
  if (std::any_of(values.begin(), values.end(), [&](double value) { return y.below(value); })) {
    draw_down_arrow(drawing, {left + 4.5, bottom + 53}, kFaint);
    drawing.text({left + 14, bottom + 53}, below_note(y), {.size = 11, .color = kFaint});
  }
  return drawing;
}

Drawing draw(const BarChart& chart) {
  const bool legend = chart.bars.size() > 1;
  const bool dots = chart.dots || chart.value.logarithmic;
  const double row_height = dots ? kRowHeight : std::max(kRowHeight, 8.0 + 11.0 * double(chart.bars.size()));
  const double left = 28 + widest(chart.rows, kLabelSize), right = chart.width - (dots ? 32 : 76);
  const std::vector<Point> entries = legend_places(chart.bars, left, chart.width - 16);
  const double top = legend ? entries.back().y + 18 : 68, bottom = top + row_height * double(chart.rows.size());

  std::vector<double> values;
  for (const BarChart::Bars& bars : chart.bars) {
    TWINSHADE_CHECK_EQ(bars.values.size(), chart.rows.size());
    values.insert(values.end(), bars.values.begin(), bars.values.end());
  }
  if (!dots) values.push_back(0);  // bars begin there
  const Scale scale(chart.value, values, left, right);

  const bool any_below = dots && std::any_of(values.begin(), values.end(), [&](double v) { return scale.below(v); });
  Drawing drawing(chart.width, bottom + (any_below ? 76 : 56));
  draw_titles(drawing, chart.title, chart.subtitle);
  if (any_below) {
    draw_left_arrow(drawing, {left, bottom + 58}, kFaint);
    drawing.text({left + 14, bottom + 62}, below_note(scale), {.size = 11, .color = kFaint});
  }
  for (std::size_t b = 0; legend && b < chart.bars.size(); ++b) {
    const auto [x, y] = entries[b];
    if (dots)
      draw_dot(drawing, {x + 6, y}, b);
    else
      drawing.disc({x + 6, y}, 5, series_color(b));
    drawing.text({x + 17, y + 4}, chart.bars[b].label, {.size = kLabelSize, .color = kInk});
  }
  draw_horizontal_axis(drawing, scale, chart.value.title, top, bottom, (left + right) / 2);

  for (std::size_t r = 0; r < chart.rows.size(); ++r) {
    const double middle = top + row_height * (double(r) + 0.5);
    drawing.text({left - 10, middle + 4}, chart.rows[r], {.size = kLabelSize, .anchor = Anchor::end, .color = kInk});
    if (dots) drawing.line({left, middle}, {right, middle}, {kFineGrid, 1, {}});
    int arrows = 0;
    for (std::size_t b = 0; b < chart.bars.size(); ++b) {
      const double value = chart.bars[b].values[r];
      if (dots) {
        if (scale.shows(value))
          draw_dot(drawing, {scale.pixel(value), middle}, b);
        else if (scale.below(value))
          draw_left_arrow(drawing, {left - 4 + 10 * arrows++, middle}, series_color(b));
        continue;
      }
      const double thickness = (row_height - 8) / double(chart.bars.size());
      const double y = middle - (row_height - 8) / 2 + thickness * double(b);
      const double zero = scale.pixel(0), end = std::isfinite(value) ? scale.pixel(value) : zero;
      drawing.rectangle({std::min(zero, end), y + 0.5}, std::max(std::abs(end - zero), 0.5), thickness - 1,
                        series_color(b));
      drawing.text({std::max(zero, end) + 5, y + thickness / 2 + 3.5}, short_number(value),
                   {.size = 10, .color = kFaint});
    }
  }
  drawing.path({{left, top}, {left, bottom}, {right, bottom}}, {kFaint, 1, {}});
  return drawing;
}

Drawing draw(const HeatMap& chart) {
  TWINSHADE_CHECK_EQ(chart.values.size(), chart.rows.size() * chart.columns.size());
  const auto shade = [&](double value) { return chart.logarithmic ? portable::log2(value) : value; };
  double low = INFINITY, high = -INFINITY;
  for (const double value : chart.values)
    if (const double s = shade(value); std::isfinite(s)) low = std::min(low, s), high = std::max(high, s);

  const double cell_width = std::max(74.0, widest(chart.columns, kLabelSize) + 14), cell_height = kRowHeight + 2;
  const double left = 28 + widest(chart.rows, kLabelSize), top = 88;
  const double width = std::max({left + cell_width * double(chart.columns.size()) + 20,
                                 text_width(chart.title, 18) + 32, text_width(chart.subtitle, 12) + 32});
  Drawing drawing(width, top + cell_height * double(chart.rows.size()) + 20);
  draw_titles(drawing, chart.title, chart.subtitle);
  for (std::size_t c = 0; c < chart.columns.size(); ++c)
    drawing.text({left + cell_width * (double(c) + 0.5), top - 8}, chart.columns[c],
                 {.size = kLabelSize, .anchor = Anchor::middle, .color = kInk});
  for (std::size_t r = 0; r < chart.rows.size(); ++r) {
    const double y = top + cell_height * double(r);
    drawing.text({left - 10, y + cell_height / 2 + 4}, chart.rows[r],
                 {.size = kLabelSize, .anchor = Anchor::end, .color = kInk});
    for (std::size_t c = 0; c < chart.columns.size(); ++c) {
      const double value = chart.values[r * chart.columns.size() + c], s = shade(value);
      const double x = left + cell_width * double(c);
      const double t = std::isfinite(s) && high > low ? (s - low) / (high - low) : 0;
      if (std::isfinite(value)) drawing.rectangle({x, y}, cell_width - 1, cell_height - 1, heat_color(t));
      drawing.text({x + cell_width / 2, y + cell_height / 2 + 4}, short_number(value),
                   {.size = 11,
                    .anchor = Anchor::middle,
                    .color = t > 0.55 || !std::isfinite(value) ? kInk : Color{255, 255, 255}});
    }
  }
  return drawing;
}

}  // namespace twinshade

// Points and their names. A name goes where it hides neither a point nor another name, as near to its point as it can.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/portable_math.h"
#include "experiments/chart.h"
#include "experiments/chart_axis.h"
#include "experiments/chart_parts.h"

namespace twinshade {
namespace {

constexpr double kDotRadius = 4, kNameSize = 11, kNameHeight = 12;

struct Box {
  double left, top, right, bottom;

  bool meets(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool within(const Box& other) const {
    return left >= other.left && right <= other.right && top >= other.top && bottom <= other.bottom;
  }
};

Box around(Point at, double radius) { return {at.x - radius, at.y - radius, at.x + radius, at.y + radius}; }

// Where a name of this width is, seen from its point: it touches the end of a spoke.
Box name_box(Point at, double angle, double distance, double width) {
  const double dx = portable::cos(angle), dy = portable::sin(angle);
  const Point end{at.x + distance * dx, at.y + distance * dy};
  const double left = end.x - width * (1 - dx) / 2, top = end.y - kNameHeight * (1 - dy) / 2;
  return {left, top, left + width, top + kNameHeight};
}

class Names {
 public:
  // line: of horizontal and vertical steps.
  Names(const Box& area, const std::vector<Point>& points, const std::vector<Point>& line) : area_(area) {
    for (const Point& point : points) taken_.push_back(around(point, kDotRadius + 0.5));
    for (std::size_t i = 1; i < line.size(); ++i)
      taken_.push_back({std::min(line[i - 1].x, line[i].x) - 1, std::min(line[i - 1].y, line[i].y) - 1,
                        std::max(line[i - 1].x, line[i].x) + 1, std::max(line[i - 1].y, line[i].y) + 1});
  }

  // No name goes there.
  void take(const Box& box) { taken_.push_back(box); }

  // The nearest free place of a name, no farther than `farthest`; none where there is none.
  std::optional<Box> place(Point at, double width, double farthest) {
    constexpr int kSpokes = 16;
    for (double distance = kDotRadius + 4; distance <= farthest; distance += 9)
      for (int spoke = 0; spoke < kSpokes; ++spoke) {
        const Box box = name_box(at, 2 * portable::kPi * spoke / kSpokes, distance, width);
        const bool free =
            box.within(area_) && std::none_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); });
        if (!free) continue;
        taken_.push_back(box);
        return box;
      }
    return std::nullopt;
  }

 private:
  Box area_;
  std::vector<Box> taken_;
};

void draw_name(Drawing& drawing, Point at, const Box& box, const std::string& name, Color color, bool bold) {
  const Point nearest{std::clamp(at.x, box.left, box.right), std::clamp(at.y, box.top, box.bottom)};
  if (std::hypot(nearest.x - at.x, nearest.y - at.y) > kDotRadius + 8) drawing.line(at, nearest, {kGrid, 1, {}});
  drawing.text({box.left, box.bottom - 2}, name, {.size = kNameSize, .color = color, .bold = bold});
}

// A logarithmic axis from the last one, two or five below the values to the first above them, where it is not said
// otherwise: whole decades would be empty for the most part.
Axis snug(Axis axis, const std::vector<double>& values) {
  double least = INFINITY, most = 0;
  for (const double value : values)
    if (std::isfinite(value) && value > 0) least = std::min(least, value), most = std::max(most, value);
  if (!axis.logarithmic || most == 0) return axis;
  double low = 1, high = 1;
  while (low > least) low /= 10;
  while (low * 10 <= least) low *= 10;
  while (high < most) high *= 10;
  while (high / 10 >= most) high /= 10;
  const double below = low, above = high;
  for (const double factor : {2.0, 5.0})
    if (factor * below <= least) low = factor * below;
  for (const double divisor : {2.0, 5.0})
    if (above / divisor >= most) high = above / divisor;
  if (low == high) high = 2 * low;
  if (!axis.low) axis.low = low;
  if (!axis.high) axis.high = high;
  return axis;
}

std::vector<double> shown_values(const ScatterChart& chart, double ScatterChart::Point::*member) {
  std::vector<double> values;
  for (const ScatterChart::Point& point : chart.points) values.push_back(point.*member);
  return values;
}

}  // namespace

Drawing draw(const ScatterChart& chart) {
  const double left = 76, right = chart.width - 32, top = 92, bottom = chart.height - 66;
  const std::vector<double> values_x = shown_values(chart, &ScatterChart::Point::x);
  std::vector<double> values_y = shown_values(chart, &ScatterChart::Point::y);
  if (chart.limit) values_y.push_back(*chart.limit);
  const Scale x(snug(chart.x, values_x), values_x, left, right);
  const Scale y(snug(chart.y, values_y), values_y, bottom, top);
  Drawing drawing(chart.width, chart.height);
  draw_titles(drawing, chart.title, chart.subtitle);
  draw_vertical_axis(drawing, y, chart.y.title, left, right, (top + bottom) / 2);
  draw_horizontal_axis(drawing, x, chart.x.title, top, bottom, (left + right) / 2);
  drawing.path({{left, top}, {left, bottom}, {right, bottom}}, {kFaint, 1, {}});

  double legend = left;
  const auto add_legend = [&](const std::string& words) {
    drawing.text({legend + 17, 78}, words, {.size = kLabelSize, .color = kInk});
    legend += 40 + text_width(words, kLabelSize);
  };
  for (std::size_t group = 0; group < chart.groups.size(); ++group) {
    drawing.disc({legend + 6, 74}, kDotRadius, series_color(group));
    add_legend(chart.groups[group]);
  }
  if (!chart.line.empty()) {
    drawing.line({legend, 74}, {legend + 13, 74}, {kFaint, 2, {}});
    add_legend(chart.line);
  }

  const auto is_shown = [&](const ScatterChart::Point& point) { return x.shows(point.x) && y.shows(point.y); };
  const auto place_of = [&](const ScatterChart::Point& point) { return Point{x.pixel(point.x), y.pixel(point.y)}; };
  std::vector<Point> steps, dots;
  for (const std::size_t i : chart.on_line) {
    if (!is_shown(chart.points[i])) continue;
    const Point at = place_of(chart.points[i]);
    if (!steps.empty()) steps.push_back({at.x, steps.back().y});
    steps.push_back(at);
  }
  drawing.path(steps, {kFaint, 2, {}});

  std::vector<std::size_t> order = chart.on_line;  // these have names first
  std::erase_if(order, [&](std::size_t i) { return !is_shown(chart.points[i]); });
  const std::size_t on_line_count = order.size();
  for (std::size_t i = 0; i < chart.points.size(); ++i)
    if (is_shown(chart.points[i]) && std::find(chart.on_line.begin(), chart.on_line.end(), i) == chart.on_line.end())
      order.push_back(i);
  for (const std::size_t i : order) dots.push_back(place_of(chart.points[i]));
  Names names({left + 2, top, right + 28, bottom - 2}, dots, steps);
  if (chart.limit && y.shows(*chart.limit)) {
    const double level = y.pixel(*chart.limit);
    drawing.line({left, level}, {right, level}, {kInk, 1, {6, 4}});
    // Above the line, at the end where fewer dots are in the way.
    const double width = text_width(chart.limit_label, kLabelSize);
    const Box ends[] = {{right - width - 2, level - 16, right, level}, {left, level - 16, left + width + 4, level}};
    const auto hidden = [&](const Box& box) {
      return std::count_if(dots.begin(), dots.end(), [&](Point dot) { return box.meets(around(dot, kDotRadius)); });
    };
    const Box& end = hidden(ends[1]) < hidden(ends[0]) ? ends[1] : ends[0];
    drawing.text({end.left + 2, level - 4}, chart.limit_label, {.size = kLabelSize, .color = kInk});
    names.take(end);
  }
  struct Name {
    std::size_t point;
    Box box;
  };
  std::vector<Name> placed;
  std::size_t unnamed = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (chart.points[order[k]].label.empty()) {
      ++unnamed;
      continue;
    }
    const bool on_line = k < on_line_count;
    const double width = text_width(chart.points[order[k]].label, kNameSize) * (on_line ? 1.1 : 1);
    if (const auto box = names.place(dots[k], width, on_line ? 200 : 120)) placed.push_back({k, *box});
  }
  for (const Name& name : placed) {
    const ScatterChart::Point& point = chart.points[order[name.point]];
    draw_name(drawing, dots[name.point], name.box, point.label, series_color(point.group), name.point < on_line_count);
  }
  for (std::size_t k = order.size(); k-- > 0;)
    drawing.disc(dots[k], kDotRadius, series_color(chart.points[order[k]].group));
  if (const std::size_t lost = order.size() - unnamed - placed.size(); lost > 0)
    drawing.text({left, bottom + 53}, std::to_string(lost) + " names have no room here", {.size = 11, .color = kFaint});
  return drawing;
}

}  // namespace twinshade

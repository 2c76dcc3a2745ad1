#include "experiments/drawing.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "experiments/chart.h"

using namespace twinshade;

namespace {

// Width and height as the PNG's header has them (ISO 15948, 11.2.2).
std::pair<unsigned, unsigned> png_size(const std::string& png) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(png[at + k]);
    return value;
  };
  return {number(16), number(20)};
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("text is escaped in SVG, and what cannot be seen is not written") {
  Drawing drawing(100, 50);
  drawing.text({10, 20.5}, "l < 2 & |m| > 0", {});
  drawing.path({{1, 1}}, {});
  const std::string svg = drawing.svg();
  CHECK(svg.find("<text x=\"10\" y=\"20.5\" font-size=\"12\" fill=\"#000000\">l &lt; 2 &amp; |m| &gt; 0</text>") !=
        std::string::npos);
  CHECK(svg.find("polyline") == std::string::npos);
}

TEST_CASE("text that is not UTF-8 is replaced, and what is drawn after it is seen") {
  const auto drawn = [](const std::string& words) {
    Drawing drawing(100, 50);
    drawing.text({10, 20}, words, {});
    drawing.rectangle({50, 30}, 20, 10, {255, 0, 0});
    return drawing;
  };
  CHECK(drawn("caf\xe9\x01").svg().find(">caf\xef\xbf\xbd\xef\xbf\xbd</text>") != std::string::npos);
  CHECK(drawn("caf\xe9").png() == drawn("caf\xef\xbf\xbd").png());
}

TEST_CASE("labels of a logarithmic axis have one form, and a level is named") {
  ScatterChart chart;
  chart.x = {"x", true};
  chart.y = {"y", true};
  chart.points = {{"low", 1e-5, 1}, {"", 0.5, 3}};
  chart.groups = {"all"};
  chart.limit = 2;
  chart.limit_label = "as much as this";
  const std::string small = draw(chart).svg();
  CHECK(count(small, ">1e-3<") == 1);
  CHECK(count(small, ">1e-5<") == 1);
  CHECK(count(small, ">0.001<") == 0);
  CHECK(count(small, ">as much as this<") == 1);
  chart.points[0].x = 0.01;
  const std::string usual = draw(chart).svg();
  CHECK(count(usual, ">0.01<") == 1);
  CHECK(count(usual, ">1e-2<") == 0);
}

TEST_CASE("an image in a drawing is a PNG within the SVG") {
  Drawing drawing(10, 10);
  drawing.image({0, 0}, 10, 10, {2, 1, {255, 0, 0, 0, 0, 255}});
  CHECK(drawing.svg().find("data:image/png;base64,iVBORw0KGgo") != std::string::npos);  // the signature of PNG
  CHECK(png_size(drawing.png()) == std::pair(20u, 20u));
  CHECK(png_size(png_file({2, 1, {255, 0, 0, 0, 0, 255}})) == std::pair(2u, 1u));
}

TEST_CASE("a line chart leaves gaps where a value is not defined") {
  LineChart chart;
  chart.y.logarithmic = true;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  chart.series.push_back({"a", {0, 1, 2, 3, 4, 5, 6}, {1, 2, nan, 3, 4, -1, 7}, true});
  const std::string svg = draw(chart).svg();
  CHECK(count(svg, "stroke-width=\"2\"") == 2);  // a lone last point is no line
  CHECK(count(svg, "<circle") == 5);
}

TEST_CASE("what is below a logarithmic axis is an arrow at its end, and the chart says so") {
  BarChart dots;
  dots.value.logarithmic = true;
  dots.rows = {"row", "other"};
  dots.bars.push_back({"shown", {1, 0.5}});
  dots.bars.push_back({"too small", {0.25, 1e-30}});
  CHECK(draw(dots).svg().find("below the axis") == std::string::npos);
  dots.value.low = 1e-3;
  const std::string low = draw(dots).svg();
  CHECK(low.find("below the axis, from 0 to 0.001") != std::string::npos);
  CHECK(count(low, "<polygon") == 2);  // and one beside the words
  dots.value.low.reset();
  dots.value.most_decades = 5;
  CHECK(draw(dots).svg().find("below the axis, from 0 to 1e-05") != std::string::npos);
  dots.bars[1].values[1] = 0;
  dots.value.most_decades.reset();
  CHECK(count(draw(dots).svg(), "<polygon") == 2);

  LineChart line;
  line.y.logarithmic = true;
  line.series.push_back({"a", {0, 1, 2}, {1, 0.5, 0}});
  const std::string svg = draw(line).svg();
  CHECK(svg.find("below the axis, from 0 to 0.1") != std::string::npos);
  CHECK(count(svg, "<polygon") == 2);
  line.y.logarithmic = false;
  CHECK(count(draw(line).svg(), "<polygon") == 0);
}

TEST_CASE("dots of different series at one place are all seen: each series has a shape of its own") {
  BarChart chart;
  chart.dots = true;
  chart.rows = {"row"};
  for (const char* name : {"a", "b", "c", "d"}) chart.bars.push_back({name, {1}});
  const std::string svg = draw(chart).svg();
  CHECK(count(svg, "<circle") == 2);               // one series: of the legend, and of the row
  CHECK(count(svg, "stroke-width=\"1.6\"") == 6);  // three of outlines, which hide nothing
}

TEST_CASE("a legend of many series goes on in further lines, within the chart") {
  BarChart chart;
  chart.dots = true;
  chart.rows = {"row"};
  for (int b = 0; b < 12; ++b) chart.bars.push_back({"a series of a long name " + std::to_string(b), {double(b)}});
  const auto [width, height] = png_size(draw(chart).png());
  CHECK(width == 1800);
  const std::string svg = draw(chart).svg();
  for (const BarChart::Bars& bars : chart.bars) {
    const std::string words = ">" + bars.label + "<";
    const std::size_t end = svg.find(words), begin = svg.rfind("<text x=\"", end) + 9;
    REQUIRE(end != std::string::npos);
    CHECK(std::stod(svg.substr(begin)) + text_width(bars.label, 12) <= 900);
  }
  chart.bars.resize(2);
  CHECK(png_size(draw(chart).png()).second < height);
}

TEST_CASE("more series than there are shapes have shapes in other colours") {
  BarChart chart;
  chart.dots = true;
  chart.rows = {"row"};
  for (int b = 0; b < 9; ++b) chart.bars.push_back({"s" + std::to_string(b), {1}});
  CHECK(count(draw(chart).svg(), "<circle") == 2);  // the first alone: its legend and its dot
}

TEST_CASE("where lines are told apart by dashes their labels show them") {
  LineChart chart;
  for (int k = 0; k < 8; ++k) chart.series.push_back({"line", {0, 1}, {0, double(k)}});
  CHECK(count(draw(chart).svg(), "stroke-width=\"2\"") == 8);
  chart.series.push_back({"dashed", {0, 1}, {0, 8}});
  const std::string svg = draw(chart).svg();
  CHECK(count(svg, "stroke-width=\"2\"") == 18);
  CHECK(count(svg, "stroke-dasharray") == 2);
}

TEST_CASE("an axis of what is counted has whole ticks") {
  LineChart chart;
  chart.series.push_back({"a", {1, 2}, {3, 4}, true});
  CHECK(draw(chart).svg().find(">1.2</text>") != std::string::npos);
  chart.x.whole = true;
  const std::string svg = draw(chart).svg();
  CHECK(svg.find(">1.2</text>") == std::string::npos);
  CHECK(svg.find(">1</text>") != std::string::npos);
  CHECK(svg.find(">2</text>") != std::string::npos);
}

TEST_CASE("a logarithmic axis of few decades has labels between them, one of many has not") {
  LineChart chart;
  chart.y.logarithmic = true;
  chart.series.push_back({"a", {1, 2}, {48, 0.31}, true});
  const std::string many = draw(chart).svg();
  for (const char* absent : {">20</text>", ">0.2</text>"}) CHECK(many.find(absent) == std::string::npos);
  chart.series[0].y = {48, 47};
  const std::string few = draw(chart).svg();
  for (const char* label : {">10</text>", ">20</text>", ">50</text>", ">100</text>"})
    CHECK(few.find(label) != std::string::npos);
  CHECK(few.find(">30</text>") == std::string::npos);
  chart.series[0].y = {0.031, 0.032};
  CHECK(draw(chart).svg().find(">0.05</text>") != std::string::npos);
  chart.series[0].y = {3e6, 4e6};
  CHECK(draw(chart).svg().find(">2e6</text>") != std::string::npos);
}

TEST_CASE("a logarithmic axis of less than a decade has steps between") {
  ScatterChart chart;
  chart.x.logarithmic = chart.y.logarithmic = true;
  chart.points.push_back({"a", 83, 19, 0});
  chart.groups = {"group"};
  const std::string svg = draw(chart).svg();
  for (const char* label : {">10</text>", ">14</text>", ">20</text>", ">50</text>", ">80</text>", ">100</text>"})
    CHECK_MESSAGE(svg.find(label) != std::string::npos, label);
}

TEST_CASE("what is said below the axis of a line chart lies within the picture") {
  LineChart chart;
  chart.y.logarithmic = true;
  chart.y.most_decades = 3;
  chart.series.push_back({"a", {1, 2}, {1, 0}, true});
  const std::string svg = draw(chart).svg();
  const std::size_t words = svg.find("arrow: below the axis"), begin = svg.rfind(" y=\"", words) + 4;
  REQUIRE(words != std::string::npos);
  CHECK(std::stod(svg.substr(begin)) <= chart.height - 8);
}

TEST_CASE("charts without anything to show are drawn all the same") {
  CHECK(!draw(LineChart{}).png().empty());
  CHECK(!draw(BarChart{}).png().empty());
  CHECK(!draw(HeatMap{}).png().empty());
  BarChart empty;
  empty.value.logarithmic = true;
  empty.rows = {"row"};
  empty.bars.push_back({"bars", {std::numeric_limits<double>::infinity()}});
  CHECK(draw(empty).svg().find("inf") == std::string::npos);
  LineChart constant;
  constant.series.push_back({"zero", {1, 1}, {0, 0}});
  CHECK(draw(constant).svg().find("nan") == std::string::npos);
}

TEST_CASE("a scatter plot names each point that it shows, apart from each other and from the line") {
  ScatterChart chart;
  chart.x.logarithmic = chart.y.logarithmic = true;
  chart.groups = {"lightmap"};
  chart.line = "frontier";
  for (int i = 0; i < 12; ++i)
    chart.points.push_back({"point_" + std::to_string(i), 10 + 0.01 * i, 5 + 0.01 * (i * 7 % 12), 0});
  chart.points.push_back({"zero", 0, 5, 0});
  chart.points.push_back({"undefined", 10, std::nan(""), 0});
  chart.on_line = {0, 12, 5};
  const std::string svg = draw(chart).svg();
  for (int i = 0; i < 12; ++i) CHECK(count(svg, ">point_" + std::to_string(i) + "<") == 1);
  CHECK(count(svg, ">zero<") == 0);
  CHECK(count(svg, ">undefined<") == 0);
  CHECK(count(svg, "have no room here") == 0);
  CHECK(count(svg, "font-weight=\"bold\">point_") == 2);
}

TEST_CASE("logarithmic axes of a scatter plot begin and end near its points") {
  ScatterChart chart;
  chart.x.logarithmic = chart.y.logarithmic = true;
  chart.points = {{"a", 21, 210, 0}, {"b", 45, 450, 0}};
  const std::string svg = draw(chart).svg();
  for (const char* label : {">20<", ">50<", ">200<", ">500<"}) CHECK(count(svg, label) == 1);
  for (const char* label : {">10<", ">100<", ">1000<"}) CHECK(count(svg, label) == 0);
}

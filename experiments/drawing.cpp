#include "experiments/drawing.h"

#include <fmt/format.h>

#include <cmath>

#include "base/base64.h"
#include "base/error.h"
#include "base/utf8.h"

namespace twinshade {
namespace {

// Two decimals, without those that say nothing: half a hundredth of a pixel cannot be seen.
std::string number(double x) {
  std::string text = fmt::format("{:.2f}", x);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  if (text == "-0") text.erase(0, 1);
  return text;
}

std::string color(Color c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

std::string points(const std::vector<Point>& list) {
  std::string text;
  for (const Point& p : list) text += fmt::format("{}{},{}", text.empty() ? "" : " ", number(p.x), number(p.y));
  return text;
}

}  // namespace

Drawing::Drawing(double width, double height) : width_(width), height_(height) {
  TWINSHADE_CHECK_LE(1.0, width);
  TWINSHADE_CHECK_LE(1.0, height);
}

// Shapes are made in place: moved ones make g++ 12 warn of members that may be uninitialised, wrongly.
template <class Kind>
Kind& Drawing::add() {
  return shapes_.emplace_back().emplace<Kind>();
}

void Drawing::line(Point from, Point to, const Stroke& stroke) { path({from, to}, stroke); }

void Drawing::path(std::vector<Point> list, const Stroke& stroke) {
  if (list.size() < 2) return;
  Path& path = add<Path>();
  path.points = std::move(list);
  path.stroke = stroke;
}

void Drawing::polygon(std::vector<Point> corners, Color fill) {
  Area& area = add<Area>();
  area.corners = std::move(corners);
  area.fill = fill;
}

void Drawing::rectangle(Point p, double width, double height, Color fill) {
  polygon({p, {p.x + width, p.y}, {p.x + width, p.y + height}, {p.x, p.y + height}}, fill);
}

void Drawing::disc(Point center, double radius, Color fill) {
  Disc& disc = add<Disc>();
  disc.center = center;
  disc.radius = radius;
  disc.fill = fill;
}

void Drawing::text(Point at, const std::string& words, const TextStyle& style) {
  Text& text = add<Text>();
  text.at = at;
  text.words = with_characters_alone(words);  // cairo draws nothing more after others, SVG is damaged by them
  text.style = style;
}

void Drawing::image(Point corner, double width, double height, PixelImage pixels) {
  TWINSHADE_CHECK_EQ(pixels.rgb.size(), std::size_t(pixels.width) * pixels.height * 3);
  Image& image = add<Image>();
  image.corner = corner;
  image.width = width;
  image.height = height;
  image.image = std::move(pixels);
}

class Drawing::SvgWriter {
 public:
  std::string out;

  void operator()(const Path& path) {
    out += fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round")",
                       points(path.points), color(path.stroke.color), number(path.stroke.width));
    std::string dashes;
    for (const double length : path.stroke.dashes)
      dashes += fmt::format("{}{}", dashes.empty() ? "" : " ", number(length));
    if (!dashes.empty()) out += fmt::format(R"( stroke-dasharray="{}")", dashes);
    out += "/>\n";
  }
  void operator()(const Area& area) {
    out += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points(area.corners), color(area.fill));
  }
  void operator()(const Disc& disc) {
    out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", number(disc.center.x),
                       number(disc.center.y), number(disc.radius), color(disc.fill));
  }
  void operator()(const Text& text) {
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    out += fmt::format(R"(<text x="{}" y="{}" font-size="{}" fill="{}")", number(text.at.x), number(text.at.y),
                       number(text.style.size), color(text.style.color));
    if (text.style.anchor != Anchor::start)
      out += fmt::format(R"( text-anchor="{}")", kAnchors[int(text.style.anchor)]);
    if (text.style.bold) out += " font-weight=\"bold\"";
    if (text.style.upwards)
      out += fmt::format(" transform=\"rotate(-90 {} {})\"", number(text.at.x), number(text.at.y));
    out += fmt::format(">{}</text>\n", xml_escaped(text.words));
  }
  void operator()(const Image& image) {
    out += fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "href=\"data:image/png;base64,{}\"/>\n",
        number(image.corner.x), number(image.corner.y), number(image.width), number(image.height),
        base64(png_file(image.image)));
  }
};

std::string Drawing::svg() const {
  SvgWriter writer;
  writer.out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      number(width_), number(height_));
  for (const Shape& shape : shapes_) std::visit(writer, shape);
  return writer.out + "</svg>\n";
}

double text_width(const std::string& words, double size) {
  double ems = 0;
  for (const char c : words) {
    if ((static_cast<unsigned char>(c) & 0xc0u) == 0x80u) continue;  // not the first byte of a UTF-8 sequence
    const bool narrow = c == 'i' || c == 'l' || c == 'j' || c == '.' || c == ',' || c == ':' || c == ' ' || c == '|';
    const bool wide = c == 'm' || c == 'w' || c == 'M' || c == 'W';
    ems += narrow ? 0.34 : wide ? 0.95 : 0.63;  // of DejaVu Sans
  }
  return ems * size;
}

}  // namespace twinshade

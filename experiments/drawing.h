// A picture made of lines, areas, text and images, kept as a list of shapes and written as SVG or painted as PNG: both
// come from the same drawing.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace twinshade {

struct Color {
  unsigned char r = 0, g = 0, b = 0;
};

struct Point {
  double x = 0, y = 0;
};

// Line width in pixels; dashes: lengths of line and gap in turn, empty for a solid line.
struct Stroke {
  Color color;
  double width = 1;
  std::vector<double> dashes;
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 12;  // pixels of an em
  Anchor anchor = Anchor::start;
  Color color;
  bool bold = false;
  bool upwards = false;  // read from below
};

// 8-bit sRGB, row 0 at the top, three bytes a pixel.
struct PixelImage {
  std::uint32_t width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

class Drawing {
 public:
  // Pixels, on white. Both at least 1.
  Drawing(double width, double height);

  // Coordinates in pixels from the upper left corner, y downwards.
  void line(Point from, Point to, const Stroke& stroke);
  void path(std::vector<Point> points, const Stroke& stroke);
  void polygon(std::vector<Point> corners, Color fill);
  void rectangle(Point corner, double width, double height, Color fill);
  void disc(Point center, double radius, Color fill);
  // y: of the base line.
  void text(Point at, const std::string& words, const TextStyle& style);
  // Stretched to width x height; pixels stay sharp-edged squares where it is enlarged.
  void image(Point corner, double width, double height, PixelImage image);

  double width() const { return width_; }
  double height() const { return height_; }

  // One shape a line. The same drawing gives the same text everywhere.
  std::string svg() const;
  // The bytes of a PNG file of twice the size, for sharp text on today's screens.
  std::string png() const;

 private:
  struct Path {
    std::vector<Point> points;
    Stroke stroke;
  };
  struct Area {
    std::vector<Point> corners;
    Color fill;
  };
  struct Disc {
    Point center;
    double radius = 0;
    Color fill;
  };
  struct Text {
    Point at;
    std::string words;
    TextStyle style;
  };
  struct Image {
    Point corner;
    double width = 0, height = 0;
    PixelImage image;
  };
  using Shape = std::variant<Path, Area, Disc, Text, Image>;
  template <class Kind>
  Kind& add();
  class SvgWriter;
  class CairoPainter;

  double width_, height_;
  std::vector<Shape> shapes_;
};

// How wide `words` are, about: enough to keep labels apart, whatever font there is.
double text_width(const std::string& words, double size);

// The bytes of a PNG file.
std::string png_file(const PixelImage& image);

}  // namespace twinshade

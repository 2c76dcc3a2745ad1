// The same shapes painted by cairo, for PNG.
#include <cairo.h>

#include <memory>

#include "base/error.h"
#include "experiments/drawing.h"

namespace twinshade {
namespace {

constexpr double kScale = 2;
constexpr double kQuarterTurn = 1.57079632679489662;

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;
using Context = std::unique_ptr<cairo_t, DestroyContext>;

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

std::string png_bytes(cairo_surface_t* surface) {
  std::string bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface, append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw UserError(std::string("a picture cannot be made: ") + cairo_status_to_string(status));
  return bytes;
}

Surface surface_of(const PixelImage& image) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(image.width), int(image.height)));
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (std::uint32_t y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t(y) * stride);
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const unsigned char* p = image.rgb.data() + (std::size_t(y) * image.width + x) * 3;
      row[x] = std::uint32_t(p[0]) << 16 | std::uint32_t(p[1]) << 8 | p[2];
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

}  // namespace

class Drawing::CairoPainter {
 public:
  explicit CairoPainter(cairo_t* context) : context_(context) {}

  void operator()(const Path& path) {
    trace(path.points);
    ink(path.stroke.color);
    cairo_set_line_width(context_, path.stroke.width);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(context_, path.stroke.dashes.data(), int(path.stroke.dashes.size()), 0);
    cairo_stroke(context_);
  }
  void operator()(const Area& area) {
    trace(area.corners);
    ink(area.fill);
    cairo_fill(context_);
  }
  void operator()(const Disc& disc) {
    cairo_new_path(context_);
    cairo_arc(context_, disc.center.x, disc.center.y, disc.radius, 0, 4 * kQuarterTurn);
    ink(disc.fill);
    cairo_fill(context_);
  }
  void operator()(const Text& text) {
    cairo_select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           text.style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, text.style.size);
    cairo_text_extents_t extents;
    cairo_text_extents(context_, text.words.c_str(), &extents);
    const double back = text.style.anchor == Anchor::start    ? 0
                        : text.style.anchor == Anchor::middle ? extents.x_advance / 2
                                                              : extents.x_advance;
    cairo_save(context_);
    cairo_translate(context_, text.at.x, text.at.y);
    if (text.style.upwards) cairo_rotate(context_, -kQuarterTurn);
    cairo_move_to(context_, -back, 0);
    ink(text.style.color);
    cairo_show_text(context_, text.words.c_str());
    cairo_restore(context_);
  }
  void operator()(const Image& image) {
    const Surface pixels = surface_of(image.image);
    cairo_save(context_);
    cairo_translate(context_, image.corner.x, image.corner.y);
    cairo_scale(context_, image.width / image.image.width, image.height / image.image.height);
    cairo_set_source_surface(context_, pixels.get(), 0, 0);
    const bool enlarged = image.width * kScale >= image.image.width;
    cairo_pattern_set_filter(cairo_get_source(context_), enlarged ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
    cairo_paint(context_);
    cairo_restore(context_);
  }

 private:
  void ink(Color c) { cairo_set_source_rgb(context_, c.r / 255.0, c.g / 255.0, c.b / 255.0); }
  void trace(const std::vector<Point>& points) {
    cairo_new_path(context_);
    for (const Point& p : points) cairo_line_to(context_, p.x, p.y);
  }

  cairo_t* context_;
};

std::string Drawing::png() const {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, int(width_ * kScale), int(height_ * kScale)));
  const Context context(cairo_create(surface.get()));
  cairo_scale(context.get(), kScale, kScale);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  CairoPainter painter(context.get());
  for (const Shape& shape : shapes_) std::visit(painter, shape);
  cairo_surface_flush(surface.get());
  return png_bytes(surface.get());
}

std::string png_file(const PixelImage& image) { return png_bytes(surface_of(image).get()); }

}  // namespace twinshade

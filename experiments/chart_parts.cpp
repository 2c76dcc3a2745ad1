#include "experiments/chart_parts.h"

#include <algorithm>

namespace twinshade {

void draw_titles(Drawing& drawing, const std::string& title, const std::string& subtitle) {
  drawing.text({16, 28}, title, {.size = 17, .color = kInk, .bold = true});
  drawing.text({16, 48}, subtitle, {.size = 12, .color = kFaint});
}

double widest(const std::vector<std::string>& labels, double size) {
  double width = 0;
  for (const std::string& label : labels) width = std::max(width, text_width(label, size));
  return width;
}

void draw_horizontal_axis(Drawing& drawing, const Scale& scale, const std::string& title, double top, double bottom,
                          double middle) {
  for (const Scale::Tick& tick : scale.ticks()) {
    const double x = scale.pixel(tick.value);
    drawing.line({x, top}, {x, bottom}, {tick.label.empty() ? kFineGrid : kGrid, 1, {}});
    drawing.text({x, bottom + 18}, tick.label, {.size = kLabelSize, .anchor = Anchor::middle, .color = kInk});
  }
  drawing.text({middle, bottom + 40}, title, {.size = 13, .anchor = Anchor::middle, .color = kInk});
}

void draw_vertical_axis(Drawing& drawing, const Scale& scale, const std::string& title, double left, double right,
                        double middle) {
  for (const Scale::Tick& tick : scale.ticks()) {
    const double y = scale.pixel(tick.value);
    drawing.line({left, y}, {right, y}, {tick.label.empty() ? kFineGrid : kGrid, 1, {}});
    drawing.text({left - 8, y + 4}, tick.label, {.size = kLabelSize, .anchor = Anchor::end, .color = kInk});
  }
  drawing.text({22, middle}, title, {.size = 13, .anchor = Anchor::middle, .color = kInk, .upwards = true});
}

}  // namespace twinshade

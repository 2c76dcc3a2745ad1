// What charts of every kind have: titles, axes, colours of what is not data. Of the charts' own.
#pragma once

#include <string>
#include <vector>

#include "experiments/chart_axis.h"
#include "experiments/drawing.h"

namespace twinshade {

inline constexpr Color kInk{30, 30, 30}, kFaint{110, 110, 110}, kGrid{222, 222, 222}, kFineGrid{240, 240, 240};
inline constexpr double kLabelSize = 12;

void draw_titles(Drawing& drawing, const std::string& title, const std::string& subtitle);

// Width of the widest label.
double widest(const std::vector<std::string>& labels, double size);

// Lines of the grid across [top, bottom] and what is written below them; the title about `middle`.
void draw_horizontal_axis(Drawing& drawing, const Scale& scale, const std::string& title, double top, double bottom,
                          double middle);

// The same across [left, right], written to the left of them.
void draw_vertical_axis(Drawing& drawing, const Scale& scale, const std::string& title, double left, double right,
                        double middle);

}  // namespace twinshade

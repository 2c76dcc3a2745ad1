// Where values lie along an axis of a chart, and what is written there. Of chart.cpp's own.
#pragma once

#include <string>
#include <vector>

#include "experiments/chart.h"

namespace twinshade {

class Scale {
 public:
  // Spans `values` (those that can be shown) and what the axis asks for, from pixel `begin` to pixel `end`.
  Scale(const Axis& axis, const std::vector<double>& values, double begin, double end);

  bool shows(double value) const;
  // A value that the axis is too short for, as every logarithmic one is for zero.
  bool below(double value) const { return logarithmic_ && value >= 0 && value < low_; }
  double pixel(double value) const;
  double low() const { return low_; }

  struct Tick {
    double value;
    std::string label;  // empty: a line without a label
  };
  std::vector<Tick> ticks() const;

 private:
  double place(double value) const;  // linear in pixels

  bool logarithmic_, whole_;
  double low_ = 0, high_ = 1, begin_, end_;
};

}  // namespace twinshade

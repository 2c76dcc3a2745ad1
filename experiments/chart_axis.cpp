#include "experiments/chart_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.h"

namespace twinshade {
namespace {

double power_of_ten(int exponent) {
  double value = 1;
  for (int i = 0; i < std::abs(exponent); ++i) value *= 10;
  return exponent < 0 ? 1 / value : value;
}

double log10_of(double x) { return portable::log2(x) / portable::log2(10.0); }

// 1, 2 or 5 times a power of ten, 1 at least where values are whole: about six steps over the range.
double nice_step(double range, bool whole) {
  const double rough = whole ? std::max(1.0, range / 6) : range / 6;
  const double decade = power_of_ten(int(std::floor(log10_of(rough))));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= rough * 0.999) return factor * decade;
  return 10 * decade;
}

// scientific: 1e-4; of all labels of an axis or of none.
std::string logarithmic_label(int digit, int exponent, bool scientific) {
  if (!scientific) return fmt::format("{:.{}f}", digit * power_of_ten(exponent), std::max(0, -exponent));
  return fmt::format("{}e{}", digit, exponent);
}

}  // namespace

Scale::Scale(const Axis& axis, const std::vector<double>& values, double begin, double end)
    : logarithmic_(axis.logarithmic), whole_(axis.whole), begin_(begin), end_(end) {
  bool any = false;
  for (const double value : values) {
    if (!std::isfinite(value) || (logarithmic_ && value <= 0)) continue;
    low_ = any ? std::min(low_, value) : value;
    high_ = any ? std::max(high_, value) : value;
    any = true;
  }
  if (!any) low_ = logarithmic_ ? 0.1 : 0, high_ = 1;
  if (logarithmic_) {  // whole decades
    const double low_exponent = log10_of(low_), high_exponent = log10_of(high_);
    low_ = power_of_ten(int(std::floor(low_exponent + 1e-9)));
    high_ = power_of_ten(int(std::ceil(high_exponent - 1e-9)));
    if (low_ == high_) high_ = low_ * 10;
    if (axis.most_decades) low_ = std::max(low_, high_ / power_of_ten(*axis.most_decades));
  } else {
    if (low_ > 0 && low_ < 0.5 * high_) low_ = 0;
    if (low_ == high_) high_ = low_ + 1;
    const double step = nice_step(high_ - low_, whole_);
    low_ = std::floor(low_ / step + 1e-9) * step;
    high_ = std::ceil(high_ / step - 1e-9) * step;
  }
  if (axis.low) low_ = *axis.low;
  if (axis.high) high_ = *axis.high;
}

bool Scale::shows(double value) const {
  return std::isfinite(value) && !(logarithmic_ && value <= 0) && value >= low_ && value <= high_;
}

double Scale::place(double value) const { return logarithmic_ ? log10_of(value) : value; }

double Scale::pixel(double value) const {
  const double t = (place(value) - place(low_)) / (place(high_) - place(low_));
  return begin_ + t * (end_ - begin_);
}

std::vector<Scale::Tick> Scale::ticks() const {
  std::vector<Tick> list;
  // Ones, twos and fives are too few of a short axis: from 10 to 20 there is none between.
  const bool is_short = high_ <= 4.001 * low_ && low_ >= 1e-3 && high_ <= 1e5;
  if (logarithmic_ && !is_short) {
    const int first = int(std::floor(log10_of(low_) - 1e-9)), last = int(std::ceil(log10_of(high_) + 1e-9));
    const int every = std::max(1, (last - first) / 8);
    const bool few = log10_of(high_ / low_) < 2.5;  // decades: what lies between is read from twos and fives
    std::vector<std::pair<int, int>> labels;        // digit and exponent of each tick; digit 0: none
    bool scientific = false;                        // all labels of an axis have one form
    for (int exponent = first; exponent <= last; ++exponent)
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = digit * power_of_ten(exponent);
        if (value < low_ * 0.999999 || value > high_ * 1.000001) continue;
        const bool labelled = digit == 1 ? (exponent - first) % every == 0 : few && (digit == 2 || digit == 5);
        if (digit != 1 && every != 1) continue;
        list.push_back({value, ""});
        labels.push_back({labelled ? digit : 0, exponent});
        scientific = scientific || (labelled && (exponent < -3 || exponent > 5));
      }
    for (std::size_t i = 0; i < list.size(); ++i)
      if (const auto [digit, exponent] = labels[i]; digit > 0)
        list[i].label = logarithmic_label(digit, exponent, scientific);
    return list;
  }
  const double step = nice_step(high_ - low_, whole_);
  const int decimals = std::max(0, -int(std::floor(log10_of(step) + 1e-9)));
  for (int k = int(std::ceil(low_ / step - 1e-9)); k * step <= high_ + 1e-9 * step; ++k)
    list.push_back({k * step, fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step, decimals)});
  return list;
}

}  // namespace twinshade

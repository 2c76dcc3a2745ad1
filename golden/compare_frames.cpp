#include "golden/compare_frames.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace twinshade {
namespace {

constexpr std::size_t kWorstKept = 8;
constexpr std::uint64_t kNoUlp = UINT64_MAX;

enum Layer : std::size_t { kCoverage, kId, kDepth, kAttributes, kColor, kLayers };
constexpr std::array<const char*, kLayers> kLayerNames{"coverage", "id", "depth", "attributes", "color"};

bool is_denormal(float v) { return std::fpclassify(v) == FP_SUBNORMAL; }

// One machine flushed what the other kept.
bool only_flushed(float a, float b) { return (is_denormal(a) && b == 0.0f) || (is_denormal(b) && a == 0.0f); }

std::size_t histogram_bin(std::uint64_t ulp) { return std::size_t(std::bit_width(ulp)); }

// What is kept of a layer until we know which layer is the first that differs.
struct LayerFindings {
  std::optional<Difference> first;
  std::vector<Difference> worst;  // sorted, largest ULP first; equal ones in reading order

  void add(const Difference& difference) {
    if (!first) first = difference;
    if (worst.size() == kWorstKept && difference.ulp <= worst.back().ulp) return;
    const auto place = std::upper_bound(worst.begin(), worst.end(), difference,
                                        [](const Difference& x, const Difference& y) { return x.ulp > y.ulp; });
    worst.insert(place, difference);
    if (worst.size() > kWorstKept) worst.pop_back();
  }
};

Difference discrete_difference(Layer layer, std::uint32_t x, std::uint32_t y, std::uint32_t a, std::uint32_t b) {
  Difference d;
  d.layer = kLayerNames[layer];
  d.x = x, d.y = y;
  d.a = a, d.b = b;
  d.a_bits = a, d.b_bits = b;
  d.ulp = kNoUlp;
  return d;
}

Difference value_difference(Layer layer, std::uint32_t x, std::uint32_t y, std::uint32_t component, Scalar scalar,
                            float a, float b) {
  Difference d;
  d.layer = kLayerNames[layer];
  d.x = x, d.y = y, d.component = component, d.scalar = scalar;
  d.a_bits = std::bit_cast<std::uint32_t>(a), d.b_bits = std::bit_cast<std::uint32_t>(b);
  d.a = value_of(scalar, d.a_bits), d.b = value_of(scalar, d.b_bits);
  d.ulp = value_distance(scalar, a, b);
  return d;
}

// Walks both frames once; the pixel at hand is (x, y).
class Walk {
 public:
  Walk(const Frame& a, const Frame& b, CompareScope scope)
      : a_(a), b_(b), only_shading_(scope == CompareScope::shaded_by_a), pixels_(std::size_t(a.width) * a.height) {
    result_.ulp_histogram.assign(65, 0);
    captured_ = !only_shading_ && !a.attribute_names.empty() && a.attribute_names == b.attribute_names;
  }

  Comparison run() {
    for (std::uint32_t row = 0; row < a_.height; ++row) {
      y_ = a_.height - 1 - row;  // reading order: the top row first
      for (x_ = 0; x_ < a_.width; ++x_) visit();
    }
    for (LayerFindings& layer : layers_) {
      if (!layer.first) continue;
      result_.first = layer.first;
      result_.worst = std::move(layer.worst);
      attach_inputs(*result_.first);
      for (Difference& d : result_.worst) attach_inputs(d);
      break;
    }
    return std::move(result_);
  }

 private:
  void visit() {
    pixel_ = std::size_t(y_) * a_.width + x_;
    const bool in_a = a_.coverage[pixel_] != 0, in_b = b_.coverage[pixel_] != 0;
    if (only_shading_ && !in_a) return;
    differs_ = false, flushed_only_ = true;
    if (in_a || in_b) ++result_.shaded_pixels;

    if (only_shading_) {
      compare_color(true);
    } else if (in_a != in_b) {
      ++result_.coverage_differs;
      found(discrete_difference(kCoverage, x_, y_, in_a, in_b));
    } else if (a_.primitive_id[pixel_] != b_.primitive_id[pixel_]) {
      ++result_.id_differs;
      found(discrete_difference(kId, x_, y_, a_.primitive_id[pixel_], b_.primitive_id[pixel_]));
    } else {
      // Only the same primitive at the same pixel has depths, attributes and colours that can be held to each other.
      if (compare_value(kDepth, 0, Scalar::f32, a_.depth[pixel_], b_.depth[pixel_])) ++result_.depth_differs;
      if (captured_ && in_a) compare_attributes();
      compare_color(in_a);
    }

    if (!differs_) return;
    ++result_.pixels_differ;
    if (flushed_only_) ++result_.denormal_only;
  }

  void found(Difference difference) {
    differs_ = true, flushed_only_ = false;
    const std::size_t layer = difference.layer == kLayerNames[kCoverage] ? kCoverage : kId;
    layers_[layer].add(difference);
  }

  bool compare_value(Layer layer, std::uint32_t component, Scalar scalar, float a, float b) {
    if (same_value(scalar, a, b)) return false;
    differs_ = true;
    flushed_only_ = flushed_only_ && scalar == Scalar::f32 && only_flushed(a, b);
    layers_[layer].add(value_difference(layer, x_, y_, component, scalar, a, b));
    return true;
  }

  void compare_attributes() {
    bool any = false;
    for (std::uint32_t c = 0; c < a_.attribute_names.size(); ++c)
      any |= compare_value(kAttributes, c, a_.attribute_scalars[c], a_.attributes[c * pixels_ + pixel_],
                           b_.attributes[c * pixels_ + pixel_]);
    if (any) ++result_.attributes_differ;
  }

  void compare_color(bool covered) {
    for (std::uint32_t c = 0; c < 4; ++c) {
      const float a = a_.color[pixel_ * 4 + c], b = b_.color[pixel_ * 4 + c];
      compare_value(kColor, c, a_.color_scalar, a, b);
      if (!covered) continue;
      const std::uint64_t ulp = value_distance(a_.color_scalar, a, b);
      ++result_.ulp_histogram[histogram_bin(ulp)];
      result_.max_ulp = std::max(result_.max_ulp, ulp);
    }
  }

  void attach_inputs(Difference& difference) const {
    if (a_.attribute_names.empty()) return;
    const std::size_t pixel = std::size_t(difference.y) * a_.width + difference.x;
    const Frame& seen = a_.coverage[pixel] ? a_ : b_;
    if (seen.attribute_names != a_.attribute_names) return;
    for (std::size_t c = 0; c < seen.attribute_names.size(); ++c)
      difference.inputs.push_back({seen.attribute_names[c], seen.attribute_scalars[c],
                                   std::bit_cast<std::uint32_t>(seen.attributes[c * pixels_ + pixel])});
  }

  const Frame& a_;
  const Frame& b_;
  const bool only_shading_;
  const std::size_t pixels_;
  bool captured_ = false;
  std::array<LayerFindings, kLayers> layers_;
  Comparison result_;

  std::uint32_t x_ = 0, y_ = 0;
  std::size_t pixel_ = 0;
  bool differs_ = false, flushed_only_ = true;
};

void require_comparable(const Frame& a, const Frame& b) {
  TWINSHADE_CHECK_EQ(a.width, b.width);
  TWINSHADE_CHECK_EQ(a.height, b.height);
  TWINSHADE_CHECK_EQ(int(a.color_scalar), int(b.color_scalar));
  for (const Frame* frame : {&a, &b}) {
    const std::size_t pixels = std::size_t(frame->width) * frame->height;
    TWINSHADE_CHECK_EQ(frame->coverage.size(), pixels);
    TWINSHADE_CHECK_EQ(frame->primitive_id.size(), pixels);
    TWINSHADE_CHECK_EQ(frame->depth.size(), pixels);
    TWINSHADE_CHECK_EQ(frame->color.size(), pixels * 4);
    TWINSHADE_CHECK_EQ(frame->attributes.size(), pixels * frame->attribute_names.size());
    TWINSHADE_CHECK_EQ(frame->attribute_scalars.size(), frame->attribute_names.size());
  }
}

}  // namespace

double value_of(Scalar scalar, std::uint32_t bits) {
  if (scalar == Scalar::f32) return double(std::bit_cast<float>(bits));
  return scalar == Scalar::i32 ? double(std::int32_t(bits)) : double(bits);
}

bool same_value(Scalar scalar, float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
         (scalar == Scalar::f32 && std::isnan(a) && std::isnan(b));
}

std::uint64_t value_distance(Scalar scalar, float a, float b) {
  if (scalar == Scalar::f32) return ulp_distance(a, b);
  const double x = value_of(scalar, std::bit_cast<std::uint32_t>(a)),
               y = value_of(scalar, std::bit_cast<std::uint32_t>(b));
  return std::uint64_t(std::abs(x - y));
}

std::uint64_t ulp_distance(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : kNoUlp;
  // Sign and magnitude to a signed line on which neighbours are 1 apart and both zeros are 0.
  const auto place = [](float v) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const auto magnitude = std::int64_t(bits & 0x7fffffffu);
    return bits >> 31 ? -magnitude : magnitude;
  };
  const std::int64_t distance = place(a) - place(b);
  return std::uint64_t(distance < 0 ? -distance : distance);
}

bool within_ulp(const Frame& a, const Frame& b, std::uint64_t ulp) {
  require_comparable(a, b);
  if (a.coverage != b.coverage || a.primitive_id != b.primitive_id) return false;
  const auto near = [&](Scalar scalar, float x, float y) {
    return same_value(scalar, x, y) || (scalar == Scalar::f32 && ulp_distance(x, y) <= ulp);
  };
  for (std::size_t pixel = 0; pixel < a.depth.size(); ++pixel) {
    if (!near(Scalar::f32, a.depth[pixel], b.depth[pixel])) return false;
    for (std::size_t c = pixel * 4; c < pixel * 4 + 4; ++c)
      if (!near(a.color_scalar, a.color[c], b.color[c])) return false;
  }
  return true;
}

Comparison compare_frames(const Frame& a, const Frame& b, CompareScope scope) {
  require_comparable(a, b);
  return Walk(a, b, scope).run();
}

}  // namespace twinshade

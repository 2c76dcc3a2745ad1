// Triangle setup: integer edge functions with the fill rule folded in (Pineda, A parallel algorithm for polygon
// rasterization, 1988). Sixteen triangles at once, step by step: compilers turn each loop into vectors.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

class TriangleSetup {
  static constexpr std::uint32_t kLanes = kSetUpAtOnce;
  using Lanes = std::int32_t[kLanes];

 public:
  TWINSHADE_INLINE explicit TriangleSetup(const SetUpTriangles& call) : call_(call) {}

  TWINSHADE_INLINE TriangleMasks run() {
    gather_corners();
    keep_simple_ones();
    face_front();
    find_boxes();
    const TriangleMasks masks{bits_of(visible_), bits_of(cut_), bits_of(front_)};
    if (masks.visible == 0) return masks;
    find_edges();
    find_nearest();
    RasterTriangle* to = call_.triangles;
    for (std::uint32_t left = masks.visible; left != 0; left &= left - 1)
      *to++ = triangle(std::uint32_t(__builtin_ctz(left)));
    return masks;
  }

 private:
  static TWINSHADE_INLINE std::uint32_t bits_of(const Lanes& lanes) {
    using I = Simd<std::int32_t, int(kLanes)>;
    return (I::load(lanes) != I(0)).bits();
  }

  // Lanes without a triangle have one vertex three times, which has neither area nor planes to be cut by.
  TWINSHADE_INLINE void gather_corners() {
    std::uint32_t padded[3 * kLanes];
    const std::uint32_t* index = call_.indices;
    if (call_.count < kLanes) {
      for (std::uint32_t i = 0; i < 3 * kLanes; ++i) padded[i] = index[i < 3 * call_.count ? i : 0];
      index = padded;
    }
    const WindowVertex* const vertices = call_.vertices;
    for (std::uint32_t k = 0; k < kLanes; k += 4)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto corner = [&](std::uint32_t triangle)
                                TWINSHADE_LAMBDA { return registers::load<4>(&vertices[index[3 * triangle + i]].x); };
        const Int4 a = corner(k), b = corner(k + 1), c = corner(k + 2), d = corner(k + 3);
        const Int4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
        const Int4 ab_rest = __builtin_shufflevector(a, b, 2, 6, 3, 7);
        const Int4 cd_rest = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        registers::store(&x_[i][k], Int4(__builtin_shufflevector(ab, cd, 0, 1, 4, 5)));
        registers::store(&y_[i][k], Int4(__builtin_shufflevector(ab, cd, 2, 3, 6, 7)));
        registers::store(&outside_[i][k], Int4(__builtin_shufflevector(ab_rest, cd_rest, 0, 1, 4, 5)));
        registers::store(&depth_[i][k], Float4(__builtin_shufflevector(ab_rest, cd_rest, 2, 3, 6, 7)));
      }
  }

  // The others lose their area, and so numbers stay within what follows. Masks are -1 or 0, and nothing is skipped:
  // compilers make vectors of that.
  TWINSHADE_INLINE void keep_simple_ones() {
    const auto mask = [](bool b) TWINSHADE_LAMBDA { return b ? -1 : 0; };
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::int32_t in_any = outside_[0][k] | outside_[1][k] | outside_[2][k];
      const std::int32_t in_all = outside_[0][k] & outside_[1][k] & outside_[2][k];
      cut_[k] = mask(in_any != 0) & mask((in_any & std::int32_t(kNotFinite)) == 0) & mask(in_all == 0);
      const std::int32_t simple = mask(in_any == 0) & mask(x_[0][k] != kUnusable) & mask(y_[0][k] != kUnusable) &
                                  mask(x_[1][k] != kUnusable) & mask(y_[1][k] != kUnusable) &
                                  mask(x_[2][k] != kUnusable) & mask(y_[2][k] != kUnusable);
      for (int i = 0; i < 3; ++i) {
        x_[i][k] &= simple;
        y_[i][k] &= simple;
      }
    }
  }

  // Coordinates are at most 2^23, so all sums and products are whole numbers below 2^53: exact in double.
  TWINSHADE_INLINE void face_front() {
    const std::int32_t both = call_.cull_back_faces ? 0 : -1;
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::int32_t x1 = x_[1][k] - x_[0][k], y1 = y_[1][k] - y_[0][k];
      const std::int32_t x2 = x_[2][k] - x_[0][k], y2 = y_[2][k] - y_[0][k];
      const double area = double(x1) * double(y2) - double(x2) * double(y1);
      front_[k] = area > 0 ? -1 : 0;
      back_[k] = area < 0 ? both : 0;
      area_[k] = float(__builtin_fabs(area));
    }
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::int32_t x0 = x_[0][k], x1 = x_[1][k], y0 = y_[0][k], y1 = y_[1][k], front = front_[k];
      x_[0][k] = front ? x0 : x1;
      x_[1][k] = front ? x1 : x0;
      y_[0][k] = front ? y0 : y1;
      y_[1][k] = front ? y1 : y0;
    }
  }

  // Pixel centres are multiples of kSubpixel: the first at or after the least coordinate, the last at or before the
  // greatest.
  TWINSHADE_INLINE void find_boxes() {
    const std::int32_t last_x = std::int32_t(call_.frame_width) - 1, last_y = std::int32_t(call_.frame_height) - 1;
    const auto least = [](std::int32_t a, std::int32_t b) TWINSHADE_LAMBDA { return a < b ? a : b; };
    const auto greatest = [](std::int32_t a, std::int32_t b) TWINSHADE_LAMBDA { return a > b ? a : b; };
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      min_x_[k] = greatest((least(least(x_[0][k], x_[1][k]), x_[2][k]) + kSubpixel - 1) >> 8, 0);
      min_y_[k] = greatest((least(least(y_[0][k], y_[1][k]), y_[2][k]) + kSubpixel - 1) >> 8, 0);
      max_x_[k] = least(greatest(greatest(x_[0][k], x_[1][k]), x_[2][k]) >> 8, last_x);
      max_y_[k] = least(greatest(greatest(y_[0][k], y_[1][k]), y_[2][k]) >> 8, last_y);
      const std::int32_t any_x = min_x_[k] <= max_x_[k] ? -1 : 0, any_y = min_y_[k] <= max_y_[k] ? -1 : 0;
      visible_[k] = (front_[k] | back_[k]) & any_x & any_y;
    }
  }

  TWINSHADE_INLINE void find_edges() {
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        a_[i][k] = y_[i][k] - y_[j][k];
        b_[i][k] = x_[j][k] - x_[i][k];
      }
      // As 2^52 and half of it more, a whole number is in the lower bits of a double.
      constexpr double kShift = 0x1.8p52;
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        // Counter-clockwise with y up: a > 0 goes down, so the inside is to its right; a = 0, b > 0 has the inside
        // above. These hold their points.
        const bool holds = (a_[i][k] > 0) | ((a_[i][k] == 0) & (b_[i][k] > 0));
        const double c = -(double(a_[i][k]) * double(x_[i][k]) + double(b_[i][k]) * double(y_[i][k]));
        // Steps are multiples of kSubpixel, so rounding down keeps the sign at every pixel centre.
        const double rounded = __builtin_floor((holds ? c : c - 1.0) * (1.0 / kSubpixel));
        c_[i][k] = number::bits<std::int64_t>(rounded + kShift) - number::bits<std::int64_t>(kShift);
      }
    }
  }

  // docs/raster-rule.md has the bound. It holds for triangles that are half a pixel high or more.
  TWINSHADE_INLINE void find_nearest() {
    const auto least = [](const auto& of, std::uint32_t k) TWINSHADE_LAMBDA {
      const auto two = of[0][k] < of[1][k] ? of[0][k] : of[1][k];
      return two < of[2][k] ? two : of[2][k];
    };
    const auto greatest = [](const auto& of, std::uint32_t k) TWINSHADE_LAMBDA {
      const auto two = of[0][k] > of[1][k] ? of[0][k] : of[1][k];
      return two > of[2][k] ? two : of[2][k];
    };
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::int32_t across = greatest(x_, k) - least(x_, k), up = greatest(y_, k) - least(y_, k);
      const float near = least(depth_, k), far = greatest(depth_, k);
      const float bound = near - (0.25f * (far - near) + 0x1p-19f);
      nearest_[k] = area_[k] >= float(kSubpixel / 2) * float(across + up) ? bound : -1.0f;
    }
  }

  TWINSHADE_INLINE RasterTriangle triangle(std::uint32_t k) const {
    return {{c_[0][k], c_[1][k], c_[2][k]},
            {a_[0][k], a_[1][k], a_[2][k]},
            {b_[0][k], b_[1][k], b_[2][k]},
            std::uint16_t(min_x_[k]),
            std::uint16_t(min_y_[k]),
            std::uint16_t(max_x_[k]),
            std::uint16_t(max_y_[k]),
            0,
            nearest_[k]};
  }

  const SetUpTriangles& call_;
  alignas(64) Lanes x_[3], y_[3];
  alignas(64) Lanes outside_[3];
  alignas(64) Lanes cut_, front_, back_, visible_, min_x_, min_y_, max_x_, max_y_, a_[3], b_[3];
  alignas(64) float depth_[3][kLanes], area_[kLanes], nearest_[kLanes];  // area: twice that, in square subpixels
  alignas(64) std::int64_t c_[3][kLanes];
};

inline TriangleMasks set_up_triangles(const SetUpTriangles& call) { return TriangleSetup(call).run(); }

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled

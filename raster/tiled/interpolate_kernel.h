// Shader inputs. Invocations of one primitive follow each other, so its vertex data is broadcast; runs are written
// in order in whole vectors, each run's last one spilling into the next run's place before that is written.
#pragma once

#include "raster/tiled/exact_kernel.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/native_kernel.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

inline constexpr std::uint8_t kSmooth = 0, kLinear = 1;  // as enum Interpolation

// An input that does not vary over the primitive, as the shader's number holds it: an integer's bits, or its value in
// double.
template <class R>
TWINSHADE_INLINE R flat_value(float stored, std::uint8_t scalar) {
  if constexpr (sizeof(R) == sizeof(float)) {
    return stored;
  } else {
    if (scalar == std::uint8_t(Scalar::f32)) return R(stored);
    if (scalar == std::uint8_t(Scalar::i32)) return R(number::bits<std::int32_t>(stored));
    return R(number::bits<std::uint32_t>(stored));
  }
}

template <class F>
class Interpolator {
  using R = typename F::element;
  using U = typename F::template with<std::uint32_t>;
  static constexpr std::uint32_t kWidth = F::width, kPoints = 64;

 public:
  TWINSHADE_INLINE explicit Interpolator(const Interpolate& call)
      : call_(call),
        center_x_(static_cast<R*>(call.center_x)),
        center_y_(static_cast<R*>(call.center_y)),
        inputs_(static_cast<R*>(call.inputs)),
        frag_coord_(static_cast<R*>(call.frag_coord)) {}

  TWINSHADE_INLINE void run() {
    find_centers();
    for (std::uint32_t r = 0; r < call_.run_count; ++r) {
      if (r + 2 < call_.run_count) ask_for_vertices(call_.primitives[call_.runs[r + 2].local].primitive);
      const std::uint32_t begin = call_.runs[r].first,
                          end = r + 1 < call_.run_count ? call_.runs[r + 1].first : call_.count;
      const LocalPrimitive& primitive = call_.primitives[call_.runs[r].local];
      if (call_.native)
        native(primitive, begin, end);
      else if (frag_coord_ || call_.front_facing)
        exact<true>(primitive, begin, end);
      else
        exact<false>(primitive, begin, end);
    }
    if (frag_coord_)
      for (std::uint32_t i = 0; i < call_.count; ++i) {
        frag_coord_[i] = center_x_[i];
        frag_coord_[call_.stride + i] = center_y_[i];
      }
  }

 private:
  // Before they are read: runs are short, and their vertices lie anywhere.
  TWINSHADE_INLINE void ask_for_vertices(std::uint32_t primitive) const {
    const VertexData& vertices = *call_.vertices;
    for (int v = 0; v < 3; ++v) {
      const std::size_t vertex = vertices.indices[std::size_t(primitive) * 3 + std::size_t(v)];
      const float* const inputs = vertices.inputs + vertex * vertices.input_components;
      __builtin_prefetch(vertices.clip_positions + vertex * 4);
      __builtin_prefetch(inputs);
      __builtin_prefetch(inputs + vertices.input_components);
    }
  }

  // From the order of pixels in a tile's memory (kernels.h).
  TWINSHADE_INLINE void find_centers() {
    // A superblock is 256 pixels, 16 across.
    const U across(((1u << call_.superblocks_log) - 1) << 4), up_by(call_.superblocks_log + 4);
    const F first_x(R(call_.tile_x) + R(0.5)), first_y(R(call_.tile_y) + R(0.5));
    std::uint32_t i = 0;
    for (; i < call_.count; i += kWidth) {
      const U pixel = U::load(call_.pixels + i), half = pixel >> U(1u), quarter = pixel >> U(2u),
              sixteenth = pixel >> U(4u);
      const U x = (pixel & U(1u)) | (half & U(2u)) | (quarter & U(12u)) | (sixteenth & across);
      const U y = (half & U(1u)) | (quarter & U(2u)) | (sixteenth & U(12u)) | (pixel >> up_by & U(~15u));
      (x.template to<std::int32_t>().template to<R>() + first_x).store(center_x_ + i);
      (y.template to<std::int32_t>().template to<R>() + first_y).store(center_y_ + i);
    }
    for (; i < call_.count + 16; ++i) center_x_[i] = center_y_[i] = R(0.5);
  }

  // By few enough invocations for their weights to stay in the first cache: points first, then input by input, so that
  // a vertex' value is broadcast once. built_ins: of gl_FragCoord and gl_FrontFacing some are asked for.
  template <bool built_ins>
  TWINSHADE_INLINE void exact(const LocalPrimitive& primitive, std::uint32_t begin, std::uint32_t end) {
    const VertexData& vertices = *call_.vertices;
    const ExactTriangle<F> triangle(vertices, primitive.primitive);
    const F scale_x(R(vertices.ndc_scale_x)), scale_y(R(vertices.ndc_scale_y));
    const std::uint32_t component_count = vertices.input_components;
    const std::uint32_t* index = vertices.indices + std::size_t(primitive.primitive) * 3;
    const float* row[3];
    for (int v = 0; v < 3; ++v) row[v] = vertices.inputs + std::size_t(index[v]) * component_count;
    if (end - begin <= kWidth) return exact_vector<built_ins>(triangle, scale_x, scale_y, begin, row);
    for (; begin < end; begin += kPoints) {
      const std::uint32_t count = end - begin < kPoints ? end - begin : kPoints;
      alignas(64) R weights[3][kPoints];
      for (std::uint32_t k = 0; k < count; k += kWidth) {
        const Weights w = exact_weights<built_ins>(triangle, scale_x, scale_y, begin + k);
        for (int v = 0; v < 3; ++v) w.of[v].store(weights[v] + k);
      }
      for (std::uint32_t c = 0; c < component_count; ++c) exact_input(c, row, begin, count, weights);
    }
  }

  // Runs are short, most of them: their weights need not be stored.
  template <bool built_ins>
  TWINSHADE_INLINE void exact_vector(const ExactTriangle<F>& triangle, const F& scale_x, const F& scale_y,
                                     std::uint32_t begin, const float* const (&row)[3]) {
    const Weights w = exact_weights<built_ins>(triangle, scale_x, scale_y, begin);
    R* to = inputs_ + begin;
    for (std::uint32_t c = 0; c < call_.vertices->input_components; ++c, to += call_.stride) {
      if (call_.interpolation[c] == kSmooth)
        ((F(R(row[0][c])) * w.of[0] + F(R(row[1][c])) * w.of[1]) + F(R(row[2][c])) * w.of[2]).store(to);
      else
        F(flat_value<R>(row[2][c], call_.scalars[c])).store(to);
    }
  }

  // Of the three vertices.
  struct Weights {
    F of[3];
  };

  template <bool built_ins>
  TWINSHADE_INLINE Weights exact_weights(const ExactTriangle<F>& triangle, const F& scale_x, const F& scale_y,
                                         std::uint32_t i) {
    const F x = F::load(center_x_ + i), y = F::load(center_y_ + i);
    const ExactPoint<F> p = triangle.at(x * scale_x - F(R(1)), y * scale_y - F(R(1)));
    if constexpr (built_ins) {
      if (frag_coord_) {
        p.depth().store(frag_coord_ + 2 * std::size_t(call_.stride) + i);
        p.reciprocal_w().store(frag_coord_ + 3 * std::size_t(call_.stride) + i);
      }
      if (call_.front_facing) select(p.w > F(R(0)), U(~0u), U(0u)).store(call_.front_facing + i);
    }
    const F r = F(R(1)) / p.sum;
    return {{p.e0 * r, p.e1 * r, p.e2 * r}};
  }

  TWINSHADE_INLINE void exact_input(std::uint32_t component, const float* const (&row)[3], std::uint32_t begin,
                                    std::uint32_t count, const R (&weights)[3][kPoints]) {
    R* const to = inputs_ + std::size_t(component) * call_.stride + begin;
    if (call_.interpolation[component] == kSmooth) {
      const F a0 = F(R(row[0][component])), a1 = F(R(row[1][component])), a2 = F(R(row[2][component]));
      const auto points = [&](std::uint32_t k) TWINSHADE_LAMBDA {
        ((a0 * F::load(weights[0] + k) + a1 * F::load(weights[1] + k)) + a2 * F::load(weights[2] + k)).store(to + k);
      };
      std::uint32_t k = 0;
      for (; k + kWidth < count; k += 2 * kWidth) {
        points(k);
        points(k + kWidth);
      }
      if (k < count) points(k);
    } else {
      const F value(flat_value<R>(row[2][component], call_.scalars[component]));
      for (std::uint32_t k = 0; k < count; k += kWidth) value.store(to + k);
    }
  }

  TWINSHADE_INLINE void native(const LocalPrimitive& primitive, std::uint32_t begin, std::uint32_t end) {
    const VertexData& vertices = *call_.vertices;
    const PlaneSetup<R> setup(*primitive.native);
    const Plane<R> reciprocal_w = setup.plane_of_reciprocal_w();
    const float* row[3];
    for (int v = 0; v < 3; ++v) row[v] = native_inputs(primitive, vertices, v);
    // Flat inputs are those of the primitive's own last vertex, whatever clipping made of it.
    const std::uint32_t last = vertices.indices[std::size_t(primitive.primitive) * 3 + 2];
    const float* flat = vertices.inputs + std::size_t(last) * vertices.input_components;

    for (std::uint32_t c = 0; c < vertices.input_components; ++c) {
      const R a0(row[0][c]), a1(row[1][c]), a2(row[2][c]);
      const std::uint8_t how = call_.interpolation[c];
      const Plane<R> plane = how == kSmooth ? setup.plane_over_w(a0, a1, a2) : setup.plane(a0, a1, a2);
      const R constant = flat_value<R>(flat[c], call_.scalars[c]);
      for (std::uint32_t i = begin; i < end; i += kWidth) {
        const F x = F::load(center_x_ + i) - F(R(0.5)), y = F::load(center_y_ + i) - F(R(0.5));
        F value;
        if (how == kSmooth)
          value = plane.at(x, y) * (F(R(1)) / reciprocal_w.at(x, y));
        else if (how == kLinear)
          value = plane.at(x, y);
        else
          value = F(constant);
        value.store(inputs_ + std::size_t(c) * call_.stride + i);
      }
    }
    const WindowPosition* p = primitive.native->position;
    const Plane<R> depth = setup.plane(R(p[0].z), R(p[1].z), R(p[2].z));
    for (std::uint32_t i = begin; i < end; i += kWidth) {
      const F x = F::load(center_x_ + i) - F(R(0.5)), y = F::load(center_y_ + i) - F(R(0.5));
      if (frag_coord_) {
        depth.at(x, y).store(frag_coord_ + 2 * std::size_t(call_.stride) + i);
        reciprocal_w.at(x, y).store(frag_coord_ + 3 * std::size_t(call_.stride) + i);
      }
      if (call_.front_facing) U(primitive.native->front_facing).store(call_.front_facing + i);
    }
  }

  const Interpolate& call_;
  R* const center_x_;
  R* const center_y_;
  R* const inputs_;
  R* const frag_coord_;
};

template <class F>
void interpolate(const Interpolate& call) {
  Interpolator<F>(call).run();
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled

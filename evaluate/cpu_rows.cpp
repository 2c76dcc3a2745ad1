#include "evaluate/cpu_rows.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "cpu_shaders/runtime/denormals.h"
#include "raster/row_grid.h"
#include "raster/tiled/aligned.h"
#include "raster/tiled/bind.h"

namespace twinshade {
namespace {

using tiled::AlignedArray;

constexpr std::size_t kBlock = 1024;  // invocations a call; whole quads

template <class Real>
Real real_of(float value, Scalar scalar) {
  if constexpr (std::is_same_v<Real, float>) return value;
  if (scalar == Scalar::i32) return Real(std::bit_cast<std::int32_t>(value));
  if (scalar == Scalar::u32) return Real(std::bit_cast<std::uint32_t>(value));
  return Real(value);
}

std::uint32_t bits_of(double value, Scalar scalar) {
  if (scalar == Scalar::i32) return std::bit_cast<std::uint32_t>(std::int32_t(value));
  if (scalar == Scalar::f32) return std::bit_cast<std::uint32_t>(float(value));
  return std::uint32_t(value);
}

// The scalar of each component that the shader leaves behind, gl_FragDepth last.
std::vector<Scalar> output_scalars(const ShaderModule& module) {
  std::vector<Scalar> scalars(module.output_components);
  for (std::uint32_t i = 0; i < module.output_count; ++i) {
    const ShaderVariable& v = module.outputs[i];
    const std::uint32_t count = v.columns * v.rows * std::max(v.array_length, 1u);
    std::fill_n(scalars.begin() + v.first_component, count, v.scalar);
  }
  if (module.writes_depth) scalars.push_back(Scalar::f32);
  return scalars;
}

template <class Real>
CpuRows run(const ShaderModule& module, const ShaderEntry& entry, const tiled::BoundDraw& draw, std::size_t rows) {
  const std::vector<Scalar> scalars = output_scalars(module);
  CpuRows result;
  result.bits.resize(scalars.size() * rows);
  if (std::is_same_v<Real, double>) result.doubles.resize(scalars.size() * rows);
  result.kept.resize(rows);

  AlignedArray<Real> inputs(module.input_components * kBlock), outputs(module.output_components * kBlock);
  AlignedArray<Real> frag_coord(4 * kBlock), depth(kBlock);
  AlignedArray<std::uint32_t> live(kBlock), front_facing(kBlock), primitive_id(kBlock), kept(kBlock);
  for (std::size_t first = 0; first < rows; first += kBlock) {
    const std::size_t count = std::min(kBlock, rows - first);
    for (std::size_t i = 0; i < kBlock; ++i) {
      const std::size_t row = first + std::min(i, count - 1);  // helpers repeat the last row
      for (std::uint32_t c = 0; c < module.input_components; ++c)
        inputs[c * kBlock + i] =
            real_of<Real>(draw.vertex_inputs[row * module.input_components + c], draw.input_scalars[c]);
      const auto [x, y] = grid_pixel(first + i);
      frag_coord[i] = Real(x) + Real(0.5);
      frag_coord[kBlock + i] = Real(y) + Real(0.5);
      frag_coord[2 * kBlock + i] = Real(0.5);
      frag_coord[3 * kBlock + i] = Real(1);
      live[i] = i < count ? ~0u : 0u;
      front_facing[i] = ~0u;
    }
    const ShadeCall call{std::uint32_t((count + 15) / 16 * 16),
                         std::uint32_t(kBlock),
                         inputs.data(),
                         frag_coord.data(),
                         live.data(),
                         front_facing.data(),
                         primitive_id.data(),
                         outputs.data(),
                         depth.data(),
                         kept.data()};
    entry.shade(draw.data(), call);
    for (std::size_t i = 0; i < count; ++i) result.kept[first + i] = kept[i] != 0;
    for (std::size_t c = 0; c < scalars.size(); ++c) {
      const Real* values = c < module.output_components ? outputs.data() + c * kBlock : depth.data();
      for (std::size_t i = 0; i < count; ++i) {
        if (kept[i] == 0) continue;
        const std::size_t at = c * rows + first + i;
        if constexpr (std::is_same_v<Real, double>) {
          result.doubles[at] = values[i];
          result.bits[at] = bits_of(values[i], scalars[c]);
        } else {
          result.bits[at] = std::bit_cast<std::uint32_t>(values[i]);
        }
      }
    }
  }
  return result;
}

}  // namespace

CpuRows run_cpu_rows(const ShaderModule& module, const ShaderEntry& entry, const BoundRows& rows, bool keep_denormals) {
  Bundle bundle = rows.resources;
  bundle.attributes = rows.inputs;
  bundle.clip_positions.resize(rows.rows.size() * 4);  // a vertex a row: each has its own values
  const tiled::BoundDraw draw = tiled::bind(bundle, module, AttributeMode::native);
  if (entry.number == Number::float64) return run<double>(module, entry, draw, rows.rows.size());
  const DenormalMode mode(!keep_denormals);
  return run<float>(module, entry, draw, rows.rows.size());
}

}  // namespace twinshade

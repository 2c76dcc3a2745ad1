// Calls of a translated shader with structs: what the generated calls (cpp_header.h) are made of. The ABI wants
// structures of arrays in blocks, component c of invocation i at [c][i]; here rows of structs are taken apart into such
// blocks and put together again.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "cpu_shaders/runtime/denormals.h"
#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade::package {

struct EntryList {  // of one instruction set
  const ShaderEntry* entries;
  std::uint32_t count;
};
// The entry for scalar or float64. Aborts where the shader was compiled without it.
ShadeFunction find_entry(std::initializer_list<EntryList> lists, Number number);
// The lanes of the best instruction set that this processor has.
ShadeFunction widest_entry(std::initializer_list<EntryList> lists);

// Arrays nest: arrays of matrices of columns of numbers.
template <class T>
inline constexpr bool is_number = std::is_arithmetic_v<T>;

// Writes a uniform. strides: bytes from element to element, outermost first.
template <class T>
void write_uniform(std::byte* to, const std::uint32_t* strides, const T& value) {
  if constexpr (std::same_as<T, bool>) {
    write_uniform(to, strides, std::uint32_t{value});
  } else if constexpr (is_number<T>) {
    std::memcpy(to, &value, sizeof value);
  } else {
    for (const auto& element : value) {
      write_uniform(to, strides + 1, element);
      to += *strides;
    }
  }
}

inline TextureView checked_texture(const TextureView& view, TextureKind kind, const char* name) {
  if (!view.texels || view.width < 1 || view.height < 1)
    throw std::invalid_argument(std::string(name) + ": no texture is set");
  if (view.kind != kind)
    throw std::invalid_argument(std::string(name) +
                                ": the texture is of another kind than the sampler (2D, 2D array or cube)");
  return view;
}
inline BufferView checked_buffer(std::span<const std::byte> bytes, std::size_t minimum, const char* name) {
  if (bytes.size() < minimum)
    throw std::invalid_argument(std::string(name) + ": the block needs " + std::to_string(minimum) + " bytes, " +
                                std::to_string(bytes.size()) + " are set");
  return {const_cast<std::byte*>(bytes.data()), bytes.size()};  // uniform blocks are never written to
}

// Up to kRows invocations. In a float array integers are bit patterns, in a double array they are their value; booleans
// 0 or 1.
template <class Real, std::uint32_t kInputs, std::uint32_t kOutputs, std::uint32_t kRows>
struct Block {
  static_assert(kRows % 16 == 0);
  alignas(64) Real inputs[kInputs == 0 ? 1 : kInputs][kRows] = {};
  alignas(64) Real outputs[kOutputs == 0 ? 1 : kOutputs][kRows] = {};
  alignas(64) Real frag_coord[4][kRows] = {};
  alignas(64) Real frag_depth[kRows] = {};
  alignas(64) std::uint32_t live[kRows] = {};
  alignas(64) std::uint32_t front_facing[kRows] = {};
  alignas(64) std::uint32_t primitive_id[kRows] = {};
  alignas(64) std::uint32_t kept[kRows] = {};

  // The value's components from `component` on; returns the one after.
  template <class T>
  std::uint32_t put(std::uint32_t component, std::size_t row, const T& value) {
    if constexpr (is_number<T>) {
      inputs[component++][row] = encode(value);
    } else {
      for (const auto& element : value) component = put(component, row, element);
    }
    return component;
  }
  template <class T>
  std::uint32_t get(std::uint32_t component, std::size_t row, T& value) const {
    if constexpr (is_number<T>) {
      value = decode<T>(outputs[component++][row]);
    } else {
      for (auto& element : value) component = get(component, row, element);
    }
    return component;
  }
  void put_frag_coord(std::size_t row, const std::array<Real, 4>& value) {
    for (std::size_t c = 0; c < 4; ++c) frag_coord[c][row] = value[c];
  }
  void run(ShadeFunction shade, const ShaderData& data, std::uint32_t count) {
    const ShadeCall call{count, kRows, inputs, frag_coord, live, front_facing, primitive_id, outputs, frag_depth, kept};
    shade(data, call);
  }

 private:
  template <class T>
  static Real encode(T value) {
    if constexpr (std::same_as<T, Real> || std::same_as<Real, double>)
      return Real(value);
    else if constexpr (std::same_as<T, bool>)
      return std::bit_cast<float>(std::uint32_t{value});
    else
      return std::bit_cast<float>(value);
  }
  template <class T>
  static T decode(Real value) {
    if constexpr (std::same_as<T, Real> || std::same_as<Real, double>)
      return T(value);
    else if constexpr (std::same_as<T, bool>)
      return std::bit_cast<std::uint32_t>(value) != 0;
    else
      return std::bit_cast<T>(value);
  }
};

// Rows says how a shader's structs become components:
//   real, Inputs, Outputs, kInputs, kOutputs, kUsesDerivatives, put(block, row, inputs), get(block, row, outputs)

// One invocation. With derivatives it is alone in its quad: they are 0.
template <class Rows>
typename Rows::Outputs shade_one(ShadeFunction shade, const ShaderData& data, const typename Rows::Inputs& inputs) {
  constexpr std::uint32_t kStep = Rows::kUsesDerivatives ? 4 : 1;  // what scalar entries run at a time
  Block<typename Rows::real, Rows::kInputs, Rows::kOutputs, 16> block;
  for (std::uint32_t row = 0; row < kStep; ++row) Rows::put(block, row, inputs);
  block.live[0] = ~0u;
  const DenormalMode mode(std::same_as<typename Rows::real, float>);
  block.run(shade, data, kStep);
  typename Rows::Outputs outputs;
  Rows::get(block, 0, outputs);
  return outputs;
}

// Many invocations; 4q .. 4q + 3 are a quad.
template <class Rows>
void shade_rows(ShadeFunction shade, const ShaderData& data, std::span<const typename Rows::Inputs> inputs,
                std::span<typename Rows::Outputs> outputs) {
  if (inputs.size() != outputs.size())
    throw std::invalid_argument("as many outputs as inputs are wanted: there are " + std::to_string(inputs.size()) +
                                " inputs and " + std::to_string(outputs.size()) + " outputs");
  if (inputs.empty()) return;
  constexpr std::uint32_t kRows = 256;
  const auto block = std::make_unique<Block<typename Rows::real, Rows::kInputs, Rows::kOutputs, kRows>>();
  const DenormalMode mode(std::same_as<typename Rows::real, float>);
  for (std::size_t first = 0; first < inputs.size(); first += kRows) {
    const std::size_t count = std::min<std::size_t>(kRows, inputs.size() - first), padded = (count + 15) / 16 * 16;
    for (std::size_t row = 0; row < padded; ++row) {  // the padding repeats the last row
      Rows::put(*block, row, inputs[first + std::min(row, count - 1)]);
      block->live[row] = row < count ? ~0u : 0;
    }
    block->run(shade, data, std::uint32_t(padded));
    for (std::size_t row = 0; row < count; ++row) Rows::get(*block, row, outputs[first + row]);
  }
}

}  // namespace twinshade::package

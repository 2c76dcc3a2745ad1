#include "harness.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <memory>

namespace twinshade {
namespace {

template <class Real>
struct Lanes64 {  // aligned as the contract asks
  explicit Lanes64(std::size_t count) : storage(count * sizeof(Real) + 64) {
    auto address = reinterpret_cast<std::uintptr_t>(storage.data());
    data = reinterpret_cast<Real*>((address + 63) / 64 * 64);
    std::memset(data, 0, count * sizeof(Real));
  }
  std::vector<std::byte> storage;
  Real* data;
};

template <class Real>
Real encode(double value, Scalar scalar) {
  if constexpr (std::is_same_v<Real, double>) return value;
  if (scalar == Scalar::f32) return static_cast<Real>(value);
  const std::uint32_t bits = scalar == Scalar::i32 ? static_cast<std::uint32_t>(static_cast<std::int32_t>(value))
                                                   : static_cast<std::uint32_t>(value);
  float result;
  std::memcpy(&result, &bits, 4);
  return static_cast<Real>(result);
}

template <class Real>
double decode(Real value, Scalar scalar) {
  if (std::is_same_v<Real, double> || scalar == Scalar::f32) return static_cast<double>(value);
  std::uint32_t bits;
  std::memcpy(&bits, &value, 4);
  return scalar == Scalar::i32 ? static_cast<double>(static_cast<std::int32_t>(bits)) : static_cast<double>(bits);
}

std::vector<std::byte> uniform_bytes(const ShaderModule& module, const Invocations& invocations) {
  std::vector<std::byte> bytes(module.uniform_bytes + 64);
  for (std::uint32_t k = 0; k < module.uniform_count; ++k) {
    const ShaderUniform& u = module.uniforms[k];
    const auto found = invocations.uniforms.find(u.name);
    REQUIRE_MESSAGE(found != invocations.uniforms.end(), "no value for uniform ", u.name);
    std::size_t at = 0;
    for (std::uint32_t e = 0; e < (u.array_length == 0 ? 1 : u.array_length); ++e)
      for (std::uint32_t c = 0; c < u.columns; ++c)
        for (std::uint32_t r = 0; r < u.rows; ++r) {
          const float value = found->second.at(at++);
          const float encoded =
              encode<float>(static_cast<double>(value), u.scalar == Scalar::boolean ? Scalar::u32 : u.scalar);
          std::memcpy(&bytes[u.offset + e * u.array_stride + c * u.matrix_stride + 4 * r], &encoded, 4);
        }
  }
  return bytes;
}

template <class Real>
Answer run(const ShaderModule& module, ShadeFunction shade, Invocations& in) {
  const std::uint32_t stride = in.count;
  Lanes64<Real> inputs(std::size_t{module.input_components} * stride + 1),
      outputs(std::size_t{module.output_components} * stride + 1);
  Lanes64<Real> frag_coord(4 * stride), depth(stride);
  Lanes64<std::uint32_t> live(stride), front(stride), primitive(stride), kept(stride);
  for (std::uint32_t k = 0; k < module.input_count; ++k) {
    const ShaderVariable& v = module.inputs[k];
    const std::uint32_t components = v.columns * v.rows * (v.array_length == 0 ? 1u : v.array_length);
    for (std::uint32_t c = 0; c < components; ++c)
      for (std::uint32_t i = 0; i < in.count; ++i)
        inputs.data[(v.first_component + c) * stride + i] = encode<Real>(in.input(v.name, c, i), v.scalar);
  }
  for (std::uint32_t i = 0; i < in.count; ++i) {
    frag_coord.data[i] = static_cast<Real>(pixel_x(i)) + Real(0.5);
    frag_coord.data[stride + i] = static_cast<Real>(pixel_y(i)) + Real(0.5);
    frag_coord.data[2 * stride + i] = Real(0.25);
    frag_coord.data[3 * stride + i] = Real(1);
    live.data[i] = in.live(i) ? ~0u : 0;
    front.data[i] = i % 3 != 0 ? ~0u : 0;
    primitive.data[i] = i / 4;
  }
  const std::vector<std::byte> uniforms = uniform_bytes(module, in);
  std::vector<TextureView> textures(module.texture_count);
  std::vector<BufferView> buffers(module.buffer_count);
  for (std::uint32_t k = 0; k < module.resource_count; ++k) {
    const ShaderResource& r = module.resources[k];
    if (r.kind == ResourceKind::uniform_block || r.kind == ResourceKind::storage_buffer) {
      const auto found = in.buffers.find(r.name);
      REQUIRE_MESSAGE(found != in.buffers.end(), "no buffer ", r.name);
      REQUIRE(found->second.size() >= r.minimum_size);
      buffers[r.slot] = {found->second.data(), found->second.size()};
    } else {
      const auto found = in.textures.find(r.name);
      REQUIRE_MESSAGE(found != in.textures.end(), "no texture ", r.name);
      const auto& t = found->second;
      textures[r.slot] = {t.texels.data(),        t.width, t.height,        t.layers,           4 * t.width,
                          4 * t.width * t.height, t.kind,  Filter::nearest, Wrap::clamp_to_edge};
    }
  }
  const ShaderData data{uniforms.data(), textures.data(), buffers.data()};
  const ShadeCall call{in.count,   stride,         inputs.data,  frag_coord.data, live.data,
                       front.data, primitive.data, outputs.data, depth.data,      kept.data};
  shade(data, call);

  Answer answer;
  for (std::uint32_t k = 0; k < module.output_count; ++k) {
    const ShaderVariable& v = module.outputs[k];
    const std::uint32_t components = v.columns * v.rows * (v.array_length == 0 ? 1u : v.array_length);
    auto& values = answer.outputs[v.name];
    values.resize(components);
    for (std::uint32_t c = 0; c < components; ++c)
      for (std::uint32_t i = 0; i < in.count; ++i)
        values[c].push_back(decode(outputs.data[(v.first_component + c) * stride + i], v.scalar));
  }
  for (std::uint32_t i = 0; i < in.count; ++i) {
    answer.kept.push_back(kept.data[i] != 0);
    answer.depth.push_back(static_cast<double>(depth.data[i]));
  }
  return answer;
}

}  // namespace

std::uint32_t pixel_x(std::uint32_t i) { return 2 * (i / 4 % 4) + i % 2; }
std::uint32_t pixel_y(std::uint32_t i) { return 2 * (i / 16) + i / 2 % 2; }

const char* number_name(Number number) {
  static const char* const names[] = {"lanes4", "lanes8", "lanes16", "scalar", "float64"};
  return names[static_cast<int>(number)];
}

Answer run_shader(const ShaderModule& module, const ShaderEntry* entries, std::uint32_t entry_count, Number number,
                  Invocations& invocations) {
  for (std::uint32_t k = 0; k < entry_count; ++k) {
    if (entries[k].number != number) continue;
    return number == Number::float64 ? run<double>(module, entries[k].shade, invocations)
                                     : run<float>(module, entries[k].shade, invocations);
  }
  FAIL("no entry for ", number_name(number));
  return {};
}

}  // namespace twinshade

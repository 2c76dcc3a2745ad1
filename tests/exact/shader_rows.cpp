#include "tests/exact/shader_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include "base/error.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/runtime/denormals.h"

namespace twinshade::test {
namespace {

constexpr std::size_t kRowsAtOnce = 1024;

template <class T>
struct Block {  // 64-byte aligned, zeroed
  explicit Block(std::size_t count) : data(new (std::align_val_t{64}) T[count]()) {}
  ~Block() { ::operator delete[](data, std::align_val_t{64}); }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  T* data;
};

}  // namespace

RowShader::RowShader(const std::string& name, const std::string& text, Number number)
    // The instruction set is named, else sixteen lanes would mean eight where registers hold no more.
    : module_(&load_module(resolve_shader(name, text, name + ".frag"), number, machine_isa())) {
  for (std::uint32_t i = 0; i < module_->entry_count; ++i)
    if (module_->entries[i].number == number) shade_ = module_->entries[i].shade;
  TWINSHADE_CHECK_EQ(shade_ != nullptr, true);
}

std::vector<float> RowShader::run(const std::vector<float>& inputs, std::size_t rows,
                                  std::span<const TextureView> textures) const {
  TWINSHADE_CHECK_EQ(inputs.size(), rows * module_->input_components);
  TWINSHADE_CHECK_EQ(textures.size(), std::size_t{module_->texture_count});
  const Block<float> in(module_->input_components * kRowsAtOnce), out(module_->output_components * kRowsAtOnce);
  const Block<float> frag_coord(4 * kRowsAtOnce), depth(kRowsAtOnce);
  const Block<std::uint32_t> live(kRowsAtOnce), front(kRowsAtOnce), id(kRowsAtOnce), kept(kRowsAtOnce);
  const FlushDenormals flush;
  std::vector<float> result(module_->output_components * rows);
  for (std::size_t first = 0; first < rows; first += kRowsAtOnce) {
    const std::size_t count = std::min(kRowsAtOnce, rows - first);
    for (std::size_t c = 0; c < module_->input_components; ++c)
      std::copy_n(inputs.data() + c * rows + first, count, in.data + c * kRowsAtOnce);
    std::fill_n(live.data, kRowsAtOnce, 0u);
    std::fill_n(live.data, count, ~0u);
    shade_(ShaderData{nullptr, textures.data(), nullptr},
           ShadeCall{static_cast<std::uint32_t>((count + 15) / 16 * 16), static_cast<std::uint32_t>(kRowsAtOnce),
                     in.data, frag_coord.data, live.data, front.data, id.data, out.data, depth.data, kept.data});
    for (std::size_t c = 0; c < module_->output_components; ++c)
      std::copy_n(out.data + c * kRowsAtOnce, count, result.data() + c * rows + first);
  }
  return result;
}

double ulp_error(float computed, long double exact) {
  constexpr double kWrong = std::numeric_limits<double>::infinity();
  constexpr long double kOverflow = 0x1p128L - 0x1p103L;  // rounds to infinity from here
  if (std::isnan(exact) || std::isnan(computed)) return std::isnan(exact) && std::isnan(computed) ? 0 : kWrong;
  if (std::isinf(computed)) {
    if (std::signbit(computed) != std::signbit(exact)) return kWrong;
    return std::fabs(exact) >= kOverflow ? 0 : static_cast<double>((0x1p128L - std::fabs(exact)) / 0x1p104L);
  }
  if (std::isinf(exact)) return kWrong;
  if (std::fabs(exact) < 0x1p-126L && computed == 0) return 0;
  int exponent = 0;
  std::frexp(exact, &exponent);
  return static_cast<double>(std::fabs(computed - exact) / std::ldexp(1.0L, std::max(exponent, -125) - 24));
}

std::uint32_t bits_of(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

float float_of(std::uint32_t bits) {
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

std::string hex(float x) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", static_cast<double>(x));
  return text;
}

}  // namespace twinshade::test

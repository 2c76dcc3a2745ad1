#include "cpu_shaders/load/host_eval.h"

#include <algorithm>
#include <memory>
#include <new>

#include "base/error.h"
#include "cpu_shaders/load/load.h"
#include "cpu_shaders/runtime/denormals.h"
#include "lighting/registry.h"

namespace twinshade {
namespace {

constexpr std::size_t kBlock = 1024;  // invocations a call

template <class T>
class Aligned {  // 64-byte aligned, zeroed
 public:
  explicit Aligned(std::size_t count) : data_(new(std::align_val_t{64}) T[count]()) {}
  T* get() const { return data_.get(); }

 private:
  struct Delete {
    void operator()(T* data) const { ::operator delete[](data, std::align_val_t{64}); }
  };
  std::unique_ptr<T[], Delete> data_;
};

const ShaderEntry& entry_of(const ShaderModule& module, Number number) {
  for (std::uint32_t i = 0; i < module.entry_count; ++i)
    if (module.entries[i].number == number && module.entries[i].isa == Isa::baseline) return module.entries[i];
  throw UserError(std::string("shader ") + module.name + " has no code for the number type asked for" +
                  (module.no_float64_reason ? std::string(": ") + module.no_float64_reason : ""));
}

template <class Real>
std::vector<double> run(const ShaderModule& module, const ShaderEntry& entry, const std::vector<double>& inputs,
                        std::size_t rows) {
  const Aligned<Real> in(module.input_components * kBlock), out(module.output_components * kBlock);
  const Aligned<Real> frag_coord(4 * kBlock), depth(kBlock);
  const Aligned<std::uint32_t> live(kBlock), front(kBlock), id(kBlock), kept(kBlock);
  std::vector<double> result(module.output_components * rows);
  for (std::size_t first = 0; first < rows; first += kBlock) {
    const std::size_t count = std::min(kBlock, rows - first);
    for (std::size_t c = 0; c < module.input_components; ++c)
      for (std::size_t i = 0; i < kBlock; ++i)  // the padding repeats the last row: finite, and harmless
        in.get()[c * kBlock + i] = Real(inputs[c * rows + first + std::min(i, count - 1)]);
    for (std::size_t i = 0; i < kBlock; ++i) live.get()[i] = i < count ? ~0u : 0;
    const ShadeCall call{std::uint32_t((count + 15) / 16 * 16), std::uint32_t(kBlock), in.get(), frag_coord.get(),
                         live.get(), front.get(), id.get(), out.get(), depth.get(), kept.get()};
    entry.shade(ShaderData{nullptr, nullptr, nullptr}, call);
    for (std::size_t c = 0; c < module.output_components; ++c)
      for (std::size_t i = 0; i < count; ++i) result[c * rows + first + i] = double(out.get()[c * kBlock + i]);
  }
  return result;
}

}  // namespace

std::vector<double> run_module(const ShaderModule& module, Number number, const std::vector<double>& inputs,
                               std::size_t rows) {
  TWINSHADE_CHECK_EQ(inputs.size(), rows * module.input_components);
  TWINSHADE_CHECK_EQ(module.resource_count, 0u);
  TWINSHADE_CHECK_EQ(module.uniform_count, 0u);
  const ShaderEntry& entry = entry_of(module, number);
  if (number == Number::float64) return run<double>(module, entry, inputs, rows);
  const FlushDenormals flush;
  return run<float>(module, entry, inputs, rows);
}

std::vector<double> evaluate_basis(std::string_view technique, const std::vector<double>& directions_xyz,
                                   Number number) {
  const TechniqueInfo& basis = find_technique(technique);
  const ShaderModule& module = load_module(basis_values_source(basis), number);
  const std::size_t rows = directions_xyz.size() / 3;
  std::vector<double> inputs(rows * 3);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t c = 0; c < 3; ++c) inputs[c * rows + i] = directions_xyz[3 * i + c];
  const std::vector<double> columns = run_module(module, number, inputs, rows);
  std::vector<double> values(rows * std::size_t(basis.count));
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < std::size_t(basis.count); ++k)
      values[i * std::size_t(basis.count) + k] = columns[k * rows + i];
  return values;
}

}  // namespace twinshade

#include "app/bench/limits_kernel.h"

#include <utility>

#include "cpu_shaders/runtime/isa.h"

namespace twinshade::bench {
namespace {

typedef float Lanes __attribute__((vector_size(kNativeLanes * sizeof(float))));

// The value is in a register, and what becomes of it is unknown to the compiler.
#if defined(__x86_64__) && defined(__AVX512F__)
#define TWINSHADE_IN_REGISTER "v"
#elif defined(__x86_64__)
#define TWINSHADE_IN_REGISTER "x"
#else
#define TWINSHADE_IN_REGISTER "w"
#endif
TWINSHADE_INLINE void changed(Lanes& value) { asm volatile("" : "+" TWINSHADE_IN_REGISTER(value)); }
TWINSHADE_INLINE void used(const Lanes& value) { asm volatile("" : : TWINSHADE_IN_REGISTER(value)); }

// Seven chains of products and seven of sums: more than latency times throughput on any processor of today, and no more
// than sixteen registers with the two operands.
std::uint64_t multiply_add(std::uint64_t turns) {
  constexpr int kChains = 7;
  Lanes product[kChains], sum[kChains], one = Lanes{} + 1.0f, zero = Lanes{};
  changed(one), changed(zero);
  for (int i = 0; i < kChains; ++i) product[i] = one, sum[i] = one;
  const auto step = [&](Lanes& p, Lanes& s) TWINSHADE_LAMBDA {
    p *= one, s += zero;
    changed(p), changed(s);
  };
  for (std::uint64_t turn = 0; turn < turns; ++turn) [&]<int... i>(std::integer_sequence<int, i...>) TWINSHADE_LAMBDA {
      (step(product[i], sum[i]), ...);
    }
  (std::make_integer_sequence<int, kChains>());
  for (int i = 0; i < kChains; ++i) used(product[i]), used(sum[i]);
  return turns * kChains * 2 * kNativeLanes;
}

std::uint64_t load(const std::byte* buffer, std::size_t bytes, std::uint64_t turns) {
  constexpr int kUnrolled = 16;
  for (std::uint64_t turn = 0; turn < turns; ++turn)
    for (const std::byte* at = buffer; at < buffer + bytes; at += kUnrolled * sizeof(Lanes))
      [&]<int... i>(std::integer_sequence<int, i...>) TWINSHADE_LAMBDA {
        (used(reinterpret_cast<const Lanes*>(at)[i]), ...);
      }
  (std::make_integer_sequence<int, kUnrolled>());
  return turns * bytes;
}

}  // namespace

LimitsKernel TWINSHADE_JOIN(limits_kernel_of_, TWINSHADE_ISA)() { return {multiply_add, load}; }

}  // namespace twinshade::bench

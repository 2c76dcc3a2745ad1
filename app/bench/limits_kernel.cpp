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

TWINSHADE_INLINE void step(Lanes& product, const Lanes& factor, Lanes& sum, const Lanes& term) {
  product *= factor, sum += term;
  changed(product), changed(sum);
}

// Seven chains of products and seven of sums: more than latency times throughput on any processor of today, and no more
// than sixteen registers with the two operands. Each is a variable of its own: g++ leaves arrays in memory.
std::uint64_t multiply_add(std::uint64_t turns) {
  constexpr int kChains = 7;
  Lanes one = Lanes{} + 1.0f, zero = Lanes{};
  changed(one), changed(zero);
  Lanes p0 = one, p1 = one, p2 = one, p3 = one, p4 = one, p5 = one, p6 = one;
  Lanes s0 = one, s1 = one, s2 = one, s3 = one, s4 = one, s5 = one, s6 = one;
  for (std::uint64_t turn = 0; turn < turns; ++turn) {
    step(p0, one, s0, zero);
    step(p1, one, s1, zero);
    step(p2, one, s2, zero);
    step(p3, one, s3, zero);
    step(p4, one, s4, zero);
    step(p5, one, s5, zero);
    step(p6, one, s6, zero);
  }
  for (const Lanes& result : {p0, p1, p2, p3, p4, p5, p6, s0, s1, s2, s3, s4, s5, s6}) used(result);
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

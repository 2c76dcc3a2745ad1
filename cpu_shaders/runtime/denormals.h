// Whether this thread keeps denormals. Fragment shaders run with them flushed, inputs and results (FTZ and DAZ in x86's
// MXCSR, FZ in Arm's FPCR), as llvmpipe runs them; float64 runs without. x86 decides after rounding whether a result is
// tiny, Arm before: a result that rounds up to the least normal number is kept by the one and flushed by the other.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace twinshade {

// For the lifetime of the object, then as it was before.
class DenormalMode {
 public:
  explicit DenormalMode(bool flush) : before_(read()) { write(flush ? before_ | kFlushBits : before_ & ~kFlushBits); }
  ~DenormalMode() { write(before_); }
  DenormalMode(const DenormalMode&) = delete;
  DenormalMode& operator=(const DenormalMode&) = delete;

 private:
#if defined(__x86_64__)
  using Register = std::uint32_t;
  static constexpr Register kFlushBits = 0x8040;  // FTZ, DAZ
  static Register read() { return _mm_getcsr(); }
  static void write(Register value) { _mm_setcsr(value); }
#elif defined(__aarch64__)
  using Register = std::uint64_t;
  static constexpr Register kFlushBits = 1u << 24;  // FZ
  static Register read() {
    Register value;
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
  }
  static void write(Register value) { __asm__ volatile("msr fpcr, %0" : : "r"(value) : "memory"); }
#else
#error "how does this processor flush denormals?"
#endif
  Register before_;
};

class FlushDenormals : DenormalMode {
 public:
  FlushDenormals() : DenormalMode(true) {}
};
class KeepDenormals : DenormalMode {
 public:
  KeepDenormals() : DenormalMode(false) {}
};

}  // namespace twinshade

// Which instruction set code runs on: the processor's best, or the one that TWINSHADE_ISA names.
#pragma once

#include <cstdlib>
#include <string>

#include "base/error.h"
#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {

inline constexpr const char* kIsaNames[] = {"baseline", "avx2", "avx512"};

// The best that this processor has, of those that code is built for.
inline Isa processor_isa() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  if (avx2) return avx512 ? Isa::avx512 : Isa::avx2;
#endif
  return Isa::baseline;
}

// What TWINSHADE_ISA (baseline, avx2 or avx512) asks for. wanted: its value, null or empty: the processor's best.
// UserError where that is none of them, or more than the processor has.
inline Isa isa_named(const char* wanted, Isa processor) {
  if (!wanted || !*wanted) return processor;
  const std::string name = wanted;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (name != kIsaNames[int(isa)]) continue;
    if (isa > processor)
      throw UserError("TWINSHADE_ISA=" + name + ": this processor has no " + name + "; the best it has is " +
                      kIsaNames[int(processor)]);
    return isa;
  }
  throw UserError("TWINSHADE_ISA=" + name + " is none of baseline, avx2, avx512");
}

// The best that code may run on: what every choice that the user does not make himself starts from. UserError as
// isa_named.
inline Isa machine_isa() {
  static const Isa isa = isa_named(std::getenv("TWINSHADE_ISA"), processor_isa());
  return isa;
}

// UserError where `isa` is more than code may run on.
inline void require_isa(Isa isa) {
  const Isa most = machine_isa();
  if (isa <= most) return;
  const std::string name = kIsaNames[int(isa)];
  throw UserError(isa > processor_isa()
                      ? "this processor has no " + name + ": the best it has is " + kIsaNames[int(most)]
                      : "TWINSHADE_ISA=" + std::string(kIsaNames[int(most)]) + " rules " + name + " out");
}

}  // namespace twinshade

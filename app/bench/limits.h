// What the machine can do at most, measured: the roofs of a roofline (Williams, Waterman and Patterson, Roofline: an
// insightful visual performance model, CACM 2009).
#pragma once

#include <vector>

#include "app/output.h"
#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade::bench {

// Of all threads together.
struct Limits {
  Isa isa = Isa::baseline;
  double flops = 0;     // a second: multiplications and additions in equal parts, not fused
  double l1_bytes = 0;  // a second, read by whole registers
  double l2_bytes = 0;
};

// On thread_count() threads, each loop for some hundredths of a second.
Limits measure_limits(Isa isa);

Json json_of(const std::vector<Limits>& limits);
// One line each, for people.
std::string text_of(const std::vector<Limits>& limits);

}  // namespace twinshade::bench

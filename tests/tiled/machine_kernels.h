// The kernels that this machine can run, one of each instruction set.
#pragma once

#include <utility>
#include <vector>

#include "cpu_shaders/machine.h"
#include "raster/tiled/entry.h"
#include "raster/tiled/kernels.h"

namespace twinshade::test {

inline std::vector<const tiled::Kernels*> kernels_of_machine() {
  std::vector<const tiled::Kernels*> all;
  for (const auto& [isa, number] : {std::pair(Isa::baseline, Number::lanes4), std::pair(Isa::avx2, Number::lanes8),
                                    std::pair(Isa::avx512, Number::lanes16)})
    if (isa <= machine_isa()) all.push_back(&tiled::choose_kernels(isa, number));
  return all;
}

}  // namespace twinshade::test

// Internal to the kernels: one list for each instruction set of the build.
#pragma once

#include "raster/tiled/kernels.h"

namespace twinshade::tiled {

struct KernelList {
  const Kernels* kernels;
  std::size_t count;
};

KernelList kernels_of_baseline();
#if defined(__x86_64__)
KernelList kernels_of_avx2();
KernelList kernels_of_avx512();
#endif

}  // namespace twinshade::tiled

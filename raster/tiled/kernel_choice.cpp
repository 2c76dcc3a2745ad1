#include "base/error.h"
#include "raster/tiled/kernel_list.h"

namespace twinshade::tiled {

const Kernels& choose_kernels(Isa isa, Number number) {
  const KernelList lists[] = {
#if defined(__x86_64__)
    kernels_of_avx512(),
    kernels_of_avx2(),
#endif
    kernels_of_baseline()
  };
  for (const KernelList& list : lists)
    for (std::size_t i = 0; i < list.count; ++i)
      if (list.kernels[i].isa <= isa && list.kernels[i].number == number) return list.kernels[i];
  throw UserError("the rasterizer was not built for the number type and instruction set asked for");
}

}  // namespace twinshade::tiled

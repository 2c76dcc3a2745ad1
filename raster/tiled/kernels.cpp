// The kernels of one instruction set, at the widths that the build asks for (TWINSHADE_NUMBERS, bits of enum Number).
#include "raster/tiled/kernels.h"

#include "raster/tiled/coverage_kernel.h"
#include "raster/tiled/interpolate_kernel.h"
#include "raster/tiled/kernel_list.h"
#include "raster/tiled/store_kernel.h"
#include "raster/tiled/store_superblock_kernel.h"
#include "raster/tiled/visible_kernel.h"

namespace twinshade::tiled {
namespace {

template <int W>
constexpr Kernels lanes_kernels(Number number) {
  return {Isa::TWINSHADE_ISA,          number,       cover,           cover_one, collect_visible, add_covered,
          interpolate<Simd<float, W>>, store_colors, store_superblock};
}

constexpr Kernels kList[] = {
#if TWINSHADE_NUMBERS & 1
    lanes_kernels<4>(Number::lanes4),
#endif
#if TWINSHADE_NUMBERS & 2
    lanes_kernels<8>(Number::lanes8),
#endif
#if TWINSHADE_NUMBERS & 4
    lanes_kernels<16>(Number::lanes16),
#endif
#if TWINSHADE_NUMBERS & 8
    {Isa::TWINSHADE_ISA, Number::scalar, cover, cover_one, collect_visible, add_covered, interpolate<Simd<float, 4>>,
     store_colors, store_superblock},
#endif
#if TWINSHADE_NUMBERS & 16
    {Isa::TWINSHADE_ISA, Number::float64, cover, cover_one, collect_visible, add_covered, interpolate<Plain<double, 4>>,
     store_colors, store_superblock},
#endif
};

}  // namespace

KernelList TWINSHADE_JOIN(kernels_of_, TWINSHADE_ISA)() { return {kList, sizeof kList / sizeof kList[0]}; }

}  // namespace twinshade::tiled

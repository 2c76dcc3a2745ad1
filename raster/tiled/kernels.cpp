// The kernels of one instruction set, at the widths that the build asks for (TWINSHADE_NUMBERS, bits of enum Number).
#include "raster/tiled/kernels.h"

#include "raster/tiled/coverage_kernel.h"
#include "raster/tiled/interpolate_kernel.h"
#include "raster/tiled/kernel_list.h"
#include "raster/tiled/setup_kernel.h"
#include "raster/tiled/store_kernel.h"
#include "raster/tiled/store_superblock_kernel.h"
#include "raster/tiled/visible_kernel.h"
#include "raster/tiled/window_kernel.h"

namespace twinshade::tiled {
namespace {

// F: lanes of float, or of double.
template <class F>
constexpr Kernels kernels(Number number) {
  return {Isa::TWINSHADE_ISA, number,      transform_vertices, set_up_triangles, cover,        cover_one,
          collect_visible,    add_covered, add_quads,          interpolate<F>,   store_colors, store_superblock};
}

constexpr Kernels kList[] = {
#if TWINSHADE_NUMBERS & 1
    kernels<Simd<float, 4>>(Number::lanes4),
#endif
#if TWINSHADE_NUMBERS & 2
    kernels<Simd<float, 8>>(Number::lanes8),
#endif
#if TWINSHADE_NUMBERS & 4
    kernels<Simd<float, 16>>(Number::lanes16),
#endif
#if TWINSHADE_NUMBERS & 8
    kernels<Simd<float, 4>>(Number::scalar),
#endif
#if TWINSHADE_NUMBERS & 16
    kernels<Plain<double, 4>>(Number::float64),
#endif
};

}  // namespace

KernelList TWINSHADE_JOIN(kernels_of_, TWINSHADE_ISA)() { return {kList, sizeof kList / sizeof kList[0]}; }

}  // namespace twinshade::tiled

// Dynamic indexing, tables, buffers and textures: what is addressed by a lane's value.
#include "tests/runtime/operations_by_policy.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace {

template <class N, int n>
struct Tables {
  using UF = typename N::UF;
  static constexpr arr<UF, n> numbers() {
    arr<UF, n> a{};
    for (int i = 0; i < n; ++i) a.e[i] = UF(static_cast<float>(i * i) + 0.25f);
    return a;
  }
  static constexpr arr<vec<UF, 3>, n> vectors() {
    arr<vec<UF, 3>, n> a{};
    for (int i = 0; i < n; ++i) {
      a.e[i] = vec<UF, 3>(UF(static_cast<float>(i)), UF(static_cast<float>(-i)), UF(static_cast<float>(3 * i)));
    }
    return a;
  }
};
template <class N, int n>
inline constexpr table<typename N::UF, n> kNumbers{Tables<N, n>::numbers()};
template <class N, int n>
inline constexpr table<vec<typename N::UF, 3>, n> kVectors{Tables<N, n>::vectors()};

// Quads see their neighbours' coordinates in any order here: only addresses matter.
template <class N>
TWINSHADE_INLINE typename N::sampler2D sampler_2d(int kind) {
  return {&test::test_texture(kind)};
}

#define ON_ARRAY(name, ...)                                                  \
  OPERATION(name, [[maybe_unused]] arr<F, 5> array{{a, b, c, a + b, b - c}}; \
            [[maybe_unused]] vec<F, 4> v(a, b, c, a * b);                    \
            [[maybe_unused]] mat<F, 2, 2> m(vec<F, 2>(a, b), vec<F, 2>(b, c)); __VA_ARGS__)

template <class N>
struct Group {
  static constexpr Operation list[] = {
      ON_ARRAY("array[i]", return lookup(array, i);),
      ON_ARRAY("array[p]", return lookup(array, p);),
      ON_ARRAY("array[i & 7]", return lookup(array, i& UI(7));),
      ON_ARRAY("array[3 uniform]", return lookup(array, UI(3));),
      ON_ARRAY("v[i & 3]", return lookup(v, i& UI(3));),
      ON_ARRAY("m[i & 1]", return lookup(m, i& UI(1));),
      ON_ARRAY("array[i & 7] = c where a < b", store_lookup(a < b, array, i& UI(7), c); return array;),
      ON_ARRAY("v[p & 3] = 1", store_lookup(a == a, v, p& UU(3u), UF(1.0f)); return v;),
      ON_ARRAY("m[i & 1][j & 1] = c", update(a < c, m, i& UI(1),
                                             [&](const auto& mask, auto& column)
                                                 TWINSHADE_LAMBDA { store_lookup(mask, column, j & UI(1), c); });
               return m;),
      OPERATION("uniform array of 6 [i & 7]", return lookup(Tables<N, 6>::numbers(), i& UI(7));),
      OPERATION("uniform vectors of 6 [i & 7]", return lookup(Tables<N, 6>::vectors(), i& UI(7));),
      OPERATION("table of 6 [i & 7]", return lookup(kNumbers<N, 6>, i& UI(7));),
      OPERATION("table of 6 [i]", return lookup(kNumbers<N, 6>, i);),
      OPERATION("table of 12 [p & 15]", return lookup(kNumbers<N, 12>, p& UU(15u));),
      OPERATION("table of 30 [i & 31]", return lookup(kNumbers<N, 30>, i& UI(31));),
      OPERATION("table of 50 [i & 63]", return lookup(kNumbers<N, 50>, i& UI(63));),
      OPERATION("vectors of 12 [i & 15]", return lookup(kVectors<N, 12>, i& UI(15));),
      OPERATION("vectors of 40 [i & 63]", return lookup(kVectors<N, 40>, i& UI(63));),
      OPERATION("buffer float at 4 * (i & 63)", return load<F>(test::test_buffer(), (i & UI(63)) * UI(4));),
      OPERATION("buffer vec3 at p", return load<vec<F, 3>>(test::test_buffer(), p & ~UU(3u));),
      OPERATION("buffer bool at 4 * (i & 31)", return load<B>(test::test_buffer(), (i & UI(31)) * UI(4));),
      OPERATION("buffer uvec2 at 8 uniform", return vec<U, 2>(load<vec<UU, 2>>(test::test_buffer(), UI(8)));),
      OPERATION("texelFetch 2D", return glsl::texelFetch(sampler_2d<N>(0), vec<I, 2>(i, j), UI(0));),
      OPERATION("texelFetch 2D near", return glsl::texelFetch(sampler_2d<N>(0), vec<I, 2>(i& UI(7), j& UI(7)), UI(0));),
      OPERATION("texelFetch uniform",
                return vec<F, 4>(glsl::texelFetch(sampler_2d<N>(0), vec<UI, 2>(UI(3), UI(2)), UI(0)));),
      OPERATION("texelFetch array", return glsl::texelFetch(typename N::sampler2DArray{&test::test_texture(3)},
                                                            vec<I, 3>(i& UI(7), j& UI(3), k& UI(3)), UI(0));),
      OPERATION("texture linear clamp", return glsl::texture(sampler_2d<N>(0), vec<F, 2>(a, b));),
      OPERATION("texture linear repeat, power of two", return glsl::texture(sampler_2d<N>(1), vec<F, 2>(a, b));),
      OPERATION("texture linear repeat", return glsl::texture(sampler_2d<N>(2), vec<F, 2>(a, b));),
      OPERATION("texture nearest", return glsl::textureLod(sampler_2d<N>(5), vec<F, 2>(a, b), UF(0.0f));),
      OPERATION("texture array",
                return glsl::texture(typename N::sampler2DArray{&test::test_texture(3)}, vec<F, 3>(a, b, c));),
      OPERATION("texture cube",
                return glsl::texture(typename N::samplerCube{&test::test_texture(4)}, vec<F, 3>(a, b, c));),
      OPERATION("textureSize",
                return vec<I, 3>(glsl::textureSize(typename N::sampler2DArray{&test::test_texture(3)}));),
  };
};

OPERATION_SETS(memory)

}  // namespace
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade

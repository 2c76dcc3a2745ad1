// Bilinear filters of lanes. Sums are done on whole texels, four lanes' RGBA to a register group or one lane's floats
// to a row, and transposed once, where GLSL as written would transpose each texel. Where all lanes read the same
// texels there may be nothing to transpose at all.
#pragma once

#include "cpu_shaders/runtime/texture.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {
namespace detail {

// A lane's value in all four channels of its texel, in the layout of transpose_groups' row j.
template <int j, class V>
TWINSHADE_FUNCTION V spread_lane(const V& lanes) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(lanes, lanes, (k / 4 * 4 + j)...);
  }
  (std::make_integer_sequence<int, sizeof(V) / 4>());
}

// The four texels of W lanes, in twos of floats from the texture's first, and their weights: (x0,y0) (x1,y0) (x0,y1)
// (x1,y1).
template <int W>
struct Taps {
  using U = Simd<std::uint32_t, W>;
  vec<U, 4> at;
  vec<Simd<float, W>, 4> weight;

  TWINSHADE_INLINE bool same_for_all_lanes() const {
    const auto same = [](const U& tap) TWINSHADE_LAMBDA { return tap == U(tap.lane(0)); };
    return all(same(at.x)) && all(same(at.y) & same(at.z) & same(at.w));
  }
  TWINSHADE_INLINE void move_by(const U& offset) { at = at + offset; }
};
template <int W>
TWINSHADE_FUNCTION void store_places(const vec<Simd<std::uint32_t, W>, 4>& at, std::uint32_t (*to)[W]) {
  at.x.store(to[0]);
  at.y.store(to[1]);
  at.z.store(to[2]);
  at.w.store(to[3]);
}

// Where lanes are taken one by one.
template <int W>
struct TapIndices {
  alignas(64) std::uint32_t at[4][W];
  TWINSHADE_INLINE explicit TapIndices(const Taps<W>& taps) {
    store_places(taps.at, at);
    __asm__("" : "+m"(at));  // really through memory: compilers would take registers apart lane by lane
  }
  TWINSHADE_INLINE const float* texel(const float* texels, int tap, int lane) const {
    return texels + std::size_t{at[tap][lane]} * 2;
  }
};

// --- one layer

// Lanes first .. first + W - 1 of the whole.
template <int W, int All>
TWINSHADE_FUNCTION vec<Simd<float, W>, 4> filtered_texels(const float* texels, const TapIndices<All>& taps, int first,
                                                          const vec<Simd<float, W>, 4>& weight) {
  if constexpr (Simd<float, W>::whole) {
    Register<float, W> rows[4];
    const auto row = [&]<int j>(std::integral_constant<int, j>) TWINSHADE_LAMBDA {
      const auto texel = [&](int tap) TWINSHADE_LAMBDA {
        return registers::texel_row<W>(
            [&](int i) TWINSHADE_LAMBDA { return registers::load_texel(taps.texel(texels, tap, first + i), 0); }, j);
      };
      rows[j] = (texel(0) * spread_lane<j>(weight.x.v) + texel(1) * spread_lane<j>(weight.y.v)) +
                (texel(2) * spread_lane<j>(weight.z.v) + texel(3) * spread_lane<j>(weight.w.v));
    };
    row(std::integral_constant<int, 0>());
    row(std::integral_constant<int, 1>());
    row(std::integral_constant<int, 2>());
    row(std::integral_constant<int, 3>());
    registers::transpose_groups(rows);
    vec<Simd<float, W>, 4> rgba;
    rgba.x.v = rows[0], rgba.y.v = rows[1], rgba.z.v = rows[2], rgba.w.v = rows[3];
    return rgba;
  } else {
    using Half = vec<Simd<float, W / 2>, 4>;
    const auto low =
        filtered_texels<W / 2>(texels, taps, first, Half(weight.x.lo, weight.y.lo, weight.z.lo, weight.w.lo));
    const auto high =
        filtered_texels<W / 2>(texels, taps, first + W / 2, Half(weight.x.hi, weight.y.hi, weight.z.hi, weight.w.hi));
    vec<Simd<float, W>, 4> rgba;
    rgba.x.lo = low.x, rgba.y.lo = low.y, rgba.z.lo = low.z, rgba.w.lo = low.w;
    rgba.x.hi = high.x, rgba.y.hi = high.y, rgba.z.hi = high.z, rgba.w.hi = high.w;
    return rgba;
  }
}

// Where the four texels are the same for all lanes: their numbers, times each lane's weights. From float `first` on.
template <int W>
TWINSHADE_FUNCTION vec<Simd<float, W>, 4> filtered_once(const float* texels, const Taps<W>& taps, int first) {
  using F = Simd<float, W>;
  const auto texel = [&](const auto& tap) TWINSHADE_LAMBDA { return texels + std::size_t{tap.lane(0)} * 2 + first; };
  const float *const x = texel(taps.at.x), *const y = texel(taps.at.y), *const z = texel(taps.at.z),
                     *const w = texel(taps.at.w);
  const vec<F, 4>& weight = taps.weight;
  const auto channel = [&](int c) TWINSHADE_LAMBDA {
    return (F(x[c]) * weight.x + F(y[c]) * weight.y) + (F(z[c]) * weight.z + F(w[c]) * weight.w);
  };
  return {channel(0), channel(1), channel(2), channel(3)};
}

template <int W>
TWINSHADE_FUNCTION vec<Simd<float, W>, 4> filtered(const float* texels, const Taps<W>& taps) {
  if (taps.same_for_all_lanes()) return filtered_once(texels, taps, 0);
  return filtered_texels<W>(texels, TapIndices<W>(taps), 0, taps.weight);
}

// f(0), f(1) ... f(n - 1), each a constant: compilers leave longer loops as they are, and compute addresses in them.
template <int n, class F>
TWINSHADE_FUNCTION void unrolled(F f) {
  [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA { (f(std::integral_constant<int, k>()), ...); }
  (std::make_integer_sequence<int, n>());
}

template <class V, class Pick>
TWINSHADE_FUNCTION V shuffle(const V& a, const V& b, Pick pick) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(a, b, pick(k)...);
  }
  (std::make_integer_sequence<int, sizeof(V) / 4>());
}
// Blocks of 128 bits 0 and 2, or 1 and 3, of two registers of four.
TWINSHADE_FUNCTION Float16 even_blocks(const Float16& a, const Float16& b) {
  return shuffle(a, b, [](int k) TWINSHADE_LAMBDA { return k / 4 % 2 * 8 + k % 4 + (k >= 8 ? 16 : 0); });
}
TWINSHADE_FUNCTION Float16 odd_blocks(const Float16& a, const Float16& b) {
  return shuffle(a, b, [](int k) TWINSHADE_LAMBDA { return 4 + k / 4 % 2 * 8 + k % 4 + (k >= 8 ? 16 : 0); });
}

// Rows of lanes 0 to W - 1, in memory, become rows of four floats each: row 4 * b + j has floats 4 * b .. of lanes j, j
// + 4 ..., as transpose_groups takes them. Registers of 8 are put together from halves as they are loaded: nothing has
// to cross the middle of a register.
template <int W>
TWINSHADE_FUNCTION void load_by_fours(const float (&lanes)[W][W], Register<float, W> (&rows)[W]) {
  if constexpr (W == 16) {
    constexpr auto low = [](int k) TWINSHADE_LAMBDA { return k % 8 + (k >= 8 ? 16 : 0); };
    constexpr auto high = [](int k) TWINSHADE_LAMBDA { return 8 + k % 8 + (k >= 8 ? 16 : 0); };
    unrolled<W>([&](auto i) TWINSHADE_LAMBDA { rows[i] = registers::load<W>(lanes[i]); });
    unrolled<4>([&](auto j) TWINSHADE_LAMBDA {
      const auto ab01 = shuffle(rows[j], rows[j + 4], low), ab23 = shuffle(rows[j], rows[j + 4], high);
      const auto cd01 = shuffle(rows[j + 8], rows[j + 12], low), cd23 = shuffle(rows[j + 8], rows[j + 12], high);
      rows[j] = even_blocks(ab01, cd01);
      rows[j + 4] = odd_blocks(ab01, cd01);
      rows[j + 8] = even_blocks(ab23, cd23);
      rows[j + 12] = odd_blocks(ab23, cd23);
    });
  } else {
    unrolled<W>([&](auto i) TWINSHADE_LAMBDA {
      const auto four = [&](int lane) TWINSHADE_LAMBDA { return registers::load<4>(lanes[lane] + i / 4 * 4); };
      rows[i] = registers::texel_row<W>(four, i % 4);
    });
  }
}

// --- several floats of a texel

// What filters of several floats are given: the taps of one sum of four texels, or of the sum of two such sums, and
// their weights, in memory. In pairs: each right texel lies `to_right` floats after the left one, and the left ones'
// places alone are there.
template <int W, int T, bool pairs = false>
struct TapTable {
  static_assert(T == 4 || (T == 8 && !pairs));
  alignas(64) std::uint32_t at[T][W];
  alignas(64) float weight[T][W];
  std::ptrdiff_t to_right;

  TWINSHADE_INLINE explicit TapTable(const Taps<W>& taps, std::ptrdiff_t right = 0) requires(T == 4) : to_right(right) {
    put(taps, 0);
  }
  TWINSHADE_INLINE TapTable(const Taps<W>& low, const Taps<W>& high) requires(T == 8) : to_right(0) {
    put(low, 0);
    put(high, 4);
  }

  // In twos of floats, from the texture's first or, of a right texel of a pair, from that after it.
  TWINSHADE_INLINE std::size_t place(int tap, int lane) const { return at[pairs ? tap & ~1 : tap][lane]; }

  TWINSHADE_INLINE bool same_for_all_lanes() const requires(!pairs) {
    using U = Simd<std::uint32_t, W>;
    U differ(0u);
    unrolled<T>([&](auto tap) TWINSHADE_LAMBDA { differ = differ | (U::load(at[tap]) ^ U(at[tap][0])); });
    return all(differ == U(0u));
  }

 private:
  TWINSHADE_INLINE void put(const Taps<W>& taps, int first) {
    if constexpr (pairs) {
      taps.at.x.store(at[first]);
      taps.at.z.store(at[first + 2]);
    } else {
      store_places(taps.at, at + first);
    }
    taps.weight.x.store(weight[first]);
    taps.weight.y.store(weight[first + 1]);
    taps.weight.z.store(weight[first + 2]);
    taps.weight.w.store(weight[first + 3]);
    // Really through memory: clang++ would spread lanes from the register that was stored, by an instruction that takes
    // as long as several loads that spread.
    if constexpr (W == 8 && Simd<float, W>::whole) __asm__("" : "+m"(weight));
  }
};

template <int K, class V>
TWINSHADE_FUNCTION Register<float, K> first_lanes(const V& lanes) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return __builtin_shufflevector(lanes, lanes, k...);
  }
  (std::make_integer_sequence<int, K>());
}

// The taps' products, summed in the order of the GLSL.
template <int T, class Product>
TWINSHADE_FUNCTION auto sum_of_taps(Product product) {
  const auto four = [&](int tap) TWINSHADE_LAMBDA {
    return (product(tap) + product(tap + 1)) + (product(tap + 2) + product(tap + 3));
  };
  if constexpr (T == 4)
    return four(0);
  else
    return four(0) + four(4);
}

// Floats first .. first + K - 1 of a lane's texels, weighted and summed in the order of the GLSL. at: as TapTable has
// it, from where left texels and right ones begin.
template <int K, int T, class Weight>
TWINSHADE_FUNCTION Register<float, K> weighted_sum(const float* const (&from)[2], const std::size_t (&at)[T],
                                                   const Weight (&weight)[T], int first) {
  return sum_of_taps<T>([&](int tap) TWINSHADE_LAMBDA {
    return registers::load<K>(from[tap % 2] + at[tap] * 2 + first) * first_lanes<K>(weight[tap]);
  });
}

// Where in its texels each lane's floats begin, `count` times: in memory, in twos of floats, given in fours.
template <int W, int count_>
struct Starts {
  static constexpr int count = count_;
  alignas(64) std::uint32_t from[count][W];

  template <class... U>
  TWINSHADE_INLINE explicit Starts(const U&... first) {
    int k = 0;
    ((first + first).store(from[k++]), ...);
  }
  TWINSHADE_INLINE std::size_t at(int k, int lane) const { return std::size_t{from[k][lane]} * 2; }
};
// With the texel, once.
struct TexelStart {
  static constexpr int count = 1;
  TWINSHADE_INLINE std::size_t at(int, int) const { return 0; }
};

// `floats` floats, a multiple of 4, of each lane's texels from each of its starts on: put(first lane, float's number as
// a constant, those of one start after those of another, register of lanes). A lane's taps and weights are loaded once
// for all of them.
template <int floats, int W, int T, int All, bool pairs, class Start, class Put>
TWINSHADE_FUNCTION void filter_floats(const float* texels, const TapTable<All, T, pairs>& taps, const Start& starts,
                                      int first_lane, Put put) {
  if constexpr (!Simd<float, W>::whole) {
    filter_floats<floats, W / 2>(texels, taps, starts, first_lane, put);
    filter_floats<floats, W / 2>(texels, taps, starts, first_lane + W / 2, put);
  } else {
    constexpr int G = Start::count;
    // Whole registers, then what is left: half a register of 16, then four floats.
    constexpr int kParts = floats / W, kRest = floats % W, kEight = kRest >= 8 ? 8 : 0, kFour = kRest % 8;
    static_assert(kFour == 0 || kFour == 4);
    // (One part too many, lest there be none.) In memory as numbers: compilers copy arrays of registers by halves,
    // which wait for the stores of whole ones.
    alignas(64) float parts[G][kParts + 1][W][W], eights[G][W][8], fours[G][W][4];
    for (int lane = 0; lane < W; ++lane) {
      std::size_t at[T];
      Register<float, W> weight[T];
      for (int tap = 0; tap < T; ++tap) {
        at[tap] = taps.place(tap, first_lane + lane);
        weight[tap] = registers::splat<float, W>(taps.weight[tap][first_lane + lane]);
        // Its first four are in the same register: clang++ would load and keep them once more.
        if constexpr (W == 8 && kParts > 0 && kFour != 0) __asm__("" : "+x"(weight[tap]));
      }
      unrolled<G>([&](auto g) TWINSHADE_LAMBDA {
        const float* const left = texels + starts.at(g, first_lane + lane);
        const float* const from[2] = {left, left + (pairs ? taps.to_right : 0)};
        unrolled<kParts>([&](auto part) TWINSHADE_LAMBDA {
          registers::store(parts[g][part][lane], weighted_sum<W>(from, at, weight, part * W));
        });
        if constexpr (kEight != 0) registers::store(eights[g][lane], weighted_sum<8>(from, at, weight, kParts * W));
        if constexpr (kFour != 0)
          registers::store(fours[g][lane], weighted_sum<4>(from, at, weight, kParts * W + kEight));
      });
    }
    // rows[j]: four floats of lanes j, j + 4 ...
    const auto put_four = [&](auto first, const Register<float, W>* rows) TWINSHADE_LAMBDA {
      Register<float, W> channels[4] = {rows[0], rows[1], rows[2], rows[3]};
      registers::transpose_groups(channels);
      unrolled<4>([&](auto c)
                      TWINSHADE_LAMBDA { put(first_lane, std::integral_constant<int, first + c>(), channels[c]); });
    };
    unrolled<G>([&](auto g) TWINSHADE_LAMBDA {
      constexpr int kFirst = g * floats;
      unrolled<kParts>([&](auto part) TWINSHADE_LAMBDA {
        Register<float, W> rows[W];
        load_by_fours<W>(parts[g][part], rows);
        unrolled<W / 4>([&](auto i) TWINSHADE_LAMBDA {
          put_four(std::integral_constant<int, kFirst + part * W + 4 * i>(), rows + 4 * i);
        });
      });
      if constexpr (kEight != 0) {
        Register<float, W> rows[8];
        const auto eight = [&](int lane) TWINSHADE_LAMBDA { return registers::load<8>(eights[g][lane]); };
        unrolled<4>([&](auto j) TWINSHADE_LAMBDA {
          const auto a = registers::concatenate(eight(j), eight(j + 4));
          const auto b = registers::concatenate(eight(j + 8), eight(j + 12));
          rows[j] = even_blocks(a, b);
          rows[4 + j] = odd_blocks(a, b);
        });
        put_four(std::integral_constant<int, kFirst + kParts * W>(), rows);
        put_four(std::integral_constant<int, kFirst + kParts * W + 4>(), rows + 4);
      }
      if constexpr (kFour != 0) {
        const auto four = [&](int lane) TWINSHADE_LAMBDA { return registers::load<4>(fours[g][lane]); };
        const Register<float, W> rows[4] = {registers::texel_row<W>(four, 0), registers::texel_row<W>(four, 1),
                                            registers::texel_row<W>(four, 2), registers::texel_row<W>(four, 3)};
        put_four(std::integral_constant<int, kFirst + kParts * W + kEight>(), rows);
      }
    });
  }
}

// Room for a value that a filter fills: it would be zero first.
template <class T>
union Unset {
  T value;
  TWINSHADE_INLINE Unset() {}
  ~Unset() = default;
};

// Lanes first_lane .. of the number-th of an aggregate's Simd<float, W>.
template <int W, class Aggregate, class V>
TWINSHADE_FUNCTION void store_lanes(Aggregate& aggregate, int number, int first_lane, const V& lanes) {
  registers::store(reinterpret_cast<float*>(&aggregate) + number * W + first_lane, lanes);
}

// The four channels of each of `count` layers that lie side by side. Part of the shader, as what follows: around a call
// every register would be stored, and nothing be done while the filter waits.
template <int count, int W, int T, bool pairs>
TWINSHADE_FUNCTION void filter_layers(const float* texels, const TapTable<W, T, pairs>& taps,
                                      vec<Simd<float, W>, 4> (&layers)[count]) {
  filter_floats<4 * count, W>(texels, taps, TexelStart(), 0,
                              [&](int first_lane, auto number, const auto& lanes)
                                  TWINSHADE_LAMBDA { store_lanes<W>(layers, number, first_lane, lanes); });
}

template <int count, int W>
TWINSHADE_APART void filter_layers_apart(const float* texels, const TapTable<W, 4>& taps,
                                         vec<Simd<float, W>, 4> (&layers)[count]) {
  filter_layers<count>(texels, taps, layers);
}

// The texels that all lanes read, by tap, and each lane's weights.
template <int W, int T>
struct SameTexels {
  const float* texel[T];
  Register<float, W> weight[T];

  TWINSHADE_INLINE SameTexels(const float* texels, const TapTable<W, T>& taps) {
    unrolled<T>([&](auto tap) TWINSHADE_LAMBDA {
      texel[tap] = texels + taps.place(tap, 0) * 2;
      __asm__("" : "+r"(texel[tap]));  // g++ would put the addresses together in registers, to take them apart again
      weight[tap] = registers::load<W>(taps.weight[tap]);
    });
  }
  // Of the number at `at` in each texel, times each lane's weights.
  TWINSHADE_INLINE Register<float, W> sum(std::size_t at) const {
    return sum_of_taps<T>([&](int tap)
                              TWINSHADE_LAMBDA { return registers::splat<float, W>(texel[tap][at]) * weight[tap]; });
  }
};

// filter_runs where all lanes read the same texels: what begins at each place where any lane begins, for all lanes, of
// which those take it that begin there. There are four such places in most groups of sixteen; in groups of eight there
// are as many for half the lanes, which costs more than lanes one by one.
template <int length, int W, class Run>
TWINSHADE_FUNCTION void filter_runs_once(const float* texels, const TapTable<W, 8>& taps, const Starts<W, 3>& first,
                                         arr<Run, 3>& runs) {
  using F = Simd<float, W>;
  using U = Simd<std::uint32_t, W>;
  const SameTexels<W, 8> same(texels, taps);
  const U begins[3] = {U::load(first.from[0]), U::load(first.from[1]), U::load(first.from[2])};
  constexpr std::uint32_t kAll = (std::uint32_t{1} << W) - 1;
  std::uint32_t left[3] = {kAll, kAll, kAll};
  float* const out = reinterpret_cast<float*>(&runs);
  for (int run = 0; run < 3; ++run)
    while (left[run] != 0) {
      const std::uint32_t place = first.from[run][__builtin_ctz(left[run])];
      const auto here0 = begins[0] == U(place), here1 = begins[1] == U(place), here2 = begins[2] == U(place);
      unrolled<3 * length>([&](auto channel) TWINSHADE_LAMBDA {
        F sum;
        sum.v = same.sum(std::size_t{place} * 2 + channel / 3 * 4 + channel % 3);
        const auto take = [&](int which, const auto& here) TWINSHADE_LAMBDA {
          float* const to = out + (which * 3 * length + channel) * W;
          blend(here, sum, F::load(to)).store(to);
        };
        take(0, here0);
        take(1, here1);
        take(2, here2);
      });
      left[0] &= ~here0.bits();
      left[1] &= ~here1.bits();
      left[2] &= ~here2.bits();
    }
}

// The colours of `length` layers that lie side by side, four floats each, from each of three layers on.
template <int length, int W, int T, class Run>
TWINSHADE_FUNCTION void filter_runs(const float* texels, const TapTable<W, T>& taps, const Starts<W, 3>& first,
                                    arr<Run, 3>& runs) {
  if constexpr (Simd<float, W>::whole && W == 16)
    if (taps.same_for_all_lanes()) return filter_runs_once<length>(texels, taps, first, runs);
  filter_floats<4 * length, W>(texels, taps, first, 0,
                               [&](int first_lane, auto number, const auto& lanes) TWINSHADE_LAMBDA {
                                 if constexpr (number % 4 != 3)
                                   store_lanes<W>(runs, number / 4 * 3 + number % 4, first_lane, lanes);
                               });
}

// Floats of a texel with the colours of `count` layers, as LayerOrder::colors_together lays them.
constexpr int color_floats(int count) { return count / 5 * 16 + (count % 5 == 0 ? 0 : count % 5 == 1 ? 4 : 16); }

// filter_colors where all lanes read the same eight texels: their numbers, times each lane's weights.
template <int count, int W>
TWINSHADE_FUNCTION void filter_colors_once(const float* texels, const TapTable<W, 8>& taps,
                                           arr<vec<Simd<float, W>, 3>, count>& colors) {
  const SameTexels<W, 8> same(texels, taps);
  unrolled<3 * count>([&](auto channel) TWINSHADE_LAMBDA {
    store_lanes<W>(colors, channel, 0, same.sum(channel / 15 * 16 + channel % 15));
  });
}

// The colours of `count` layers that lie side by side so.
template <int count, int W, int T, bool pairs>
TWINSHADE_FUNCTION void filter_colors(const float* texels, const TapTable<W, T, pairs>& taps,
                                      arr<vec<Simd<float, W>, 3>, count>& colors) {
  // Cells of volumes are larger than most groups of lanes.
  if constexpr (Simd<float, W>::whole && T == 8 && W >= 8)
    if (taps.same_for_all_lanes()) return filter_colors_once(texels, taps, colors);
  filter_floats<color_floats(count), W>(texels, taps, TexelStart(), 0,
                                        [&](int first_lane, auto number, const auto& lanes) TWINSHADE_LAMBDA {
                                          constexpr int channel = number / 16 * 15 + number % 16;
                                          if constexpr (number % 16 != 15 && channel < 3 * count)
                                            store_lanes<W>(colors, channel, first_lane, lanes);
                                        });
}

template <int count, int W>
TWINSHADE_APART void filter_colors_apart(const float* texels, const TapTable<W, 4>& taps,
                                         arr<vec<Simd<float, W>, 3>, count>& colors) {
  filter_colors<count>(texels, taps, colors);
}

}  // namespace detail
}  // namespace served
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade

// Plain<E, W>: W numbers worked on one after another, in portable C++. W = 1 is a uniform value (the same for all
// lanes) and the number of the scalar policies; W = 4 is one 2 x 2 quad of a scalar policy. E: float, double, int32,
// uint32, bool.
#pragma once

#include <cstddef>

#include "cpu_shaders/runtime/number.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

template <number::Element E, int W>
struct Plain {
  using element = E;
  static constexpr int width = W;
  static constexpr bool is_lanes = true;
  using mask = Plain<bool, W>;
  template <class G>
  using with = Plain<G, W>;  // the same lanes of another element

  E e[W];

  Plain() = default;
  template <std::same_as<E> T>
  TWINSHADE_INLINE constexpr Plain(T x) : e{} {
    for (int i = 0; i < W; ++i) e[i] = x;
  }
  template <std::same_as<float> T>
  requires std::same_as<E, double> TWINSHADE_INLINE constexpr Plain(T x)  // constants are the float values, widened
      : Plain(static_cast<double>(x)) {}
  template <int V>
  requires(V == 1 && W != 1) TWINSHADE_INLINE constexpr Plain(Plain<E, V> x) : Plain(x.e[0]) {}
  // Value conversion, as number::convert.
  template <number::Element G, int V>
  requires(!std::same_as<E, G> && (V == W || V == 1)) TWINSHADE_INLINE constexpr explicit Plain(Plain<G, V> x) : e{} {
    for (int i = 0; i < W; ++i) e[i] = number::convert<E>(x.e[V == 1 ? 0 : i]);
  }

  TWINSHADE_INLINE constexpr E lane(int i) const { return e[i]; }
  TWINSHADE_INLINE constexpr void set_lane(int i, E x) { e[i] = x; }
  TWINSHADE_INLINE constexpr E value() const {
    static_assert(W == 1);
    return e[0];
  }
  TWINSHADE_INLINE constexpr explicit operator bool() const requires(W == 1 && std::same_as<E, bool>) { return e[0]; }

  static TWINSHADE_INLINE Plain load(const E* from) {
    Plain r;
    for (int i = 0; i < W; ++i) r.e[i] = from[i];
    return r;
  }
  TWINSHADE_INLINE void store(E* to) const {
    for (int i = 0; i < W; ++i) to[i] = e[i];
  }
  template <class G>
  TWINSHADE_INLINE constexpr Plain<G, W> to() const {
    if constexpr (std::same_as<E, G>)
      return *this;
    else
      return Plain<G, W>(*this);
  }
  template <class G>
  TWINSHADE_INLINE Plain<G, W> as() const {  // the same bits
    Plain<G, W> r;
    for (int i = 0; i < W; ++i) r.e[i] = number::bits<G>(e[i]);
    return r;
  }

  template <class R, class Op, class... A>
  static TWINSHADE_INLINE constexpr R each(Op op, const A&... a) {
    R r{};
    for (int i = 0; i < W; ++i) r.e[i] = op(a.e[i]...);
    return r;
  }

  friend TWINSHADE_INLINE constexpr Plain operator+(Plain a, Plain b) { return each<Plain>(number::add<E>, a, b); }
  friend TWINSHADE_INLINE constexpr Plain operator-(Plain a, Plain b) { return each<Plain>(number::subtract<E>, a, b); }
  friend TWINSHADE_INLINE constexpr Plain operator*(Plain a, Plain b) { return each<Plain>(number::multiply<E>, a, b); }
  friend TWINSHADE_INLINE constexpr Plain operator/(Plain a, Plain b) { return each<Plain>(number::divide<E>, a, b); }
  friend TWINSHADE_INLINE constexpr Plain operator%(Plain a, Plain b) {
    return each<Plain>([](E x, E y) TWINSHADE_LAMBDA { return number::remainder(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE constexpr Plain operator-(Plain a) { return each<Plain>(number::negate<E>, a); }

  // On bool these are the logical operators.
  friend TWINSHADE_INLINE constexpr Plain operator&(Plain a, Plain b) {
    return each<Plain>([](E x, E y) TWINSHADE_LAMBDA { return static_cast<E>(x & y); }, a, b);
  }
  friend TWINSHADE_INLINE constexpr Plain operator|(Plain a, Plain b) {
    return each<Plain>([](E x, E y) TWINSHADE_LAMBDA { return static_cast<E>(x | y); }, a, b);
  }
  friend TWINSHADE_INLINE constexpr Plain operator^(Plain a, Plain b) {
    return each<Plain>([](E x, E y) TWINSHADE_LAMBDA { return static_cast<E>(x ^ y); }, a, b);
  }
  friend TWINSHADE_INLINE constexpr Plain operator~(Plain a) {
    return each<Plain>([](E x) TWINSHADE_LAMBDA { return static_cast<E>(~x); }, a);
  }
  friend TWINSHADE_INLINE constexpr mask operator!(Plain a) {
    return each<mask>([](E x) TWINSHADE_LAMBDA { return !x; }, a);
  }
  // Both sides are evaluated.
  friend TWINSHADE_INLINE constexpr mask operator&&(Plain a, Plain b) { return a & b; }
  friend TWINSHADE_INLINE constexpr mask operator||(Plain a, Plain b) { return a | b; }
  friend TWINSHADE_INLINE constexpr Plain operator<<(Plain a, Plain<std::uint32_t, W> n) {
    return each<Plain>([](E x, std::uint32_t k) TWINSHADE_LAMBDA { return number::shift_left(x, k); }, a, n);
  }
  friend TWINSHADE_INLINE constexpr Plain operator<<(Plain a, Plain<std::int32_t, W> n) {
    return a << n.template to<std::uint32_t>();
  }
  friend TWINSHADE_INLINE constexpr Plain operator>>(Plain a, Plain<std::uint32_t, W> n) {
    return each<Plain>([](E x, std::uint32_t k) TWINSHADE_LAMBDA { return number::shift_right(x, k); }, a, n);
  }
  friend TWINSHADE_INLINE constexpr Plain operator>>(Plain a, Plain<std::int32_t, W> n) {
    return a >> n.template to<std::uint32_t>();
  }

  friend TWINSHADE_INLINE constexpr mask operator<(Plain a, Plain b) {
    return each<mask>([](E x, E y) TWINSHADE_LAMBDA { return x < y; }, a, b);
  }
  friend TWINSHADE_INLINE constexpr mask operator>(Plain a, Plain b) {
    return each<mask>([](E x, E y) TWINSHADE_LAMBDA { return x > y; }, a, b);
  }
  friend TWINSHADE_INLINE constexpr mask operator<=(Plain a, Plain b) {
    return each<mask>([](E x, E y) TWINSHADE_LAMBDA { return x <= y; }, a, b);
  }
  friend TWINSHADE_INLINE constexpr mask operator>=(Plain a, Plain b) {
    return each<mask>([](E x, E y) TWINSHADE_LAMBDA { return x >= y; }, a, b);
  }
  friend TWINSHADE_INLINE constexpr mask operator==(Plain a, Plain b) {
    return each<mask>([](E x, E y) TWINSHADE_LAMBDA { return x == y; }, a, b);
  }
  friend TWINSHADE_INLINE constexpr mask operator!=(Plain a, Plain b) {
    return each<mask>([](E x, E y) TWINSHADE_LAMBDA { return x != y; }, a, b);
  }

  friend TWINSHADE_INLINE constexpr Plain select(mask m, Plain a, Plain b) {
    return each<Plain>([](bool c, E x, E y) TWINSHADE_LAMBDA { return c ? x : y; }, m, a, b);
  }
  friend TWINSHADE_INLINE constexpr Plain lanes_min(Plain a, Plain b) { return each<Plain>(number::minimum<E>, a, b); }
  friend TWINSHADE_INLINE constexpr Plain lanes_max(Plain a, Plain b) { return each<Plain>(number::maximum<E>, a, b); }
  friend TWINSHADE_INLINE constexpr Plain lanes_abs(Plain a) {
    return each<Plain>(
        [](E x) TWINSHADE_LAMBDA {
          if constexpr (number::Real<E>)
            return number::absolute(x);
          else
            return x < E{0} ? number::negate(x) : x;
        },
        a);
  }
  friend TWINSHADE_INLINE Plain lanes_sqrt(Plain a) {
    return each<Plain>([](E x) TWINSHADE_LAMBDA { return number::square_root(x); }, a);
  }
  friend TWINSHADE_INLINE Plain lanes_floor(Plain a) {
    return each<Plain>([](E x) TWINSHADE_LAMBDA { return number::round_down(x); }, a);
  }
  friend TWINSHADE_INLINE Plain lanes_ceil(Plain a) {
    return each<Plain>([](E x) TWINSHADE_LAMBDA { return number::round_up(x); }, a);
  }
  friend TWINSHADE_INLINE Plain lanes_trunc(Plain a) {
    return each<Plain>([](E x) TWINSHADE_LAMBDA { return number::round_to_zero(x); }, a);
  }
  friend TWINSHADE_INLINE Plain lanes_round_even(Plain a) {
    return each<Plain>([](E x) TWINSHADE_LAMBDA { return number::round_to_even(x); }, a);
  }

  friend TWINSHADE_INLINE constexpr bool any(Plain a) {
    bool r = false;
    for (int i = 0; i < W; ++i) r = r || a.e[i];
    return r;
  }
  friend TWINSHADE_INLINE constexpr bool all(Plain a) {
    bool r = true;
    for (int i = 0; i < W; ++i) r = r && a.e[i];
    return r;
  }
  friend TWINSHADE_INLINE constexpr bool none(Plain a) { return !any(a); }

  // Values of the quad's neighbours: lanes are (x,y) (x+1,y) (x,y+1) (x+1,y+1), derivatives fine.
  friend TWINSHADE_INLINE Plain quad_dx(Plain a) {
    static_assert(W % 4 == 0, "derivatives need whole quads");
    Plain r;
    for (int i = 0; i < W; ++i) r.e[i] = a.e[i | 1] - a.e[i & ~1];
    return r;
  }
  friend TWINSHADE_INLINE Plain quad_dy(Plain a) {
    static_assert(W % 4 == 0, "derivatives need whole quads");
    Plain r;
    for (int i = 0; i < W; ++i) r.e[i] = a.e[i | 2] - a.e[i & ~2];
    return r;
  }
};

// f(number, ...) for each lane, for what has no vector form.
template <class E, int W, class F, class... A>
TWINSHADE_INLINE Plain<E, W> map_lanes(F f, const Plain<E, W>& first, const A&... rest) {
  Plain<E, W> r;
  for (int i = 0; i < W; ++i) r.e[i] = f(first.e[i], rest.lane(i)...);
  return r;
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade

// Simd<E, W> and SimdMask<W>: W lanes in vector registers; wider than one register: a pair of halves. E: float, int32,
// uint32. Each lane does what number.h says, bit for bit.
#pragma once

#include "cpu_shaders/runtime/plain_lanes.h"
#include "cpu_shaders/runtime/simd_register.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

template <class E, int W>
struct Simd;
template <int W>
struct SimdMask;

// Whether SimdMask<W> is a mask register, rather than lanes of 0 or -1.
#if defined(__AVX512F__)
template <int W>
inline constexpr bool kMaskRegister = W == 16;
#else
template <int W>
inline constexpr bool kMaskRegister = false;
#endif

namespace detail {
template <class V, class Half, bool whole>
struct Storage {
  V v;
};
template <class V, class Half>
struct Storage<V, Half, false> {
  Half lo, hi;
  Storage() = default;
  TWINSHADE_INLINE Storage(const Storage& o) : lo(o.lo), hi(o.hi) {}  // as Components in aggregates.h
  TWINSHADE_INLINE Storage& operator=(const Storage& o) {
    lo = o.lo;
    hi = o.hi;
    return *this;
  }
};
template <class E, int W>
struct SimdOf {
  using type = Simd<E, W>;
};
template <int W>
struct SimdOf<bool, W> {
  using type = SimdMask<W>;
};
}  // namespace detail

// What Simd and SimdMask share: registers, lane access, memory.
template <class Derived, class HalfT, class E, int W>
struct SimdBase : detail::Storage<Register<E, W <= kNativeLanes ? W : 4>, HalfT, W <= kNativeLanes> {
  static constexpr int width = W;
  static constexpr bool is_lanes = true;
  static constexpr bool whole = W <= kNativeLanes;
  using Half = HalfT;
  using Vector = Register<E, whole ? W : 4>;  // meaningful if whole
  using mask = SimdMask<W>;
  template <class G>
  using with = typename detail::SimdOf<G, W>::type;

  // op(register, ...) on each register of the operands, making an R.
  template <class R, class Op, class... A>
  static TWINSHADE_INLINE R each(Op op, const A&... a) {
    R r;
    if constexpr (whole) {
      r.v = (typename R::Vector)op(a.v...);
    } else {
      r.lo = Half::template each<typename R::Half>(op, a.lo...);
      r.hi = Half::template each<typename R::Half>(op, a.hi...);
    }
    return r;
  }
  static TWINSHADE_INLINE Derived splat_lanes(E x) {
    Derived r;
    if constexpr (whole)
      r.v = registers::splat<E, W>(x);
    else
      r.lo = r.hi = Half::splat_lanes(x);
    return r;
  }
  TWINSHADE_INLINE E element_at(int i) const {
    if constexpr (whole)
      return this->v[i];
    else
      return i < W / 2 ? this->lo.element_at(i) : this->hi.element_at(i - W / 2);
  }
  TWINSHADE_INLINE void set_element(int i, E x) {
    if constexpr (whole)
      this->v[i] = x;
    else if (i < W / 2)
      this->lo.set_element(i, x);
    else
      this->hi.set_element(i - W / 2, x);
  }
  static TWINSHADE_INLINE Derived load_elements(const E* from) {
    Derived r;
    if constexpr (whole) {
      r.v = registers::load<W>(from);
    } else {
      r.lo = Half::load_elements(from);
      r.hi = Half::load_elements(from + W / 2);
    }
    return r;
  }
  TWINSHADE_INLINE void store_elements(E* to) const {
    if constexpr (whole) {
      registers::store(to, this->v);
    } else {
      this->lo.store_elements(to);
      this->hi.store_elements(to + W / 2);
    }
  }
};

template <int W>
struct SimdMask : SimdBase<SimdMask<W>, SimdMask<W / 2>, std::int32_t, W> {
  using element = bool;
  using Base = SimdBase<SimdMask<W>, SimdMask<W / 2>, std::int32_t, W>;

  SimdMask() = default;
  template <std::same_as<bool> T>
  TWINSHADE_INLINE SimdMask(T x) : SimdMask(Base::splat_lanes(x ? -1 : 0)) {}
  TWINSHADE_INLINE SimdMask(Plain<bool, 1> x) : SimdMask(x.e[0]) {}

  TWINSHADE_INLINE bool lane(int i) const { return this->element_at(i) != 0; }
  TWINSHADE_INLINE void set_lane(int i, bool x) { this->set_element(i, x ? -1 : 0); }
  // Words of 0 or ~0.
  static TWINSHADE_INLINE SimdMask load(const std::uint32_t* from) {
    return Base::load_elements(reinterpret_cast<const std::int32_t*>(from));
  }
  TWINSHADE_INLINE void store(std::uint32_t* to) const { this->store_elements(reinterpret_cast<std::int32_t*>(to)); }
  // Bit i is lane i.
  TWINSHADE_INLINE std::uint32_t bits() const {
    if constexpr (Base::whole)
      return registers::mask_bits(this->v);
    else
      return this->lo.bits() | this->hi.bits() << (W / 2);
  }
  template <class G>
  TWINSHADE_INLINE typename Base::template with<G> to() const {  // 1 where set
    if constexpr (std::same_as<G, bool>)
      return *this;
    else
      return select(*this, typename Base::template with<G>(G{1}), typename Base::template with<G>(G{0}));
  }

  friend TWINSHADE_INLINE SimdMask operator&(SimdMask a, SimdMask b) {
    return Base::template each<SimdMask>([](auto x, auto y) TWINSHADE_LAMBDA { return x & y; }, a, b);
  }
  friend TWINSHADE_INLINE SimdMask operator|(SimdMask a, SimdMask b) {
    return Base::template each<SimdMask>([](auto x, auto y) TWINSHADE_LAMBDA { return x | y; }, a, b);
  }
  friend TWINSHADE_INLINE SimdMask operator^(SimdMask a, SimdMask b) {
    return Base::template each<SimdMask>([](auto x, auto y) TWINSHADE_LAMBDA { return x ^ y; }, a, b);
  }
  friend TWINSHADE_INLINE SimdMask operator!(SimdMask a) {
    return Base::template each<SimdMask>([](auto x) TWINSHADE_LAMBDA { return ~x; }, a);
  }
  // Both sides are evaluated.
  friend TWINSHADE_INLINE SimdMask operator&&(SimdMask a, SimdMask b) { return a & b; }
  friend TWINSHADE_INLINE SimdMask operator||(SimdMask a, SimdMask b) { return a | b; }
  friend TWINSHADE_INLINE SimdMask operator!=(SimdMask a, SimdMask b) { return a ^ b; }
  friend TWINSHADE_INLINE SimdMask operator==(SimdMask a, SimdMask b) { return !(a ^ b); }
  friend TWINSHADE_INLINE SimdMask select(SimdMask m, SimdMask a, SimdMask b) {
    return Base::template each<SimdMask>([](auto c, auto x, auto y) TWINSHADE_LAMBDA { return (c & x) | (~c & y); }, m,
                                         a, b);
  }
  friend TWINSHADE_INLINE bool any(SimdMask m) {
    if constexpr (Base::whole)
      return registers::any(m.v);
    else
      return any(m.lo | m.hi);
  }
  friend TWINSHADE_INLINE bool all(SimdMask m) {
    if constexpr (Base::whole)
      return registers::all(m.v);
    else
      return all(m.lo & m.hi);
  }
  friend TWINSHADE_INLINE bool none(SimdMask m) { return !any(m); }
};

#if defined(__AVX512F__)
// Sixteen lanes: a mask register, whose bit i is lane i.
template <>
struct SimdMask<16> {
  using element = bool;
  static constexpr int width = 16;
  static constexpr bool is_lanes = true;
  static constexpr bool whole = true;
  template <class G>
  using with = typename detail::SimdOf<G, 16>::type;
  __mmask16 m;

  SimdMask() = default;
  TWINSHADE_INLINE explicit SimdMask(__mmask16 bits) : m(bits) {}
  template <std::same_as<bool> T>
  TWINSHADE_INLINE SimdMask(T x) : m(x ? 0xffff : 0) {}
  TWINSHADE_INLINE SimdMask(Plain<bool, 1> x) : SimdMask(x.e[0]) {}

  TWINSHADE_INLINE bool lane(int i) const { return (m >> i & 1) != 0; }
  TWINSHADE_INLINE void set_lane(int i, bool x) {
    m = static_cast<__mmask16>((m & ~(1u << i)) | (static_cast<unsigned>(x) << i));
  }
  static TWINSHADE_INLINE SimdMask load(const std::uint32_t* from) {
    Register<std::int32_t, 16> words;
    std::memcpy(&words, from, sizeof words);
    return SimdMask(registers::mask_of(words));
  }
  TWINSHADE_INLINE void store(std::uint32_t* to) const {
    const auto words = registers::blend(m, registers::splat<std::uint32_t, 16>(~0u), Register<std::uint32_t, 16>{});
    std::memcpy(to, &words, sizeof words);
  }
  TWINSHADE_INLINE std::uint32_t bits() const { return m; }
  template <class G>
  TWINSHADE_INLINE with<G> to() const {  // 1 where set
    if constexpr (std::same_as<G, bool>)
      return *this;
    else
      return select(*this, with<G>(G{1}), with<G>(G{0}));
  }

  friend TWINSHADE_INLINE SimdMask operator&(SimdMask a, SimdMask b) { return made(a.m & b.m); }
  friend TWINSHADE_INLINE SimdMask operator|(SimdMask a, SimdMask b) { return made(a.m | b.m); }
  friend TWINSHADE_INLINE SimdMask operator^(SimdMask a, SimdMask b) { return made(a.m ^ b.m); }
  friend TWINSHADE_INLINE SimdMask operator!(SimdMask a) { return made(~a.m); }
  friend TWINSHADE_INLINE SimdMask operator&&(SimdMask a, SimdMask b) { return a & b; }
  friend TWINSHADE_INLINE SimdMask operator||(SimdMask a, SimdMask b) { return a | b; }
  friend TWINSHADE_INLINE SimdMask operator!=(SimdMask a, SimdMask b) { return a ^ b; }
  friend TWINSHADE_INLINE SimdMask operator==(SimdMask a, SimdMask b) { return !(a ^ b); }
  friend TWINSHADE_INLINE SimdMask select(SimdMask c, SimdMask a, SimdMask b) {
    return made((c.m & a.m) | (~c.m & b.m));
  }
  friend TWINSHADE_INLINE bool any(SimdMask a) { return a.m != 0; }
  friend TWINSHADE_INLINE bool all(SimdMask a) { return a.m == 0xffff; }
  friend TWINSHADE_INLINE bool none(SimdMask a) { return a.m == 0; }

 private:
  static TWINSHADE_INLINE SimdMask made(int bits) { return SimdMask(static_cast<__mmask16>(bits)); }
};
#endif

template <class E, int W>
struct Simd : SimdBase<Simd<E, W>, Simd<E, W / 2>, E, W> {
  static_assert(std::same_as<E, float> || number::Integer<E>);
  using element = E;
  using Base = SimdBase<Simd<E, W>, Simd<E, W / 2>, E, W>;
  using mask = SimdMask<W>;
  static constexpr bool real = number::Real<E>;

  Simd() = default;
  template <std::same_as<E> T>
  TWINSHADE_INLINE Simd(T x) : Simd(Base::splat_lanes(x)) {}
  TWINSHADE_INLINE Simd(Plain<E, 1> x) : Simd(x.e[0]) {}
  // Value conversion, as number::convert.
  template <class G>
  requires(!std::same_as<E, G>) TWINSHADE_INLINE explicit Simd(Simd<G, W> x) : Simd(x.template to<E>()) {}
  template <class G>
  requires(!std::same_as<E, G>) TWINSHADE_INLINE explicit Simd(Plain<G, 1> x) : Simd(x.template to<E>()) {}
  TWINSHADE_INLINE explicit Simd(SimdMask<W> x) : Simd(x.template to<E>()) {}

  TWINSHADE_INLINE E lane(int i) const { return this->element_at(i); }
  TWINSHADE_INLINE void set_lane(int i, E x) { this->set_element(i, x); }
  static TWINSHADE_INLINE Simd load(const E* from) { return Base::load_elements(from); }
  TWINSHADE_INLINE void store(E* to) const { this->store_elements(to); }
  // base[index] in each lane; indices must be in range.
  static TWINSHADE_INLINE Simd gather(const E* base, Simd<std::int32_t, W> index) {
    return Base::template each<Simd>(
        [base](auto i) TWINSHADE_LAMBDA { return registers::gather<E, sizeof(i) / 4>(base, i); }, index);
  }
  // 0, 1, 2 ...
  static TWINSHADE_INLINE Simd ramp() {
    E numbers[W];
    for (int i = 0; i < W; ++i) numbers[i] = static_cast<E>(i);
    return load(numbers);
  }

  template <class G>
  TWINSHADE_INLINE typename Base::template with<G> as() const {  // the same bits
    using R = typename Base::template with<G>;
    return Base::template each<R>([](auto x) TWINSHADE_LAMBDA { return x; }, *this);
  }
  template <class G>
  TWINSHADE_INLINE typename Base::template with<G> to() const {  // the same value; rounded, clamped where it cannot be
    using R = typename Base::template with<G>;
    if constexpr (std::same_as<E, G>) {
      return *this;
    } else if constexpr (std::same_as<G, bool>) {
      return *this != Simd(E{0});
    } else if constexpr (number::Integer<E> && number::Integer<G>) {
      return as<G>();
    } else if constexpr (std::same_as<E, float> && std::same_as<G, std::int32_t>) {
      return Base::template each<R>([](auto x) TWINSHADE_LAMBDA { return registers::to_int(x); }, *this);
    } else if constexpr (std::same_as<E, float> && std::same_as<G, std::uint32_t>) {
      const Simd half(2147483648.0f);
      const R low = to<std::int32_t>().template as<std::uint32_t>();
      const R high = (*this - half).template to<std::int32_t>().template as<std::uint32_t>() ^ R(0x80000000u);
      const R inside = select(*this < half, low, high);
      return select(*this >= half + half, R(~0u), select(*this > Simd(0.0f), inside, R(0u)));
    } else if constexpr (std::same_as<E, std::int32_t>) {
      return Base::template each<R>(
          [](auto x)
              TWINSHADE_LAMBDA { return __builtin_convertvector(x, typename RegisterOf<float, sizeof(x) / 4>::type); },
          *this);
    } else {  // uint32 to float, rounded once: both halves and the product are exact
      const auto high = (*this >> Simd<std::uint32_t, W>(16u)).template as<std::int32_t>().template to<float>();
      const auto low = (*this & Simd(0xffffu)).template as<std::int32_t>().template to<float>();
      return high * R(65536.0f) + low;
    }
  }

  friend TWINSHADE_INLINE Simd operator+(Simd a, Simd b) {
    return wrapping([](auto x, auto y) TWINSHADE_LAMBDA { return x + y; }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator-(Simd a, Simd b) {
    return wrapping([](auto x, auto y) TWINSHADE_LAMBDA { return x - y; }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator*(Simd a, Simd b) {
    return wrapping([](auto x, auto y) TWINSHADE_LAMBDA { return x * y; }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator/(Simd a, Simd b) {
    if constexpr (real)
      return Base::template each<Simd>([](auto x, auto y) TWINSHADE_LAMBDA { return x / y; }, a, b);
    else
      return map_lanes(number::divide<E>, a, b);
  }
  friend TWINSHADE_INLINE Simd operator%(Simd a, Simd b) {
    return map_lanes([](E x, E y) TWINSHADE_LAMBDA { return number::remainder(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator-(Simd a) {
    return wrapping([](auto x) TWINSHADE_LAMBDA { return -x; }, a);
  }
  friend TWINSHADE_INLINE Simd operator&(Simd a, Simd b) {
    return Base::template each<Simd>([](auto x, auto y) TWINSHADE_LAMBDA { return x & y; }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator|(Simd a, Simd b) {
    return Base::template each<Simd>([](auto x, auto y) TWINSHADE_LAMBDA { return x | y; }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator^(Simd a, Simd b) {
    return Base::template each<Simd>([](auto x, auto y) TWINSHADE_LAMBDA { return x ^ y; }, a, b);
  }
  friend TWINSHADE_INLINE Simd operator~(Simd a) {
    return Base::template each<Simd>([](auto x) TWINSHADE_LAMBDA { return ~x; }, a);
  }
  friend TWINSHADE_INLINE Simd operator<<(Simd a, Simd<std::uint32_t, W> n) {
    return Base::template each<Simd>([](auto x, auto k) TWINSHADE_LAMBDA { return (decltype(k))x << (k & 31u); }, a, n);
  }
  friend TWINSHADE_INLINE Simd operator<<(Simd a, Simd<std::int32_t, W> n) {
    return a << n.template as<std::uint32_t>();
  }
  friend TWINSHADE_INLINE Simd operator>>(Simd a, Simd<std::uint32_t, W> n) {
    return Base::template each<Simd>([](auto x, auto k) TWINSHADE_LAMBDA { return x >> (decltype(x))(k & 31u); }, a, n);
  }
  friend TWINSHADE_INLINE Simd operator>>(Simd a, Simd<std::int32_t, W> n) {
    return a >> n.template as<std::uint32_t>();
  }

  friend TWINSHADE_INLINE mask operator<(Simd a, Simd b) {
    return compare([](auto x, auto y) TWINSHADE_LAMBDA { return registers::less(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE mask operator>(Simd a, Simd b) {
    return compare([](auto x, auto y) TWINSHADE_LAMBDA { return registers::greater(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE mask operator<=(Simd a, Simd b) {
    return compare([](auto x, auto y) TWINSHADE_LAMBDA { return registers::less_equal(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE mask operator>=(Simd a, Simd b) {
    return compare([](auto x, auto y) TWINSHADE_LAMBDA { return registers::greater_equal(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE mask operator==(Simd a, Simd b) {
    return compare([](auto x, auto y) TWINSHADE_LAMBDA { return registers::equal(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE mask operator!=(Simd a, Simd b) {
    return compare([](auto x, auto y) TWINSHADE_LAMBDA { return registers::not_equal(x, y); }, a, b);
  }

  friend TWINSHADE_INLINE Simd select(mask m, Simd a, Simd b) {
    if constexpr (kMaskRegister<W>) {
      Simd r;
      r.v = registers::blend(m.m, a.v, b.v);
      return r;
    } else {
      return Base::template each<Simd>([](auto c, auto x, auto y) TWINSHADE_LAMBDA { return c ? x : y; }, m, a, b);
    }
  }
  // The same in fewer instructions where compilers do not know that m's lanes are 0 or -1, but more where they do.
  friend TWINSHADE_INLINE Simd blend(mask m, Simd a, Simd b) {
    if constexpr (kMaskRegister<W>)
      return select(m, a, b);
    else
      return Base::template each<Simd>(
          [](auto c, auto x, auto y) TWINSHADE_LAMBDA { return registers::blend(c, x, y); }, m, a, b);
  }
  // The other operand where one is NaN; of +0 and -0 the second.
  friend TWINSHADE_INLINE Simd lanes_min(Simd a, Simd b) {
    return Base::template each<Simd>([](auto x, auto y) TWINSHADE_LAMBDA { return registers::lesser(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE Simd lanes_max(Simd a, Simd b) {
    return Base::template each<Simd>([](auto x, auto y) TWINSHADE_LAMBDA { return registers::larger(x, y); }, a, b);
  }
  friend TWINSHADE_INLINE Simd lanes_abs(Simd a) {
    if constexpr (real)
      return (a.template as<std::uint32_t>() & Simd<std::uint32_t, W>(0x7fffffffu)).template as<E>();
    else
      return select(a < Simd(E{0}), -a, a);
  }
  friend TWINSHADE_INLINE Simd lanes_sqrt(Simd a) {
    return Base::template each<Simd>([](auto x) TWINSHADE_LAMBDA { return registers::sqrt(x); }, a);
  }
  friend TWINSHADE_INLINE Simd lanes_floor(Simd a) {
    return Base::template each<Simd>([](auto x) TWINSHADE_LAMBDA { return registers::floor(x); }, a);
  }
  friend TWINSHADE_INLINE Simd lanes_ceil(Simd a) {
    return Base::template each<Simd>([](auto x) TWINSHADE_LAMBDA { return registers::ceil(x); }, a);
  }
  friend TWINSHADE_INLINE Simd lanes_trunc(Simd a) {
    return Base::template each<Simd>([](auto x) TWINSHADE_LAMBDA { return registers::trunc(x); }, a);
  }
  friend TWINSHADE_INLINE Simd lanes_round_even(Simd a) {
    return Base::template each<Simd>([](auto x) TWINSHADE_LAMBDA { return registers::round_even(x); }, a);
  }

  // Values of the quad's neighbours: lanes are (x,y) (x+1,y) (x,y+1) (x+1,y+1), derivatives fine.
  friend TWINSHADE_INLINE Simd quad_dx(Simd a) {
    return Base::template each<Simd>(
        [](auto x) TWINSHADE_LAMBDA {
          return permuted(x, [](int i) TWINSHADE_LAMBDA { return i | 1; }) -
                 permuted(x, [](int i) TWINSHADE_LAMBDA { return i & ~1; });
        },
        a);
  }
  friend TWINSHADE_INLINE Simd quad_dy(Simd a) {
    return Base::template each<Simd>(
        [](auto x) TWINSHADE_LAMBDA {
          return permuted(x, [](int i) TWINSHADE_LAMBDA { return i | 2; }) -
                 permuted(x, [](int i) TWINSHADE_LAMBDA { return i & ~2; });
        },
        a);
  }

 private:
  template <class E2, int W2>
  friend struct Simd;

  template <class Op>
  static TWINSHADE_INLINE mask compare(Op op, Simd a, Simd b) {
    if constexpr (kMaskRegister<W>)
      return mask(op(a.v, b.v));
    else
      return Base::template each<mask>(op, a, b);
  }
  // Integers are worked on as unsigned, so that they wrap.
  template <class Op, class... A>
  static TWINSHADE_INLINE Simd wrapping(Op op, const A&... a) {
    if constexpr (std::same_as<E, std::int32_t>) {
      return Base::template each<Simd>(
          [op](auto... x) { return op((typename RegisterOf<std::uint32_t, sizeof(x) / 4>::type) x...); }, a...);
    } else {
      return Base::template each<Simd>(op, a...);
    }
  }
  template <class V, class From, std::size_t... k>
  static TWINSHADE_INLINE V permute_register(V x, From, std::index_sequence<k...>) {
    return __builtin_shufflevector(x, x, From{}(static_cast<int>(k))...);
  }
  template <class V, class From>
  static TWINSHADE_INLINE V permuted(V x, From from) {
    return permute_register(x, from, std::make_index_sequence<sizeof(V) / 4>());
  }
};

template <class E, int W, class F, class... A>
TWINSHADE_INLINE Simd<E, W> map_lanes(F f, const Simd<E, W>& first, const A&... rest) {
  E to[W];
  first.store(to);
  for (int i = 0; i < W; ++i) to[i] = f(to[i], rest.lane(i)...);
  return Simd<E, W>::load(to);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade

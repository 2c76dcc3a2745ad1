// What a translated shader inherits: inputs, outputs, masks, buffers, atomics, in every policy. The kernel here is made
// by hand and shades nothing.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <new>

#include "cpu_shaders/runtime/denormals.h"
#include "cpu_shaders/runtime/runtime.h"
#include "tests/runtime/test_data.h"

namespace twinshade::test {
namespace {

// Inputs: float 0, vec2 1-2, int 3, bool 4, float[2] 5-6. Outputs: vec2 0-1, int 2, bool 3, mat2 4-7.
template <class N>
struct Kernel : ShaderBase<N> {
  using Base = ShaderBase<N>;
  using F = typename N::F;
  using I = typename N::I;
  using B = typename N::B;
  using UF = typename N::UF;
  using UI = typename N::UI;
  using UU = typename N::UU;
  Kernel(const ShaderData& data, const ShadeCall& call) : Base(data, call) {}

  void run() {
    const F x = this->template input<F>(0);
    const vec<F, 2> v = this->template input<vec<F, 2>>(1);
    const I i = this->template input<I>(3);
    const B b = this->template input<B>(4);
    const auto a = this->template input<arr<F, 2>>(5);
    const vec<F, 4> position = this->frag_coord();
    this->output(0, v + swizzle<0, 1>(position) * UF(0.5f));
    this->output(2, i + this->primitive_id());
    this->output(3, b ^ this->front_facing());
    this->output(4, mat<F, 2, 2>(vec<F, 2>(x, a[0]), vec<F, 2>(a[1], UF(7.0f))));
    this->frag_depth(x * UF(2.0f));
    const BufferView buffer = this->buffer(0);
    const BufferView uniforms = this->uniforms(8);
    // Word 0: how many lanes are live. Word 1: the last live lane's i. Words from 4: i where b, two words each.
    (void)atomic_add(this->live(), buffer, UI(0), UI(1));
    store(this->live(), buffer, UI(4), i);
    store(this->live() & b, buffer, UI(16) + i * UI(8), vec<I, 2>(i, load<UI>(uniforms, UI(4))));
    this->kept = this->kept & !(i == UI(5));
  }
};

template <class T>
struct Aligned {
  explicit Aligned(std::size_t n) : data(new (std::align_val_t{64}) T[n]()) {}
  ~Aligned() { ::operator delete[](data, std::align_val_t{64}); }
  Aligned(const Aligned&) = delete;
  Aligned& operator=(const Aligned&) = delete;
  T* data;
};

constexpr std::uint32_t kCount = 32, kStride = 48;

template <class N>
void check_policy() {
  using real = typename N::real;
  Aligned<real> inputs(7 * kStride), coord(4 * kStride), outputs(8 * kStride), depth(kStride);
  Aligned<std::uint32_t> live(kStride), facing(kStride), id(kStride), kept(kStride);
  std::vector<std::uint32_t> buffer(4 + 2 * kCount, 0xdeadbeefu);
  buffer[0] = 0;
  const std::uint32_t uniforms[2] = {1, 99};
  const auto put_int = [](real& to, std::int32_t x) {
    if constexpr (std::same_as<real, float>)
      to = float_of(static_cast<std::uint32_t>(x));
    else
      to = x;
  };
  const auto get_int = [](real from) {
    if constexpr (std::same_as<real, float>)
      return static_cast<std::int32_t>(word_of(from));
    else
      return static_cast<std::int32_t>(from);
  };
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const auto set = [&](std::uint32_t c, double x) { inputs.data[c * kStride + i] = static_cast<real>(x); };
    set(0, i * 0.25), set(1, i), set(2, -1.0 * i), set(5, 100 + i), set(6, 200 + i);
    put_int(inputs.data[3 * kStride + i], static_cast<std::int32_t>(i));
    put_int(inputs.data[4 * kStride + i], i % 3 == 0);
    for (std::uint32_t c = 0; c < 4; ++c) coord.data[c * kStride + i] = static_cast<real>(c + 1);
    live.data[i] = i < 30 ? ~0u : 0;
    facing.data[i] = i % 2 ? ~0u : 0;
    id.data[i] = 1000 * i;
  }
  const BufferView view{reinterpret_cast<std::byte*>(buffer.data()), buffer.size() * 4};
  const ShaderData data{reinterpret_cast<const std::byte*>(uniforms), nullptr, &view};
  const ShadeCall call{kCount,      kStride, inputs.data,  coord.data, live.data,
                       facing.data, id.data, outputs.data, depth.data, kept.data};
  shade_all<Kernel, N>(data, call);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    CAPTURE(i);
    const auto out = [&](std::uint32_t c) { return outputs.data[c * kStride + i]; };
    CHECK(out(0) == real(i + 0.5));
    CHECK(out(1) == real(-1.0 * i + 1));
    CHECK(get_int(out(2)) == static_cast<std::int32_t>(1001 * i));
    CHECK(get_int(out(3)) == ((i % 3 == 0) != (i % 2 == 1)));
    CHECK(out(4) == real(i * 0.25));
    CHECK(out(5) == real(100 + i));
    CHECK(out(6) == real(200 + i));
    CHECK(out(7) == real(7));
    CHECK(depth.data[i] == real(i * 0.5));
    CHECK(kept.data[i] == (i < 30 && i != 5 ? ~0u : 0u));
    const bool written = i < 30 && i % 3 == 0;
    CHECK(buffer[4 + 2 * i] == (written ? i : 0xdeadbeefu));
    CHECK(buffer[5 + 2 * i] == (written ? 99 : 0xdeadbeefu));
  }
  CHECK(buffer[0] == 30);
  CHECK(buffer[1] == 29);
}

}  // namespace

TEST_CASE_TEMPLATE("inputs, outputs, masks and buffers go where the call says", N, Lanes<4>, Lanes<8>, Lanes<16>,
                   Scalar32, Quad32, Scalar64, Quad64) {
  check_policy<N>();
}

// Nothing is read, so nothing can be seen of it: for the sanitizers.
TEST_CASE_TEMPLATE("texels can be asked for at any coordinates, for any number of invocations and textures", N,
                   Lanes<4>, Lanes<8>, Lanes<16>) {
  constexpr std::uint32_t kMost = 272;
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const float odd[8] = {0, -0.001f, 0.999f, 1e9f, -3e38f, inf, -inf, nan};
  Aligned<float> inputs(3 * kMost);
  for (std::uint32_t i = 0; i < kMost; ++i) {
    inputs.data[i] = odd[i % 8];
    inputs.data[kMost + i] = odd[i / 2 % 8];
    inputs.data[2 * kMost + i] = float_of(i % 3 == 0 ? 0u : i % 3 == 1 ? 0x80000000u : 0x7fffffffu);
  }
  struct Map {
    std::int32_t size;
    Wrap wrap;
  };
  for (const Map map : {Map{1, Wrap::repeat}, Map{3, Wrap::repeat}, Map{8, Wrap::repeat}, Map{1, Wrap::clamp_to_edge},
                        Map{3, Wrap::clamp_to_edge}}) {
    const std::int32_t size = map.size;
    const std::vector<float> texels(std::size_t(size) * std::size_t(size) * 4 * 2);
    const TextureView view{
        texels.data(),  size,    size, 2, size * 4, std::ptrdiff_t{size} * size * 4, TextureKind::two_d_array,
        Filter::linear, map.wrap};
    const ShaderData data{nullptr, &view, nullptr};
    const std::vector<TexelsAhead> ahead{{0, 0, 2}, {0, 0, -1}, {0, 0, 2}, {0, 0, 2}, {0, 0, 2},
                                         {0, 0, 2}, {0, 0, 2},  {0, 0, 2}, {0, 0, 2}, {0, 0, -1}};
    for (const std::uint32_t count : {0u, 16u, 64u, 80u, 256u, kMost})
      for (const std::uint32_t hints : {0u, 2u, 8u, 10u}) {
        ShadeCall call{};
        call.count = count;
        call.stride = kMost;
        call.inputs = inputs.data;
        call.ahead = ahead.data();
        call.ahead_count = hints;
        TexelPrefetch<N> prefetch(data, call);
        for (std::uint32_t end = 0; end < 2 * kMost; end += 24) prefetch.ask_until(end);
      }
  }
}

TEST_CASE("buffers: nothing is read or written outside the view, whatever the offset") {
  std::uint32_t words[4] = {1, 2, 3, 4};
  const BufferView view{reinterpret_cast<std::byte*>(words + 1), 8};
  using N = Lanes<4>;
  const std::int32_t offsets[4] = {-4, 0, 8, 0x7ffffffc};
  const N::I at = N::I::load(offsets);
  const N::I loaded = load<N::I>(view, at);
  CHECK(loaded.lane(0) == 0);
  CHECK(loaded.lane(1) == 2);
  CHECK(loaded.lane(2) == 0);
  CHECK(loaded.lane(3) == 0);
  store(N::B(true), view, at, N::I(9));
  (void)atomic_add(N::B(true), view, at, N::I(1));
  CHECK(words[0] == 1);
  CHECK(words[1] == 10);
  CHECK(words[2] == 3);
  CHECK(words[3] == 4);
  CHECK(load<N::UF>(BufferView{nullptr, 0}, N::UI(0)).value() == 0);
  CHECK(array_length(view, 4, 4).value() == 1);
  CHECK(array_length(view, 12, 4).value() == 0);
  CHECK(array_length(view, 0, 16).value() == 0);
}

TEST_CASE("atomics run lane by lane and give what was there before") {
  std::uint32_t word = 10;
  const BufferView view{reinterpret_cast<std::byte*>(&word), 4};
  using N = Lanes<8>;
  const N::U ramp = N::U::ramp();
  const N::B odd = (ramp & N::U(1u)) == N::U(1u);
  const N::U before = atomic_add(odd, view, N::UI(0), ramp);
  CHECK(before.lane(1) == 10);
  CHECK(before.lane(3) == 11);
  CHECK(before.lane(5) == 14);
  CHECK(before.lane(7) == 19);
  CHECK(word == 26);
  CHECK(atomic_max(N::B(true), view, N::UI(0), ramp + N::U(24u)).lane(7) == 30);
  CHECK(word == 31);
  (void)atomic_and(N::B(true), view, N::UI(0), N::UU(~1u));
  CHECK(word == 30);
  (void)atomic_comp_swap(N::B(true), view, N::UI(0), N::UU(30u), ramp);
  CHECK(word == 0);
  (void)atomic_exchange(odd, view, N::UI(0), ramp);
  CHECK(word == 7);
}

TEST_CASE("denormals are flushed within a scope and kept again after it") {
  volatile float least = 0x1p-126f, denormal = 0x1p-140f;
  const auto halves = [&] { return least * 0.5f; };
  const auto doubles = [&] { return denormal * 0x1p40f; };
  CHECK(halves() == 0x1p-127f);
  CHECK(doubles() == 0x1p-100f);
  {
    const FlushDenormals flush;
    const bool results = halves() == 0, operands = doubles() == 0;
    bool kept_inside;
    {
      const KeepDenormals keep;
      kept_inside = halves() > 0;
    }
    const bool flushed_again = halves() == 0;
    CHECK(results);
    CHECK(operands);
    CHECK(kept_inside);
    CHECK(flushed_again);
  }
  CHECK(halves() == 0x1p-127f);
}

// Compilers may take a double that came from a float, unchanged, for that float.
TEST_CASE("odd functions of denormals are zeros of their sign where denormals are flushed") {
  volatile float denormals[] = {0x1p-149f, 0x1.8p-140f, 0x1.fffffcp-127f};
  for (const volatile float& denormal : denormals)
    for (const float sign : {1.0f, -1.0f}) {
      const float input = denormal * sign;
      float results[8];
      {
        const FlushDenormals flush;
        const Plain<float, 1> x(input);
        int i = 0;
        for (const auto& y : {glsl::sin(x), glsl::tan(x), glsl::asin(x), glsl::atan(x), glsl::sinh(x), glsl::tanh(x),
                              glsl::asinh(x), glsl::atanh(x)})
          results[i++] = y.e[0];
      }
      CAPTURE(input);
      for (const float result : results) {
        CHECK(std::fpclassify(result) == FP_ZERO);
        CHECK(std::signbit(result) == (sign < 0));
      }
    }
}

TEST_CASE_TEMPLATE("derivatives are the differences within each row and column of a quad", N, Lanes<4>, Lanes<8>,
                   Lanes<16>, Quad32) {
  float x[16], dx[16], dy[16];
  for (int i = 0; i < 16; ++i) x[i] = static_cast<float>((i * 37) % 23) * 0.5f;
  for (int i = 0; i < 16; i += N::width) {
    glsl::dFdx(N::F::load(x + i)).store(dx + i);
    glsl::dFdy(N::F::load(x + i)).store(dy + i);
  }
  for (int q = 0; q < 16; q += 4) {
    CHECK(dx[q] == x[q + 1] - x[q]);
    CHECK(dx[q + 1] == dx[q]);
    CHECK(dx[q + 2] == x[q + 3] - x[q + 2]);
    CHECK(dx[q + 3] == dx[q + 2]);
    CHECK(dy[q] == x[q + 2] - x[q]);
    CHECK(dy[q + 2] == dy[q]);
    CHECK(dy[q + 1] == x[q + 3] - x[q + 1]);
    CHECK(dy[q + 3] == dy[q + 1]);
  }
  CHECK(glsl::dFdx(typename N::UF(3.0f)).value() == 0);
}

TEST_CASE("structs are looked up by their own select, arrays of them copied uniform to varying") {
  using N = Lanes<4>;
  const arr<N::UF, 3> uniform{{N::UF(1.0f), N::UF(2.0f), N::UF(3.0f)}};
  const arr<N::F, 3> varying = uniform;
  CHECK(varying[2].lane(3) == 3.0f);
  const arr<N::UB, 2> flags{{N::UB(false), N::UB(true)}};
  const N::B picked = lookup(flags, N::I::ramp());
  CHECK(picked.bits() == 0b1110u);
  const N::I negative(-5);
  CHECK(varying[N::UI(-5)].lane(0) == 1.0f);
  CHECK(lookup(varying, negative).lane(0) == 1.0f);
}

}  // namespace twinshade::test

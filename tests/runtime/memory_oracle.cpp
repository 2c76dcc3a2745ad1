#include "tests/runtime/oracle.h"

#include <algorithm>

#include "tests/runtime/operations.h"

namespace twinshade::test {
namespace {

using Words = std::vector<std::uint32_t>;
using Word = std::uint32_t;

int clamp_signed(Word i, int n) { return std::clamp(static_cast<std::int32_t>(i), 0, n - 1); }
int clamp_unsigned(Word i, int n) { return i < static_cast<Word>(n) ? static_cast<int>(i) : n - 1; }

float number(int i) { return static_cast<float>(i * i) + 0.25f; }
Words vector(int i) {
  return {word_of(static_cast<float>(i)), word_of(static_cast<float>(-i) + 0.0f), word_of(static_cast<float>(3 * i))};
}
Words array_of(Word a, Word b, Word c) {
  return {a, b, c, word_of(float_of(a) + float_of(b)), word_of(float_of(b) - float_of(c))};
}
Word buffer_word(std::uint64_t offset) {
  const BufferView view = test_buffer();
  Word w = 0;
  if (offset + 4 <= view.size) std::memcpy(&w, view.bytes + offset, 4);
  return w;
}
Words texel(const TextureView& t, int x, int y, int layer) {
  const float* at = t.texels + layer * t.layer_pitch + y * t.row_pitch + x * 4;
  return {word_of(at[0]), word_of(at[1]), word_of(at[2]), word_of(at[3])};
}

// Bilinear filtering by its definition, in double: texel centres at (i + .5) / size.
Words bilinear(const TextureView& t, double s, double v, int layer, bool repeat) {
  const auto wrapped = [&](double i, int size) {
    const double n = size;
    return static_cast<int>(repeat ? i - n * std::floor(i / n) : std::clamp(i, 0.0, n - 1));
  };
  const double x = s * t.width - 0.5, y = v * t.height - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  Words words;
  for (int c = 0; c < 4; ++c) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const double weight = (k & 1 ? fx : 1 - fx) * (k & 2 ? fy : 1 - fy);
      const float* at = t.texels + layer * t.layer_pitch + wrapped(y0 + (k >> 1), t.height) * t.row_pitch +
                        wrapped(x0 + (k & 1), t.width) * 4;
      sum += weight * at[c];
    }
    words.push_back(word_of(static_cast<float>(sum)));
  }
  return words;
}
// Coordinates for which float keeps enough digits of the weight.
bool moderate(Word w) { return std::fabs(float_of(w)) < 4; }

}  // namespace

std::map<std::string, Oracle> memory_oracles() {
  std::map<std::string, Oracle> o;
  o["array[i]"] = {[](Word a, Word b, Word c) { return Words{array_of(a, b, c)[clamp_signed(a, 5)]}; }};
  o["array[p]"] = {[](Word a, Word b, Word c) { return Words{array_of(a, b, c)[clamp_unsigned(a, 5)]}; }};
  o["array[i & 7]"] = {[](Word a, Word b, Word c) { return Words{array_of(a, b, c)[clamp_signed(a & 7u, 5)]}; }};
  o["array[3 uniform]"] = {[](Word a, Word b, Word c) { return Words{array_of(a, b, c)[3]}; }};
  o["m[i & 1]"] = {[](Word a, Word b, Word c) { return a & 1u ? Words{b, c} : Words{a, b}; }};
  o["array[i & 7] = c where a < b"] = {[](Word a, Word b, Word c) {
    Words array = array_of(a, b, c);
    if (float_of(a) < float_of(b)) array[clamp_signed(a & 7u, 5)] = c;
    return array;
  }};
  o["m[i & 1][j & 1] = c"] = {[](Word a, Word b, Word c) {
    Words m{a, b, b, c};
    if (float_of(a) < float_of(c)) m[(a & 1u) * 2 + (b & 1u)] = c;
    return m;
  }};
  const auto numbers = [&](const char* name, int n, Word mask, bool is_signed = true) {
    o[name] = {[=](Word a, Word, Word) {
      return Words{word_of(number(is_signed ? clamp_signed(a & mask, n) : clamp_unsigned(a & mask, n)))};
    }};
  };
  numbers("uniform array of 6 [i & 7]", 6, 7);
  numbers("table of 6 [i & 7]", 6, 7);
  numbers("table of 6 [i]", 6, ~0u);
  numbers("table of 12 [p & 15]", 12, 15, false);
  numbers("table of 30 [i & 31]", 30, 31);
  numbers("table of 50 [i & 63]", 50, 63);
  const auto vectors = [&](const char* name, int n, Word mask) {
    o[name] = {[=](Word a, Word, Word) { return vector(clamp_signed(a & mask, n)); }};
  };
  vectors("uniform vectors of 6 [i & 7]", 6, 7);
  vectors("vectors of 12 [i & 15]", 12, 15);
  vectors("vectors of 40 [i & 63]", 40, 63);

  o["buffer float at 4 * (i & 63)"] = {[](Word a, Word, Word) { return Words{buffer_word((a & 63u) * 4)}; }};
  o["buffer vec3 at p"] = {[](Word a, Word, Word) {
    const Word at = a & ~3u;  // offsets wrap as the uint they are
    return Words{buffer_word(at), buffer_word(Word(at + 4)), buffer_word(Word(at + 8))};
  }};
  o["buffer bool at 4 * (i & 31)"] = {[](Word a, Word, Word) { return Words{buffer_word((a & 31u) * 4) != 0}; }};
  o["buffer uvec2 at 8 uniform"] = {[](Word, Word, Word) { return Words{buffer_word(8), buffer_word(12)}; }};

  o["texelFetch 2D"] = {
      [](Word a, Word b, Word) { return texel(test_texture(0), clamp_signed(a, 7), clamp_signed(b, 5), 0); }};
  o["texelFetch 2D near"] = {
      [](Word a, Word b, Word) { return texel(test_texture(0), clamp_signed(a & 7u, 7), clamp_signed(b & 7u, 5), 0); }};
  o["texelFetch uniform"] = {[](Word, Word, Word) { return texel(test_texture(0), 3, 2, 0); }};
  o["texelFetch array"] = {[](Word a, Word b, Word c) {
    return texel(test_texture(3), clamp_signed(a & 7u, 7), clamp_signed(b & 3u, 5), clamp_signed(c & 3u, 3));
  }};
  o["textureSize"] = {[](Word, Word, Word) { return Words{7, 5, 3}; }};
  const auto filtered = [&](const char* name, int kind, bool repeat) {
    o[name] = {[=](Word a, Word b, Word) {
                 if (!moderate(a) || !moderate(b)) return Words{};
                 return bilinear(test_texture(kind), float_of(a), float_of(b), 0, repeat);
               },
               512, 1};
  };
  filtered("texture linear clamp", 0, false);
  filtered("texture linear repeat, power of two", 1, true);
  filtered("texture linear repeat", 2, true);
  o["texture array"] = {[](Word a, Word b, Word c) {
                          if (!moderate(a) || !moderate(b) || std::isnan(float_of(c))) return Words{};
                          const float layer = std::clamp(std::nearbyint(float_of(c)), 0.0f, 2.0f);
                          return bilinear(test_texture(3), float_of(a), float_of(b), static_cast<int>(layer), false);
                        },
                        512, 1};
  o["texture nearest"] = {[](Word a, Word b, Word) {
    if (!moderate(a) || !moderate(b)) return Words{};
    const auto at = [](double s, int size) { return (s - std::floor(s)) * size; };
    const double x = at(float_of(a), 7), y = at(float_of(b), 5);
    // On a texel's edge the last bit of the product decides.
    if (std::fabs(x - std::nearbyint(x)) < 1e-4 || std::fabs(y - std::nearbyint(y)) < 1e-4) return Words{};
    return texel(test_texture(5), static_cast<int>(x), static_cast<int>(y), 0);
  }};
  o["texture cube"] = {
      [](Word a, Word b, Word c) {
        const double d[3] = {float_of(a), float_of(b), float_of(c)};
        for (const double x : d) {
          if (!(std::fabs(x) < 4)) return Words{};
        }
        if (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]) < 0x1p-20) return Words{};  // .5 / |ma| overflows
        // The axis of the greatest magnitude; ties are left to the implementation.
        int axis = 0;
        for (int i = 1; i < 3; ++i) axis = std::fabs(d[i]) > std::fabs(d[axis]) ? i : axis;
        for (int i = 0; i < 3; ++i) {
          if (i != axis && std::fabs(d[i]) == std::fabs(d[axis])) return Words{};
        }
        // Directions of s and t on each face, OpenGL 4.5 table 8.19.
        constexpr double kS[6][3] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
        constexpr double kT[6][3] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
        const int face = axis * 2 + (d[axis] < 0);
        double s = 0, t = 0;
        for (int i = 0; i < 3; ++i) s += kS[face][i] * d[i], t += kT[face][i] * d[i];
        const double ma = std::fabs(d[axis]);
        return bilinear(test_texture(4), (s / ma + 1) / 2, (t / ma + 1) / 2, face, false);
      },
      512, 1};
  return o;
}

}  // namespace twinshade::test

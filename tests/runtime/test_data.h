// Rows of words for the sweeps: every triple of special values, then random bits, then random moderate floats.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace twinshade::test {

struct Rows {
  std::vector<std::uint32_t> a, b, c;
  std::size_t count() const { return a.size(); }
};

inline float float_of(std::uint32_t word) {
  float x;
  std::memcpy(&x, &word, 4);
  return x;
}
inline std::uint32_t word_of(float x) {
  std::uint32_t word;
  std::memcpy(&word, &x, 4);
  return word;
}
inline bool is_nan(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }
inline std::string show(std::uint32_t word) {
  char text[64];
  std::snprintf(text, sizeof text, "%#010x (%a)", word, static_cast<double>(float_of(word)));
  return text;
}

inline const std::vector<std::uint32_t>& special_words() {
  static const std::vector<std::uint32_t> words = {
      0x00000000,
      0x80000000,  // zeros; INT_MIN
      0x00000001,
      0x80000001,
      0x007fffff,  // denormals; 1
      0x00800000,
      0x80800000,  // least normal
      0x3f800000,
      0xbf800000,  // 1, -1
      0x3f000000,
      0xbf000000,  // 0.5, -0.5: halfway
      0x3fc00000,
      0x40200000,
      0xc0200000,  // 1.5, 2.5, -2.5
      0x3f7fffff,
      0x3eaaaaab,  // just below 1, 1/3
      0x4b000001,
      0x4effffff,
      0x4f000000,
      0xcf000000,
      0xcf000001,
      0x4f7fffff,
      0x4f800000,  // 2^23 + 1, around 2^31,
                   // 2^32
      0x7f7fffff,
      0xff7fffff,
      0x7f800000,
      0xff800000,
      0x7fc00000,
      0xffc00001,  // greatest, infinite, NaN
      0x00000002,
      0x00000007,
      0x0000001f,
      0x00000020,
      0x00000021,
      0x7fffffff,
      0xffffffff,
      0xfffffffe,
  };
  return words;
}

// count is a multiple of 16.
inline Rows make_rows() {
  Rows rows;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    rows.a.push_back(a), rows.b.push_back(b), rows.c.push_back(c);
  };
  const auto& special = special_words();
  for (const auto a : special) {
    for (const auto b : special) {
      for (std::size_t k = 0; k < special.size(); k += 3) add(a, b, special[(k + rows.count()) % special.size()]);
    }
  }
  std::mt19937 random(20240607);
  for (int i = 0; i < 8000; ++i) {
    const auto a = static_cast<std::uint32_t>(random()), b = static_cast<std::uint32_t>(random());
    add(a, b, static_cast<std::uint32_t>(random()));
  }
  const auto moderate = [&] { return word_of(static_cast<float>(static_cast<std::int32_t>(random())) * 0x1p-29f); };
  for (int i = 0; i < 8000; ++i) {
    const auto a = moderate(), b = moderate();
    add(a, b, moderate());
  }
  while (rows.count() % 16 != 0) add(0, 0, 0);
  return rows;
}

}  // namespace twinshade::test

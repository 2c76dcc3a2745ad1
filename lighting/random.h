// Counter-based random numbers: a hash of what is being sampled, so that a value never depends on the order or the
// thread in which it is asked for. Finaliser of splitmix64 (Steele, Lea and Flood, Fast splittable pseudorandom number
// generators, 2014); hash-based Owen scrambling after Burley, Practical hash-based Owen scrambling, JCGT 2020.
#pragma once

#include <cstdint>

namespace twinshade {

constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ull;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// A stream of a seed: `domain` keeps the uses of one seed apart, `a` and `b` are the counters.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t domain, std::uint64_t a, std::uint64_t b = 0) {
  std::uint64_t x = mix_bits(seed + 0x9e3779b97f4a7c15ull * (domain + 1));
  x = mix_bits(x + 0x9e3779b97f4a7c15ull * (a + 1));
  return mix_bits(x + 0x9e3779b97f4a7c15ull * (b + 1));
}

// [0, 1), 53 bits.
constexpr double unit_real(std::uint64_t bits) { return double(bits >> 11) * 0x1p-53; }

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

// Base-2 radical inverse of `index` as a 32-bit fraction, with a nested uniform (Owen) scramble: any 2^k consecutive
// indices starting at a multiple of 2^k fall one each into the 2^k equal parts of [0, 1), at a random place in each.
constexpr std::uint32_t scrambled_radical_inverse(std::uint32_t index, std::uint32_t seed) {
  std::uint32_t x = index;  // bit-reversed radical inverse: carries below go only from low to high bits
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x);
}

}  // namespace twinshade

// SHA-256, FIPS 180-4, sections 4.1.2, 5.1.1, 6.2.
#include "base/hash.h"

#include <bit>
#include <cstring>

#include "base/hash_instructions.h"

namespace twinshade {
namespace {

// FIPS 180-4, 4.2.2: first 32 bits of the fractional parts of the cube roots of the first 64 primes.
constexpr std::uint32_t kRound[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

// 6.2.2, step 3, but for the moves; key: K_t + W_t.
[[gnu::always_inline]] inline void round(std::uint32_t key, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                         std::uint32_t& d, std::uint32_t e, std::uint32_t f, std::uint32_t g,
                                         std::uint32_t& h) {
  const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + ((e & f) ^ (~e & g)) + key;
  d += t1;
  h = t1 + (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
}

void add_block(std::uint32_t state[8], const std::uint8_t* bytes) {
  std::uint32_t w[64];
  for (int i = 0; i < 16; ++i)
    w[i] = std::uint32_t(bytes[4 * i]) << 24 | std::uint32_t(bytes[4 * i + 1]) << 16 |
           std::uint32_t(bytes[4 * i + 2]) << 8 | bytes[4 * i + 3];
  for (int i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3)) + w[i - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10));
  }
  // The working variables move up by one each round: here their names do instead, so that they stay in registers.
  std::uint32_t a = state[0], b = state[1], c = state[2], d = state[3], e = state[4], f = state[5], g = state[6],
                h = state[7];
  for (int i = 0; i < 64; i += 8) {
    round(kRound[i] + w[i], a, b, c, d, e, f, g, h);
    round(kRound[i + 1] + w[i + 1], h, a, b, c, d, e, f, g);
    round(kRound[i + 2] + w[i + 2], g, h, a, b, c, d, e, f);
    round(kRound[i + 3] + w[i + 3], f, g, h, a, b, c, d, e);
    round(kRound[i + 4] + w[i + 4], e, f, g, h, a, b, c, d);
    round(kRound[i + 5] + w[i + 5], d, e, f, g, h, a, b, c);
    round(kRound[i + 6] + w[i + 6], c, d, e, f, g, h, a, b);
    round(kRound[i + 7] + w[i + 7], b, c, d, e, f, g, h, a);
  }
  const std::uint32_t after[8] = {a, b, c, d, e, f, g, h};
  for (int i = 0; i < 8; ++i) state[i] += after[i];
}

}  // namespace

Sha256::Sha256(bool portable)
    : by_instructions_(!portable && has_sha256_instructions()),
      state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19},
      pending_{} {}

void Sha256::add_blocks(const std::uint8_t* bytes, std::size_t count) {
  if (by_instructions_) return add_sha256_blocks(state_, bytes, count, kRound);
  for (; count > 0; --count, bytes += 64) add_block(state_, bytes);
}

void Sha256::add(const void* data, std::size_t count) {
  if (count == 0) return;  // data may be null
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  std::size_t used = length_ % 64;
  length_ += count;
  if (used != 0) {
    const std::size_t take = count < 64 - used ? count : 64 - used;
    std::memcpy(pending_ + used, bytes, take);
    bytes += take;
    count -= take;
    used += take;
    if (used < 64) return;
    add_blocks(pending_, 1);
  }
  add_blocks(bytes, count / 64);
  if (count % 64 != 0) std::memcpy(pending_, bytes + count / 64 * 64, count % 64);
}

std::string Sha256::hex() {
  const std::uint64_t bits = length_ * 8;
  const std::uint8_t one = 0x80, zero = 0;
  add(&one, 1);
  while (length_ % 64 != 56) add(&zero, 1);
  std::uint8_t tail[8];
  for (int i = 0; i < 8; ++i) tail[i] = std::uint8_t(bits >> (56 - 8 * i));
  add(tail, 8);
  std::string text;
  for (const std::uint32_t word : state_)
    for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[(word >> shift) & 15];
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

}  // namespace twinshade

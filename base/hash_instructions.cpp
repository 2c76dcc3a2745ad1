// SHA-256, FIPS 180-4, 6.2.2, four rounds at a time (Intel, "Intel SHA Extensions", 2013, for what the instructions
// do).
#include "base/hash_instructions.h"

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>

namespace twinshade {

bool has_sha256_instructions() {
  static const bool has = [] {  // asked once: a guest's cpuid may take the host's time
    unsigned eax, ebx, ecx, edx;
    if (!__get_cpuid(1, &eax, &ebx, &ecx, &edx) || !(ecx & bit_SSE4_1)) return false;
    return __get_cpuid_count(7, 0, &eax, &ebx, &ecx, &edx) && (ebx & bit_SHA);
  }();
  return has;
}

[[gnu::target("sha,sse4.1")]] void add_sha256_blocks(std::uint32_t state[8], const std::uint8_t* bytes,
                                                     std::size_t count, const std::uint32_t round_constants[64]) {
  const auto at = [](const void* p) { return static_cast<const __m128i*>(p); };
  const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
  // The instructions take the working variables in pairs of halves, highest lane first: a, b, e, f and c, d, g, h.
  const __m128i abcd = _mm_shuffle_epi32(_mm_loadu_si128(at(state)), 0x1b);
  const __m128i efgh = _mm_shuffle_epi32(_mm_loadu_si128(at(state + 4)), 0x1b);
  __m128i abef = _mm_unpackhi_epi64(efgh, abcd), cdgh = _mm_unpacklo_epi64(efgh, abcd);
  for (; count > 0; --count, bytes += 64) {
    const __m128i abef_before = abef, cdgh_before = cdgh;
    __m128i w[4];  // the last sixteen words of the message schedule
    for (int i = 0; i < 16; ++i) {
      __m128i& words = w[i % 4];
      if (i < 4) {
        words = _mm_shuffle_epi8(_mm_loadu_si128(at(bytes + 16 * i)), big_endian);
      } else {  // W_t = s1(W_(t-2)) + W_(t-7) + s0(W_(t-15)) + W_(t-16)
        const __m128i last = w[(i + 3) % 4], w_7 = _mm_alignr_epi8(last, w[(i + 2) % 4], 4);
        words = _mm_sha256msg2_epu32(_mm_add_epi32(_mm_sha256msg1_epu32(words, w[(i + 1) % 4]), w_7), last);
      }
      const __m128i keys = _mm_add_epi32(words, _mm_loadu_si128(at(round_constants + 4 * i)));
      cdgh = _mm_sha256rnds2_epu32(cdgh, abef, keys);
      abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(keys, 0x0e));
    }
    abef = _mm_add_epi32(abef, abef_before);
    cdgh = _mm_add_epi32(cdgh, cdgh_before);
  }
  auto* const out = reinterpret_cast<__m128i*>(state);
  _mm_storeu_si128(out, _mm_shuffle_epi32(_mm_unpackhi_epi64(cdgh, abef), 0x1b));
  _mm_storeu_si128(out + 1, _mm_shuffle_epi32(_mm_unpacklo_epi64(cdgh, abef), 0x1b));
}

}  // namespace twinshade

#else

#include <cstdlib>

namespace twinshade {

bool has_sha256_instructions() { return false; }
void add_sha256_blocks(std::uint32_t*, const std::uint8_t*, std::size_t, const std::uint32_t*) { std::abort(); }

}  // namespace twinshade

#endif

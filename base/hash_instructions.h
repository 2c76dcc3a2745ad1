// SHA-256's blocks by the instructions that x86 processors have for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace twinshade {

// True where this processor has them.
bool has_sha256_instructions();

// Adds `count` blocks of 64 bytes each to the state, a to h of FIPS 180-4; round_constants: its K, 64 of them. To be
// called only where has_sha256_instructions().
void add_sha256_blocks(std::uint32_t state[8], const std::uint8_t* bytes, std::size_t count,
                       const std::uint32_t round_constants[64]);

}  // namespace twinshade

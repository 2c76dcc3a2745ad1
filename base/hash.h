// Content hash: SHA-256, so that a cached or golden file with the same name is the same content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace twinshade {

class Sha256 {
 public:
  // By the processor's own instructions where it has them; `portable`: never, which gives the same digests.
  explicit Sha256(bool portable = false);
  void add(const void* bytes, std::size_t count);
  void add(std::string_view text) { add(text.data(), text.size()); }
  // 64 lower-case hex digits. The object is spent afterwards.
  std::string hex();

 private:
  void add_blocks(const std::uint8_t* bytes, std::size_t count);
  bool by_instructions_;
  std::uint32_t state_[8];
  std::uint8_t pending_[64];
  std::uint64_t length_ = 0;
};

std::string sha256_hex(std::string_view bytes);

}  // namespace twinshade

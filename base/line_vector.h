// std::vector whose first element begins a cache line: what writes whole lines of it past the caches, or reads them,
// meets each line once. Large ones lie in large pages where the system has them: what is read here and there would
// otherwise wait for addresses to be looked up, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace twinshade {

inline constexpr std::size_t kCacheLine = 64;  // bytes

// To be given back with free_lines.
void* allocate_lines(std::size_t bytes);
void free_lines(void* p, std::size_t bytes);

template <class T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(allocate_lines(count * sizeof(T))); }
  void deallocate(T* p, std::size_t count) { free_lines(p, count * sizeof(T)); }
  template <class U>
  bool operator==(const LineAllocator<U>&) const {
    return true;
  }
};

template <class T>
using LineVector = std::vector<T, LineAllocator<T>>;

}  // namespace twinshade

// Compiled once, optimised: code built without optimisation, which handles frames too, would clear them at a tenth of
// the speed, and the linker may take its functions for all.
extern template class std::vector<float, twinshade::LineAllocator<float>>;
extern template class std::vector<std::uint32_t, twinshade::LineAllocator<std::uint32_t>>;
extern template class std::vector<std::uint8_t, twinshade::LineAllocator<std::uint8_t>>;

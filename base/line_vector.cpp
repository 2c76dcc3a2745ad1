#include "base/line_vector.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace twinshade {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

std::align_val_t alignment(std::size_t bytes) {
  return std::align_val_t{bytes >= kLargePage ? kLargePage : kCacheLine};
}

}  // namespace

void* allocate_lines(std::size_t bytes) {
  void* p = ::operator new(bytes, alignment(bytes));
#if defined(__linux__)
  if (bytes >= kLargePage) ::madvise(p, bytes, MADV_HUGEPAGE);  // a wish: systems without them go on as they did
#endif
  return p;
}

void free_lines(void* p, std::size_t bytes) { ::operator delete(p, alignment(bytes)); }

}  // namespace twinshade

template class std::vector<float, twinshade::LineAllocator<float>>;
template class std::vector<std::uint32_t, twinshade::LineAllocator<std::uint32_t>>;
template class std::vector<std::uint8_t, twinshade::LineAllocator<std::uint8_t>>;

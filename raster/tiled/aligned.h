// Scratch memory on cache-line boundaries, allocated once.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include "base/line_vector.h"

namespace twinshade::tiled {

template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count)
      : data_(static_cast<T*>(allocate_lines(count * sizeof(T))), Free{count * sizeof(T)}) {
    std::uninitialized_value_construct_n(data_.get(), count);
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    std::size_t bytes = 0;
    void operator()(T* p) const { free_lines(p, bytes); }
  };
  std::unique_ptr<T, Free> data_;
};

}  // namespace twinshade::tiled

#include <doctest/doctest.h>

#include <cstdint>

#include "base/line_vector.h"

using namespace twinshade;

TEST_CASE("vectors of lines begin cache lines, large ones large pages, and hold what they are given") {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 18, (std::size_t{1} << 19) - 1,
                                  std::size_t{1} << 19, (std::size_t{3} << 19) + 5}) {
    CAPTURE(count);
    LineVector<float> values(count, 0.5f);
    const auto address = reinterpret_cast<std::uintptr_t>(values.data());
    CHECK(address % kCacheLine == 0);
    if (count * sizeof(float) >= std::size_t{2} << 20) CHECK(address % (std::uintptr_t{2} << 20) == 0);
    values.back() = 2;
    values.push_back(3);
    CHECK(values[0] == (count == 1 ? 2.0f : 0.5f));
    CHECK(values[count - 1] == 2);
    CHECK(values[count] == 3);
  }
}

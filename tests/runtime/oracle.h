// What operations must give, computed another way: in double (whose single rounding back to float is exact for + - * /
// sqrt of floats), 128-bit integers, the standard library or GLM.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/runtime/test_data.h"

namespace twinshade::test {

struct Oracle {
  // Expected words for one row; an empty vector where the row is undefined and skipped.
  std::function<std::vector<std::uint32_t>(std::uint32_t a, std::uint32_t b, std::uint32_t c)> expect;
  // 0: the same bits (NaN as a class). Else: floats may differ by this many ULP, of the expected value or of `least`
  // where that is greater.
  double ulp = 0;
  double least = 0;
};

// flush: denormal operands and results count as zero.
std::map<std::string, Oracle> arithmetic_oracles(bool flush);
std::map<std::string, Oracle> builtin_oracles();  // on rows whose floats are no denormals
std::map<std::string, Oracle> vector_oracles();   // GLM; on moderate floats
std::map<std::string, Oracle> memory_oracles();

}  // namespace twinshade::test

// One line per operation and denormal mode: the hash of its results over the sweep's rows, by 4 lanes. Run on two
// machines, the lines must be equal. NaN count as a class. With denormals flushed the least normal number counts as
// zero: x86 decides after rounding whether a result is tiny, Arm before.
#include <cstdio>

#include "base/hash.h"
#include "cpu_shaders/runtime/denormals.h"
#include "tests/runtime/operations.h"
#include "tests/runtime/test_data.h"

int main() {
  using namespace twinshade;
  using namespace twinshade::test;
  const Rows rows = make_rows();
  for (const auto sets : {arithmetic_operations_baseline(), builtin_operations_baseline(), vector_operations_baseline(),
                          memory_operations_baseline()}) {
    const OperationSet& set = sets.sets[0];
    for (int k = 0; k < set.count; ++k) {
      const Operation& operation = set.operations[k];
      for (const bool flush : {false, true}) {
        std::vector<std::uint32_t> out(rows.count() * static_cast<std::size_t>(operation.results));
        {
          const DenormalMode mode(flush);
          operation.run(rows.a.data(), rows.b.data(), rows.c.data(), out.data(), rows.count());
        }
        for (std::uint32_t& word : out) {
          if (!operation.real_results) continue;
          if (is_nan(word)) word = 0x7fc00000u;
          if (flush && (word & 0x7fffffffu) == 0x00800000u) word &= 0x80000000u;
        }
        Sha256 hash;
        hash.add(out.data(), out.size() * 4);
        std::printf("%s %s: %s\n", operation.name, flush ? "flushed" : "kept", hash.hex().c_str());
      }
    }
  }
}

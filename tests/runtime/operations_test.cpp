// Every operator and built-in of every lane count and instruction set gives the bits that the scalar policy gives, and
// the scalar policy gives what independent computations expect.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "cpu_shaders/machine.h"
#include "cpu_shaders/runtime/denormals.h"
#include "tests/runtime/operations.h"
#include "tests/runtime/oracle.h"

namespace twinshade::test {
namespace {

using Getter = OperationSets (*)();
struct GroupOfSets {
  const char* name;
  Getter by_isa[3];
};
#if defined(__x86_64__)
#define TWINSHADE_TEST_GROUP(group)                                                             \
  {                                                                                             \
#group, { group##_operations_baseline, group##_operations_avx2, group##_operations_avx512 } \
  }
#else
#define TWINSHADE_TEST_GROUP(group)                           \
  {                                                           \
#group, { group##_operations_baseline, nullptr, nullptr } \
  }
#endif
const GroupOfSets kGroups[] = {TWINSHADE_TEST_GROUP(arithmetic), TWINSHADE_TEST_GROUP(builtin),
                               TWINSHADE_TEST_GROUP(vector), TWINSHADE_TEST_GROUP(memory)};
const char* const kIsaNames[] = {"baseline", "avx2", "avx512"};

const OperationSet& scalar_set(const GroupOfSets& group) {
  const OperationSets sets = group.by_isa[0]();
  for (int i = 0; i < sets.count; ++i) {
    if (std::string(sets.sets[i].policy) == "scalar") return sets.sets[i];
  }
  throw std::logic_error("no scalar policy");
}

std::vector<std::uint32_t> run(const Operation& operation, const Rows& rows, bool flush) {
  std::vector<std::uint32_t> out(rows.count() * static_cast<std::size_t>(operation.results));
  const DenormalMode mode(flush);
  operation.run(rows.a.data(), rows.b.data(), rows.c.data(), out.data(), rows.count());
  return out;
}

bool same(std::uint32_t x, std::uint32_t y, bool real) { return x == y || (real && is_nan(x) && is_nan(y)); }

std::string row_text(const Rows& rows, std::size_t i) {
  return fmt::format("a {} b {} c {}", show(rows.a[i]), show(rows.b[i]), show(rows.c[i]));
}

// Mismatches of `set` with the scalar policy's `expected`; the first is reported.
void compare_with_scalar(const GroupOfSets& group, const char* isa, const OperationSet& set, bool flush,
                         const Rows& rows, const std::vector<std::vector<std::uint32_t>>& expected) {
  const OperationSet& scalar = scalar_set(group);
  REQUIRE(set.count == scalar.count);
  for (int k = 0; k < set.count; ++k) {
    const Operation& operation = set.operations[k];
    REQUIRE(std::string(operation.name) == scalar.operations[k].name);
    const auto& want = expected[static_cast<std::size_t>(k)];
    const auto got = run(operation, rows, flush);
    std::size_t differ = 0, first = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (!same(got[i], want[i], operation.real_results) && differ++ == 0) first = i;
    }
    CHECK_MESSAGE(differ == 0, std::string(operation.name), " ", std::string(set.policy), " ", std::string(isa),
                  std::string(flush ? " flushed" : " kept"), ": ", differ, " differ; ",
                  row_text(rows, first % rows.count()), " result ", first / rows.count(), " is ", show(got[first]),
                  ", scalar ", show(want[first]));
  }
}

double ulp_of(double x) { return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23); }

void compare_with_oracles(const OperationSet& set, const std::map<std::string, Oracle>& oracles, bool flush,
                          const Rows& rows) {
  std::size_t used = 0;
  for (int k = 0; k < set.count; ++k) {
    const Operation& operation = set.operations[k];
    const auto oracle = oracles.find(operation.name);
    if (oracle == oracles.end()) continue;
    ++used;
    const auto got = run(operation, rows, flush);
    std::size_t wrong = 0, defined = 0;
    std::string first;
    for (std::size_t i = 0; i < rows.count(); ++i) {
      const auto want = oracle->second.expect(rows.a[i], rows.b[i], rows.c[i]);
      if (want.empty()) continue;
      ++defined;
      REQUIRE(want.size() == static_cast<std::size_t>(operation.results));
      for (std::size_t r = 0; r < want.size(); ++r) {
        const std::uint32_t have = got[r * rows.count() + i];
        bool good = same(have, want[r], operation.real_results);
        if (!good && oracle->second.ulp > 0 && operation.real_results) {
          const double x = float_of(have), e = float_of(want[r]);
          const double unit = ulp_of(std::max(std::fabs(e), oracle->second.least));
          good = std::fabs(x - e) <= oracle->second.ulp * unit;
        }
        if (!good && wrong++ == 0) {
          first = fmt::format("{} result {} is {}, expected {}", row_text(rows, i), r, show(have), show(want[r]));
        }
      }
    }
    CHECK_MESSAGE(wrong == 0, std::string(operation.name), std::string(flush ? " flushed" : " kept"), ": ", wrong,
                  " wrong; ", first);
    CHECK_MESSAGE(defined > 100, std::string(operation.name), ": only ", defined, " rows are defined");
  }
  CHECK(used == oracles.size());  // none is misspelt
}

Rows without_denormals(const Rows& rows) {
  Rows kept;
  const auto denormal = [](std::uint32_t w) { return std::fpclassify(float_of(w)) == FP_SUBNORMAL; };
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (denormal(rows.a[i]) || denormal(rows.b[i]) || denormal(rows.c[i])) continue;
    kept.a.push_back(rows.a[i]), kept.b.push_back(rows.b[i]), kept.c.push_back(rows.c[i]);
  }
  while (kept.count() % 16 != 0) kept.a.push_back(0), kept.b.push_back(0), kept.c.push_back(0);
  return kept;
}

}  // namespace

TEST_CASE("every lane count and instruction set gives the scalar policy's bits") {
  const Rows rows = make_rows();
  for (const GroupOfSets& group : kGroups) {
    for (const bool flush : {true, false}) {
      const OperationSet& scalar = scalar_set(group);
      std::vector<std::vector<std::uint32_t>> expected;
      for (int k = 0; k < scalar.count; ++k) expected.push_back(run(scalar.operations[k], rows, flush));
      for (int isa = 0; isa < 3; ++isa) {
        if (group.by_isa[isa] == nullptr) continue;
        if (isa > static_cast<int>(machine_isa())) {
          MESSAGE("skipped: this processor has no ", kIsaNames[isa]);
          continue;
        }
        const OperationSets sets = group.by_isa[isa]();
        for (int i = 0; i < sets.count; ++i) {
          compare_with_scalar(group, kIsaNames[isa], sets.sets[i], flush, rows, expected);
        }
      }
    }
  }
}

TEST_CASE("operators are IEEE's, wrapping and defined everywhere, with denormals kept and flushed") {
  const Rows rows = make_rows();
  for (const bool flush : {false, true}) {
    compare_with_oracles(scalar_set(kGroups[0]), arithmetic_oracles(flush), flush, rows);
  }
}
TEST_CASE("built-ins of one number agree with the C library, bit by bit or within their ULP") {
  compare_with_oracles(scalar_set(kGroups[1]), builtin_oracles(), false, without_denormals(make_rows()));
}
TEST_CASE("vector and matrix functions agree with GLM in double") {
  compare_with_oracles(scalar_set(kGroups[2]), vector_oracles(), false, make_rows());
}
TEST_CASE("dynamic indexing, buffers and textures address what they should") {
  compare_with_oracles(scalar_set(kGroups[3]), memory_oracles(), false, make_rows());
}

}  // namespace twinshade::test

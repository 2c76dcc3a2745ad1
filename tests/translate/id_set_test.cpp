// IdSet against std::set.
#include "cpu_shaders/translate/id_set.h"

#include <doctest/doctest.h>

#include <random>
#include <set>

namespace twinshade::spirv {

TEST_CASE("sets that share their parts are sets, and stay as they are when others made of them change") {
  std::mt19937 random(1);
  constexpr Id kIds[] = {0, 1, 2, 3, 5, 8, 1000, 1001, 65536, 0x7fffffffu, 0x80000000u, 0xfffffffeu, 0xffffffffu};
  struct Pair {
    IdSet set;
    std::set<Id> expected;
  };
  Pair pairs[8];
  const auto agree = [&](const Pair& p) {
    for (const Id id : kIds)
      if (p.set.count(id) != (p.expected.count(id) != 0)) return false;
    return true;
  };
  int equal = 0;
  for (int step = 0; step < 20000; ++step) {
    Pair& p = pairs[random() % 8];
    const Pair& other = pairs[random() % 8];
    const Id id = kIds[random() % std::size(kIds)];
    switch (random() % 5) {
      case 0:
      case 1:
        p.set.insert(id), p.expected.insert(id);
        break;
      case 2:
      case 3:
        p.set.erase(id), p.expected.erase(id);
        break;
      default:
        if (random() % 2 != 0)
          p.set.insert(other.set), p.expected.insert(other.expected.begin(), other.expected.end());
        else
          p = other;
    }
    REQUIRE(agree(p));
    REQUIRE(agree(other));
    for (const Pair& q : pairs) {
      REQUIRE((q.set == p.set) == (q.expected == p.expected));
      equal += q.expected == p.expected;
    }
  }
  CHECK(equal > 20000);
}

}  // namespace twinshade::spirv

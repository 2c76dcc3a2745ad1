// The properties of all_directions.h for 10^8 directions: minutes.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "tests/basis/all_directions.h"

namespace twinshade::test {
namespace {

constexpr std::size_t kDirections = 100'000'000, kBlock = 20'000;

template <class Check>
void for_all_blocks(Check check) {
  parallel_for(kDirections / kBlock, [&](std::size_t block, int) {
    Uniform uniform(1000 + block);
    std::vector<glm::dvec3> directions;
    directions.reserve(kBlock);
    for (std::size_t i = 0; i < kBlock; ++i) directions.push_back(awkward_direction(uniform));
    check(directions);
  });
}

}  // namespace

TEST_CASE("10^8 directions: the triangle is the one that brute force finds") {
  std::atomic<int> wrong = 0;
  for_all_blocks([&](const std::vector<glm::dvec3>& directions) { wrong += count_wrong_triangles(directions); });
  CHECK(wrong == 0);
}

TEST_CASE("10^8 directions: no basis gives NaN") {
  std::set<std::string> files;
  std::vector<const TechniqueInfo*> chosen;  // one of each file
  for (const TechniqueInfo& basis : techniques())
    if (basis.is_basis && files.insert(std::string(basis.file)).second) chosen.push_back(&basis);
  std::vector<std::atomic<int>> bad(chosen.size());
  for_all_blocks([&](const std::vector<glm::dvec3>& directions) {
    for (std::size_t i = 0; i < chosen.size(); ++i) bad[i] += count_not_finite(*chosen[i], directions);
  });
  for (std::size_t i = 0; i < chosen.size(); ++i) CHECK_MESSAGE(bad[i] == 0, std::string(chosen[i]->name));
}

}  // namespace twinshade::test

// What is estimated of a scene's memory, where the program cannot be made to need it.
#include "app/memory_needed.h"

#include <doctest/doctest.h>

#include <string>

#include "base/error.h"

using namespace twinshade;

namespace {

// The refusal; empty where there is none.
template <class Check>
std::string refusal(const Check& check) {
  try {
    check();
    return "";
  } catch (const UserError& error) {
    return error.what();
  }
}

LitTechnique lit(const char* name, CoefficientStorage storage) { return {&find_technique(name), storage}; }

}  // namespace

TEST_CASE("light that vertices keep is estimated by vertices and coefficients, and refused where it cannot fit") {
  constexpr std::size_t kMany = std::size_t{1} << 40;
  const auto of = [&](std::size_t vertices, const std::vector<LitTechnique>& baked) {
    return refusal([&] { require_vertex_memory(vertices, baked); });
  };
  const std::string sh5 = of(kMany, {lit("sh5", CoefficientStorage::vertex)});
  CHECK(sh5.find("light of 1099511627776 vertices, 25 coefficients each, needs 1105920.0 GiB") == 0);
  CHECK(sh5.find("fewer techniques") != std::string::npos);
  // What is kept of several is kept side by side; few coefficients take what baking does.
  CHECK(of(kMany, {lit("sh5", CoefficientStorage::vertex), lit("sh3", CoefficientStorage::vertex)})
            .find("34 coefficients each, needs 1400832.0 GiB") != std::string::npos);
  CHECK(of(kMany, {lit("h4", CoefficientStorage::vertex)}).find("needs 573440.0 GiB") != std::string::npos);
  CHECK(of(1000, {lit("sh5", CoefficientStorage::vertex)}).empty());
  CHECK(of(kMany, {lit("sh5", CoefficientStorage::lightmap), lit("sh3", CoefficientStorage::volume)}).empty());
}

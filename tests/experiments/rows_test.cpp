#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "experiments/experiment.h"
#include "experiments/probe_light.h"
#include "lighting/registry.h"

using namespace twinshade;

TEST_CASE("probes of one file name have names of their own") {
  ExperimentOptions options;
  options.probes = {"p1/x.hdr", "p2/x.hdr", "x-2.exr", "p3/x.hdr"};
  CHECK(probe_names(options) == std::vector<std::string>{"x", "x-2", "x-2-2", "x-3"});
}

TEST_CASE("CSV quotes what needs it, keeps every digit and leaves undefined cells empty") {
  Rows rows({"basis", "norm", "count"});
  rows.add({std::string("a, \"b\""), 0.1, std::int64_t{3}});
  rows.add({std::string("plain"), number_cell(std::numeric_limits<double>::infinity()), Cell()});
  CHECK(rows.csv() == "basis,norm,count\n\"a, \"\"b\"\"\",0.10000000000000001,3\nplain,,\n");
  CHECK(rows.number(0, "norm") == 0.1);
  CHECK(rows.number(0, "count") == 3);
  CHECK(std::isnan(rows.number(1, "norm")));
}

TEST_CASE("an experiment that does not exist is answered with the nearest name") {
  CHECK_THROWS_WITH_AS(find_experiment("frobenus"), doctest::Contains("frobenius"), UserError);
}

TEST_CASE("only bases that an experiment can measure are named where one does not exist") {
  ExperimentOptions options;
  options.bases = {"foo"};
  for (const ExperimentInfo& experiment : experiments()) {
    if (std::find(experiment.options.begin(), experiment.options.end(), "--basis") == experiment.options.end())
      continue;
    CAPTURE(experiment.name);
    std::string said;
    try {
      experiment.run(options);
    } catch (const UserError& error) {
      said = error.what();
    }
    CHECK(said.starts_with("unknown basis 'foo'; known: "));
    for (const TechniqueInfo& technique : techniques())
      if (!technique.is_basis) CHECK((said + ",").find(" " + std::string(technique.name) + ",") == std::string::npos);
  }
}

TEST_CASE("a basis that does not exist, or is none, is refused by every experiment") {
  for (const ExperimentInfo& experiment : experiments()) {
    CAPTURE(experiment.name);
    ExperimentOptions options;
    options.bases = {"sh33"};
    options.maps = {"cubic"};
    CHECK_THROWS_AS(experiment.run(options), UserError);
    options.bases = {"facets"};
    CHECK_THROWS_AS(experiment.run(options), UserError);
  }
}

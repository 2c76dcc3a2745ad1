// stability: where a method fails, how badly, and with which input. Each test looks for the input that a basis or a
// sphere map does worst at, running the method's own GLSL.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"

namespace twinshade {

struct StabilityOptions {
  std::vector<std::string> methods{};  // bases and sphere maps; empty: all
  std::vector<std::string> tests{};    // empty: all
  // Empty, or a folder with one's own GLSL of bases, under basis/, by the names of the built-in files: those are
  // tested.
  std::string include_folder{};
  std::uint64_t seed = 1;  // of random coefficients
  bool pictures = true;
  std::function<void(const std::string&)> progress = [](const std::string&) {};  // from one thread at a time
};

struct StabilityTestInfo {
  std::string_view name, description;
};
std::span<const StabilityTestInfo> stability_tests();

// Rows `method test measure value unit verdict input light normal other_normal coefficients`, by method, in the order
// of the registry, then by test. input: for people; light (the sun's direction), normals and coefficients (RGB after
// RGB): the same in full, as hex floats. verdict: "ok", "poor" (beyond what the test allows: docs/stability.md),
// "fails" (NaN or infinite where the method should have a value), or empty where there is nothing to judge. The same
// rows, bit by bit, for any number of threads. UserError for names that do not exist, with the nearest ones, for tests
// that none of the methods can be put to, and for a folder that has not what is asked for.
ExperimentResult run_stability(const StabilityOptions& options);

// Names of all pictures that it may give.
std::vector<std::string> stability_pictures();

// Whether some row's verdict is "fails".
bool stability_fails(const Rows& rows);

}  // namespace twinshade

// A difference between two frames, for people and as JSON.
#pragma once

#include <string>

#include "app/output.h"
#include "golden/compare_frames.h"

namespace twinshade {

// Several lines: first layer that differs, pixel, both values in decimal and hex float, ULP, the shader's inputs, the
// worst others and a histogram. frame_a: of the two, the one that comparison calls a.
std::string describe_mismatch(const std::string& technique, const std::string& a, const std::string& b,
                              const Comparison& comparison, const Frame& frame_a);

// {"layer", "x", "y", "component", "a", "b", "a_hex", "b_hex", "ulp", "inputs"}; null where nothing differs.
Json difference_json(const std::optional<Difference>& difference, const Frame& frame_a);

}  // namespace twinshade

// A difference between two frames, for people and as JSON.
#pragma once

#include <string>

#include "app/output.h"
#include "app/report/case_result.h"
#include "golden/compare_frames.h"
#include "golden/pictures.h"

namespace twinshade {

// Several lines: first layer that differs, pixel, both values in decimal and hex float, ULP, the shader's inputs, the
// worst others and a histogram. frame_a: of the two, the one that comparison calls a.
std::string describe_mismatch(const std::string& technique, const std::string& a, const std::string& b,
                              const Comparison& comparison, const Frame& frame_a);

// Both frames, named a and b, and where they differ, about the pixel of `first`. The frames are of one size.
CaseResult::Pictures mismatch_pictures(const std::string& a, const Frame& frame_a, const std::string& b,
                                       const Frame& frame_b, const std::optional<Difference>& first,
                                       const PictureOptions& options = {});

// {"layer", "x", "y", "component", "a", "b", "a_hex", "b_hex", "ulp", "inputs"}; null where nothing differs.
Json difference_json(const std::optional<Difference>& difference, const Frame& frame_a);

// "shaded_pixels", "coverage_differs" and the other counts, "max_ulp", "first_difference": difference_json's.
void add_comparison(Json& json, const Comparison& comparison, const Json& first_difference);

}  // namespace twinshade

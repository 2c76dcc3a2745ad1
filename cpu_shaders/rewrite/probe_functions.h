// What probes are made of: GLSL that stands before a probed shader.
#pragma once

#include <string>

namespace twinshade::lint_detail {

inline constexpr const char* kGlobals = "twinshadeprobe_globals";  // tells of globals; to be defined behind the shader
inline constexpr const char* kThrough = "twinshadeprobe_through";
inline constexpr const char* kKept = "twinshadeprobe_kept";  // variables kept_bool, kept_int, kept_uint

// Overloads of twinshadeprobe_tell, and of twinshadeprobe_through, which also gives back what it was given.
std::string probe_functions();

}  // namespace twinshade::lint_detail

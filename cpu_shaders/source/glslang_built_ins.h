// Which of glslang's built-in functions it declares. It declares each in GLSL, parses that text in every process, once
// for each version, and most of it is functions that only an extension brings: none of those is translated
// (docs/glsl-support.md). Without them a process' first translation takes a quarter of the time (docs/on-demand.md).
#pragma once

#include <string_view>

namespace twinshade {

// Functions of this name come with an extension and are not declared: subgroup operations, sparse textures, what ends
// in ARB, AMD, NV or EXT.
bool is_left_out(std::string_view function);

}  // namespace twinshade

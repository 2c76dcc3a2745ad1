// Shaders that do not end. Loops whose end nobody can tell count their iterations while they run.
#pragma once

#include <cstdint>

namespace twinshade {

// Of one group of lanes, in all such loops together.
inline constexpr std::uint32_t kMostIterations = 1u << 26;

// What a shader calls when there are more. Throws UserError. where: "file:line" of the loop.
[[noreturn]] void stop_endless_loop(const char* where);

}  // namespace twinshade

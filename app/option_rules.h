// Which options of a verb need or exclude each other: one that would be ignored is refused instead.
#pragma once

#include <CLI/CLI.hpp>

namespace twinshade {

// --shader draws with that shader alone, --technique with others.
inline void require_one_shader(CLI::App& command) {
  command.get_option("--shader")->excludes(command.get_option("--technique"));
}

// --blend is the part of --env2.
inline void require_second_environment(CLI::App& command) {
  command.get_option("--blend")->needs(command.get_option("--env2"));
}

}  // namespace twinshade

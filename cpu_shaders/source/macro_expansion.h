// How much text macros make of a shader, told before it is preprocessed: a few short ones that stand within each other
// can make more than memory holds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace twinshade {

struct MacroUse {
  std::size_t macros = 0;  // #define lines
  double tokens = 0;       // at most that all uses of macros become
  // Cannot be told: macros within each other, ##, or the name of one that takes arguments without its arguments, which
  // may get them elsewhere.
  bool unclear = false;
};

// Conditionals are not decided: of several definitions of one name the largest counts.
MacroUse estimate_macros(std::string_view text);

}  // namespace twinshade

// The system's C++ compiler.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/error.h"

namespace twinshade {

struct Compiler {
  std::vector<std::string> command;  // the program's path, then words that belong to it: "/usr/bin/ccache" "g++"
  std::string identity;              // changes with the compiler's version
};

// The compiler was waited for in vain: nobody should wait for it again for the same thing.
class CompilerTimeout : public UserError {
 public:
  using UserError::UserError;
};

// asked: a name or path, perhaps with words after it ("ccache g++"); empty: the first of $CXX, clang++, g++, c++ that
// is there. clang++ comes before g++ since it makes as fast code in two thirds of the time. UserError where there is
// none, or where the one asked for, by argument or by $CXX, is not there (another one would be a surprise) or has words
// after it that change values or make what cannot be loaded (-ffast-math, -fsanitize=address, -m32).
// patience: for a wrapper's answer to --version; UserError where it has none by then.
Compiler find_compiler(const std::string& asked = {}, std::chrono::milliseconds patience = std::chrono::seconds(20));

}  // namespace twinshade

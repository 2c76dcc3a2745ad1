// The system's C++ compiler.
#pragma once

#include <string>
#include <vector>

namespace twinshade {

struct Compiler {
  std::vector<std::string> command;  // the program's path, then words that belong to it: "/usr/bin/ccache" "g++"
  std::string identity;              // changes with the compiler's version
};

// asked: a name or path, perhaps with words after it ("ccache g++"); empty: the first of $CXX, clang++, g++, c++ that
// is there. clang++ comes before g++ since it makes as fast code in two thirds of the time. UserError where there is
// none, or where the one asked for, by argument or by $CXX, is not there (another one would be a surprise) or has words
// after it that change values or make what cannot be loaded (-ffast-math, -fsanitize=address, -m32).
Compiler find_compiler(const std::string& asked = {});

struct ProgramResult {
  int status;          // exit status; -1: could not be started, or was killed
  std::string output;  // stdout and stderr
};
// Runs words[0], a path, and waits for it. It and what it starts may take 300 s of processor time and 4 GiB of addresses each.
ProgramResult run_program(const std::vector<std::string>& words);

}  // namespace twinshade

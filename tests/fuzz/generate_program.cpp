// Writes a generated program:  generate_program SEED [FILE.frag]
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "tests/fuzz/program_generator.h"

int main(int count, char** arguments) {
  if (count < 2 || count > 3) {
    std::cerr << "usage: generate_program SEED [FILE.frag]\n";
    return 2;
  }
  const std::string text = twinshade::fuzz::generate_program(std::strtoull(arguments[1], nullptr, 10)).text;
  if (count == 2) {
    std::cout << text;
    return 0;
  }
  std::ofstream file(arguments[2]);
  file << text;
  return file.flush() ? 0 : 2;
}

// The author's lines, found again by file and number.
#pragma once

#include <map>
#include <string>

#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/translate/spirv_module.h"

namespace twinshade {

class SourceLines {
 public:
  explicit SourceLines(const ShaderSource& source);

  // Trimmed text of a line; empty where there is none.
  const std::string& text(const std::string& file, int line) const;

  // Position of a line in the whole text.
  std::size_t order(const spirv::Position& position) const;

  // Where `name` is first declared as a global: the line that has it as a word and begins with a qualifier or continues
  // such a declaration. SPIR-V gives global variables no position.
  spirv::Position declaration(const std::string& name) const;

 private:
  struct Line {
    std::string file, text;
    int number;
  };
  std::vector<Line> lines_;
  std::map<std::pair<std::string, int>, std::size_t> index_;
};

}  // namespace twinshade

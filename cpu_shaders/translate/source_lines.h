// The author's lines, found again by file and number.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"

namespace twinshade {

struct Position {
  std::string file;
  int line = 0;
  std::string text() const { return file + ":" + std::to_string(line); }
};

class SourceLines {
 public:
  explicit SourceLines(const ShaderSource& source);

  // Trimmed text of a line; empty where there is none.
  const std::string& text(const std::string& file, int line) const;

  // Position of a line in the whole text.
  std::size_t order(const Position& position) const;

  // Where `name` is first declared as a global: the line that has it as a word, outside comments, and a qualifier; the
  // first that has it at all where there is none. SPIR-V gives global variables no position.
  Position declaration(const std::string& name) const;

  // The last line.
  Position last() const;

  // The first line with one of the words, outside comments.
  Position mention(const std::vector<std::string>& words) const;

 private:
  struct Line {
    std::string file, text, code;  // code: without comments
    int number;
  };
  std::vector<Line> lines_;
  std::map<std::pair<std::string, int>, std::size_t> index_;
};

}  // namespace twinshade

// The lines of Wavefront OBJ files (Advanced Visualizer manual, appendix B1), so that assimp misreads none of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace twinshade {

// The statements of a text whose lines end in line feeds: each without the blanks and carriage returns around it, with
// the lines that it goes on in behind a backslash. Comments and empty lines are empty statements.
class ObjLines {
 public:
  explicit ObjLines(std::string_view text) : text_(text) {}
  bool next();                                               // false: there are no more
  std::string_view statement() const { return statement_; }  // as long as text lives and next is not called
  std::size_t number() const { return number_; }             // of its first line, from 1

 private:
  std::string_view take_line();

  std::string_view text_;  // what is left
  std::string_view statement_;
  std::string joined_;
  std::size_t number_ = 0, lines_ = 0;
};

// The word that the text begins with, for messages.
std::string shown_word(std::string_view text);

// Adds a statement to `text` in the form in which assimp 5.2 reads it as it is meant. It stops at comments in faces,
// takes .5 for no number, and skips vertices with other counts of numbers than it knows, so that later faces name other
// vertices than they should: those are refused. Statements that are not drawn are left out. UserError naming `path` and
// the line.
void add_statement(std::string& text, std::string_view statement, const std::string& path, std::size_t number);

// What a statement asks for that is not drawn; empty: nothing, or what is refused elsewhere.
std::string undrawn_statement(std::string_view statement);

// Adds Kd with the numbers of a colour of a material library: one stands for three. UserError naming `path` and the
// line where there is another count, or none.
void add_colour(std::string& text, std::string_view numbers, const std::string& path, std::size_t line);

}  // namespace twinshade

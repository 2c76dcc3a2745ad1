// Indented lines of C++.
#pragma once

#include <string>
#include <vector>

namespace twinshade::spirv {

// Between quotes, as a string literal or the file of a #line.
std::string quoted(const std::string& text);

class Writer {
 public:
  void line(const std::string& text);   // indented, wrapped at 120 columns; empty: an empty line
  void raw(const std::string& text);    // as it is: preprocessor lines
  void open(const std::string& text) {  // text, then deeper
    line(text);
    ++depth_;
  }
  void close(const std::string& text) {
    --depth_;
    line(text);
  }
  void indent() { ++depth_; }
  void outdent() { --depth_; }

  // Everything written since `mark`, taken back.
  std::size_t mark() const { return lines_.size(); }
  std::vector<std::string> take(std::size_t mark);
  void append(const std::vector<std::string>& lines) { lines_.insert(lines_.end(), lines.begin(), lines.end()); }
  int depth() const { return depth_; }
  std::string text() const;

 private:
  std::vector<std::string> lines_;
  int depth_ = 0;
};

}  // namespace twinshade::spirv

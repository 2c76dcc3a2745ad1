// The two kinds of failure.
//
// UserError: something the caller can put right (bad GLSL, missing file, wrong size). One line that names the file,
// the line where there is one, and the remedy. The command line prints it on stderr and exits with 2.
// Broken invariants: our own mistake. TWINSHADE_CHECK_* print both values with file and line, then abort.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>

namespace twinshade {

class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& one_line) : std::runtime_error(one_line) {}
};

namespace detail {
template <class A, class B>
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const A& a, const B& b) {
  std::ostringstream text;
  text << file << ':' << line << ": broken invariant: " << expression << " (left " << a << ", right " << b << ")\n";
  std::fputs(text.str().c_str(), stderr);
  std::abort();
}
}  // namespace detail

#define TWINSHADE_CHECK_OP_(a, op, b)                                                                   \
  do {                                                                                                  \
    const auto& check_left_ = (a);                                                                      \
    const auto& check_right_ = (b);                                                                     \
    if (!(check_left_ op check_right_))                                                                 \
      ::twinshade::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b, check_left_, check_right_); \
  } while (false)
#define TWINSHADE_CHECK_EQ(a, b) TWINSHADE_CHECK_OP_(a, ==, b)
#define TWINSHADE_CHECK_LE(a, b) TWINSHADE_CHECK_OP_(a, <=, b)
#define TWINSHADE_CHECK_LT(a, b) TWINSHADE_CHECK_OP_(a, <, b)

}  // namespace twinshade

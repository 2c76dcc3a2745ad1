// The built-in functions of GLSL 4.50 sections 8.1 to 8.8: what each is swept over, and what it should give.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace twinshade::test {

// Of one argument, every component alike.
struct Range {
  double low, high;
  bool logarithmic =
      false;  // magnitudes from 2^-20 of the greatest on, evenly in their logarithm; both signs if low < 0
};

struct Arguments {
  std::vector<long double> x;        // floats by value, integers by value, components of all arguments in order
  std::vector<std::uint32_t> words;  // the same by bit pattern
};

// What is true of one row. `scale`: the magnitude whose ULP errors are counted in, where it is greater than the value
// itself: the greatest of the terms that the value is a sum of.
struct Truth {
  std::vector<long double> values;
  long double scale = 0;
};

struct BuiltIn {
  std::string section, name;
  std::vector<std::string> types;  // of the arguments a, b, c ... in GLSL
  std::vector<Range> ranges;
  std::string glsl;    // gives `result`; arguments are a, b, c ...
  std::string result;  // its type
  double most_ulp;     // what ours may be off by
  std::function<Truth(const Arguments&)> truth;
};

const std::vector<BuiltIn>& built_in_table();

// Scalars in a GLSL type, and its scalar's first letter: f, i, u or b.
int component_count(const std::string& type);
char scalar_letter(const std::string& type);

}  // namespace twinshade::test

// Where the outputs of a fragment shader go that say no location: OpenGL leaves the choice to the driver, but no two
// outputs may share one (OpenGL 4.5, section 15.2). All machines choose alike.
#pragma once

#include <set>

namespace twinshade {

class OutputLocations {
 public:
  // Those that the author wrote come first. count: an array's elements, else 1.
  void take(int first, int count) {
    for (int i = 0; i < count; ++i) taken_.insert(first + i);
  }
  // The lowest that are free and follow each other; then they are taken. In the order of declaration.
  int take_lowest(int count) {
    int first = 0;
    for (auto next = taken_.begin(); next != taken_.end() && *next < first + count; ++next) first = *next + 1;
    take(first, count);
    return first;
  }

 private:
  std::set<int> taken_;
};

}  // namespace twinshade

#include "base/endless_loop.h"

#include <string>

#include "base/endless_loop_error.h"

namespace twinshade {

void stop_endless_loop(const char* where) {
  throw EndlessLoopError(std::string(where) + ": the shader does not end: this loop was stopped after " +
                  std::to_string(kMostIterations) + " iterations");
}

}  // namespace twinshade

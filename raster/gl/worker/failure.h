// Why a draw cannot be done, on its way to the answer. Whatever else is thrown in a worker is the backend's failure.
#pragma once

#include <stdexcept>

#include "raster/gl/protocol.h"

namespace twinshade::gl {

struct Failure : std::runtime_error {
  Failure(Outcome why, const std::string& text) : std::runtime_error(text), outcome(why) {}
  Outcome outcome;
};

}  // namespace twinshade::gl

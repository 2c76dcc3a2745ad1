// What stop_endless_loop throws.
#pragma once

#include "base/error.h"

namespace twinshade {

class EndlessLoopError : public UserError {
 public:
  using UserError::UserError;
};

}  // namespace twinshade

// Files that a model names.
#pragma once

#include <string>

#include "base/error.h"

namespace twinshade {

// What `read` returns. Its UserError, which names the file that it reads, names `model` in front of it: whoever gave
// the model alone would not know where that file comes from.
template <class Read>
auto read_for_model(const std::string& model, const Read& read) {
  try {
    return read();
  } catch (const UserError& error) {
    const std::string what = error.what();
    throw UserError(what.rfind(model + ": ", 0) == 0 ? what : model + ": " + what);
  }
}

}  // namespace twinshade

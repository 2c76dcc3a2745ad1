// The commands of golden.
#pragma once

#include "app/options.h"

namespace twinshade {

Verb add_golden_update(CLI::App& golden);
Verb add_golden_check(CLI::App& golden);
Verb add_golden_remove(CLI::App& golden);

}  // namespace twinshade

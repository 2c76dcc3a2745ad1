#pragma once

namespace twinshade {

// Processors that this process may run on.
int processor_count();

}  // namespace twinshade

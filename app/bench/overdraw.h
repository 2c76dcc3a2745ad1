#pragma once

#include "bundle/bundle.h"

namespace twinshade::bench {

// The bundle's triangles `layers` times over, each copy a little nearer than the one before: every pixel is covered as
// often, and what is drawn first is hidden by all that follows.
Bundle with_overdraw(const Bundle& bundle, int layers);

}  // namespace twinshade::bench

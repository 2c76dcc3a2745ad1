// Techniques as one writes them for a driver when only speed counts: what llvmpipe is timed with.
#pragma once

#include "lighting/registry.h"

namespace twinshade {

// technique_source, or visibility_source for `map`, with textures filtered by the driver (shaders/driver/) and nothing
// precise. Its bits are the driver's own. map: ignored by techniques that read none.
ShaderSource driver_source(const TechniqueInfo& technique, CoefficientStorage storage, const SphereMapInfo& map);

}  // namespace twinshade

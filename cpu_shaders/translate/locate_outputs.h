// Outputs of a fragment shader that say no location: glslang would give 0 to all of them.
#pragma once

namespace glslang {
class TIntermediate;
}

namespace twinshade {

// Writes into the tree where they go, as OutputLocations has it.
void locate_outputs(const glslang::TIntermediate& tree);

}  // namespace twinshade

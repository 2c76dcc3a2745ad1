// glslang makes m * (1.0 / s) of m / s, a matrix by a scalar: another number, and in SPIR-V just what an author may
// have written.
#pragma once

namespace glslang {
class TIntermediate;
}

namespace twinshade {

// Decorates the divisions of the tree with NoContraction, which forbids nothing that is done to them; the reciprocals
// that glslang makes are left without.
void mark_divisions(const glslang::TIntermediate& tree);

}  // namespace twinshade

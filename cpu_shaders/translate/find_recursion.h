// GLSL has no recursion, static or not. glslang finds it when it links, but says neither where nor along which calls.
#pragma once

#include "cpu_shaders/shader_source.h"

namespace glslang {
class TIntermediate;
}

namespace twinshade {

// UserError "file:line: f calls itself: f -> g (file:line) -> f (file:line) ..." where a function reaches itself.
void refuse_recursion(const glslang::TIntermediate& tree, const ShaderSource& source);

}  // namespace twinshade

// Hashes of what a frame is drawn from, which do not depend on where files lie: they tell why a frame has changed.
#pragma once

#include <string>

#include "bundle/bundle.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// SHA-256 of all that a renderer gets: of the bundle without its notes, which have names of files.
std::string content_hash(Bundle bundle);

// SHA-256 of the GLSL, includes resolved; files count by their order, not by their names and folders.
std::string content_hash(const ShaderSource& source);

}  // namespace twinshade

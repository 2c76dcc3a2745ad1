// The environment variables that a worker starts with.
#pragma once

#include <string>
#include <vector>

#include "raster/gl/gl_renderer.h"

namespace twinshade::gl {

// What this backend and these settings add.
std::vector<std::pair<std::string, std::string>> worker_settings(GlBackend backend, const GlEnvironment& environment);

// This process's environment without anything that steers OpenGL drivers or windowing, plus worker_settings, as
// NAME=VALUE.
std::vector<std::string> worker_environment(GlBackend backend, const GlEnvironment& environment);

}  // namespace twinshade::gl

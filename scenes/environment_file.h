// Lat-long environments from .hdr and .exr files.
#pragma once

#include <string>

#include "scenes/environment.h"

namespace twinshade {

bool is_environment_file(const std::string& path);  // by its ending
Environment load_environment_file(const std::string& path, bool clamp_radiance);

}  // namespace twinshade

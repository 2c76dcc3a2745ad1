// Files of the source tree that a binary carries, so that it needs no source tree. cmake/TwinshadeEmbed.cmake makes them.
#pragma once

#include <string_view>

namespace twinshade {

struct EmbeddedFile {
  std::string_view path;  // relative to the folder named to twinshade_embed
  std::string_view content;
};

}  // namespace twinshade

// The texture lines of MTL material libraries, of which assimp takes blanks after a name for a part of it, and the name
// for an argument of the option before it.
#pragma once

#include <set>
#include <string>

namespace twinshade {

// The library's text with the lines of colour, bump and normal maps cut down to keyword and name. `ignored`: gets the
// options that were cut off and would have changed the picture, as "-s".
std::string with_plain_textures(const std::string& library, std::set<std::string>& ignored);

}  // namespace twinshade

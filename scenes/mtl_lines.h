// The lines of MTL material libraries that are drawn, in a form in which assimp reads them as they are meant: it takes
// blanks after a texture's name for a part of it, the name for an argument of the option before it, one number of a
// colour for red alone, and stops at a colour in words.
#pragma once

#include <set>
#include <string>

namespace twinshade {

// The library's text with the names of materials, their diffuse colours, and the lines of colour, bump and normal maps
// cut down to keyword and name; other lines are empty. A material with a picture of colours alone is white beside it. `notes` gets what is ignored and would have changed the picture,
// as "the option -s of its textures is ignored". UserError naming `path` and the line: a colour that is none.
std::string plain_materials(const std::string& library, const std::string& path, std::set<std::string>& notes);

}  // namespace twinshade

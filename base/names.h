// What to say about a name that is not known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace twinshade {

// Insertions, deletions, substitutions and swaps of neighbours that turn one into the other.
int edit_distance(std::string_view a, std::string_view b);

// "unknown scene 'courtyrad'; did you mean 'courtyard'?" with at most three candidates, nearest first, or, where none
// is near, "unknown scene 'x'; known: courtyard, spheres". One line. kind: singular noun, as "scene".
std::string unknown_name_message(std::string_view kind, std::string_view name,
                                 const std::vector<std::string>& candidates);

}  // namespace twinshade

// What a glTF file has that is not drawn, as far as the file as a whole says so.
#pragma once

#include <set>
#include <string>

#include "scenes/gltf_document.h"

namespace twinshade {

void note_ignored_parts(const GltfDocument& document, std::set<std::string>& notes);

}  // namespace twinshade

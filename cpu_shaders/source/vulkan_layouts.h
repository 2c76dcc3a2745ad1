// What GLSL for Vulkan says of places in memory, which OpenGL has otherwise: descriptor sets and push constants.
#pragma once

#include <string>

namespace twinshade {

// The text without `set` in layouts, and without `binding` beside one, since places of several sets are the same
// number: textures and blocks are found by name. A block of push constants is a uniform block, in std140 as OpenGL has
// it. What goes is blanked, so that all else stays where it is.
std::string without_vulkan_layouts(const std::string& text);

}  // namespace twinshade

// From image files to what materials hold: row 0 at the bottom, linear colours, unit normals.
#pragma once

#include <string>

#include "images/image_file.h"
#include "scenes/scene.h"

namespace twinshade {

// Linear value of an sRGB-encoded one, both in [0, 1] (IEC 61966-2-1).
double srgb_decoded(double encoded);

// Integer images are sRGB, floating-point ones linear. Grey becomes three equal channels; alpha is 1.
// UserError naming the image (`name`) and its first pixel that is negative or not finite.
Image albedo_image(const DecodedImage& decoded, const std::string& name);

// Tangent-space normals stored as n * 0.5 + 0.5, x and y times `scale`, then made unit. Texels that are no direction
// become (0, 0, 1).
Image normal_image(const DecodedImage& decoded, double scale);

// Whether an image is such a normal map (mostly near (.5, .5, 1)) and not a height field.
bool looks_like_normal_map(const DecodedImage& decoded);

}  // namespace twinshade

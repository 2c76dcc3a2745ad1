#include "scenes/material_image.h"

#include <cmath>

#include "base/error.h"
#include "base/portable_math.h"

namespace twinshade {
namespace {

// Texel (x, y) counted from the lower left, channel c; grey images have three equal channels.
float sample(const DecodedImage& image, std::size_t x, std::size_t y, std::size_t c) {
  const std::size_t row = image.height - 1 - y;
  return image.texels[(row * image.width + x) * image.channels + (image.channels >= 3 ? c : 0)];
}

}  // namespace

double srgb_decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : portable::pow((encoded + 0.055) / 1.055, 2.4);
}

Image albedo_image(const DecodedImage& decoded, const std::string& name) {
  // Integer samples take few values: decode each once.
  const std::size_t steps = decoded.bits == 8 ? 256 : decoded.bits == 16 ? 65536 : 0;
  std::vector<float> linear(steps);
  for (std::size_t i = 0; i < steps; ++i) linear[i] = float(srgb_decoded(double(i) / double(steps - 1)));
  Image image{decoded.width, decoded.height, std::vector<float>(std::size_t(decoded.width) * decoded.height * 4, 1.0f)};
  for (std::size_t y = image.height; y-- > 0;)
    for (std::size_t x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = sample(decoded, x, y, c);
        if (!(value >= 0 && std::isfinite(value)))
          throw UserError(name + ": the colour at " +
                          pixel_name((decoded.height - 1 - y) * decoded.width + x, decoded.width) +
                          " is negative or not finite; repair the image");
        image.texels[(y * image.width + x) * 4 + c] =
            steps ? linear[std::size_t(double(value) * double(steps - 1) + 0.5)] : value;
      }
  return image;
}

Image normal_image(const DecodedImage& decoded, double scale) {
  Image image{decoded.width, decoded.height, std::vector<float>(std::size_t(decoded.width) * decoded.height * 4, 1.0f)};
  for (std::size_t y = 0; y < image.height; ++y)
    for (std::size_t x = 0; x < image.width; ++x) {
      glm::dvec3 n;
      for (int c = 0; c < 3; ++c) n[c] = 2.0 * double(sample(decoded, x, y, std::size_t(c))) - 1.0;
      n.x *= scale;
      n.y *= scale;
      const double length = glm::length(n);
      n = length > 1e-6 && std::isfinite(length) ? n / length : glm::dvec3(0, 0, 1);
      for (int c = 0; c < 3; ++c) image.texels[(y * image.width + x) * 4 + std::size_t(c)] = float(n[c]);
    }
  return image;
}

bool looks_like_normal_map(const DecodedImage& decoded) {
  if (decoded.channels < 3) return false;
  double mean[3] = {0, 0, 0};
  for (std::size_t i = 0; i < decoded.texels.size(); i += decoded.channels)
    for (std::size_t c = 0; c < 3; ++c) mean[c] += decoded.texels[i + c];
  const double count = double(decoded.width) * decoded.height;
  return std::fabs(mean[0] / count - 0.5) < 0.1 && std::fabs(mean[1] / count - 0.5) < 0.1 && mean[2] / count > 0.75;
}

}  // namespace twinshade

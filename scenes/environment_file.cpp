#include "scenes/environment_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "images/image_file.h"

namespace twinshade {
namespace {

// Sums of larger ones over a sphere, lit from and squared, are not finite as floats.
constexpr float kLargestRadiance = 1e30f;

}  // namespace

bool is_environment_file(const std::string& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".hdr" || ending == ".exr";
}

Environment load_environment_file(const std::string& path, bool clamp_radiance) {
  const DecodedImage image = decode_image_file(path);
  Environment environment{std::filesystem::path(path).stem().string(), image.width, image.height, {}};
  // As angular maps and crosses of cube maps are not
  if (environment.height > 1 && environment.width != 2 * std::uint64_t(environment.height))
    environment.note = path + ": " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                       ", not twice as wide as high; read as lat-long all the same";
  if (!image.note.empty()) environment.note += (environment.note.empty() ? path + ": " : "; ") + image.note;
  environment.radiance.resize(std::size_t(image.width) * image.height);
  float largest = 0;
  for (float value : image.texels)
    if (value <= kLargestRadiance) largest = std::max(largest, value);
  for (std::size_t i = 0; i < environment.radiance.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      float value = image.texels[i * image.channels + (image.channels >= 3 ? std::size_t(c) : 0)];
      const char* trouble = std::isnan(value)          ? "is not a number"
                            : value < 0                ? "is negative"
                            : std::isinf(value)        ? "is infinite"
                            : value > kLargestRadiance ? "is above 1e30"
                                                       : nullptr;
      if (trouble) {
        if (!clamp_radiance)
          throw UserError(path + ": radiance at " + pixel_name(i, image.width) + " " + trouble +
                          "; repair the image or use --clamp-radiance");
        value = value > 0 ? largest : 0;
      }
      environment.radiance[i][c] = value == 0 ? 0 : value;  // no negative zeros
    }
  return environment;
}

}  // namespace twinshade

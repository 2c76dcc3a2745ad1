// All layers of an array have one size: the largest of its images, resampled bilinearly in double with repeat, halved
// until the array is within a budget.
#include "lighting/material_textures.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace twinshade {
namespace {

constexpr std::size_t kArrayBudget = std::size_t(512) << 20;  // bytes

struct Layer {
  const Image* image;  // null: constant
  glm::dvec3 factor;   // multiplies the image, or is the constant
};

// Mean of the image over [x0, x1) x [y0, y1) in texels, repeating: a box filter when shrinking, else bilinear at the
// middle.
class Resampler {
 public:
  Resampler(const Image& image, std::uint32_t width, std::uint32_t height)
      : image_(image), scale_x_(double(image.width) / width), scale_y_(double(image.height) / height) {}

  glm::dvec3 operator()(std::uint32_t x, std::uint32_t y) const {
    const int taps_x = std::max(1, int(std::ceil(scale_x_))), taps_y = std::max(1, int(std::ceil(scale_y_)));
    glm::dvec3 sum(0);
    for (int j = 0; j < taps_y; ++j)
      for (int i = 0; i < taps_x; ++i)
        sum += bilinear((x + (i + 0.5) / taps_x) * scale_x_ - 0.5, (y + (j + 0.5) / taps_y) * scale_y_ - 0.5);
    return sum / double(taps_x * taps_y);
  }

 private:
  glm::dvec3 texel(std::int64_t x, std::int64_t y) const {
    const std::int64_t width = image_.width, height = image_.height;
    const float* t = image_.texels.data() + (((y + height) % height) * width + (x + width) % width) * 4;
    return {t[0], t[1], t[2]};
  }
  glm::dvec3 bilinear(double x, double y) const {
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    const std::int64_t i = std::int64_t(std::floor(x)), j = std::int64_t(std::floor(y));
    const glm::dvec3 low = texel(i, j) * (1 - fx) + texel(i + 1, j) * fx;
    const glm::dvec3 high = texel(i, j + 1) * (1 - fx) + texel(i + 1, j + 1) * fx;
    return low * (1 - fy) + high * fy;
  }

  const Image& image_;
  double scale_x_, scale_y_;
};

Texture texture_array(const char* name, const std::vector<Layer>& layers, bool unit_length) {
  Texture out;
  out.name = name;
  out.kind = TextureKind::two_d_array;
  out.wrap = Wrap::repeat;
  out.width = out.height = 1;
  out.layers = std::uint32_t(layers.size());
  for (const Layer& layer : layers) {
    if (!layer.image) continue;
    out.width = std::max(out.width, layer.image->width);
    out.height = std::max(out.height, layer.image->height);
  }
  const auto bytes = [&] { return std::size_t(out.width) * out.height * out.layers * 4 * sizeof(float); };
  while (bytes() > kArrayBudget && out.width * out.height > 1) {
    out.width = std::max(1u, out.width / 2);
    out.height = std::max(1u, out.height / 2);
  }
  out.texels.resize(bytes() / sizeof(float));
  parallel_for(std::size_t(out.layers) * out.height, [&](std::size_t row, int) {
    const Layer& layer = layers[row / out.height];
    float* texel = out.texels.data() + row * out.width * 4;
    for (std::uint32_t x = 0; x < out.width; ++x, texel += 4) {
      glm::dvec3 value = layer.factor;
      if (layer.image) value *= Resampler(*layer.image, out.width, out.height)(x, std::uint32_t(row % out.height));
      if (unit_length) {
        const double length = std::sqrt(glm::dot(value, value));
        value = length > 0 ? value / length : glm::dvec3(0, 0, 1);
      }
      texel[0] = float(value.x), texel[1] = float(value.y), texel[2] = float(value.z), texel[3] = 1;
    }
  });
  return out;
}

const Image* image_of(const Scene& scene, int index) {
  return index >= 0 && scene.has_uvs && scene.images[index].width > 0 && scene.images[index].height > 0
             ? &scene.images[index]
             : nullptr;
}

}  // namespace

Texture albedo_maps(const Scene& scene, bool on) {
  std::vector<Layer> layers;
  for (const Material& material : scene.materials)
    layers.push_back(on ? Layer{image_of(scene, material.albedo_image), glm::dvec3(material.albedo)}
                        : Layer{nullptr, glm::dvec3(1)});
  if (layers.empty()) layers.push_back({nullptr, on ? glm::dvec3(Material{}.albedo) : glm::dvec3(1)});
  return texture_array("albedo_maps", layers, false);
}

Texture normal_maps(const Scene& scene, bool on) {
  std::vector<Layer> layers;
  for (const Material& material : scene.materials) {
    const Image* image = on ? image_of(scene, material.normal_image) : nullptr;
    layers.push_back({image, image ? glm::dvec3(1) : glm::dvec3(0, 0, 1)});
  }
  if (layers.empty()) layers.push_back({nullptr, glm::dvec3(0, 0, 1)});
  return texture_array("normal_maps", layers, true);
}

}  // namespace twinshade

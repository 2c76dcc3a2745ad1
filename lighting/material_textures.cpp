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

struct Size {
  std::uint32_t width = 1, height = 1;
};

// That holds every image without a loss.
Size full_size(const std::vector<Layer>& layers) {
  Size size;
  for (const Layer& layer : layers) {
    if (!layer.image) continue;
    size.width = std::max(size.width, layer.image->width);
    size.height = std::max(size.height, layer.image->height);
  }
  return size;
}

Size array_size(const std::vector<Layer>& layers) {
  Size size = full_size(layers);
  const auto bytes = [&] { return std::size_t(size.width) * size.height * layers.size() * 4 * sizeof(float); };
  while (bytes() > kArrayBudget && (size.width > 1 || size.height > 1)) {
    size.width = std::max(1u, size.width / 2);
    size.height = std::max(1u, size.height / 2);
  }
  return size;
}

Texture texture_array(const char* name, const std::vector<Layer>& layers, bool unit_length) {
  Texture out;
  out.name = name;
  out.kind = TextureKind::two_d_array;
  out.wrap = Wrap::repeat;
  out.width = array_size(layers).width, out.height = array_size(layers).height;
  out.layers = std::uint32_t(layers.size());
  out.texels.resize(std::size_t(out.width) * out.height * out.layers * 4);
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

std::vector<Layer> albedo_layers(const Scene& scene) {
  std::vector<Layer> layers;
  for (const Material& material : scene.materials)
    layers.push_back({image_of(scene, material.albedo_image), glm::dvec3(material.albedo)});
  if (layers.empty()) layers.push_back({nullptr, glm::dvec3(Material{}.albedo)});
  return layers;
}

std::vector<Layer> normal_layers(const Scene& scene) {
  std::vector<Layer> layers;
  for (const Material& material : scene.materials) {
    const Image* image = image_of(scene, material.normal_image);
    layers.push_back({image, image ? glm::dvec3(1) : glm::dvec3(0, 0, 1)});
  }
  if (layers.empty()) layers.push_back({nullptr, glm::dvec3(0, 0, 1)});
  return layers;
}

std::string resampling_note(const char* kind, const std::vector<Layer>& layers) {
  const Size size = array_size(layers), full = full_size(layers);
  std::size_t pictures = 0, resampled = 0;
  for (const Layer& layer : layers) {
    pictures += layer.image != nullptr;
    resampled += layer.image && (layer.image->width != size.width || layer.image->height != size.height);
  }
  if (resampled == 0) return "";
  const auto words = [](const Size& s) { return std::to_string(s.width) + " x " + std::to_string(s.height); };
  std::string note = std::to_string(resampled) + " of " + std::to_string(pictures) + " " + kind + " are resampled to " +
                     words(size) + ", one size for the layers of all materials";
  if (full.width > size.width || full.height > size.height)
    note += ": at " + words(full) + " they would take more than 512 MiB";
  return note;
}

}  // namespace

Texture albedo_maps(const Scene& scene, bool on) {
  std::vector<Layer> layers = albedo_layers(scene);
  if (!on) std::fill(layers.begin(), layers.end(), Layer{nullptr, glm::dvec3(1)});
  return texture_array("albedo_maps", layers, false);
}

Texture normal_maps(const Scene& scene, bool on) {
  std::vector<Layer> layers = normal_layers(scene);
  if (!on) std::fill(layers.begin(), layers.end(), Layer{nullptr, glm::dvec3(0, 0, 1)});
  return texture_array("normal_maps", layers, true);
}

std::vector<std::string> resampling_notes(const Scene& scene, bool albedo, bool normal_map) {
  std::vector<std::string> notes;
  if (albedo) notes.push_back(resampling_note("colour pictures", albedo_layers(scene)));
  if (normal_map) notes.push_back(resampling_note("normal maps", normal_layers(scene)));
  std::erase(notes, "");
  return notes;
}

}  // namespace twinshade

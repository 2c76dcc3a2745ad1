#include "app/texture_files.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/names.h"
#include "cpu_shaders/translate/translate.h"
#include "images/image_file.h"

namespace twinshade {
namespace {

std::size_t equals_in(const std::string& given) {
  const std::size_t equals = given.find('=');
  if (equals == given.npos || equals == 0 || equals + 1 == given.size())
    throw UserError("--texture " + given + ": must be NAME=FILE: map=brick.png");
  return equals;
}

void require_sampler(const ShaderSource& source, const Reflection& reflection, const std::string& given,
                     const std::string& name) {
  const std::string start = "--texture " + given + ": " + (source.files.empty() ? source.name : source.files[0]) + ": ";
  std::vector<std::string> names;
  for (const ReflectedResource& resource : reflection.resources) {
    if (resource.kind == ResourceKind::sampler_2d) names.push_back(resource.name);
    if (resource.name != name) continue;
    if (resource.kind != ResourceKind::sampler_2d) throw UserError(start + name + " is no sampler2D");
    return;
  }
  throw UserError(start + unknown_name_message("sampler2D", name, names));
}

Texture texture_of(const std::string& name, const std::string& file) {
  const DecodedImage image = decode_image_file(file);
  Texture texture;
  texture.name = name;
  texture.width = image.width, texture.height = image.height;
  texture.wrap = Wrap::repeat;
  texture.texels.resize(std::size_t{4} * image.width * image.height);
  const bool grey = image.channels < 3;
  for (std::size_t pixel = 0; pixel < std::size_t{image.width} * image.height; ++pixel) {
    const float* from = &image.texels[pixel * image.channels];
    for (std::uint32_t c = 0; c < image.channels; ++c)
      if (!std::isfinite(from[c]))
        throw UserError(file + ": " + pixel_name(pixel, image.width) +
                        " is NaN or infinite, which no filter stands: replace it");
    const std::size_t row = image.height - 1 - pixel / image.width;
    float* to = &texture.texels[4 * (row * image.width + pixel % image.width)];
    for (std::uint32_t c = 0; c < 3; ++c) to[c] = from[grey ? 0 : c];
    to[3] = image.channels % 2 == 0 ? from[image.channels - 1] : 1.0f;
  }
  return texture;
}

}  // namespace

std::string texture_file(const std::string& given) { return given.substr(equals_in(given) + 1); }

std::vector<Texture> texture_files(const ShaderSource& source, const std::vector<std::string>& given) {
  std::vector<Texture> textures;
  if (given.empty()) return textures;
  const Reflection reflection = translate(source).reflection;
  for (const std::string& text : given) {
    const std::string name = text.substr(0, equals_in(text));
    if (std::any_of(textures.begin(), textures.end(), [&](const Texture& t) { return t.name == name; }))
      throw UserError("--texture " + text + ": " + name + " is given twice");
    require_sampler(source, reflection, text, name);
    textures.push_back(texture_of(name, texture_file(text)));
  }
  return textures;
}

}  // namespace twinshade

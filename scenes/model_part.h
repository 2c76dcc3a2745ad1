// What model files are read into, before tangents, welding and checks that are the same for all formats.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace twinshade {

// Triangles of one material in world space. Attribute arrays are empty or as long as positions.
struct ModelPart {
  std::string name;  // for messages
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs;           // t upwards
  std::vector<glm::vec2> lightmap_uvs;  // second set
  std::vector<std::uint32_t> indices;
  int material = 0;  // into Model::materials
};

struct Model {
  std::vector<ModelPart> parts;
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<std::string> files;  // as Scene::files
  std::vector<std::string> notes;
  std::optional<Camera> camera;  // its far plane is infinite where it sees as far as the model reaches
  double cos_crease = 1;         // for parts without normals: the cosine of the angle up to which edges are smooth
};

// Applies a 3 x 4 affine transform (columns) to a part: normals by the inverse transpose; a mirroring one turns
// triangles around.
void transform_part(ModelPart& part, const glm::dmat4& world);

}  // namespace twinshade

// What is there: triangles with materials, in world space. Right-handed, Y up, metres.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace twinshade {

// RGBA32F, row 0 at t = 0 (bottom), as Texture in a bundle.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<float> texels;  // 4 a texel
};

struct Material {
  std::string name;
  glm::vec3 albedo{0.8f};  // linear; multiplies the albedo image
  int albedo_image = -1;   // into Scene::images; linear RGB (already decoded from sRGB); -1: none
  int normal_image =
      -1;  // into Scene::images; unit tangent-space normals (x along the tangent, y bitangent, z out), decoded
};

struct Camera {
  glm::dvec3 eye{0, 1.6, 5}, target{0, 1, 0}, up{0, 1, 0};
  double vertical_fov_degrees = 55;
  double orthographic_height = 0;  // metres from the view's lower edge to its upper, without perspective; 0: with it
  double near_plane = 0.1, far_plane = 200;
};

struct Scene {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit
  std::vector<glm::vec4>
      tangents;  // xyz unit, orthogonal to the normal; w = +1 or -1: bitangent = w * cross(normal, tangent)
  std::vector<glm::vec2> uvs;           // material images, repeat; zeros where the model has none
  std::vector<glm::vec2> lightmap_uvs;  // in [0, 1], non-overlapping; empty: light is baked per vertex
  std::vector<std::uint32_t> indices;   // 3 a triangle, counter-clockwise outside
  std::vector<std::uint32_t> triangle_materials;
  std::vector<Material> materials;
  std::vector<Image> images;
  Camera camera;
  bool camera_frames = false;  // made by framing_camera, for a square view, since the model has none
  bool has_uvs = true;

  // raster_torture and raster_invalid only: positions are given in clip space (4 floats a vertex) and replace the
  // camera's.
  std::vector<glm::vec4> clip_positions;
  bool procedural_coefficients = false;  // light is not baked; coefficients are smooth functions of the vertex

  std::vector<std::string> files;  // that a model was read from: itself, its buffers, images and material libraries
  std::vector<std::string> notes;  // said aloud on load: "no UVs: normal map ignored" ...

  std::size_t triangle_count() const { return indices.size() / 3; }
};

// Vertices that triangles of different materials share are split by the loaders and generators: every vertex belongs to
// triangles of one material only.

// Built-in scene by name, or a file: .gltf, .glb, .obj. UserError with the nearest names where there is none.
// triangles: for procedural scenes, refine until at least this many (0: the scene's default).
// needs_camera: whether the scene's camera is used. Where it is not, a model whose own camera sees nothing loads
// nevertheless, with a camera that frames it.
Scene load_scene(const std::string& name_or_path, std::uint32_t triangles = 0, bool needs_camera = true);
std::vector<std::string> scene_names();

// SHA-256 over all that the frame or the bake depends on.
std::string scene_hash(const Scene& scene);

}  // namespace twinshade

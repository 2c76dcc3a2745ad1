// One quad, leaning back against the light: the smallest scene that has everything.
#include "scenes/builtin_scenes.h"
#include "scenes/surface_patterns.h"
#include "scenes/surfaces.h"

namespace twinshade {

Scene make_quad(std::uint32_t triangles) {
  check_triangle_request(triangles);
  Scene scene;
  scene.name = "quad";
  const Finish brick{add_pattern_material(scene, "bricks", bricks, 256, 1.0), 1.0, 2.0};
  PatchMesh mesh;
  add_rectangle(mesh, {-1, 0, 0}, {1, 0, 0}, {0, 0.8, -0.6}, 2, 2, brick);
  mesh.build(scene, triangles);
  scene.camera.eye = {0, 1.8, 2.6};
  scene.camera.target = {0, 0.8, -0.6};
  scene.camera.vertical_fov_degrees = 50;
  scene.camera.far_plane = 20;
  return scene;
}

}  // namespace twinshade

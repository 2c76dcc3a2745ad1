// Five balls of different stone on a paved floor.
#include <array>

#include "scenes/builtin_scenes.h"
#include "scenes/surface_patterns.h"
#include "scenes/surfaces.h"

namespace twinshade {

using glm::dvec3;

Scene make_spheres(std::uint32_t triangles) {
  check_triangle_request(triangles);
  Scene scene;
  scene.name = "spheres";
  const Finish floor{add_pattern_material(scene, "ashlar", ashlar, 256, 1.6), 1.6, 0.5};
  const std::array<int, 5> stone = {add_pattern_material(scene, "cobbles", cobbles, 256, 1.5),
                                    add_pattern_material(scene, "marble", marble, 256, 1.0),
                                    add_pattern_material(scene, "bricks", bricks, 256, 1.0),
                                    add_pattern_material(scene, "plaster", plaster, 256, 2.0),
                                    add_pattern_material(scene, "fluted", fluted, 256, 0.3)};
  PatchMesh mesh;
  add_rectangle(mesh, {-4, 0, 4}, {1, 0, 0}, {0, 0, -1}, 8, 8, floor);
  struct Ball {
    dvec3 centre;
    double radius, tile;
  };
  const std::array<Ball, 5> balls = {{{{0, 1.0, -0.4}, 1.0, 1.5},
                                      {{-2.0, 0.7, 0.3}, 0.7, 1.0},
                                      {{2.0, 0.8, 0.1}, 0.8, 1.0},
                                      {{-0.9, 0.4, 1.5}, 0.4, 1.0},
                                      {{0.95, 0.45, 1.4}, 0.45, 0.3}}};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& ball = balls[i];
    add_ball(
        mesh, [ball](const dvec3& d) { return ball.centre + ball.radius * d; }, ball.radius, {stone[i], ball.tile, 0.5},
        24, 1.3);
  }
  mesh.build(scene, triangles);
  scene.camera.eye = {0, 1.9, 5.2};
  scene.camera.target = {0, 0.75, 0};
  scene.camera.vertical_fov_degrees = 45;
  scene.camera.far_plane = 40;
  return scene;
}

}  // namespace twinshade

// In place of sphere_map/cube.glsl where OpenGL is timed: the face is chosen once for all tables, each filtered within the face as an
// array layer. llvmpipe's own cube map arrays choose it again at every fetch, so they cost it more.
#include "sphere_map/cube_face.glsl"

SphereMapTaps sphere_map_taps(vec3 direction, int width) {
  int face = cube_face(direction);
  vec3 q = cube_to_face(face, direction);
  return SphereMapTaps(q.xy / q.z * 0.5 + 0.5, face);
}

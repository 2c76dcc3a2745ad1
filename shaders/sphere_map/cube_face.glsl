// Faces of a cube map, as OpenGL has them: +X -X +Y -Y +Z -Z, with s to the right and t down the face's image (OpenGL 4.6, table 8.19).
// Texel (x, y) of width W has its centre at s = (2x + 1) / W - 1, t likewise.
#include "exact/bilinear.glsl"
#include "exact/normalize.glsl"
#include "sphere_map/taps.glsl"

const int SPHERE_MAP_LAYERS = 6;

// The face that a direction meets; the lower axis where two are equally far. NaN meets +Z.
int cube_face(vec3 direction) {
  vec3 extent = abs(direction);
  bool x = extent.x >= extent.y && extent.x >= extent.z;
  bool y = !x && extent.y >= extent.z;
  return x ? (direction.x < 0.0 ? 1 : 0) : y ? (direction.y < 0.0 ? 3 : 2) : (direction.z < 0.0 ? 5 : 4);
}

// (s, t, distance along the face's axis) of a point.
vec3 cube_to_face(int face, vec3 p) {
  return face == 0   ? vec3(-p.z, -p.y, p.x)
         : face == 1 ? vec3(p.z, -p.y, -p.x)
         : face == 2 ? vec3(p.x, p.z, p.y)
         : face == 3 ? vec3(p.x, -p.z, -p.y)
         : face == 4 ? vec3(p.x, -p.y, p.z)
                     : vec3(-p.x, -p.y, -p.z);
}

ivec3 cube_to_face(int face, ivec3 p) {
  return face == 0   ? ivec3(-p.z, -p.y, p.x)
         : face == 1 ? ivec3(p.z, -p.y, -p.x)
         : face == 2 ? ivec3(p.x, p.z, p.y)
         : face == 3 ? ivec3(p.x, -p.z, -p.y)
         : face == 4 ? ivec3(p.x, -p.y, p.z)
                     : ivec3(-p.x, -p.y, -p.z);
}

// The point at (s, t, distance) of a face.
ivec3 cube_from_face(int face, ivec3 q) {
  return face == 0   ? ivec3(q.z, -q.y, -q.x)
         : face == 1 ? ivec3(-q.z, -q.y, q.x)
         : face == 2 ? ivec3(q.x, q.z, q.y)
         : face == 3 ? ivec3(q.x, -q.z, -q.y)
         : face == 4 ? ivec3(q.x, -q.y, q.z)
                     : ivec3(-q.x, -q.y, -q.z);
}

// Where a direction meets its face, in texels: -0.5 to width - 0.5, texel centres at whole numbers. NaN and zero meet a corner.
vec2 cube_position(int face, vec3 direction, int width) {
  vec3 q = cube_to_face(face, direction);
  precise float half_width = float(width) * 0.5;
  precise float center = half_width - 0.5;
  precise vec2 position = (q.xy / q.z) * half_width + center;
  precise float limit = float(width) - 0.5;
  precise float u = position.x > -0.5 ? position.x : -0.5;
  precise float v = position.y > -0.5 ? position.y : -0.5;
  return vec2(u < limit ? u : limit, v < limit ? v : limit);
}

vec3 sphere_map_direction(ivec3 texel, int width) {
  return exact_normalize(vec3(cube_from_face(texel.z, ivec3(texel.xy * 2 + (1 - width), width))));
}

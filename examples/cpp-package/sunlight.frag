// Sunlight on a matte surface under a uniform sky, fading with distance.
in vec3 normal;  // of unit length
in float distance_to_camera;
out vec3 radiance;

struct Sun {
  vec3 direction;  // of unit length, towards the sun
  vec3 colour;
};
uniform Sun sun;
uniform vec3 sky;
uniform float haze;  // 1 / metre

void main() {
  vec3 lit = sun.colour * max(dot(normal, sun.direction), 0.0) + sky * (0.5 + 0.5 * normal.y);
  radiance = mix(sky, lit, exp2(-haze * distance_to_camera));
}

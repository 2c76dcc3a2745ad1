// Cross product; each component is one difference of two products.

vec3 exact_cross(vec3 a, vec3 b) {
  precise float x = a.y * b.z - a.z * b.y;
  precise float y = a.z * b.x - a.x * b.z;
  precise float z = a.x * b.y - a.y * b.x;
  return vec3(x, y, z);
}

// Ambient Cube: a colour per face of a cube, weighted by the squares of the normal's components, 3 of 6 read. McTaggart,
// Half-Life 2 / Valve Source Shading, GDC 2004. A constant is exact. Faces: +x, +y, +z, -x, -y, -z.
// Includer defines COEF(i): coefficient i as vec3. n: unit normal.

const int BASIS_COUNT = 6;

float ambient_cube_weight(float component) {
  precise float weight = component * component;
  return weight;
}

float basis_value(int i, vec3 n) {
  int axis = i < 3 ? i : i - 3;
  float component = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  return (component < 0.0) == (i >= 3) ? ambient_cube_weight(component) : 0.0;
}

vec3 basis_irradiance(vec3 n) {
  precise vec3 irradiance = (n.x < 0.0 ? COEF(3) : COEF(0)) * ambient_cube_weight(n.x);
  irradiance += (n.y < 0.0 ? COEF(4) : COEF(1)) * ambient_cube_weight(n.y);
  irradiance += (n.z < 0.0 ? COEF(5) : COEF(2)) * ambient_cube_weight(n.z);
  return irradiance;
}

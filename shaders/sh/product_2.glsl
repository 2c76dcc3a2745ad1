// Product of two functions given by spherical harmonics of order 2, cut to order 2: Y_00 times anything is a constant, and bands
// 1 by 1 leave bands 0 and 2. Sloan, Stupid Spherical Harmonics (SH) Tricks, 2008.

vec3[4] sh2_product(vec3 a[4], vec4 b) {
  precise vec3 dotted = (a[0] * b.x + a[1] * b.y) + (a[2] * b.z + a[3] * b.w);
  precise vec3 c0 = dotted * 0.282094792;  // sqrt(1/4pi)
  precise vec3 c1 = (a[0] * b.y + a[1] * b.x) * 0.282094792;
  precise vec3 c2 = (a[0] * b.z + a[2] * b.x) * 0.282094792;
  precise vec3 c3 = (a[0] * b.w + a[3] * b.x) * 0.282094792;
  return vec3[4](c0, c1, c2, c3);
}

// float only
ivec4 kernel(int a, int b, float x, float y) {
  vec3 v = vec3(x, y, float(a));
  vec3 w = vec3(2.0f);
  v = v * w + vec3(float(b), 1.0f, 0.5f);
  v[a % 3] = 9.0f;
  v.y += 1.0f;
  if (x > y) v[b % 3] -= w.z;
  vec4 q = vec4(v, 1.0f);
  vec2 two = vec2(q);
  q = q - vec4(two, two) * 0.25f;
  mat3 m = mat3(1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 8.0f, 10.0f);
  m[a % 3][b % 3] = 2.0f;
  m[1] = m[1] + v;
  if (a > b) m[b % 3] = w;
  vec3 p = m * v;
  vec3 r = v * m;
  mat3 mm = m * m;
  mat3 tr = transpose(mm);
  mat3 sum = mm + tr - m;
  mat2x3 wide = mat2x3(v, w);
  vec3 wv = wide * vec2(x, 1.0f);
  vec2 vw = v * wide;
  mat2 small = mat2(x, y, 1.0f, 2.0f);
  float det = determinant(small);
  bvec3 less = lessThan(v, w);
  int bits = (less.x ? 1 : 0) + (less.y ? 2 : 0) + (less.z ? 4 : 0) + (any(less) ? 8 : 0) + (all(less) ? 16 : 0);
  ivec3 iv = ivec3(a, b, 3);
  iv = iv * 2 - ivec3(1);
  iv[b % 3] = 40;
  iv[(a + b) % 3]++;
  --iv[(a * 2 + 1) % 3];
  return ivec4(int((p.x + r.y + q.w) * 4.0f), int((mm[0][0] + tr[2][1] + sum[b % 3].z) * 2.0f), int((wv.z + vw.x + det) * 4.0f), bits * 1000 + iv.x + iv[a % 3]);
}

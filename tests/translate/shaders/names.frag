// Names that mean something else in generated C++: of types and of their members, of what the class inherits, of the
// runtime's functions, of the parameters of small functions within it.
#version 450
layout(location = 0) flat in int p;
layout(location = 1) flat in int q;
layout(location = 0) out vec4 structs;
layout(location = 1) out vec4 others;
layout(std430, binding = 0) buffer Counts { uint count; };
uniform float shader_data, shade_call;
struct V { float V; };
struct light { float light; };
struct A { float x; };
struct T { A A; float y; };
struct S { float a; };
struct S_of { float b; };
struct a { float mask; };
struct mask { float b; };
float uniform_S = 3.0, Steps = 4.0;
float num_work_groups = 1.0, work_group_id = 2.0, local_invocation_index = 3.0;
float iterate(float x) { return x * 2.0; }
uint atomic_add(uint x) { return x * 2u; }
void main() {
  float k = float(p);
  bool odd = (q & 1) == 1;
  V v = V(k);
  light l = light(k + 1.0);
  T t = T(A(k), 2.0);
  S same = S(shader_data), each = S(k);
  S_of of = S_of(k);
  a m = odd ? a(1.0) : a(2.0);
  mask n = odd ? mask(3.0) : mask(4.0);
  structs = vec4(v.V + 10.0 * l.light, t.A.x + 10.0 * t.y, same.a + 10.0 * each.a + 100.0 * uniform_S,
                 m.mask + 10.0 * n.b + 100.0 * of.b);
  float sum = 0.0;
  for (int i = 0; i < q; i++) sum += iterate(k);
  int element = p % 3, here = q % 3;
  mat3 cells = mat3(0.0);
  cells[here][element] = 5.0;
  cells[element][here] += 1.0;
  atomicAdd(count, atomic_add(3u));
  others = vec4(sum, shade_call, num_work_groups + work_group_id + local_invocation_index + Steps, cells[1][2]);
}

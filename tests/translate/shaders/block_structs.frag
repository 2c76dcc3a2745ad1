#version 450
layout(location = 0) flat in int a;
layout(location = 1) flat in int b;
struct Light { float power; vec2 range; };
struct Switch { float value; bool on; bvec2 both; };
layout(std140) uniform Lights { Light lights[3]; Light sun; };
layout(std140) uniform Switches { Switch switches[3]; Switch first; };
layout(location = 0) out vec4 chosen;
layout(location = 1) out ivec4 equal;
Light of(int k) { return k > 3 ? lights[1] : Light(4.0, vec2(k, 9.0)); }
void main() {
  Light x = sun;
  Light y = a > 3 ? x : lights[b % 3];
  Light z = lights[0].power < 0.0 ? sun : lights[2];
  Light all[3] = a > 5 ? lights : Light[](x, y, z);
  chosen = vec4(y.power + y.range.y, z.power, of(a).range.x, all[b % 3].power);
  Switch s = switches[a % 3];
  equal = ivec4(s == first && first == s, switches[b % 3] != s, first.on == s.on, (b > 3 ? s : first).both.y);
}

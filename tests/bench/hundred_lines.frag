// A hundred lines as engines have them: microfacet lights, a normal map, fog and value noise.
in vec2 v_uv;
in vec3 v_position;
in vec3 v_normal;
in vec4 v_tangent;
flat in int v_material;
layout(location = 0) out vec4 colour;

struct Light {
  vec3 position;
  vec3 colour;
  float radius;
};

uniform vec3 camera;
uniform Light lights[4];
uniform vec3 fog_colour;
uniform float fog_density;
uniform float roughness[8];
uniform sampler2DArray albedo_maps;
uniform sampler2DArray normal_maps;

const float PI = 3.14159265358979;

float hash(vec3 cell) {
  uvec3 n = uvec3(ivec3(cell)) * uvec3(1597334673u, 3812015801u, 2798796415u);
  uint bits = (n.x ^ n.y ^ n.z) * 1597334673u;
  return float(bits >> 8) * (1.0 / 16777216.0);
}

float value_noise(vec3 p) {
  vec3 cell = floor(p), f = p - cell;
  f = f * f * (3.0 - 2.0 * f);
  float bottom = mix(mix(hash(cell), hash(cell + vec3(1.0, 0.0, 0.0)), f.x),
                     mix(hash(cell + vec3(0.0, 1.0, 0.0)), hash(cell + vec3(1.0, 1.0, 0.0)), f.x), f.y);
  float top = mix(mix(hash(cell + vec3(0.0, 0.0, 1.0)), hash(cell + vec3(1.0, 0.0, 1.0)), f.x),
                  mix(hash(cell + vec3(0.0, 1.0, 1.0)), hash(cell + vec3(1.0, 1.0, 1.0)), f.x), f.y);
  return mix(bottom, top, f.z);
}

float fractal_noise(vec3 p) {
  float sum = 0.0, amplitude = 0.5;
  for (int octave = 0; octave < 4; ++octave) {
    sum += amplitude * value_noise(p);
    p *= 2.02;
    amplitude *= 0.5;
  }
  return sum;
}

float distribution_ggx(float n_h, float alpha) {
  float a2 = alpha * alpha;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  return a2 / (PI * d * d);
}

float visibility_smith(float n_v, float n_l, float alpha) {
  float a2 = alpha * alpha;
  float v = n_l * sqrt(n_v * n_v * (1.0 - a2) + a2);
  float l = n_v * sqrt(n_l * n_l * (1.0 - a2) + a2);
  return 0.5 / max(v + l, 1e-5);
}

vec3 fresnel_schlick(float v_h, vec3 f0) {
  return f0 + (1.0 - f0) * pow(1.0 - v_h, 5.0);
}

vec3 mapped_normal() {
  vec3 n = normalize(v_normal), t = normalize(v_tangent.xyz - n * dot(n, v_tangent.xyz));
  vec3 b = v_tangent.w * cross(n, t);
  vec3 m = texture(normal_maps, vec3(v_uv, float(v_material))).xyz;
  return normalize(mat3(t, b, n) * m);
}

vec3 light_from(Light light, vec3 n, vec3 v, vec3 albedo, vec3 f0, float alpha) {
  vec3 to_light = light.position - v_position;
  float distance = length(to_light);
  if (distance > light.radius) return vec3(0.0);
  vec3 l = to_light / distance, h = normalize(l + v);
  float n_l = max(dot(n, l), 0.0), n_v = max(dot(n, v), 1e-4);
  float n_h = max(dot(n, h), 0.0), v_h = max(dot(v, h), 0.0);
  float window = clamp(1.0 - pow(distance / light.radius, 4.0), 0.0, 1.0);
  vec3 specular = distribution_ggx(n_h, alpha) * visibility_smith(n_v, n_l, alpha) * fresnel_schlick(v_h, f0);
  return light.colour * (albedo / PI + specular) * n_l * window * window / (distance * distance + 1.0);
}

void main() {
  vec3 albedo = texture(albedo_maps, vec3(v_uv, float(v_material))).rgb;
  float wear = fractal_noise(v_position * 4.0);
  float metallic = smoothstep(0.45, 0.55, wear);
  float rough = clamp(roughness[v_material & 7] + 0.3 * wear, 0.05, 1.0);
  vec3 n = mapped_normal(), v = normalize(camera - v_position);
  vec3 f0 = mix(vec3(0.04), albedo, metallic), sum = vec3(0.03) * albedo;
  for (int i = 0; i < 4; ++i) {
    sum += light_from(lights[i], n, v, albedo * (1.0 - metallic), f0, rough * rough);
  }
  float fog = exp(-fog_density * length(camera - v_position));
  colour = vec4(mix(fog_colour, sum, fog), 1.0);
}

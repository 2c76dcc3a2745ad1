// In place of technique/coefficients_volume.glsl where OpenGL is timed: the driver's filter between four probes of a row, blended
// with that of the row above.

in vec3 v_position;             // world space
uniform vec3 volume_origin;     // world position of probe (0, 0, 0)
uniform vec3 volume_scale;      // probes per unit of length, each axis
uniform ivec3 volume_size;      // probes along each axis
uniform sampler2DArray COEFFICIENTS;  // RGB

vec2 volume_low, volume_high;  // between the four probes below and above
float volume_fraction;

void load_coefficients() {
  vec3 inside = clamp((v_position - volume_origin) * volume_scale, vec3(0.0), vec3(volume_size - 1));
  float low = floor(inside.z);
  float high = min(low + 1.0, float(volume_size.z - 1));
  vec2 texel = 1.0 / vec2(textureSize(COEFFICIENTS, 0).xy);
  volume_low = vec2(inside.x + 0.5, low * float(volume_size.y) + inside.y + 0.5) * texel;
  volume_high = vec2(inside.x + 0.5, high * float(volume_size.y) + inside.y + 0.5) * texel;
  volume_fraction = inside.z - low;
}

vec3 volume_coefficient(int i) {
  return mix(texture(COEFFICIENTS, vec3(volume_low, float(i))).rgb, texture(COEFFICIENTS, vec3(volume_high, float(i))).rgb,
             volume_fraction);
}

#define COEF(i) volume_coefficient(i)

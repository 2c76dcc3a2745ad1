// Names that are free in GLSL and not in C++, beside those that they could become.
#version 450
struct Colour {
  vec3 lights_struct;
};
struct Light {
  Colour lights;
  float lights_struct;
};
uniform Light lights[2];
uniform float lights_struct;
uniform float new;
uniform float new_;
uniform float EOF;
uniform float stdin;
uniform float INT_MAX;
uniform float M_PI;
uniform float INFINITY;
uniform float errno;
uniform float linux;
uniform float MVP;
in float x;
layout(location = 0) out float discarded;
layout(location = 1) out float NAN;

void main() {
  if (x < 0.0) discard;
  discarded = lights[1].lights.lights_struct.y + 10.0 * lights[1].lights_struct + 100.0 * lights_struct + 1000.0 * new +
              10000.0 * new_;
  NAN = EOF + 10.0 * stdin + 100.0 * INT_MAX + 1000.0 * M_PI + 10000.0 * INFINITY + 100000.0 * errno + MVP * linux;
}

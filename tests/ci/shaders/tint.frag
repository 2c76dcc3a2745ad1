#version 450
// @input colour 0..1
in vec3 colour;
uniform float amount;
out vec4 tinted;

void main() {
  precise vec3 scaled = colour * amount;
  tinted = vec4(scaled, 1.0);
}

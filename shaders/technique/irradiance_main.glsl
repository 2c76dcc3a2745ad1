// Irradiance normal mapping with the basis included before this.
#include "technique/reflected_light.glsl"

out vec4 color;

void main() {
  color = vec4(reflected_light(), 1.0);
}

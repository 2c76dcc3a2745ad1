// The surface as textures give it, its normal in tangent space, z up.
#include "technique/surface_maps.glsl"

vec3 surface_normal() {
  return mapped_normal();
}

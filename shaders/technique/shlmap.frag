// Lightmap of spherical harmonics l <= 2, as sh3: all light that was gathered, bounces included, evaluated at the mapped normal.
// Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012, section 5.
// TWINSHADE_VERTEX_COEFFICIENTS: coefficients come from the vertices.
#define COEFFICIENTS coefficients_sh3
#define COEFFICIENT_COUNT 9
#include "technique/surface.glsl"
#ifdef TWINSHADE_VERTEX_COEFFICIENTS
#include "technique/coefficients_vertex.glsl"
#else
#include "technique/coefficients_lightmap.glsl"
#endif
#include "basis/sh3.glsl"
#include "technique/irradiance_main.glsl"

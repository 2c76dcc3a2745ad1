// Light that a Lambertian surface reflects: albedo / pi times the irradiance that the basis reconstructs at the surface's normal.
// After a surface*.glsl, a coefficients_*.glsl and a basis.

vec3 reflected_light() {
  load_surface_maps();
  load_coefficients();
  precise vec3 exitance = surface_albedo() * basis_irradiance(surface_normal());
  precise vec3 radiance = exitance * 0.318309886;  // 1/pi
  return radiance;
}

// Distant light: lat-long radiance, OpenEXR's orientation (Y up, row 0 at the zenith, longitude pi at the left edge to
// -pi at the right; direction = (sin(lon) cos(lat), sin(lat), cos(lon) cos(lat))).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace twinshade {

struct Environment {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> radiance;  // row-major, row 0 at the zenith
  std::string note{};               // to be said where it is used; empty: nothing

  // Radiance towards `direction` (unit, world space): bilinear between pixel centres, wrapped in longitude, clamped in
  // latitude.
  glm::dvec3 radiance_towards(const glm::dvec3& direction) const;
  // Exact solid angle of a pixel of row y: (2 pi / width) * (sin(lat_top) - sin(lat_bottom)).
  double pixel_solid_angle(std::uint32_t y) const;
  // Unit direction of a pixel's centre.
  glm::dvec3 pixel_direction(std::uint32_t x, std::uint32_t y) const;
};

// Environment::pixel_direction of all pixels of a size, for those who need most of them: a row's and a column's sines
// and cosines are computed once.
class PixelDirections {
 public:
  PixelDirections(std::uint32_t width, std::uint32_t height);
  glm::dvec3 operator()(std::uint32_t x, std::uint32_t y) const;

 private:
  std::vector<glm::dvec2> longitudes_, colatitudes_;  // sine, cosine
};

// With at least so many columns and rows: each pixel as several of its radiance. Pixels count as lights in the
// direction of their centres in some integrals and are interpolated in others; large ones differ between the two.
Environment refine_environment(const Environment& environment, std::uint32_t width, std::uint32_t height);

// A picture of fewer rows, or of fewer columns than twice that, with at least twice as many: one light is then the same
// however small it was stored, and turning or blending it takes nothing away.
Environment refine_small_environment(const Environment& environment, std::uint32_t few_rows);

// "sky", "studio", "window", "constant", or a .hdr/.exr file. UserError: unknown name (nearest suggested), unreadable
// or truncated file, NaN, infinite, negative radiance or one above 1e30 (naming the pixel; clamp_radiance replaces NaN
// and negatives by 0 and what is too large by the largest value that is not).
Environment load_environment(const std::string& name_or_path, bool clamp_radiance = false);
// Rotated about Y, counter-clockwise seen from above, by resampling on lookup: same size.
Environment rotate_environment(const Environment& environment, double degrees);
// a + (b - a) * part, 0 <= part <= 1. Where their sizes differ, with the larger width and height of the two, whose
// pixels are means of a's and b's: no light is lost or gained.
Environment blend_environments(const Environment& a, const Environment& b, double part);
std::vector<std::string> environment_names();
std::string environment_hash(const Environment& environment);

}  // namespace twinshade

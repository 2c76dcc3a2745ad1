#include "scenes/environment_painted.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/portable_math.h"
#include "scenes/blend.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;
using portable::kPi;

// Each pixel is the mean of samples x samples directions spread evenly over it in longitude and latitude.
Environment paint(const char* name, std::uint32_t width, std::uint32_t height, int samples,
                  const std::function<dvec3(const dvec3& direction)>& radiance) {
  Environment environment{name, width, height, {}};
  environment.radiance.resize(std::size_t(width) * height);
  // A grid of the finer size has the sample points as its pixel centres.
  const auto fine = std::uint32_t(samples);
  const PixelDirections directions(width * fine, height * fine);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      dvec3 sum(0);
      for (std::uint32_t j = 0; j < fine; ++j)
        for (std::uint32_t i = 0; i < fine; ++i) sum += radiance(directions(x * fine + i, y * fine + j));
      environment.radiance[std::size_t(y) * width + x] = glm::vec3(sum / double(fine * fine));
    }
  return environment;
}

// A flat lamp in space, seen from the origin: 1 on it, falling to 0 over `soft` metres inside its edge, 0 outside.
struct Lamp {
  dvec3 centre, half_u, half_v;  // half_u, half_v: orthogonal, metres
  double soft;

  double seen(const dvec3& direction) const {
    const dvec3 normal = glm::cross(half_u, half_v);
    const double facing = glm::dot(direction, normal), distance = glm::dot(centre, normal);
    if (facing * distance <= 0) return 0;
    const dvec3 at = direction * (distance / facing) - centre;
    const double width = glm::length(half_u), height = glm::length(half_v);
    const dvec2 inside(width - std::fabs(glm::dot(at, half_u)) / width,
                       height - std::fabs(glm::dot(at, half_v)) / height);
    return smooth_step(0, soft, inside.x) * smooth_step(0, soft, inside.y);
  }
};

}  // namespace

Environment paint_sky() {
  const dvec3 sun = glm::normalize(dvec3(0.30, 0.74, 0.60));
  const double sun_edge = portable::cos(1.0 * kPi / 180);
  // Irradiance 11 on a surface that faces the sun: radiance = 11 / solid angle.
  const dvec3 sun_radiance = dvec3(1.0, 0.92, 0.79) * (11 / (2 * kPi * (1 - sun_edge)));
  return paint("sky", 512, 256, 4, [=](const dvec3& d) {
    const dvec3 zenith(0.22, 0.40, 0.82), horizon(0.78, 0.84, 0.90), ground(0.24, 0.20, 0.16);
    if (d.y < 0) return mix(horizon * 0.45, ground, smooth_step(0, 0.12, -d.y));
    const double cosine = glm::dot(d, sun);
    const double away = 1 - std::max(cosine, 0.0);
    // Bright towards the horizon and around the sun.
    dvec3 light = mix(horizon, zenith, 1 - (1 - d.y) * (1 - d.y) * (1 - d.y));
    light += dvec3(0.9, 0.8, 0.62) * (0.30 * portable::exp(-6 * away) + 1.4 * portable::exp(-160 * away));
    return cosine > sun_edge ? light + sun_radiance : light;
  });
}

Environment paint_studio() {
  const Lamp key{{-2.2, 2.6, 1.8}, {0.9, 0, 1.1}, {0.55, 0.75, -0.45}, 0.25};
  const Lamp fill{{3.2, 1.0, 1.4}, {0.35, 0, -0.8}, {0, 1.3, 0}, 0.4};
  const Lamp rim{{0.8, 2.4, -3.0}, {1.2, 0, 0.32}, {0, 0.35, 0}, 0.15};
  return paint("studio", 512, 256, 3, [=](const dvec3& d) {
    const dvec3 room = mix(dvec3(0.035, 0.034, 0.033), dvec3(0.06, 0.06, 0.065), smooth_step(-0.5, 0.8, d.y));
    return room + dvec3(9.0, 8.6, 8.0) * key.seen(d) + dvec3(2.1, 2.4, 3.0) * fill.seen(d) +
           dvec3(12.0, 11.0, 9.5) * rim.seen(d);
  });
}

Environment paint_window() {
  return paint("window", 512, 256, 4, [=](const dvec3& d) {
    // The room: warm floor, grey walls, paler ceiling.
    const dvec3 wall = mix(dvec3(0.055, 0.040, 0.028), dvec3(0.070, 0.068, 0.064), smooth_step(-0.7, 0.2, d.y));
    const dvec3 room = mix(wall, dvec3(0.11, 0.11, 0.115), smooth_step(0.5, 0.8, d.y));
    if (d.z <= 0) return room;
    // The window in the plane z = 2.4: 1.6 m wide, 1.8 m high, a cross of bars 8 cm wide.
    const double x = d.x / d.z * 2.4, y = d.y / d.z * 2.4 - 0.7;
    if (std::fabs(x) > 0.8 || std::fabs(y) > 0.9) return room;
    if (std::fabs(x) < 0.04 || std::fabs(y) < 0.04) return dvec3(0.12, 0.11, 0.10);
    const dvec3 sky = mix(dvec3(13, 14, 15), dvec3(6, 9, 16), smooth_step(-0.1, 0.6, d.y));
    return mix(dvec3(2.2, 2.6, 1.5), sky, smooth_step(-0.02, 0.04, d.y - 0.05));
  });
}

Environment paint_constant() {
  return paint("constant", 64, 32, 1, [](const dvec3&) { return dvec3(1); });
}

}  // namespace twinshade

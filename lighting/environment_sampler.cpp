// The rest is resampled to a cube: looking up a direction takes no transcendental function there. Bright pixels are
// sampled by power with their exact solid angle, in Morton order so that stratified numbers spread over their area.
#include "lighting/environment_sampler.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/portable_math.h"

namespace twinshade {
namespace {

// A pixel is bright above this many times the mean of the sphere.
constexpr double kBrightness = 8;

double luminance(const glm::dvec3& c) { return (0.2126 * c.r + 0.7152 * c.g) + 0.0722 * c.b; }

double sine_of_latitude_edge(std::uint32_t edge, std::uint32_t height) {
  if (edge == 0) return 1;
  if (edge == height) return -1;
  return portable::cos(portable::kPi * edge / height);
}

std::uint64_t morton(std::uint32_t x, std::uint32_t y) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 32; ++bit)
    code |= (std::uint64_t(x >> bit & 1u) << (2 * bit)) | (std::uint64_t(y >> bit & 1u) << (2 * bit + 1));
  return code;
}

// Direction of point (s, t) of [-1, 1]^2 on a face. Which way s and t run is our own affair: cube_lookup inverts this.
glm::dvec3 face_direction(int face, double s, double t) {
  const int axis = face / 2;
  glm::dvec3 d;
  d[axis] = face % 2 == 0 ? 1 : -1;
  d[(axis + 1) % 3] = s;
  d[(axis + 2) % 3] = t;
  return d;
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Environment& environment) {
  const std::uint32_t width = environment.width, height = environment.height;

  // Mean luminance over the sphere
  double mean = 0;
  for (std::uint32_t y = 0; y < height; ++y) {
    double row = 0;
    for (std::uint32_t x = 0; x < width; ++x)
      row += luminance(glm::dvec3(environment.radiance[std::size_t(y) * width + x]));
    mean += row * environment.pixel_solid_angle(y);
  }
  mean /= 4 * portable::kPi;

  // The excess over the threshold, and what remains
  Environment rest = environment;
  struct Candidate {
    std::uint64_t order;
    std::uint32_t x, y;
    glm::dvec3 excess;
  };
  std::vector<Candidate> candidates;
  const double threshold = kBrightness * mean;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      glm::vec3& pixel = rest.radiance[std::size_t(y) * width + x];
      const glm::dvec3 whole(pixel);
      const double bright = luminance(whole);
      if (!(bright > threshold)) continue;
      pixel = glm::vec3(whole * (threshold / bright));
      candidates.push_back({morton(x, y), x, y, whole - glm::dvec3(pixel)});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.order < b.order; });
  double power = 0;
  for (const Candidate& c : candidates) power += luminance(c.excess) * environment.pixel_solid_angle(c.y);
  double sum = 0;
  for (const Candidate& c : candidates) {
    const double share = luminance(c.excess) * environment.pixel_solid_angle(c.y) / power;
    if (!(share > 0)) continue;
    sum += share;
    const double top = sine_of_latitude_edge(c.y, height), bottom = sine_of_latitude_edge(c.y + 1, height);
    bright_.push_back({sum, c.excess * (environment.pixel_solid_angle(c.y) / share),
                       portable::kPi - 2 * portable::kPi * (c.x + 1) / width, bottom, 2 * portable::kPi / width,
                       top - bottom});
  }
  if (!bright_.empty()) bright_.back().cumulative = 1;

  // The rest as a cube, each texel the mean of points in it
  constexpr int kPoints = 4;  // across
  face_size_ = std::clamp<std::uint32_t>(std::max(width / 4, height / 2), 16, 512);
  const std::size_t face_texels = std::size_t(face_size_) * face_size_;
  faces_.resize(6 * face_texels);
  parallel_for(std::size_t(6) * face_size_, [&](std::size_t row, int) {
    const int face = int(row / face_size_);
    for (std::uint32_t x = 0; x < face_size_; ++x) {
      glm::dvec3 total(0);
      for (int point = 0; point < kPoints * kPoints; ++point) {
        const double s = (x + (point % kPoints + 0.5) / kPoints) * 2 / face_size_ - 1;
        const double t = (double(row % face_size_) + (point / kPoints + 0.5) / kPoints) * 2 / face_size_ - 1;
        const glm::dvec3 d = face_direction(face, s, t);
        total += rest.radiance_towards(d / std::sqrt(glm::dot(d, d)));
      }
      faces_[row * face_size_ + x] = glm::vec3(total * (1.0 / (kPoints * kPoints)));
    }
  });
}

glm::vec3 EnvironmentSampler::rest(const glm::vec3& direction) const {
  const float ax = std::abs(direction.x), ay = std::abs(direction.y), az = std::abs(direction.z);
  const int axis = ax >= ay ? (ax >= az ? 0 : 2) : (ay >= az ? 1 : 2);
  const int face = 2 * axis + (direction[axis] < 0 ? 1 : 0);
  const float scale = 1.0f / std::abs(direction[axis]);
  const float size = float(face_size_);
  const float x = std::clamp((direction[(axis + 1) % 3] * scale + 1.0f) * 0.5f * size - 0.5f, 0.0f, size - 1.0f);
  const float y = std::clamp((direction[(axis + 2) % 3] * scale + 1.0f) * 0.5f * size - 0.5f, 0.0f, size - 1.0f);
  const std::uint32_t x0 = std::uint32_t(x), y0 = std::uint32_t(y);
  const std::uint32_t x1 = std::min(x0 + 1, face_size_ - 1), y1 = std::min(y0 + 1, face_size_ - 1);
  const float fx = x - float(x0), fy = y - float(y0);
  const glm::vec3* texels = faces_.data() + std::size_t(face) * face_size_ * face_size_;
  const glm::vec3 &a = texels[y0 * face_size_ + x0], &b = texels[y0 * face_size_ + x1];
  const glm::vec3 &c = texels[y1 * face_size_ + x0], &d = texels[y1 * face_size_ + x1];
  const glm::vec3 low = a + (b - a) * fx, high = c + (d - c) * fx;
  return low + (high - low) * fy;
}

EnvironmentSampler::Sample EnvironmentSampler::bright(double u, double a, double b) const {
  const auto found = std::upper_bound(bright_.begin(), bright_.end(), u,
                                      [](double value, const BrightPixel& pixel) { return value < pixel.cumulative; });
  const BrightPixel& pixel = found == bright_.end() ? bright_.back() : *found;
  const double longitude = pixel.longitude + pixel.longitude_width * a;
  const double sine = pixel.sine_low + pixel.sine_height * b;
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  return {{portable::sin(longitude) * cosine, sine, portable::cos(longitude) * cosine}, pixel.weighted_radiance};
}

}  // namespace twinshade

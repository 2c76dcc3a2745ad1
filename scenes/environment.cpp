#include "scenes/environment.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "base/error.h"
#include "base/hash.h"
#include "base/names.h"
#include "base/portable_math.h"
#include "scenes/environment_file.h"
#include "scenes/environment_painted.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;
using portable::kPi;

dvec2 sine_cosine(double angle) { return {portable::sin(angle), portable::cos(angle)}; }
// Sine and cosine of a pixel centre's longitude and colatitude.
dvec2 column_longitude(std::uint32_t x, std::uint32_t width) { return sine_cosine(kPi - 2 * kPi * (x + 0.5) / width); }
dvec2 row_colatitude(std::uint32_t y, std::uint32_t height) { return sine_cosine(kPi * (y + 0.5) / height); }
dvec3 direction(const dvec2& longitude, const dvec2& colatitude) {
  return {longitude.x * colatitude.x, colatitude.y, longitude.y * colatitude.x};
}

// Pixel i of `count` is a mean of pixels first to first + weights.size() - 1 of `old_count`.
struct Mean {
  std::uint32_t first;
  std::vector<double> weights;
};

// edge(i, n): where pixel i of n begins, in what means are weighed by; it rises with i / n.
template <class Edge>
std::vector<Mean> means(std::uint32_t old_count, std::uint32_t count, Edge edge) {
  std::vector<Mean> result(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    // By integers which pixels overlap: i / count < (k + 1) / old_count and k / old_count < (i + 1) / count
    result[i].first = std::uint32_t(std::uint64_t{i} * old_count / count);
    const std::uint32_t last = std::uint32_t(((std::uint64_t{i} + 1) * old_count - 1) / count);
    const double low = edge(i, count), high = edge(i + 1, count);
    double sum = 0;
    for (std::uint32_t k = result[i].first; k <= last; ++k) {
      const double overlap = std::min(high, edge(k + 1, old_count)) - std::max(low, edge(k, old_count));
      result[i].weights.push_back(std::max(overlap, 0.0));
      sum += result[i].weights.back();
    }
    for (double& weight : result[i].weights) weight /= sum;
  }
  return result;
}

// Pixels are means of what they overlap, weighed by solid angle.
Environment resized(const Environment& environment, std::uint32_t width, std::uint32_t height) {
  if (environment.width == width && environment.height == height) return environment;
  const std::vector<Mean> columns =
      means(environment.width, width, [](std::uint32_t i, std::uint32_t n) { return double(i) / n; });
  const std::vector<Mean> rows = means(environment.height, height, [](std::uint32_t i, std::uint32_t n) {
    return i == n ? 1.0 : -portable::cos(kPi * i / n);  // the sine of the latitude, southwards
  });
  Environment result{environment.name, width, height, {}, environment.note};
  result.radiance.reserve(std::size_t(width) * height);
  for (const Mean& row : rows)
    for (const Mean& column : columns) {
      dvec3 sum(0);
      for (std::size_t j = 0; j < row.weights.size(); ++j)
        for (std::size_t i = 0; i < column.weights.size(); ++i)
          sum += dvec3(environment.radiance[(row.first + j) * environment.width + column.first + i]) *
                 (row.weights[j] * column.weights[i]);
      result.radiance.push_back(glm::vec3(sum));
    }
  return result;
}

std::uint32_t wrap(std::int64_t x, std::uint32_t width) {
  const std::int64_t rest = x % std::int64_t(width);
  return std::uint32_t(rest < 0 ? rest + width : rest);
}

}  // namespace

dvec3 Environment::radiance_towards(const dvec3& direction) const {
  const double longitude = portable::atan2(direction.x, direction.z), latitude = portable::asin(direction.y);
  const double px = (kPi - longitude) / (2 * kPi) * width - 0.5, py = (0.5 * kPi - latitude) / kPi * height - 0.5;
  const double column = std::floor(px), row = std::floor(py);
  const double fx = px - column, fy = py - row;
  const auto texel = [&](double i, double j) {
    const std::uint32_t x = wrap(std::int64_t(i), width);
    const auto y = std::uint32_t(std::clamp(j, 0.0, double(height - 1)));
    return dvec3(radiance[std::size_t(y) * width + x]);
  };
  const dvec3 upper = texel(column, row) * (1 - fx) + texel(column + 1, row) * fx;
  const dvec3 lower = texel(column, row + 1) * (1 - fx) + texel(column + 1, row + 1) * fx;
  return upper * (1 - fy) + lower * fy;
}

double Environment::pixel_solid_angle(std::uint32_t y) const {
  // sin(latitude) at a row's upper edge is cos(colatitude).
  const double top = portable::cos(kPi * y / height), bottom = portable::cos(kPi * (y + 1.0) / height);
  return 2 * kPi / width * (top - bottom);
}

dvec3 Environment::pixel_direction(std::uint32_t x, std::uint32_t y) const {
  return direction(column_longitude(x, width), row_colatitude(y, height));
}

PixelDirections::PixelDirections(std::uint32_t width, std::uint32_t height) : longitudes_(width), colatitudes_(height) {
  for (std::uint32_t x = 0; x < width; ++x) longitudes_[x] = column_longitude(x, width);
  for (std::uint32_t y = 0; y < height; ++y) colatitudes_[y] = row_colatitude(y, height);
}

dvec3 PixelDirections::operator()(std::uint32_t x, std::uint32_t y) const {
  return direction(longitudes_[x], colatitudes_[y]);
}

std::vector<std::string> environment_names() { return {"sky", "studio", "window", "constant"}; }

Environment load_environment(const std::string& name_or_path, bool clamp_radiance) {
  if (name_or_path == "sky") return paint_sky();
  if (name_or_path == "studio") return paint_studio();
  if (name_or_path == "window") return paint_window();
  if (name_or_path == "constant") return paint_constant();
  if (is_environment_file(name_or_path)) {
    try {
      return load_environment_file(name_or_path, clamp_radiance);
    } catch (const std::bad_alloc&) {
      throw UserError(name_or_path + ": there is not enough memory for this environment; make it smaller");
    }
  }
  if (name_or_path.find_first_of("/.") != std::string::npos)
    throw UserError(name_or_path + ": not an environment: the name must end in .hdr or .exr");
  throw UserError(unknown_name_message("environment", name_or_path, environment_names()));
}

// A turn about Y moves longitudes only: radiance'(longitude) = radiance(longitude - angle), a shift along the rows.
Environment rotate_environment(const Environment& environment, double degrees) {
  if (!std::isfinite(degrees)) throw UserError("environment rotation must be a finite number of degrees");
  const double turns = degrees / 360 - std::floor(degrees / 360);
  const double shift = turns * environment.width;
  const double whole = std::floor(shift), rest = shift - whole;
  if (whole == 0 && rest == 0) return environment;
  Environment result = environment;
  for (std::uint32_t y = 0; y < environment.height; ++y) {
    const glm::vec3* row = &environment.radiance[std::size_t(y) * environment.width];
    for (std::uint32_t x = 0; x < environment.width; ++x) {
      const dvec3 left(row[wrap(std::int64_t(x) + std::int64_t(whole), environment.width)]);
      const dvec3 right(row[wrap(std::int64_t(x) + std::int64_t(whole) + 1, environment.width)]);
      result.radiance[std::size_t(y) * environment.width + x] =
          rest == 0 ? glm::vec3(left) : glm::vec3(left * (1 - rest) + right * rest);
    }
  }
  return result;
}

Environment refine_environment(const Environment& environment, std::uint32_t width, std::uint32_t height) {
  if (environment.radiance.empty()) return environment;
  const std::uint32_t columns = std::max(1u, (width + environment.width - 1) / environment.width);
  const std::uint32_t rows = std::max(1u, (height + environment.height - 1) / environment.height);
  Environment result = environment;
  result.width *= columns;
  result.height *= rows;
  result.radiance.resize(std::size_t(result.width) * result.height);
  for (std::uint32_t y = 0; y < result.height; ++y)
    for (std::uint32_t x = 0; x < result.width; ++x)
      result.radiance[std::size_t(y) * result.width + x] =
          environment.radiance[std::size_t(y / rows) * environment.width + x / columns];
  return result;
}

Environment refine_small_environment(const Environment& environment, std::uint32_t few_rows) {
  return refine_environment(environment, environment.width < 2 * few_rows ? 4 * few_rows : 0,
                            environment.height < few_rows ? 2 * few_rows : 0);
}

Environment blend_environments(const Environment& a, const Environment& b, double part) {
  if (!(part >= 0 && part <= 1)) throw UserError("blend of environments must be from 0 to 1");
  const std::uint32_t width = std::max(a.width, b.width), height = std::max(a.height, b.height);
  Environment result = resized(a, width, height);
  const Environment to = resized(b, width, height);
  result.name = a.name + " + " + b.name;
  if (result.note.empty()) result.note = b.note;
  for (std::size_t pixel = 0; pixel < result.radiance.size(); ++pixel)
    result.radiance[pixel] = glm::vec3(dvec3(result.radiance[pixel]) * (1 - part) + dvec3(to.radiance[pixel]) * part);
  return result;
}

std::string environment_hash(const Environment& environment) {
  static_assert(sizeof(glm::vec3) == 12);
  Sha256 hash;
  hash.add("twinshade environment 1");
  hash.add(&environment.width, sizeof environment.width);
  hash.add(&environment.height, sizeof environment.height);
  hash.add(environment.radiance.data(), environment.radiance.size() * sizeof(glm::vec3));
  return hash.hex();
}

}  // namespace twinshade

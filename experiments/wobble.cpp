// A single distant light steered over the sphere (Iwanicki and Sloan, Ambient Dice, EGSR 2017, figure 11): its
// irradiance max(0, n . light) should look the same from wherever it shines. A basis that is not rotation invariant
// makes its peak rise and fall and stray from the light, and lights the dark side in rings.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "experiments/bases.h"
#include "experiments/chart.h"
#include "experiments/directions.h"
#include "experiments/probe_light.h"
#include "lighting/irradiance_module.h"
#include "lighting/projection.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

using portable::kPi;

constexpr int kPublishedLights = 240;
constexpr int kRingDegrees = 2, kSpokes = 24;  // where irradiance is looked at, about the light
constexpr int kRings = 180 / kRingDegrees + 1;
constexpr int kCellPoints = 10;  // of the quadrature that fits

// kRings rings of kSpokes normals about the light, from the light to its opposite.
std::vector<glm::dvec3> normals_about(const glm::dvec3& light) {
  const auto [u, v] = tangents(light);
  std::vector<glm::dvec3> normals;
  for (int ring = 0; ring < kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double theta = ring * kRingDegrees * kPi / 180, phi = 2 * kPi * spoke / kSpokes;
      normals.push_back(light * portable::cos(theta) +
                        (u * portable::cos(phi) + v * portable::sin(phi)) * portable::sin(theta));
    }
  return normals;
}

// Of one light.
struct Shape {
  double peak = 0, position_error = 0;  // largest value, and degrees between it and the light
  double ring = 0;                      // how far irradiance falls below zero, in the ring about the dark side's edge
  double rebound = 0;                   // how high it rises again beyond: see rebound_height
  double asymmetry = 0;                 // root mean square difference from the mean around the light
  std::vector<double> profile;          // mean around the light, by ring
};

// Going away from the light, the largest mean around it after the first minimum: 0 where it only gets darker.
double rebound_height(const std::vector<double>& profile) {
  int ring = 60 / kRingDegrees;  // nearer the light a dent in the peak would count
  while (ring + 1 < kRings && profile[std::size_t(ring + 1)] <= profile[std::size_t(ring)]) ++ring;
  double height = 0;
  for (++ring; ring < kRings; ++ring) height = std::max(height, profile[std::size_t(ring)]);
  return height;
}

class Basis {
 public:
  explicit Basis(const TechniqueInfo& basis)
      : points_(icosahedral_quadrature(kCellPoints)),
        projector_(basis, points_.directions, points_.weights),
        module_(basis, Number::float64) {}

  Shape shape(const glm::dvec3& light) const {
    const std::vector<double> coefficients = coefficients_of(light);
    const std::vector<glm::dvec3> normals = normals_about(light);
    const std::vector<double> values = irradiance(coefficients, normals);
    Shape shape;
    double weights = 0, squares = 0;
    std::size_t brightest = 0;
    double darkest = values[0];
    for (int ring = 0; ring < kRings; ++ring) {
      double mean = 0;
      for (int spoke = 0; spoke < kSpokes; ++spoke) mean += values[std::size_t(ring * kSpokes + spoke)] / kSpokes;
      shape.profile.push_back(mean);
      const double weight = portable::sin(ring * kRingDegrees * kPi / 180);
      for (int spoke = 0; spoke < kSpokes; ++spoke) {
        const std::size_t i = std::size_t(ring * kSpokes + spoke);
        if (values[i] > values[brightest]) brightest = i;
        darkest = std::min(darkest, values[i]);
        weights += weight;
        squares += weight * (values[i] - mean) * (values[i] - mean);
      }
    }
    shape.asymmetry = std::sqrt(squares / weights);
    shape.ring = std::max(0.0, -darkest);
    shape.rebound = rebound_height(shape.profile);
    const glm::dvec3 peak = climb(coefficients, normals[brightest], values[brightest], shape.peak);
    shape.position_error = portable::acos(glm::dot(peak, light)) * 180 / kPi;
    return shape;
  }

 private:
  std::vector<double> coefficients_of(const glm::dvec3& light) const {
    std::vector<double> samples, radiance(std::size_t(kMostRadianceCount) * 3, 0.0);
    for (const glm::dvec3& n : points_.directions) samples.insert(samples.end(), 3, std::max(0.0, glm::dot(n, light)));
    const std::vector<double> values = radiance_basis({&light, 1});
    for (std::size_t j = 0; j < values.size(); ++j)
      for (std::size_t c = 0; c < 3; ++c) radiance[j * 3 + c] = values[j];
    return projector_.project(samples, radiance);
  }

  // White light: the first channel.
  std::vector<double> irradiance(const std::vector<double>& coefficients,
                                 const std::vector<glm::dvec3>& normals) const {
    const std::vector<double> rgb = module_.run(
        normals.size(), [&](std::size_t row) { return normals[row]; },
        [&](std::size_t, int i, int c) { return coefficients[std::size_t(i) * 3 + std::size_t(c)]; });
    std::vector<double> values;
    for (std::size_t i = 0; i < rgb.size(); i += 3) values.push_back(rgb[i]);
    return values;
  }

  // The peak near a point of the grid, by steps to the highest of eight neighbours, if it is higher. Each is half as
  // long as the one before; together they reach twice the rings' distance, and near the light no peak is farther from
  // the grid.
  glm::dvec3 climb(const std::vector<double>& coefficients, glm::dvec3 n, double value, double& peak) const {
    for (double step = kRingDegrees * kPi / 180; step > 1e-4; step /= 2) {
      const auto around = directions_around(n, step);
      const std::vector<double> values = irradiance(coefficients, {around.begin(), around.end()});
      const std::size_t best = std::size_t(std::max_element(values.begin(), values.end()) - values.begin());
      if (values[best] > value) n = around[best], value = values[best];
    }
    peak = value;
    return n;
  }

  Quadrature points_;
  SampleProjector projector_;
  IrradianceModule module_;
};

// Over all lights.
struct Wobble {
  double peak_low = 0, peak_high = 0, position_error = 0, ring_low = 0, ring_high = 0, rebound = 0, asymmetry = 0;
  std::vector<double> profile;
};

Wobble wobble(const std::vector<Shape>& shapes) {
  Wobble all;
  all.peak_low = all.ring_low = INFINITY;
  all.peak_high = -INFINITY;
  all.profile.assign(std::size_t(kRings), 0.0);
  for (const Shape& shape : shapes) {
    all.peak_low = std::min(all.peak_low, shape.peak);
    all.peak_high = std::max(all.peak_high, shape.peak);
    all.position_error = std::max(all.position_error, shape.position_error);
    all.ring_low = std::min(all.ring_low, shape.ring);
    all.ring_high = std::max(all.ring_high, shape.ring);
    all.rebound = std::max(all.rebound, shape.rebound);
    all.asymmetry = std::max(all.asymmetry, shape.asymmetry);
    for (std::size_t k = 0; k < all.profile.size(); ++k) all.profile[k] += shape.profile[k] / double(shapes.size());
  }
  return all;
}

Drawing peak_chart(const std::vector<const TechniqueInfo*>& bases, const std::vector<Wobble>& wobbles) {
  BarChart chart;
  chart.title = "A single light steered over the sphere";
  chart.subtitle = "What each basis makes of max(0, n . light): exact would be a peak of 1 and nothing below 0.";
  chart.value.title = "irradiance, of that facing the light";
  chart.dots = true;
  chart.bars = {{"lowest peak", {}}, {"highest peak", {}}, {"dark ring", {}}, {"rebound", {}}};
  for (std::size_t b = 0; b < bases.size(); ++b) {
    chart.rows.emplace_back(bases[b]->name);
    const double values[] = {wobbles[b].peak_low, wobbles[b].peak_high, -wobbles[b].ring_high, wobbles[b].rebound};
    for (std::size_t k = 0; k < chart.bars.size(); ++k) chart.bars[k].values.push_back(values[k]);
  }
  return draw(chart);
}

Drawing profile_chart(const std::vector<const TechniqueInfo*>& bases, const std::vector<Wobble>& wobbles,
                      const ExperimentOptions& options) {
  // More lines than can be told apart: where no basis was asked for, those that the paper compares.
  constexpr std::string_view kShown[] = {"sh2",     "sh3",         "sh5", "ambient_cube", "ad_linear_spherical",
                                         "ad_flat", "ad_spherical"};
  LineChart chart;
  chart.title = "Profile of a single light";
  chart.subtitle = "Irradiance by angle from the light: mean over all lights and around each.";
  chart.x.title = "angle from the light, degrees";
  chart.y.title = "irradiance, of that facing the light";
  chart.x.high = 180;
  Series exact{"exact", {}, {}, false};
  for (int ring = 0; ring < kRings; ++ring) {
    exact.x.push_back(ring * kRingDegrees);
    exact.y.push_back(std::max(0.0, portable::cos(ring * kRingDegrees * kPi / 180)));
  }
  for (std::size_t b = 0; b < bases.size(); ++b)
    if (!options.bases.empty() || std::find(std::begin(kShown), std::end(kShown), bases[b]->name) != std::end(kShown))
      chart.series.push_back({std::string(bases[b]->name), exact.x, wobbles[b].profile, false});
  chart.series.push_back(std::move(exact));
  return draw(chart);
}

}  // namespace

ExperimentResult run_wobble(const ExperimentOptions& options) {
  const std::vector<const TechniqueInfo*> bases = chosen_bases(options, why_not_spherical);
  const std::size_t lights = std::size_t(options.samples > 0 ? options.samples : kPublishedLights);
  ExperimentResult result{
      Rows({"basis", "peak_low", "peak_high", "position_error", "ring_low", "ring_high", "rebound", "asymmetry"}),
      {},
      {}};
  std::vector<Wobble> wobbles;
  for (const TechniqueInfo* info : bases) {
    options.progress(std::string(info->name));
    const Basis basis(*info);
    std::vector<Shape> shapes(lights);
    parallel_for(lights, [&](std::size_t i, int) { shapes[i] = basis.shape(lattice_direction(i, lights)); });
    wobbles.push_back(wobble(shapes));
    const Wobble& w = wobbles.back();
    result.rows.add({std::string(info->name), w.peak_low, w.peak_high, w.position_error, w.ring_low, w.ring_high,
                     w.rebound, w.asymmetry});
  }
  result.notes = {"irradiance of that facing the light; position_error in degrees",
                  "ring: how far irradiance falls below zero, least and most over all lights; rebound: largest mean "
                  "around the light beyond that ring; asymmetry: largest root mean square difference from rotational "
                  "symmetry about the light"};
  if (options.pictures && !bases.empty()) {
    result.pictures.push_back({"wobble", peak_chart(bases, wobbles)});
    result.pictures.push_back({"wobble-profile", profile_chart(bases, wobbles, options)});
  }
  return result;
}

}  // namespace twinshade

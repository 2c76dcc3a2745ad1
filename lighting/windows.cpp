// The search for the weakest window is one over a growing set of directions: at first a fixed grid, for which the
// weakest window is found by bisection; then, again and again, the lowest place under that window, until it is not
// below zero any more.
#include "lighting/windows.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "lighting/radiance_basis.h"

namespace twinshade {
namespace {

constexpr double kStrongest = 1.0 / 3;

double sinc(double x) { return x == 0 ? 1 : portable::sin(x) / x; }

}  // namespace

BandFactors hanning_window(double width) {
  BandFactors factors{1, 0, 0};
  for (int l = 1; l < 3; ++l) factors[l] = l < width ? (1 + portable::cos(portable::kPi * l / width)) / 2 : 0;
  return factors;
}

BandFactors lanczos_window(double width) {
  BandFactors factors{1, 0, 0};
  for (int l = 1; l < 3; ++l) factors[l] = l < width ? sinc(portable::kPi * l / width) : 0;
  return factors;
}

BandFactors minimum_window(double strength) {
  BandFactors factors{1, 0, 0};
  for (int l = 1; l < 3; ++l) {
    const double once = sinc(portable::kPi * l * strength);
    factors[l] = (once * once) * (once * once);
  }
  return factors;
}

MinimumWindow::MinimumWindow(Domain domain) : hemisphere_(domain == Domain::hemisphere) {
  const int levels = hemisphere_ ? 8 : 15, spokes = 16;
  for (int level = 0; level < levels; ++level) {
    const double z = hemisphere_ ? level / double(levels) : -1 + 2 * (level + 0.5) / levels;
    const double radius = std::sqrt(1 - z * z);
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double angle = 2 * portable::kPi * (spoke + 0.5 * (level % 2)) / spokes;
      directions_.push_back({radius * portable::cos(angle), radius * portable::sin(angle), z});
    }
  }
  directions_.push_back({0, 0, 1});

  // The functions as polynomials, from their values along the axes and between them
  const double half = std::sqrt(0.5);
  const glm::dvec3 places[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {half, half, 0}, {0, half, half}, {half, 0, half}};
  const std::vector<double> values = basis_values(find_technique("sh3"), places);
  constant_ = values[0];
  for (int j = 0; j < 3; ++j)
    for (int axis = 0; axis < 3; ++axis) linear_[j][axis] = values[axis * 9 + 1 + j];
  for (int j = 0; j < 5; ++j) {
    const auto value = [&](int place) { return values[place * 9 + 4 + j]; };
    glm::dmat3& q = quadratic_[j];
    for (int axis = 0; axis < 3; ++axis) {
      q[axis][axis] = value(axis);
      const int next = (axis + 1) % 3;
      q[axis][next] = q[next][axis] = value(3 + axis) - (value(axis) + value(next)) / 2;
    }
  }
}

MinimumWindow::Polynomial MinimumWindow::polynomial(const double* sh, int channel) const {
  Polynomial out{sh[channel] * constant_, glm::dvec3(0), glm::dmat3(0)};
  for (int j = 0; j < 3; ++j) out.linear += linear_[j] * sh[(1 + j) * 3 + channel];
  for (int j = 0; j < 5; ++j) out.quadratic += quadratic_[j] * sh[(4 + j) * 3 + channel];
  return out;
}

// Newton's method on the sphere where it goes down, else a gradient step short enough to do so; at the horizon of a
// hemisphere that would be left, along the horizon.
glm::dvec3 MinimumWindow::descend(const Polynomial& channel, const BandFactors& factors, glm::dvec3 n) const {
  const glm::dvec3 linear = channel.linear * factors[1];
  const glm::dmat3 quadratic = channel.quadratic * factors[2];
  const auto height = [&](const glm::dvec3& d) { return glm::dot(linear, d) + glm::dot(d, quadratic * d); };
  double norm = 0;
  for (int i = 0; i < 3; ++i) norm += glm::dot(quadratic[i], quadratic[i]);
  const double bound = 4 * std::sqrt(norm) + std::sqrt(glm::dot(linear, linear));
  if (!(bound > 0)) return n;

  const auto onto_domain = [&](glm::dvec3 d) {
    if (hemisphere_ && d.z < 0) d.z = 0;
    return d / std::sqrt(glm::dot(d, d));
  };
  double lowest = height(n);
  for (int step = 0; step < 24; ++step) {
    const glm::dvec3 gradient = linear + (quadratic * n) * 2.0;
    const glm::dvec3 tangential = gradient - n * glm::dot(n, gradient);
    const glm::dvec3 helper = std::abs(n.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    glm::dvec3 e1 = glm::cross(helper, n);
    e1 /= std::sqrt(glm::dot(e1, e1));
    const glm::dvec3 e2 = glm::cross(n, e1);  // at the horizon: up
    const bool at_horizon = hemisphere_ && n.z <= 0 && tangential.z > 0;
    const double g1 = glm::dot(gradient, e1), g2 = at_horizon ? 0 : glm::dot(gradient, e2);
    const double bend = glm::dot(gradient, n);
    const double h11 = 2 * glm::dot(e1, quadratic * e1) - bend, h12 = 2 * glm::dot(e1, quadratic * e2);
    const double h22 = 2 * glm::dot(e2, quadratic * e2) - bend, determinant = h11 * h22 - h12 * h12;
    glm::dvec3 next = n;
    bool down = false;
    if (h11 > 0 && (at_horizon || determinant > 0)) {
      const double s1 = at_horizon ? g1 / h11 : (h22 * g1 - h12 * g2) / determinant;
      const double s2 = at_horizon ? 0 : (h11 * g2 - h12 * g1) / determinant;
      next = onto_domain(n - e1 * s1 - e2 * s2);
      down = height(next) < lowest;
    }
    if (!down) {
      next = onto_domain(n - (e1 * g1 + e2 * g2) / bound);
      if (!(height(next) < lowest)) break;
    }
    n = next;
    lowest = height(n);
  }
  return n;
}

double MinimumWindow::strength(const double* sh) const {
  Polynomial channels[3];
  bool lit[3];
  for (int c = 0; c < 3; ++c) {
    channels[c] = polynomial(sh, c);
    lit[c] = false;
    for (int j = 0; j < 9; ++j) lit[c] = lit[c] || sh[j * 3 + c] != 0;
    if (lit[c] && !(channels[c].constant > 0)) return kStrongest;
  }

  // Mostly the bands cannot reach the constant at all
  bool reaches = false;
  for (int c = 0; c < 3; ++c) {
    double norm = 0;
    for (int i = 0; i < 3; ++i) norm += glm::dot(channels[c].quadratic[i], channels[c].quadratic[i]);
    const double most = std::sqrt(glm::dot(channels[c].linear, channels[c].linear)) + std::sqrt(norm);
    reaches = reaches || (lit[c] && !(most <= channels[c].constant));
  }
  if (!reaches) return 0;

  // Directions that some window between none and the strongest could leave below zero
  const BandFactors strongest = minimum_window(kStrongest);
  std::vector<Place> places;
  const auto add_place = [&](const Polynomial& channel, const glm::dvec3& n) {
    const double band1 = glm::dot(channel.linear, n) / channel.constant;
    const double band2 = glm::dot(n, channel.quadratic * n) / channel.constant;
    if (1 + std::min(band1, band1 * strongest[1]) + std::min(band2, band2 * strongest[2]) < 0)
      places.push_back({band1, band2});
  };
  const auto lowest_under = [&](const BandFactors& factors) {
    double lowest = 1;
    for (const Place& place : places)
      lowest = std::min(lowest, 1 + factors[1] * place.band1 + factors[2] * place.band2);
    return lowest;
  };

  for (int c = 0; c < 3; ++c)
    if (lit[c])
      for (const glm::dvec3& n : directions_) add_place(channels[c], n);

  double strength = 0;
  for (int round = 0; round < 8; ++round) {
    if (lowest_under(minimum_window(strength)) < 0) {
      double low = strength, high = kStrongest;
      if (lowest_under(strongest) < 0) return kStrongest;
      for (int i = 0; i < 48; ++i) {
        const double middle = (low + high) / 2;
        (lowest_under(minimum_window(middle)) < 0 ? low : high) = middle;
      }
      strength = high;
    }

    // The lowest place of each channel under this window
    const BandFactors factors = minimum_window(strength);
    bool below = false;
    for (int c = 0; c < 3; ++c) {
      if (!lit[c]) continue;
      const auto height = [&](const glm::dvec3& n) {
        return channels[c].constant + factors[1] * glm::dot(channels[c].linear, n) +
               factors[2] * glm::dot(n, channels[c].quadratic * n);
      };
      glm::dvec3 lowest = directions_[0];
      double lowest_height = height(lowest);
      for (const glm::dvec3& n : directions_)
        if (const double h = height(n); h < lowest_height) lowest = n, lowest_height = h;
      lowest = descend(channels[c], factors, lowest);
      if (height(lowest) < -1e-12 * channels[c].constant) {
        below = true;
        add_place(channels[c], lowest);
      }
    }
    if (!below) break;
  }
  return strength;
}

}  // namespace twinshade

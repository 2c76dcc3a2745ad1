#include "scenes/statues.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/portable_math.h"
#include "scenes/blend.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;
using portable::kPi;

// A Catmull-Rom curve through evenly spaced values (E. Catmull and R. Rom, A class of local interpolating splines,
// 1974).
template <std::size_t N>
double through(const std::array<double, N>& values, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * double(N - 1);
  const auto i = std::min(std::size_t(x), N - 2);
  const double f = x - double(i);
  const double p0 = values[i == 0 ? 0 : i - 1], p1 = values[i], p2 = values[i + 1],
               p3 = values[i + 2 < N ? i + 2 : N - 1];
  return p1 + 0.5 * f * (p2 - p0 + f * (2 * p0 - 5 * p1 + 4 * p2 - p3 + f * (3 * (p1 - p2) + p3 - p0)));
}

}  // namespace

void add_pedestal(PatchMesh& mesh, const dvec3& foot, const Finish& moulding, const Finish& block) {
  const dvec3 up(0, 1, 0);
  const auto slab = [&](double low, double high, double half, const char* faces, const Finish& finish) {
    add_box(mesh, foot + up * (0.5 * (low + high)), {half, 0.5 * (high - low), half}, faces, finish);
  };
  slab(-0.002, 0.10, 0.46, "xXYzZ", moulding);
  slab(0.099, 0.16, 0.41, "xXYzZ", moulding);
  slab(0.159, 0.83, 0.35, "xXzZ", block);
  slab(0.829, 0.87, 0.39, "xXyzZ", moulding);
  slab(0.869, kPedestalHeight, 0.44, "xXyYzZ", moulding);
}

void add_figure(PatchMesh& mesh, const dvec3& foot, int number, const Finish& finish) {
  constexpr double kHeight = 1.46;  // to the neck's end
  // Half widths from the hem to the neck, side to side and front to back.
  static constexpr std::array<double, 12> kSide = {0.27,  0.25, 0.235, 0.23,  0.235, 0.225,
                                                   0.185, 0.19, 0.215, 0.232, 0.165, 0.056};
  static constexpr std::array<double, 12> kFront = {0.25,  0.225, 0.205, 0.195, 0.19,  0.175,
                                                    0.145, 0.155, 0.165, 0.150, 0.105, 0.056};
  const double turn = 0.7 * number + 0.3, phase = 1.9 * number, folds = 9 + 2 * (number % 3);
  const double lean = number % 2 == 0 ? 1 : -1;
  const double cosine = portable::cos(turn), sine = portable::sin(turn);
  // The axis sways as the weight rests on one leg.
  const auto axis = [=](double t) {
    return 0.045 * lean * portable::sin(2.3 * kPi * t) * (1 - smooth_step(0.75, 1, t));
  };
  const auto place = [=](double x, double y, double z) {
    return foot + dvec3(x * cosine + z * sine, y, z * cosine - x * sine);
  };
  const auto body = [=](double u, double v) {
    const double angle = 2 * kPi * u;
    const double c = portable::cos(angle), s = portable::sin(angle);
    // Folds hang from the hips, twist a little and gather towards the hem; a sash crosses the chest.
    const double hang = 1 - smooth_step(0.30, 0.62, v),
                 chest = smooth_step(0.48, 0.62, v) * (1 - smooth_step(0.72, 0.84, v));
    const double fold = portable::cos(folds * angle + phase + 2.2 * v + 0.9 * portable::sin(3 * angle + phase));
    const double sash = portable::cos(26 * (v - 0.07 * c * lean) + 2 * angle + phase);
    const double knee = std::max(0.0, c * 0.5 + s * 0.8 * lean);
    const double swell = 1 + 0.115 * hang * fold * (1.1 - 0.5 * v) + 0.035 * chest * sash +
                         0.10 * knee * knee * smooth_step(0.12, 0.26, v) * (1 - smooth_step(0.30, 0.48, v));
    // The neck closes inside the head.
    const double close = v < 0.96 ? 1 : std::sqrt(std::max(0.0, 1 - (v - 0.96) * (v - 0.96) / (0.04 * 0.04)));
    return place(axis(v) + through(kSide, v) * swell * close * c, kHeight * v, -through(kFront, v) * swell * close * s);
  };
  add_tube(mesh, body, 1.5, kHeight, finish, 44, 40, dvec2(2, 2), false, true, 1.4);

  // Head with a knot of hair, and arms folded under the drapery as two soft limbs.
  const double lift = kHeight + 0.10;
  add_ball(
      mesh,
      [=](const dvec3& d) {
        const double face = 1 + 0.05 * std::max(0.0, d.z) - 0.10 * std::max(0.0, -d.y) * std::max(0.0, -d.y);
        return place(d.x * 0.088 * face, lift + d.y * 0.128, d.z * 0.108 * face);
      },
      0.11, finish, 6, 1.4);
  add_ball(
      mesh, [=](const dvec3& d) { return place(d.x * 0.06, lift + 0.05 + d.y * 0.055, -0.105 + d.z * 0.06); }, 0.06,
      finish, 4, 1.4);
  for (int arm = 0; arm < 2; ++arm) {
    const double mirror = arm == 0 ? 1 : -1;
    // Shoulder, elbow, hand: a bent tube of changing width.
    const std::array<dvec3, 4> joints = {
        {{0.20 * mirror, 1.235, 0},
         {0.285 * mirror, 1.05, -0.02},
         {0.25 * mirror, 0.86, 0.06},
         {arm == number % 2 ? 0.02 : 0.22 * mirror, arm == number % 2 ? 0.98 : 0.70, 0.19}}};
    const auto limb = [=](double u, double v) {
      const auto spine = [&](double t) {
        const double a = 1 - t;
        return joints[0] * (a * a * a) + joints[1] * (3 * a * a * t) + joints[2] * (3 * a * t * t) +
               joints[3] * (t * t * t);
      };
      const double t = std::min(v, 1.0);
      const dvec3 tangent = glm::normalize(spine(t + 0x1p-9) - spine(t - 0x1p-9));
      // The reference is far from every direction that the limb takes.
      const dvec3 across = glm::normalize(glm::cross(tangent, dvec3(0.6, 0.3 * mirror, 0.75 * mirror)));
      const dvec3 other = glm::cross(tangent, across);
      const double angle = 2 * kPi * u;
      // Rounded ends: quarter circles over the first eighth and the last tenth.
      const double end = std::max(std::max(0.0, 1 - v / 0.125), std::max(0.0, (v - 0.9) / 0.1));
      const double rounded = std::sqrt(std::max(0.0, 1 - end * end));
      const double width = (0.070 - 0.034 * t + 0.003 * portable::cos(14 * kPi * t)) * rounded;
      const dvec3 at = spine(t) + (across * portable::cos(angle) + other * portable::sin(angle)) * width;
      return place(at.x, at.y, at.z);
    };
    add_tube(mesh, limb, 0.42, 0.62, finish, 14, 14, dvec2(1, 1), true, true, 1.4);
  }
}

void add_twist(PatchMesh& mesh, const dvec3& foot, double height, double radius, const Finish& finish) {
  const auto position = [=](double u, double v) {
    const double angle = 2 * kPi * u;
    const double taper = std::sqrt(std::max(0.0, 1 - v)) * (0.75 + 0.25 * portable::sin(kPi * (0.2 + 1.6 * v)));
    const double strands = 1 + 0.28 * portable::cos(3 * angle + 9 * v);
    const double r = radius * taper * strands;
    return foot + dvec3(r * portable::cos(angle), height * v, -r * portable::sin(angle));
  };
  add_tube(mesh, position, 2 * kPi * radius, height, finish, 36, 28, dvec2(1, 1), false, true, 1.4);
}

}  // namespace twinshade

#include "experiments/frame_error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "lighting/random.h"

using namespace twinshade;

namespace {

double noise(std::uint64_t domain, std::size_t i) { return unit_real(random_bits(7, domain, i)) - 0.5; }

// Pixels whose radiance is between 0.5 and 1.5, drawn `factor` times as bright; the truth's estimates are off by noise
// of this amplitude, independent of each other.
struct Drawn {
  Frame frame;
  Truth truth;
  Drawn(std::size_t count, float factor, double amplitude) {
    frame.width = std::uint32_t(count);
    frame.height = 1;
    frame.color.assign(count * 4, 1.0f);
    for (std::size_t i = 0; i < count; ++i) {
      truth.pixels.push_back(i);
      const double radiance = 1 + noise(1, i);
      for (std::size_t c = 0; c < 3; ++c) frame.color[i * 4 + c] = float(radiance) * factor;
      for (std::size_t half = 0; half < 2; ++half)
        truth.radiance[half].push_back(glm::vec3(float(radiance + amplitude * noise(2 + half, i))));
    }
  }
};

}  // namespace

TEST_CASE("a frame that is a tenth too bright is off by a tenth") {
  const Drawn drawn(1000, 1.1f, 0);
  const FrameError error = frame_error(drawn.frame, drawn.truth);
  CHECK(error.finite);
  CHECK(error.rms == doctest::Approx(0.1).epsilon(1e-5));
  CHECK(error.bias == doctest::Approx(0.1).epsilon(1e-5));
  CHECK(error.worst > 0.1);
  CHECK(error.worst < 0.15);
  CHECK(truth_noise(drawn.truth) == 0);
}

TEST_CASE("the truth's noise does not count as the frame's error") {
  const Drawn right(100000, 1, 0.4), wrong(100000, 1.05f, 0.4);
  // Of uniform noise 0.4 wide: its standard deviation, of the mean of two
  CHECK(truth_noise(right.truth) == doctest::Approx(0.4 / std::sqrt(24) / std::sqrt(1 + 1.0 / 12)).epsilon(0.01));
  CHECK(frame_error(right.frame, right.truth).rms < 0.01);
  CHECK(frame_error(wrong.frame, wrong.truth).rms == doctest::Approx(0.05).epsilon(0.03));
}

TEST_CASE("a frame with a NaN has no error, and pixels that are not compared do not matter") {
  Drawn drawn(10, 1, 0);
  drawn.truth.pixels.pop_back();
  for (auto& half : drawn.truth.radiance) half.pop_back();
  drawn.frame.color[9 * 4] = std::numeric_limits<float>::quiet_NaN();
  CHECK(frame_error(drawn.frame, drawn.truth).finite);
  drawn.frame.color[4 * 4 + 2] = std::numeric_limits<float>::infinity();
  const FrameError error = frame_error(drawn.frame, drawn.truth);
  CHECK_FALSE(error.finite);
  CHECK(std::isnan(error.rms));
}

TEST_CASE("against black there is no relative error") {
  Drawn drawn(10, 1, 0);
  for (auto& half : drawn.truth.radiance) half.assign(10, glm::vec3(0));
  const FrameError error = frame_error(drawn.frame, drawn.truth);
  CHECK(std::isnan(error.rms));
  CHECK(std::isnan(error.bias));
  CHECK(error.finite);
}

TEST_CASE("stratified places rise, one in each stretch, and are all of them where there are no more") {
  const std::vector<std::size_t> places = stratified_places(1000, 70, 3);
  REQUIRE(places.size() == 70);
  for (std::size_t k = 0; k < places.size(); ++k) {
    CAPTURE(k);
    CHECK(double(places[k]) >= std::floor(double(k) * 1000 / 70));
    CHECK(double(places[k]) < double(k + 1) * 1000 / 70);
    if (k > 0) CHECK(places[k] > places[k - 1]);
  }
  CHECK(stratified_places(1000, 70, 3) == places);
  CHECK(stratified_places(1000, 70, 4) != places);
  CHECK(stratified_places(4, 9, 3) == std::vector<std::size_t>{0, 1, 2, 3});
  CHECK(stratified_places(0, 9, 3).empty());
}

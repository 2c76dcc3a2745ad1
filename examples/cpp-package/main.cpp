// Calls sunlight.frag: once, for a whole half circle of normals, and in double.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "sunlight.h"

int main() {
  sunlight::Uniforms uniforms;
  uniforms.sun.direction = {0.6f, 0.8f, 0.0f};
  uniforms.sun.colour = {10.0f, 9.0f, 8.0f};
  uniforms.sky = {1.0f, 2.0f, 4.0f};
  uniforms.haze = 0.01f;

  // One invocation: a floor, a hundred metres away. Half of its radiance is lost to haze.
  const sunlight::Outputs floor =
      sunlight::shade(uniforms, sunlight::Inputs{.normal = {0.0f, 1.0f, 0.0f}, .distance_to_camera = 100.0f});
  std::printf("floor: %g %g %g\n", double(floor.radiance[0]), double(floor.radiance[1]), double(floor.radiance[2]));

  // A batch: as many outputs as inputs.
  constexpr std::size_t kCount = 1001;
  std::vector<sunlight::Inputs> inputs(kCount);
  std::vector<sunlight::Outputs> outputs(kCount);
  std::vector<sunlight::InputsDouble> exact_inputs(kCount);
  std::vector<sunlight::OutputsDouble> exact(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double angle = std::numbers::pi * double(i) / double(kCount - 1);
    const float x = float(std::cos(angle)), y = float(std::sin(angle));
    inputs[i].normal = {x, y, 0.0f};
    exact_inputs[i].normal = {double(x), double(y), 0.0};
  }
  sunlight::shade(uniforms, inputs, outputs);
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < kCount; ++i)
    if (outputs[i].radiance[0] > outputs[brightest].radiance[0]) brightest = i;
  std::printf("brightest: %zu\n", brightest);

  // In double: how much of the result is rounding?
  sunlight::shade(uniforms, exact_inputs, exact);
  double rounding = 0;
  for (std::size_t i = 0; i < kCount; ++i)
    rounding =
        std::fmax(rounding, std::fabs(double(outputs[i].radiance[0]) - exact[i].radiance[0]) / exact[i].radiance[0]);
  std::printf("rounding: %s\n", rounding > 0 && rounding < 1e-6 ? "below 1e-6" : "too much");
}

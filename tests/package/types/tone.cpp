// Made into two libraries, each with a shader tone of its own and TONE as the function's name.
#include "tone.h"

#include <vector>

float TONE(float x);
float TONE(float x) {
  std::vector<tone::Inputs> inputs;
  while (inputs.size() < 5) {
    inputs.emplace_back();
    inputs.back().x = x;
  }
  std::vector<tone::Outputs> outputs(inputs.size());
  tone::shade(tone::Uniforms{}, inputs, outputs);
  return outputs.back().y == tone::shade(tone::Uniforms{}, inputs[0]).y ? outputs.back().y : -1;
}

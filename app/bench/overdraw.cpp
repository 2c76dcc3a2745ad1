#include "app/bench/overdraw.h"

namespace twinshade::bench {

Bundle with_overdraw(const Bundle& bundle, int layers) {
  constexpr float kStep = 0.002f;  // of normalized depth, which reaches from -1 to 1
  Bundle stacked = bundle;
  const std::size_t vertices = bundle.vertex_count();
  for (int layer = 1; layer < layers; ++layer) {
    for (std::size_t v = 0; v < vertices; ++v) {
      const float* p = &bundle.clip_positions[4 * v];
      stacked.clip_positions.insert(stacked.clip_positions.end(),
                                    {p[0], p[1], p[2] - kStep * float(layer) * p[3], p[3]});
    }
    for (const std::uint32_t index : bundle.indices)
      stacked.indices.push_back(index + std::uint32_t(vertices * std::size_t(layer)));
    for (std::size_t a = 0; a < bundle.attributes.size(); ++a) {
      const std::vector<float>& values = bundle.attributes[a].values;
      stacked.attributes[a].values.insert(stacked.attributes[a].values.end(), values.begin(), values.end());
    }
  }
  return stacked;
}

}  // namespace twinshade::bench

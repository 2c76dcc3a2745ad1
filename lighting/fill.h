// Cells without light of their own take it from their neighbours: texels inside geometry, and the gutters around charts
// that bilinear filtering reads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lighting/receivers.h"

namespace twinshade {

class FillPlan {
 public:
  // known: 1 where a cell has light of its own, else 0; by cell. Receivers that are not known are filled from known
  // ones however far away they are, as long as receivers lie between; where none is in reach a receiver keeps what it
  // has. Then cells that are no receivers are filled up to `gutter` texels away.
  static FillPlan lightmap(const std::vector<std::uint8_t>& known, const Receivers& receivers, int gutter);
  // Probes of a grid, x fastest, then y, then z: all are receivers, neighbours share a face.
  static FillPlan grid(const std::vector<std::uint8_t>& known, const glm::ivec3& size);
  // Along the edges of triangles.
  static FillPlan vertices(const std::vector<std::uint8_t>& known, const Receivers& receivers, const Scene& scene);

  // In place: `cells` has `stride` consecutive values a cell.
  void apply(std::span<float> cells, std::size_t stride) const;

 private:
  struct Step {
    std::uint32_t cell;
    std::uint32_t first_source, source_count;
  };
  std::vector<Step> steps_;  // in order: a source is known or filled by an earlier step
  std::vector<std::uint32_t> sources_;

  template <class Neighbours>
  static FillPlan grow(const std::vector<std::uint8_t>& known, const std::vector<std::uint8_t>& receives, int gutter,
                       const Neighbours& neighbours);
};

}  // namespace twinshade

// A table of images, a caption under each and a label before each row.
#pragma once

#include <string>
#include <vector>

#include "experiments/drawing.h"

namespace twinshade {

struct Tile {
  PixelImage image;
  std::string caption;
};
struct TileRow {
  std::string label;
  std::vector<Tile> tiles;
};

// scale: drawn size of an image's pixel.
Drawing draw_tiles(const std::string& title, const std::string& subtitle, const std::vector<TileRow>& rows,
                   double scale = 1);

}  // namespace twinshade

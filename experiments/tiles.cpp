#include "experiments/tiles.h"

#include <algorithm>

#include "experiments/chart_parts.h"

namespace twinshade {

Drawing draw_tiles(const std::string& title, const std::string& subtitle, const std::vector<TileRow>& rows,
                   double scale) {
  constexpr double kTilesTop = 68, kTilesGap = 12, kTilesCaption = 24;
  double label_width = 0, cell_width = 0, cell_height = 0;
  std::size_t columns = 0;
  for (const TileRow& row : rows) {
    label_width = std::max(label_width, text_width(row.label, 12));
    columns = std::max(columns, row.tiles.size());
    for (const Tile& tile : row.tiles) {
      cell_width = std::max({cell_width, scale * tile.image.width, text_width(tile.caption, 11)});
      cell_height = std::max(cell_height, scale * tile.image.height + kTilesCaption);
    }
  }
  const double left = 16 + label_width + kTilesGap;
  Drawing drawing(std::max({left + double(columns) * (cell_width + kTilesGap), 32 + text_width(title, 19.5),
                            32 + text_width(subtitle, 12)}),
                  kTilesTop + double(rows.size()) * (cell_height + kTilesGap));
  drawing.text({16, 28}, title, {.size = 17, .color = kInk, .bold = true});
  drawing.text({16, 48}, subtitle, {.size = 12, .color = kFaint});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = kTilesTop + double(r) * (cell_height + kTilesGap);
    drawing.text({16, y + (cell_height - kTilesCaption) / 2 + 4}, rows[r].label, {.size = 12, .color = kInk});
    for (std::size_t k = 0; k < rows[r].tiles.size(); ++k) {
      const Tile& tile = rows[r].tiles[k];
      const double x = left + double(k) * (cell_width + kTilesGap);
      drawing.image({x, y}, scale * tile.image.width, scale * tile.image.height, tile.image);
      drawing.text({x + scale * tile.image.width / 2, y + scale * tile.image.height + 15}, tile.caption,
                   {.size = 11, .anchor = Anchor::middle, .color = kInk});
    }
  }
  return drawing;
}

}  // namespace twinshade

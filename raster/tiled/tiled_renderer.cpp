#include "raster/tiled/tiled_renderer.h"

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/tiled/draw.h"
#include "raster/tiled/entry.h"

namespace twinshade {
namespace {

using namespace tiled;

void allocate(Frame& frame, const Bundle& bundle, const BoundDraw& bound, const DrawOptions& options, bool float64) {
  const std::size_t pixels = std::size_t(bundle.width) * bundle.height;
  frame.width = bundle.width;
  frame.height = bundle.height;
  frame.color.resize(pixels * 4);
  frame.color_scalar = bound.color_scalar;
  frame.depth.resize(pixels);
  frame.primitive_id.resize(options.visibility ? pixels : 0);
  frame.coverage.resize(options.visibility ? pixels : 0);
  if (float64) frame.color64.resize(pixels * 4);
  if (options.capture_attributes) {
    frame.attributes.resize(pixels * bound.input_components);
    frame.attribute_names = bound.component_names;
    frame.attribute_scalars = bound.input_scalars;
  }
}

// One frame, stage by stage.
StageMilliseconds draw_frame(const Draw& draw, std::vector<std::unique_ptr<TileWorker>>& workers) {
  StageClock clock;
  clock.start();
  transform_vertices(draw.bundle, draw.options.attributes, draw.kernels, draw.geometry);
  clock.lap(Stage::vertex);
  set_up_and_bin(draw.bundle, draw.bound, draw.options.attributes, draw.kernels, draw.grid, draw.geometry);
  clock.lap(Stage::bin);

  for (const auto& worker : workers) worker->ticks().reset();
  StageClock tiles;
  tiles.start();
  if (draw.module.has_side_effects) {  // what the shader writes must not depend on which tile comes first
    for (std::uint32_t tile = 0; tile < draw.grid.count(); ++tile) workers[0]->draw_tile(tile);
  } else {
    parallel_for(draw.grid.count(),
                 [&](std::size_t tile, int worker) { workers[std::size_t(worker)]->draw_tile(std::uint32_t(tile)); });
  }
  tiles.lap(Stage::store);

  // Tiles go through the remaining stages side by side: each gets its share of the time that all of them took.
  StageMilliseconds stages = clock.total(), share{};
  double all = 0;
  for (const auto& worker : workers)
    for (std::size_t i = 0; i < kStageCount; ++i) share[i] += double(worker->ticks().total()[i]);
  for (const double part : share) all += part;
  const double wall = tiles.total()[std::size_t(Stage::store)];
  for (std::size_t i = 0; i < kStageCount && all > 0; ++i) stages[i] += wall * share[i] / all;
  return stages;
}

// Fewer triangles are in several tiles when tiles are large; with few tiles threads wait for the last one. What a
// shader writes to buffers depends on the size of tiles, so there it must not depend on threads.
int choose_tile_size(const Bundle& bundle, const ShaderModule& module, int wanted) {
  constexpr std::uint32_t kTilesForEachThread = 32;
  if (wanted != 0) return wanted;
  const bool many =
      make_grid(bundle.width, bundle.height, 128).count() >= kTilesForEachThread * std::uint32_t(thread_count());
  return many && !module.has_side_effects ? 128 : 64;
}

double median(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(middle), values.end());
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * (values[middle] + *std::max_element(values.begin(), values.begin() + std::ptrdiff_t(middle)));
}

class TiledRenderer : public Renderer {
 public:
  using FindModule = std::function<const ShaderModule&(const ShaderSource&, Number, std::optional<Isa>)>;
  explicit TiledRenderer(FindModule find_module) : find_module_(std::move(find_module)) {}

  std::string name() const override { return "cpu"; }
  Frame draw(const Bundle& bundle, const ShaderSource& source, const DrawOptions& options) override {
    return draw_tiled(bundle, find_module_(source, options.number, options.isa), options);
  }

 private:
  FindModule find_module_;
};

}  // namespace

Frame draw_tiled(const Bundle& bundle, const ShaderModule& module, const DrawOptions& options) {
  if (module.abi_version != kAbiVersion)
    throw UserError("shader \"" + std::string(module.name) +
                    "\" was translated by another version: translate it again");
  validate(bundle, "bundle");
  const ShaderEntry& entry = choose_entry(module, options.number, options.isa);
  BoundDraw bound = bind(bundle, module, options.attributes, options.output);
  Frame frame;
  allocate(frame, bundle, bound, options, entry.number == Number::float64);

  const int tile_size = choose_tile_size(bundle, module, options.tile_size);
  const auto [viewport_width, viewport_height] = viewport_size(bundle.width, bundle.height);
  Geometry geometry;
  const Draw draw{bundle,
                  module,
                  options,
                  bound,
                  entry,
                  choose_kernels(entry.isa, entry.number),
                  make_grid(bundle.width, bundle.height, tile_size),
                  {bundle.clip_positions.data(), bundle.indices.data(), bound.vertex_inputs.data(),
                   bound.input_components, 2.0f / float(viewport_width), 2.0f / float(viewport_height)},
                  geometry,
                  frame};
  std::vector<std::unique_ptr<TileWorker>> workers;
  for (int i = 0; i < thread_count(); ++i) workers.push_back(std::make_unique<TileWorker>(draw));

  std::vector<double> times[kStageCount + 1];  // of each stage, then of the whole frame
  for (int i = 0; i < options.warmup + std::max(1, options.repeat); ++i) {
    if (i > 0) bound.reset_buffers(bundle);
    const StageMilliseconds stages = draw_frame(draw, workers);
    if (i < options.warmup) continue;
    double whole = 0;
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
      times[stage].push_back(stages[stage]);
      whole += stages[stage];
    }
    times[kStageCount].push_back(whole);
  }
  for (std::size_t stage = 0; stage < kStageCount; ++stage)
    frame.milliseconds.emplace_back(kStageNames[stage], median(times[stage]));
  frame.milliseconds.emplace_back("draw", median(times[kStageCount]));

  for (const auto& worker : workers) frame.distinct_threads += worker->tiles_shaded() > 0;
  frame.provenance = {{"renderer", "twinshade tiled"},          {"isa", isa_name(entry.isa)},
                      {"number", number_name(entry.number)},    {"threads", std::to_string(thread_count())},
                      {"tile_size", std::to_string(tile_size)}, {"shader", module.source_hash}};
  return frame;
}

std::unique_ptr<Renderer> make_tiled_renderer(
    std::function<const ShaderModule&(const ShaderSource&, Number, std::optional<Isa>)> find_module) {
  return std::make_unique<TiledRenderer>(std::move(find_module));
}

}  // namespace twinshade

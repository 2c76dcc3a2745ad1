// The stones of the cobbles are cells of jittered lattice points (S. Worley, A cellular texture basis function, 1996).
#include "scenes/surface_patterns.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "scenes/blend.h"
#include "scenes/noise.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

double fraction(double x) { return x - std::floor(x); }

std::int32_t wrap(std::int32_t i, std::int32_t period) { return ((i % period) + period) % period; }

// Distances to the nearest and the second nearest of period^2 jittered points, in cells, and the nearest one's name.
struct Cell {
  double nearest, second;
  std::int32_t x, y;
};

Cell nearest_cell(double x, double y, std::int32_t period, double jitter, std::uint32_t seed) {
  const auto cell_x = std::int32_t(std::floor(x)), cell_y = std::int32_t(std::floor(y));
  Cell best{1e9, 1e9, 0, 0};
  for (std::int32_t j = cell_y - 1; j <= cell_y + 1; ++j)
    for (std::int32_t i = cell_x - 1; i <= cell_x + 1; ++i) {
      const std::int32_t wi = wrap(i, period), wj = wrap(j, period);
      const double px = i + 0.5 + jitter * (lattice_random(wi, wj, seed) - 0.5);
      const double py = j + 0.5 + jitter * (lattice_random(wi, wj, seed + 1) - 0.5);
      const double distance = std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
      if (distance < best.nearest) {
        best = {distance, best.nearest, wi, wj};
      } else if (distance < best.second) {
        best.second = distance;
      }
    }
  return best;
}

// 0 at the edge of a block of width x height metres, 1 from `bevel` metres inwards; x, y from the block's corner.
double block_top(double x, double y, double width, double height, double bevel) {
  const double edge = std::min(std::min(x, width - x), std::min(y, height - y));
  return smooth_step(0, bevel, edge);
}

}  // namespace

PatternPoint cobbles(double u, double v) {
  constexpr std::int32_t kStones = 11;  // each way
  const Cell cell = nearest_cell(u * kStones, v * kStones, kStones, 0.55, 11);
  const double gap = cell.second - cell.nearest;
  const double top = smooth_step(0.02, 0.30, gap);
  const double dome = std::max(0.0, 1 - 1.6 * cell.nearest * cell.nearest);
  const double grain = fractal_noise(u * 32, v * 32, 32, 3, 21);
  const double tone = lattice_random(cell.x, cell.y, 31), hue = lattice_random(cell.x, cell.y, 41);
  const dvec3 stone = mix(dvec3(0.30, 0.275, 0.25), dvec3(0.34, 0.27, 0.205), hue) * mix(0.62, 1.25, tone);
  const dvec3 sand(0.20, 0.165, 0.125);
  return {0.016 * top * (0.45 + 0.55 * dome) + 0.0016 * grain * (0.4 + 0.6 * top),
          mix(sand, stone, smooth_step(0.03, 0.14, gap)) * (1 + 0.22 * grain)};
}

PatternPoint bricks(double u, double v) {
  constexpr std::int32_t kCourses = 12, kBricks = 4;
  constexpr double kWidth = 1.0 / kBricks, kHeight = 1.0 / kCourses, kJoint = 0.005;  // metres in a tile of 1 m
  const auto course = std::int32_t(std::floor(v * kCourses));
  const double along = u * kBricks + (course % 2 == 0 ? 0 : 0.5);
  const std::int32_t brick = wrap(std::int32_t(std::floor(along)), kBricks);
  const double x = fraction(along) * kWidth - kJoint, y = fraction(v * kCourses) * kHeight - kJoint;
  const double rough = fractal_noise(u * 16, v * 16, 16, 4, 51);
  const double top = block_top(x, y, kWidth - 2 * kJoint, kHeight - 2 * kJoint, 0.009 + 0.004 * rough);
  const double tone = lattice_random(brick, course, 61), hue = lattice_random(brick, course, 71);
  const double tilt = (lattice_random(brick, course, 81) - 0.5) * 0.003;
  const dvec3 clay = mix(dvec3(0.46, 0.205, 0.125), dvec3(0.50, 0.30, 0.19), hue) * mix(0.68, 1.12, tone);
  const dvec3 mortar(0.50, 0.46, 0.39);
  return {0.007 * top + tilt * top + 0.0022 * rough,
          mix(mortar, clay, smooth_step(0.1, 0.6, top)) * (1 + 0.25 * rough)};
}

PatternPoint plaster(double u, double v) {
  const double broad = fractal_noise(u * 4, v * 4, 4, 4, 91);
  const double trowel = value_noise(u * 24 + broad, v * 24 + broad, 24, 101);
  const double grain = fractal_noise(u * 64, v * 64, 64, 2, 111);
  const double chip = smooth_step(0.36, 0.46, fractal_noise(u * 8, v * 8, 8, 4, 121));
  const dvec3 wash = mix(dvec3(0.70, 0.50, 0.29), dvec3(0.78, 0.62, 0.42), smooth_step(-0.4, 0.5, broad));
  const dvec3 bare(0.60, 0.54, 0.46);
  return {0.006 * broad + 0.0022 * trowel + 0.0008 * grain - 0.004 * chip,
          mix(wash, bare, 0.8 * chip) * (1 + 0.05 * trowel + 0.08 * grain)};
}

PatternPoint ashlar(double u, double v) {
  constexpr std::int32_t kCourses = 4, kBlocks = 2;
  constexpr double kTile = 1.6, kWidth = kTile / kBlocks, kHeight = kTile / kCourses, kJoint = 0.003;
  const auto course = std::int32_t(std::floor(v * kCourses));
  const double along = u * kBlocks + (course % 2 == 0 ? 0.25 : 0.75);
  const std::int32_t block = wrap(std::int32_t(std::floor(along)), kBlocks);
  const double x = fraction(along) * kWidth - kJoint, y = fraction(v * kCourses) * kHeight - kJoint;
  const double top = block_top(x, y, kWidth - 2 * kJoint, kHeight - 2 * kJoint, 0.014);
  const double pitted = fractal_noise(u * 24, v * 24, 24, 4, 131);
  const double band = fractal_noise(u * 2, v * 16, 2, 3, 141);
  const double tone = lattice_random(block, course, 151), hue = lattice_random(block, course, 161);
  const dvec3 stone = mix(dvec3(0.54, 0.48, 0.385), dvec3(0.58, 0.53, 0.45), hue) * mix(0.84, 1.08, tone);
  const double pit = smooth_step(0.18, 0.5, pitted);
  return {0.006 * top + 0.0016 * pitted - 0.0030 * pit,
          stone * mix(0.55, 1.0, smooth_step(0.0, 0.5, top)) * (1 + 0.10 * band + 0.10 * pitted - 0.18 * pit)};
}

PatternPoint fluted(double u, double v) {
  // One flute: a circular hollow between narrow flat fillets.
  constexpr int kFlutes = 4;
  const double across = 2 * fraction(u * kFlutes) - 1;  // -1 to 1
  const double hollow = std::min(1.0, std::fabs(across) / 0.86);
  const double depth = std::sqrt(std::max(0.0, 1 - hollow * hollow));
  const double grain = fractal_noise(u * 8, v * 8, 8, 4, 171);
  const dvec3 stone = mix(dvec3(0.60, 0.545, 0.45), dvec3(0.66, 0.61, 0.53), smooth_step(-0.4, 0.4, grain));
  return {-0.014 * depth + 0.0008 * grain, stone * (1 - 0.22 * depth) * (1 + 0.08 * grain)};
}

PatternPoint marble(double u, double v) {
  const double warp = fractal_noise(u * 4, v * 4, 4, 4, 181);
  // Veins: where a warped, repeating wave passes zero.
  const double wave = portable::sin(2 * portable::kPi * (u + 2 * v) + 7 * warp);
  const double vein = 1 - smooth_step(0.0, 0.35, std::fabs(wave));
  const double worn = fractal_noise(u * 8, v * 8, 8, 5, 191);
  const dvec3 ground = mix(dvec3(0.66, 0.63, 0.57), dvec3(0.75, 0.72, 0.67), smooth_step(-0.5, 0.5, warp));
  return {0.0035 * worn - 0.0006 * vein, mix(ground, dvec3(0.46, 0.44, 0.42), 0.45 * vein) * (1 + 0.06 * worn)};
}

PatternPoint shingles(double u, double v) {
  constexpr std::int32_t kCourses = 6, kShingles = 8;
  constexpr double kTile = 1.2, kWidth = kTile / kShingles, kGap = 0.004;
  const auto course = std::int32_t(std::floor(v * kCourses));
  const double along = u * kShingles + (course % 2 == 0 ? 0.0 : 0.5);
  const std::int32_t shingle = wrap(std::int32_t(std::floor(along)), kShingles);
  const double x = fraction(along) * kWidth, y = fraction(v * kCourses);
  // Each lies on the one below: thickest at its lower edge, whose height varies.
  const double lower = 0.06 * lattice_random(shingle, course, 201);
  const double thickness = y < lower ? 0.25 * y : 0.012 * (1 - 0.8 * y) * smooth_step(lower, lower + 0.05, y);
  const double side = smooth_step(0, kGap, std::min(x, kWidth - x));
  const double grain = fractal_noise(u * 64, v * 8, 8, 3, 211);
  const double tone = lattice_random(shingle, course, 221), weather = fractal_noise(u * 4, v * 4, 4, 3, 231);
  const dvec3 wood = mix(dvec3(0.20, 0.13, 0.09), dvec3(0.34, 0.25, 0.19), tone);
  return {thickness * side + 0.0012 * grain, wood * mix(0.45, 1.0, side) *
                                                 mix(0.6, 1.0, smooth_step(lower, lower + 0.12, y)) *
                                                 (1 + 0.25 * grain + 0.2 * weather)};
}

PatternPoint siding(double u, double v) {
  constexpr std::int32_t kBoards = 8;
  const auto board = std::int32_t(std::floor(v * kBoards));
  const double y = fraction(v * kBoards);
  const double grain = fractal_noise(u * 8, v * 128, 8, 3, 241), worn = fractal_noise(u * 4, v * 4, 4, 4, 251);
  const double edge = smooth_step(0, 0.07, y);
  const dvec3 paint = mix(dvec3(0.46, 0.52, 0.50), dvec3(0.56, 0.60, 0.56), lattice_random(board, 0, 261));
  return {0.015 * (1 - y) * edge + 0.0008 * grain, paint * mix(0.6, 1.0, edge) * (1 + 0.06 * grain + 0.10 * worn)};
}

PatternPoint planks(double u, double v) {
  constexpr std::int32_t kPlanks = 7;
  constexpr double kWidth = 1.0 / kPlanks;
  const auto plank = std::int32_t(std::floor(v * kPlanks));
  const double y = fraction(v * kPlanks) * kWidth;
  const double top = smooth_step(0, 0.008, std::min(y, kWidth - y));
  const double grain = fractal_noise(u * 8, v * 64, 8, 4, 271);
  const dvec3 wood = mix(dvec3(0.30, 0.20, 0.12), dvec3(0.42, 0.30, 0.20), lattice_random(plank, 0, 281));
  return {0.006 * top + 0.0010 * grain, wood * mix(0.4, 1.0, top) * (1 + 0.22 * grain)};
}

int add_pattern_material(Scene& scene, const char* name, Pattern pattern, std::uint32_t size, double tile) {
  std::vector<double> height(std::size_t(size) * size);
  Image albedo{size, size, std::vector<float>(std::size_t(size) * size * 4)};
  Image normal = albedo;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const std::size_t at = std::size_t(y) * size + x;
      const PatternPoint point = pattern((x + 0.5) / size, (y + 0.5) / size);
      height[at] = point.height;
      for (int c = 0; c < 3; ++c) albedo.texels[at * 4 + std::size_t(c)] = float(std::clamp(point.albedo[c], 0.0, 1.0));
      albedo.texels[at * 4 + 3] = 1;
    }
  const auto height_at = [&](std::uint32_t x, std::uint32_t y) {
    return height[std::size_t(y % size) * size + x % size];
  };
  const double per_metre = size / (2 * tile);
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const double slope_x = (height_at(x + 1, y) - height_at(x + size - 1, y)) * per_metre;
      const double slope_y = (height_at(x, y + 1) - height_at(x, y + size - 1)) * per_metre;
      const dvec3 n = glm::normalize(dvec3(-slope_x, -slope_y, 1));
      float* texel = &normal.texels[(std::size_t(y) * size + x) * 4];
      for (int c = 0; c < 3; ++c) texel[c] = float(n[c]);
      texel[3] = 1;
    }
  Material material;
  material.name = name;
  material.albedo = glm::vec3(1);
  material.albedo_image = int(scene.images.size());
  material.normal_image = material.albedo_image + 1;
  scene.images.push_back(std::move(albedo));
  scene.images.push_back(std::move(normal));
  scene.materials.push_back(std::move(material));
  return int(scene.materials.size()) - 1;
}

}  // namespace twinshade

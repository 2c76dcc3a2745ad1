#include "tests/tiled/random_scene.h"

#include <bit>
#include <cmath>

namespace twinshade::test {

std::uint64_t Random::bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

Bundle empty_bundle(std::uint32_t width, std::uint32_t height) {
  Bundle bundle;
  bundle.width = width;
  bundle.height = height;
  bundle.attributes.push_back({"v_value", Scalar::f32, 4, {}});
  bundle.attributes.push_back({"v_key", Scalar::u32, 1, {}});
  return bundle;
}

void add_triangle(Bundle& bundle, const float (&positions)[12], Random& random) {
  for (int v = 0; v < 3; ++v) {
    bundle.indices.push_back(std::uint32_t(bundle.vertex_count()));
    bundle.clip_positions.insert(bundle.clip_positions.end(), positions + 4 * v, positions + 4 * v + 4);
    for (int c = 0; c < 4; ++c) bundle.attributes[0].values.push_back(float(random.unit()));
    bundle.attributes[1].values.push_back(std::bit_cast<float>(random.below(1u << 20)));
  }
}

void finish(Bundle& bundle) { fit_to_viewport(bundle.clip_positions, bundle.width, bundle.height); }

namespace {

// A vertex in front of the eye, `reach` times the frame wide.
void put_vertex(float* out, Random& random, double center_x, double center_y, double reach) {
  const double w = std::exp2(random.between(-3, 3));
  out[0] = float((center_x + random.between(-reach, reach)) * w);
  out[1] = float((center_y + random.between(-reach, reach)) * w);
  out[2] = float(random.between(-1.1, 1.1) * w);
  out[3] = float(w);
}

// On a pixel centre, pixel corner or subpixel of the power-of-two viewport after fit_to_viewport, at w = 1.
void put_on_grid(float* out, Random& random, std::uint32_t width, std::uint32_t height, int subpixels) {
  const double x = double(random.below(width * std::uint32_t(subpixels))) / subpixels;
  const double y = double(random.below(height * std::uint32_t(subpixels))) / subpixels;
  out[0] = float(x * 2 / width - 1);
  out[1] = float(y * 2 / height - 1);
  out[2] = float(random.between(-1, 1));
  out[3] = 1;
}

void put_triangle(float (&p)[12], Random& random, const Bundle& bundle) {
  const double cx = random.between(-1, 1), cy = random.between(-1, 1);
  switch (random.below(11)) {
    case 0:  // small
    case 1:
      for (int v = 0; v < 3; ++v) put_vertex(p + 4 * v, random, cx, cy, 0.05);
      break;
    case 2:  // large
      for (int v = 0; v < 3; ++v) put_vertex(p + 4 * v, random, 0, 0, 1.5);
      break;
    case 3:  // huge, mostly off the screen
      for (int v = 0; v < 3; ++v) put_vertex(p + 4 * v, random, 0, 0, std::exp2(random.between(1, 20)));
      break;
    case 4:  // sliver
      put_vertex(p, random, 0, 0, 1);
      put_vertex(p + 4, random, 0, 0, 1);
      for (int c = 0; c < 4; ++c) p[8 + c] = p[c] * 0.7f + p[4 + c] * 0.3f + float(random.between(-1e-3, 1e-3));
      break;
    case 5:  // through the near plane and behind the eye
      for (int v = 0; v < 3; ++v)
        for (int c = 0; c < 4; ++c) p[4 * v + c] = float(random.between(-2, 2));
      break;
    case 6:  // on pixel centres and corners
      for (int v = 0; v < 3; ++v) put_on_grid(p + 4 * v, random, bundle.width, bundle.height, 2);
      break;
    case 7:  // on subpixels, small
      put_on_grid(p, random, bundle.width, bundle.height, 256);
      for (int v = 1; v < 3; ++v)
        for (int c = 0; c < 4; ++c)
          p[4 * v + c] = p[c] + (c < 2 ? float(int(random.below(2048)) - 1024) / 256 * 2 / float(bundle.width) : 0);
      break;
    case 8:  // zero area: a repeated vertex
      for (int v = 0; v < 3; ++v) put_vertex(p + 4 * v, random, cx, cy, 0.3);
      for (int c = 0; c < 4; ++c) p[8 + c] = p[4 * int(random.below(2)) + c];
      break;
    case 9: {  // any magnitude: the same picture at another scale, until products of coordinates overflow or vanish
      for (int v = 0; v < 3; ++v) put_vertex(p + 4 * v, random, cx, cy, 0.4);
      const double scale = std::exp2(std::floor(random.between(-110, 120)));
      for (float& c : p) c = float(c * scale);
      break;
    }
    default:  // exactly on planes of the view volume, w = 0 among them
      for (int v = 0; v < 3; ++v) {
        const double w = double(random.below(3));
        p[4 * v + 3] = float(w);
        for (int c = 0; c < 3; ++c) p[4 * v + c] = float((double(random.below(5)) - 2) * (w > 0 ? w : 1) * 0.5);
        // The eye point itself, (0, 0, 0, 0), has no place on the screen: docs/raster-rule.md.
        if (w == 0 && p[4 * v] == 0 && p[4 * v + 1] == 0) p[4 * v + 2] = 1;
      }
  }
}

// Shares an edge or a vertex with the triangle before, half of the time.
void share(Bundle& bundle, Random& random) {
  const std::size_t n = bundle.indices.size();
  if (n < 6 || random.below(2) != 0) return;
  bundle.indices[n - 3] = bundle.indices[n - 4];
  if (random.below(2) == 0) bundle.indices[n - 2] = bundle.indices[n - 6];
}

}  // namespace

Bundle torture_bundle(std::uint32_t width, std::uint32_t height, int triangles, std::uint64_t seed) {
  Random random(seed);
  Bundle bundle = empty_bundle(width, height);
  for (int i = 0; i < triangles; ++i) {
    float positions[12];
    put_triangle(positions, random, bundle);
    add_triangle(bundle, positions, random);
    share(bundle, random);
  }
  finish(bundle);
  return bundle;
}

Bundle inside_bundle(std::uint32_t width, std::uint32_t height, int triangles, std::uint64_t seed) {
  Random random(seed);
  Bundle bundle = empty_bundle(width, height);
  for (int i = 0; i < triangles; ++i) {
    float positions[12];
    const double cx = random.between(-0.8, 0.8), cy = random.between(-0.8, 0.8),
                 reach = std::exp2(random.between(-8, -2.5));
    for (int v = 0; v < 3; ++v) {
      if (i % 3 == 0) {
        put_on_grid(positions + 4 * v, random, width, height, i % 2 ? 2 : 256);
        if (i % 6 == 0 && v > 0)  // a thin one
          for (int c = 0; c < 4; ++c) positions[4 * v + c] = positions[c] * 0.95f + positions[4 * v + c] * 0.05f;
      } else {
        const double w = std::exp2(random.between(-3, 3));
        positions[4 * v] = float((cx + random.between(-reach, reach)) * w);
        positions[4 * v + 1] = float((cy + random.between(-reach, reach)) * w);
        positions[4 * v + 2] = float(random.between(-0.9, 0.9) * w);
        positions[4 * v + 3] = float(w);
      }
    }
    add_triangle(bundle, positions, random);
  }
  finish(bundle);
  return bundle;
}

}  // namespace twinshade::test

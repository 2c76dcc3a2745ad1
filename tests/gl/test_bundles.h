// Small bundles made by hand.
#pragma once

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "bundle/bundle.h"

namespace twinshade::test {

// Two triangles over the whole frame (before the power-of-two viewport), with v_uv from (0,0) to (1,1).
inline Bundle quad(std::uint32_t width, std::uint32_t height, float z = 0.0f) {
  Bundle bundle;
  bundle.width = width, bundle.height = height;
  bundle.clip_positions = {-1, -1, z, 1, 1, -1, z, 1, 1, 1, z, 1, -1, 1, z, 1};
  fit_to_viewport(bundle.clip_positions, width, height);
  bundle.indices = {0, 1, 2, 0, 2, 3};
  bundle.attributes.push_back({"v_uv", Scalar::f32, 2, {0, 0, 1, 0, 1, 1, 0, 1}});
  return bundle;
}

enum class Soup { small, large, slivers, near_crossing, huge, reversed_and_empty };

// Random triangles of one kind, none sharing vertices, with a vec3 and a float attribute.
inline Bundle soup(Soup kind, std::uint32_t width, std::uint32_t height, std::size_t triangles, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (double(random()) / 4294967296.0); };
  Bundle bundle;
  bundle.width = width, bundle.height = height;
  Attribute color{"v_color", Scalar::f32, 3, {}}, scale{"v_scale", Scalar::f32, 1, {}},
      tag{"v_tag", Scalar::u32, 1, {}};
  for (std::size_t t = 0; t < triangles; ++t) {
    const double cx = uniform(-1.1, 1.1), cy = uniform(-1.1, 1.1), cz = uniform(-1.05, 1.05);
    const double size = kind == Soup::small ? 0.05 : kind == Soup::huge ? 1000.0 : 0.8;
    double p[3][4];
    for (auto& v : p) {
      const double w = kind == Soup::near_crossing ? uniform(-0.6, 1.0) : uniform(0.5, 4.0);
      v[0] = (cx + size * uniform(-1, 1)) * w;
      v[1] = (cy + size * uniform(-1, 1)) * w;
      v[2] = kind == Soup::near_crossing ? uniform(-1.5, 1.5) : (cz + 0.2 * uniform(-1, 1)) * w;
      v[3] = w;
    }
    if (kind == Soup::slivers) {
      const double along = uniform(-0.2, 1.2), off = uniform(-1e-3, 1e-3);
      for (int c = 0; c < 4; ++c) p[2][c] = p[0][c] + along * (p[1][c] - p[0][c]);
      p[2][0] += off * p[2][3];
    }
    if (kind == Soup::reversed_and_empty && t % 3 == 0)
      for (int c = 0; c < 4; ++c) p[2][c] = t % 2 == 0 ? p[1][c] : 0.5 * (p[0][c] + p[1][c]);
    for (const auto& v : p) {
      for (const double c : v) bundle.clip_positions.push_back(float(c));
      for (int c = 0; c < 3; ++c) color.values.push_back(float(uniform(-1, 1)));
      scale.values.push_back(float(uniform(0.1, 10)));
      std::uint32_t bits = random();
      tag.values.push_back(0.0f);
      std::memcpy(&tag.values.back(), &bits, sizeof bits);
      bundle.indices.push_back(std::uint32_t(bundle.indices.size()));
    }
  }
  fit_to_viewport(bundle.clip_positions, width, height);
  bundle.attributes = {color, scale, tag};
  return bundle;
}

}  // namespace twinshade::test

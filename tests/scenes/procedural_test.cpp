// What every built-in scene promises.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "scenes/patch_mesh.h"
#include "scenes/scene.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;

namespace {

const std::vector<std::string> kBaked = {"courtyard", "house", "spheres", "quad"};

glm::dvec2 lightmap(const Scene& scene, std::uint32_t vertex) { return glm::dvec2(scene.lightmap_uvs[vertex]); }

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Triangles joined by equal lightmap uvs are one chart.
std::vector<std::uint32_t> charts_of(const Scene& scene) {
  std::vector<std::uint32_t> parent(scene.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<std::pair<long, long>, std::uint32_t> first;  // to 2^-18 of the map
  const auto key = [](float x) { return std::lround(x * 0x1p18f); };
  for (std::uint32_t i = 0; i < scene.positions.size(); ++i) {
    const auto [entry, fresh] = first.try_emplace({key(scene.lightmap_uvs[i].x), key(scene.lightmap_uvs[i].y)}, i);
    if (!fresh) parent[root(i)] = root(entry->second);
  }
  for (std::size_t t = 0; t < scene.triangle_count(); ++t)
    for (int k = 1; k < 3; ++k) parent[root(scene.indices[3 * t + std::size_t(k)])] = root(scene.indices[3 * t]);
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
  return parent;
}

// Calls body(x, y) for each sample of a size x size grid of pixel centres strictly inside the triangle.
template <class Body>
void rasterise(const Scene& scene, std::size_t t, int size, Body body) {
  glm::dvec2 p[3];
  for (int k = 0; k < 3; ++k) p[k] = lightmap(scene, scene.indices[3 * t + std::size_t(k)]) * double(size);
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0) return;
  const glm::dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
  for (int y = int(std::floor(low.y)); y <= int(std::ceil(high.y)); ++y)
    for (int x = int(std::floor(low.x)); x <= int(std::ceil(high.x)); ++x) {
      const glm::dvec2 q(x + 0.5, y + 0.5);
      bool inside = true;
      for (int k = 0; k < 3 && inside; ++k) {
        const glm::dvec2 edge = p[(k + 1) % 3] - p[k];
        // 1e-4 samples inside: float uvs are rounded by 3e-8 of the map.
        inside = cross(edge, q - p[k]) / area * std::fabs(area) > 1e-4 * glm::length(edge);
      }
      if (inside) body(x, y);
    }
}

}  // namespace

TEST_CASE("built-in scenes are whole: sizes, indices, unit and orthogonal frames, one material a vertex") {
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    INFO(name);
    CHECK(scene.name == name);
    const std::size_t count = scene.positions.size();
    CHECK(scene.normals.size() == count);
    CHECK(scene.tangents.size() == count);
    CHECK(scene.uvs.size() == count);
    CHECK(scene.indices.size() == 3 * scene.triangle_materials.size());
    CHECK(scene.clip_positions.size() == (scene.procedural_coefficients ? count : 0));
    CHECK(scene.lightmap_uvs.size() == (scene.procedural_coefficients ? 0 : count));
    double worst_unit = 0, worst_orthogonal = 0;
    bool finite = true;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 n(scene.normals[i]), t(scene.tangents[i]);
      worst_unit = std::max({worst_unit, std::fabs(glm::length(n) - 1), std::fabs(glm::length(t) - 1)});
      worst_orthogonal = std::max(worst_orthogonal, std::fabs(glm::dot(n, t)));
      finite = finite && std::fabs(scene.tangents[i].w) == 1 && std::isfinite(scene.uvs[i].x + scene.uvs[i].y) &&
               std::isfinite(scene.positions[i].x + scene.positions[i].y + scene.positions[i].z);
    }
    CHECK(finite);
    CHECK(worst_unit < 2e-7);
    CHECK(worst_orthogonal < 2e-7);
    std::vector<std::uint32_t> material(count, ~0u);
    for (std::size_t t = 0; t < scene.triangle_count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        REQUIRE(scene.indices[3 * t + k] < count);
        std::uint32_t& of_vertex = material[scene.indices[3 * t + k]];
        REQUIRE((of_vertex == ~0u || of_vertex == scene.triangle_materials[t]));
        of_vertex = scene.triangle_materials[t];
      }
    CHECK(std::count(material.begin(), material.end(), ~0u) == 0);  // no vertex without a triangle
    for (const Material& m : scene.materials) {
      CHECK(m.albedo_image < int(scene.images.size()));
      CHECK(m.normal_image < int(scene.images.size()));
    }
    for (const Image& image : scene.images) CHECK(image.texels.size() == std::size_t(image.width) * image.height * 4);
  }
}

TEST_CASE("normal maps hold unit normals that point out, albedo maps values in [0, 1]") {
  const Scene scene = load_scene("courtyard");
  CHECK(scene.materials.size() == 6);
  for (const Material& material : scene.materials) {
    INFO(material.name);
    const Image &normal = scene.images[std::size_t(material.normal_image)],
                &albedo = scene.images[std::size_t(material.albedo_image)];
    double worst = 0, flattest = 1, mean_x = 0;
    bool valid = true;
    for (std::size_t i = 0; i < normal.texels.size(); i += 4) {
      const glm::dvec3 n(normal.texels[i], normal.texels[i + 1], normal.texels[i + 2]);
      worst = std::max(worst, std::fabs(glm::length(n) - 1));
      flattest = std::min(flattest, n.z);
      mean_x += n.x / n.z;
      valid = valid && n.z > 0;
      for (std::size_t c = 0; c < 3; ++c) valid = valid && albedo.texels[i + c] >= 0 && albedo.texels[i + c] <= 1;
    }
    CHECK(worst < 2e-7);
    CHECK(valid);
    CHECK(flattest < 0.99);  // there is something to see
    // Slopes of a repeating height field sum to zero: the map has no seam.
    CHECK(std::fabs(mean_x) / double(normal.texels.size() / 4) < 1e-6);
  }
}

TEST_CASE("triangles face the way their normals point") {
  for (const std::string& name : kBaked) {
    const Scene scene = load_scene(name);
    INFO(name);
    std::size_t turned = 0;
    for (std::size_t t = 0; t < scene.triangle_count(); ++t) {
      const std::uint32_t* v = &scene.indices[3 * t];
      const glm::dvec3 a(scene.positions[v[0]]), b(scene.positions[v[1]]), c(scene.positions[v[2]]);
      const glm::dvec3 face = glm::cross(b - a, c - a);
      const glm::dvec3 normal(scene.normals[v[0]] + scene.normals[v[1]] + scene.normals[v[2]]);
      if (glm::dot(face, normal) <= 0) ++turned;
    }
    CHECK(turned == 0);
  }
}

TEST_CASE("tangents point where the material's u grows, with the handedness of its v") {
  for (const std::string& name : kBaked) {
    const Scene scene = load_scene(name);
    INFO(name);
    std::size_t wrong = 0, tested = 0;
    for (std::size_t t = 0; t < scene.triangle_count(); ++t) {
      const std::uint32_t* v = &scene.indices[3 * t];
      const glm::dvec3 e1 = glm::dvec3(scene.positions[v[1]]) - glm::dvec3(scene.positions[v[0]]);
      const glm::dvec3 e2 = glm::dvec3(scene.positions[v[2]]) - glm::dvec3(scene.positions[v[0]]);
      const glm::dvec2 d1 = glm::dvec2(scene.uvs[v[1]]) - glm::dvec2(scene.uvs[v[0]]);
      const glm::dvec2 d2 = glm::dvec2(scene.uvs[v[2]]) - glm::dvec2(scene.uvs[v[0]]);
      const double area = cross(d1, d2);
      if (std::fabs(area) < 1e-9) continue;
      const glm::dvec3 u_axis = (e1 * d2.y - e2 * d1.y) / area, v_axis = (e2 * d1.x - e1 * d2.x) / area;
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 n(scene.normals[v[k]]), tangent(scene.tangents[v[k]]);
        const glm::dvec3 bitangent = glm::cross(n, tangent) * double(scene.tangents[v[k]].w);
        ++tested;
        if (glm::dot(tangent, u_axis) <= 0 || glm::dot(bitangent, v_axis) <= 0) ++wrong;
      }
    }
    CHECK(tested > 0);
    CHECK(double(wrong) <= 0.002 * double(tested));  // needle-like cells beside poles
  }
}

TEST_CASE("lightmap charts do not overlap and have two texels between them at 512 x 512") {
  for (const std::string& name : kBaked) {
    const Scene scene = load_scene(name);
    INFO(name);
    bool in_range = true;
    for (const glm::vec2& uv : scene.lightmap_uvs) in_range = in_range && uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1;
    CHECK(in_range);

    // No point belongs to two triangles.
    constexpr int kFine = 2048;
    std::vector<std::uint8_t> covered(std::size_t(kFine) * kFine);
    std::size_t twice = 0, used = 0;
    for (std::size_t t = 0; t < scene.triangle_count(); ++t)
      rasterise(scene, t, kFine, [&](int x, int y) {
        std::uint8_t& count = covered[std::size_t(y) * kFine + std::size_t(x)];
        if (count++) ++twice;
        ++used;
      });
    CHECK(twice == 0);
    CHECK(double(used) > 0.6 * kFine * kFine);

    // Whole texels: every texel that a chart's bounds touch is at least two texels from those of any other chart.
    constexpr int kSize = int(kChartAtlasSize);
    const std::vector<std::uint32_t> chart = charts_of(scene);
    std::map<std::uint32_t, std::array<double, 4>> bounds;
    for (std::uint32_t i = 0; i < chart.size(); ++i) {
      const glm::dvec2 uv = lightmap(scene, i) * double(kSize);
      auto [entry, fresh] = bounds.try_emplace(chart[i], std::array<double, 4>{uv.x, uv.y, uv.x, uv.y});
      auto& b = entry->second;
      if (!fresh) b = {std::min(b[0], uv.x), std::min(b[1], uv.y), std::max(b[2], uv.x), std::max(b[3], uv.y)};
    }
    std::vector<std::uint32_t> owner(std::size_t(kSize) * kSize, ~0u);
    std::size_t crowded = 0;
    for (const auto& [id, b] : bounds)
      for (int y = int(b[1]) - int(kChartGutter); y <= int(b[3]); ++y)
        for (int x = int(b[0]) - int(kChartGutter); x <= int(b[2]); ++x) {
          REQUIRE(x >= 0);
          REQUIRE(y >= 0);
          std::uint32_t& texel = owner[std::size_t(y) * kSize + std::size_t(x)];
          if (texel != ~0u && texel != id) ++crowded;
          texel = id;
        }
    CHECK(crowded == 0);
    CHECK(bounds.size() >= 1);
  }
}

TEST_CASE("every lightmap texel centre of a chart's inside is covered: no cracks between its patches") {
  const Scene scene = load_scene("spheres");
  constexpr int kSize = int(kChartAtlasSize);
  std::vector<std::uint8_t> covered(std::size_t(kSize) * kSize);
  for (std::size_t t = 0; t < scene.triangle_count(); ++t)
    rasterise(scene, t, kSize, [&](int x, int y) { covered[std::size_t(y) * kSize + std::size_t(x)] = 1; });
  // Rows of covered texels in the spheres' charts are unbroken from end to end, up to samples that lie on an edge.
  std::size_t holes = 0, inside = 0;
  for (int y = 1; y + 1 < kSize; ++y)
    for (int x = 1; x + 1 < kSize; ++x) {
      const auto at = [&](int i, int j) { return covered[std::size_t(j) * kSize + std::size_t(i)]; };
      if (at(x - 1, y) && at(x + 1, y) && at(x, y - 1) && at(x, y + 1)) {
        ++inside;
        if (!at(x, y)) ++holes;
      }
    }
  CHECK(double(holes) < 0.01 * double(inside));
}

TEST_CASE("the courtyard has at least the triangles asked for, and not many more") {
  CHECK(load_scene("courtyard").triangle_count() >= 20000);
  for (std::uint32_t wanted : {50000u, 200000u}) {
    const std::size_t got = load_scene("courtyard", wanted).triangle_count();
    CHECK(got >= wanted);
    CHECK(double(got) < 1.35 * wanted);
  }
  for (const char* name : {"spheres", "quad", "raster_torture", "raster_invalid"})
    CHECK(load_scene(name, 30000).triangle_count() >= 30000);
  CHECK(load_scene("quad").triangle_count() == 2);
  CHECK(user_error([] { load_scene("quad", 0xffffffffu); }).find("--triangles") == 0);
}

TEST_CASE("patches that meet share their vertices: a ball has no open edge but its faces' rims") {
  const Scene scene = load_scene("spheres");
  // Join vertices by position: then every edge of a closed ball has two triangles, one each way.
  std::map<std::array<float, 3>, int> ids;
  std::map<std::pair<int, int>, int> edges;
  for (std::size_t t = 0; t < scene.triangle_count(); ++t) {
    if (scene.materials[scene.triangle_materials[t]].name == "ashlar") continue;  // the floor
    int v[3];
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 p = scene.positions[scene.indices[3 * t + std::size_t(k)]];
      v[k] = ids.try_emplace({p.x, p.y, p.z}, int(ids.size())).first->second;
    }
    for (int k = 0; k < 3; ++k) ++edges[{v[k], v[(k + 1) % 3]}];
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : edges)
    if (count != 1 || edges.count({edge.second, edge.first}) == 0) ++open;
  CHECK(edges.size() > 1000);
  CHECK(open == 0);
}

TEST_CASE("the tortures contain what they promise") {
  const Scene scene = load_scene("raster_torture");
  CHECK(scene.triangle_count() >= 3000);
  std::size_t behind = 0, crossing = 0, zero = 0, reversed = 0, large = 0, beyond = 0;
  std::map<std::array<float, 3>, int> depth_seen;
  for (std::size_t t = 0; t < scene.triangle_count(); ++t) {
    glm::dvec4 p[3];
    int negative = 0;
    bool far = false;
    for (int k = 0; k < 3; ++k) {
      p[k] = glm::dvec4(scene.clip_positions[scene.indices[3 * t + std::size_t(k)]]);
      negative += p[k].z < -p[k].w;
      behind += p[k].w < 0;
      far = far || p[k].z > p[k].w;
      large += std::fabs(p[k].x) > 1000 * std::fabs(p[k].w);
    }
    crossing += negative > 0 && negative < 3;
    beyond += far;
    if (negative == 0) {
      const glm::dvec2 a = glm::dvec2(p[0]) / p[0].w, b = glm::dvec2(p[1]) / p[1].w, c = glm::dvec2(p[2]) / p[2].w;
      const double area = cross(b - a, c - a);
      zero += area == 0;
      reversed += area < 0;
    }
  }
  CHECK(behind > 20);
  CHECK(crossing > 20);
  CHECK(zero > 20);
  CHECK(reversed > 500);
  CHECK(large > 10);
  CHECK(beyond > 10);
  for (const glm::vec4& p : scene.clip_positions)
    for (int c = 0; c < 4; ++c) REQUIRE(std::isfinite(p[c]));

  const Scene invalid = load_scene("raster_invalid");
  std::size_t nan = 0, infinite = 0;
  for (const glm::vec4& p : invalid.clip_positions)
    for (int c = 0; c < 4; ++c) nan += std::isnan(p[c]), infinite += std::isinf(p[c]);
  CHECK(nan > 50);
  CHECK(infinite > 50);
}

TEST_CASE("a scene's hash follows what is drawn, and nothing else") {
  const Scene scene = load_scene("quad");
  const std::string hash = scene_hash(scene);
  CHECK(scene_hash(load_scene("quad")) == hash);
  Scene other = scene;
  other.name = "renamed";
  other.notes.push_back("said aloud");
  CHECK(scene_hash(other) == hash);
  other = scene;
  other.positions[0].x = std::nextafter(other.positions[0].x, 2.0f);
  CHECK(scene_hash(other) != hash);
  other = scene;
  other.images[0].texels[5] += 0.25f;
  CHECK(scene_hash(other) != hash);
  other = scene;
  other.camera.eye.y += 1e-9;
  CHECK(scene_hash(other) != hash);
}

// Recorded so that any compiler, optimisation level or processor that gives other bits is caught.
TEST_CASE("built-in scenes have the same bits everywhere") {
  const std::map<std::string, std::string> expected = {
      {"courtyard", "aac2f90926874cf094a4f83ffd7a7c9c4083871b0d85e2fd3693adb0568920e5"},
      {"house", "07745c8172878ea347a97145da976b4a9342de261a2b81be825fd93d882b29ee"},
      {"spheres", "cba68be232a4bb0140b9a139145dc7338d7fd126c91f21333c7aa05e4744d4ee"},
      {"quad", "15b3988dd50123590399bdd58da97cf740885feb2f231973ea0058aa139595c3"},
      {"raster_torture", "806b1cbbd12c5a59c488452f9fa2b113de3fc801609f1244f7e6c6589599d836"},
      {"raster_invalid", "b945de17352b24c167a78bb013a169b3a220d9641d1d92ae719f75575b8d955a"}};
  for (const std::string& name : scene_names()) {
    INFO(name);
    CHECK(scene_hash(load_scene(name)) == expected.at(name));
  }
}

TEST_CASE("unknown scenes are answered with the nearest names") {
  CHECK(user_error([] { load_scene("courtyrad"); }) == "unknown scene 'courtyrad'; did you mean 'courtyard'?");
  CHECK(user_error([] { load_scene("sphere"); }) == "unknown scene 'sphere'; did you mean 'spheres'?");
}

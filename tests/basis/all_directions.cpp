#include "tests/basis/all_directions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <mutex>

#include "tests/exact/shader_rows.h"

namespace twinshade::test {
namespace {

glm::dvec3 to_float(const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); }

double step(double x, int steps) {
  float moved = float(x);
  for (int i = 0; i < std::abs(steps); ++i)
    moved = std::nextafter(
        moved, steps > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity());
  return moved;
}

const RowShader& triangle_shader() {
  static const RowShader shader("dice_triangle",
                                "#include \"basis/ambient_dice_functions.glsl\"\n"
                                "in vec3 n;\nlayout(location = 0) out vec3 vertex;\n"
                                "layout(location = 1) out vec3 barycentric;\nvoid main() {\n"
                                "  DiceTriangle triangle = dice_triangle(n);\n  vertex = vec3(triangle.vertex);\n"
                                "  barycentric = triangle.barycentric;\n}\n");
  return shader;
}

// Irradiance of a basis in lanes, its coefficients some constants between 0.5 and 2.5.
const RowShader& irradiance_shader(const TechniqueInfo& basis) {
  static std::mutex mutex;
  static std::map<std::string, RowShader> shaders;
  const std::lock_guard lock(mutex);
  const std::string file(basis.file);
  if (const auto found = shaders.find(file); found != shaders.end()) return found->second;
  const std::string text =
      "#define COEF(i) coefficient(i)\n"
      "vec3 coefficient(int i) {\n"
      "  precise vec3 numbers = vec3(float((i * 7 + 3) % 17), float((i * 5 + 1) % 13), float(i % 11));\n"
      "  precise vec3 scaled = numbers * 0.125 + 0.5;\n"
      "  return scaled;\n"
      "}\n"
      "#include \"basis/" +
      file +
      "\"\n"
      "in vec3 direction;\nout vec3 irradiance;\nvoid main() {\n"
      // As the host's own evaluation: a direction with a NaN counts as the zero vector
      "  bool defined = direction.x == direction.x && direction.y == direction.y && direction.z == direction.z;\n"
      "  irradiance = basis_irradiance(defined ? direction : vec3(0.0));\n}\n";
  return shaders.try_emplace(file, "irradiance_" + std::string(basis.name), text).first->second;
}

std::vector<float> component_major(const std::vector<glm::dvec3>& directions) {
  std::vector<float> inputs;
  inputs.reserve(3 * directions.size());
  for (int c = 0; c < 3; ++c)
    for (const glm::dvec3& d : directions) inputs.push_back(float(d[c]));
  return inputs;
}

// Vectors whose dot product with a direction is its barycentric coordinate in a face.
struct FacePlanes {
  std::array<int, 3> face;
  glm::dvec3 normal[3];
  glm::dvec3 operator()(const glm::dvec3& n) const {
    return {glm::dot(normal[0], n), glm::dot(normal[1], n), glm::dot(normal[2], n)};
  }
};
const std::vector<FacePlanes>& face_planes() {
  static const std::vector<FacePlanes> planes = [] {
    std::vector<FacePlanes> all;
    for (const std::array<int, 3>& face : icosahedron_faces()) {
      FacePlanes& p = all.emplace_back();
      p.face = face;
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 unit(0);
        unit[axis] = 1;
        const glm::dvec3 b = barycentric(face, unit);
        for (int k = 0; k < 3; ++k) p.normal[k][axis] = b[k];
      }
    }
    return all;
  }();
  return planes;
}

// Why it is not the face that contains n, or null.
const char* wrong(const glm::dvec3& n, const std::array<int, 3>& picked, const glm::dvec3& b) {
  std::array<int, 3> sorted = picked;
  std::sort(sorted.begin(), sorted.end());
  const auto& faces = icosahedron_faces();
  if (std::find(faces.begin(), faces.end(), sorted) == faces.end()) return "no face";
  if (!(b.x >= 0 && b.y >= 0 && b.z >= 0)) return "negative or NaN barycentric coordinate";
  if (std::isnan(n.x + n.y + n.z)) return b == glm::dvec3(0) ? nullptr : "NaN does not count as zero";
  if (glm::length(barycentric(picked, n) - b) > 5e-7) return "wrong barycentric coordinates";
  // Clearly inside one face: that one, no other
  for (const FacePlanes& other : face_planes()) {
    const glm::dvec3 inside = other(n);
    if (std::min({inside.x, inside.y, inside.z}) > 3e-7 && sorted != other.face) return "another face contains it";
  }
  return nullptr;
}

}  // namespace

std::vector<glm::dvec3> special_directions() {
  std::vector<glm::dvec3> exact = {{0, 0, 0}, {-0.0, 0, 0}, {0, -0.0, 0}, {-0.0, -0.0, -0.0}};
  // Components -0, 0 and both signs of everything
  const double levels[] = {-1, -0.0, 0.0, 1};
  for (const double x : levels)
    for (const double y : levels)
      for (const double z : levels)
        if (x != 0 || y != 0 || z != 0) {
          const glm::dvec3 v(x, y, z);
          exact.push_back(to_float(v / std::sqrt(glm::dot(v, v))));
        }
  exact.emplace_back(to_float({-0.0, .3, .95}));
  for (int i = 0; i < 12; ++i) exact.push_back(to_float(icosahedron()[i].v));
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < i; ++j) {
      const glm::dvec3 middle = icosahedron()[i].v + icosahedron()[j].v;
      if (glm::dot(middle, middle) > 1) exact.push_back(to_float(glm::normalize(middle)));
    }
  for (const std::array<int, 3>& face : icosahedron_faces())
    exact.push_back(
        to_float(glm::normalize(icosahedron()[face[0]].v + icosahedron()[face[1]].v + icosahedron()[face[2]].v)));
  std::vector<glm::dvec3> all = exact;
  for (const glm::dvec3& n : exact)
    for (int axis = 0; axis < 3; ++axis)
      for (const int steps : {-1, 1}) {
        glm::dvec3 moved = n;
        moved[axis] = step(moved[axis], steps);
        all.push_back(moved);
      }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int mask = 1; mask < 8; ++mask)
    all.emplace_back(mask & 1 ? nan : 0.6, mask & 2 ? -nan : 0, mask & 4 ? nan : 0.8);
  return all;
}

glm::dvec3 awkward_direction(Uniform& uniform) {
  const int kind = int(uniform(0, 8));
  glm::dvec3 n = uniform.direction();
  if (kind < 4) return n;
  if (kind == 4) {  // coordinate plane
    n[int(uniform(0, 3))] = uniform() < 0 ? -0.0 : 0.0;
    return to_float(n);
  }
  const auto& face = icosahedron_faces()[std::size_t(uniform(0, 20))];
  const glm::dvec3 a = icosahedron()[face[0]].v, b = icosahedron()[face[1]].v;
  const double share = kind == 5 ? 0 : uniform(0, 1);
  n = to_float(glm::normalize((1 - share) * a + share * b));
  for (int axis = 0; axis < 3; ++axis) n[axis] = step(n[axis], int(uniform(-4, 4)));
  return n;
}

int count_not_finite(const TechniqueInfo& basis, const std::vector<glm::dvec3>& directions) {
  const std::size_t rows = directions.size();
  const std::vector<float> e = irradiance_shader(basis).run(component_major(directions), rows);
  int bad = 0;
  for (std::size_t r = 0; r < rows; ++r)
    if (!std::isfinite(e[r] + e[rows + r] + e[2 * rows + r]) && bad++ < 5)
      std::fprintf(stderr, "%s at %s\n", std::string(basis.name).c_str(), hex(directions[r]).c_str());
  return bad;
}

int count_wrong_triangles(const std::vector<glm::dvec3>& directions) {
  const std::size_t rows = directions.size();
  const std::vector<float> outputs = triangle_shader().run(component_major(directions), rows);
  int bad = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::array<int, 3> picked = {int(outputs[r]), int(outputs[rows + r]), int(outputs[2 * rows + r])};
    const glm::dvec3 b(outputs[3 * rows + r], outputs[4 * rows + r], outputs[5 * rows + r]);
    const char* why = wrong(directions[r], picked, b);
    if (why && bad++ < 5) std::fprintf(stderr, "%s at %s\n", why, hex(directions[r]).c_str());
  }
  return bad;
}

}  // namespace twinshade::test

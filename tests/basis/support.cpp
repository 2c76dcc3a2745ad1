#include "tests/basis/support.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "cpu_shaders/load/host_eval.h"
#include "cpu_shaders/load/load.h"

namespace twinshade::test {

Nodes gauss_legendre(int count) {
  Nodes nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (count + 0.5)), derivative = 0;
    for (int step = 0; step < 20; ++step) {
      double previous = 1, value = x;
      for (int k = 2; k <= count; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      derivative = count * (x * value - previous) / (x * x - 1);
      x -= value / derivative;
    }
    nodes.x.push_back(0.5 * (x + 1));
    nodes.weight.push_back(1 / ((1 - x * x) * derivative * derivative));
  }
  return nodes;
}

Points rings(double z_low, int count) {
  const Nodes nodes = gauss_legendre(count);
  Points points;
  for (int i = 0; i < count; ++i) {
    const double z = z_low + (1 - z_low) * nodes.x[i], radius = std::sqrt(1 - z * z);
    for (int j = 0; j < 2 * count; ++j) {
      const double phi = kPi * (j + 0.5) / count;
      points.directions.emplace_back(radius * std::cos(phi), radius * std::sin(phi), z);
      points.weights.push_back(nodes.weight[i] * (1 - z_low) * kPi / count);
    }
  }
  return points;
}

namespace {

// Of the triangle's projection on the sphere; Gauss-Legendre on the square collapsed to a triangle.
void add_triangle(Points& points, const Nodes& nodes, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
  for (std::size_t i = 0; i < nodes.x.size(); ++i)
    for (std::size_t j = 0; j < nodes.x.size(); ++j) {
      const double u = nodes.x[i], v = u * nodes.x[j];
      const glm::dvec3 p = a + u * (b - a) + v * (c - b);
      const double length = glm::length(p);
      points.directions.push_back(p / length);
      points.weights.push_back(nodes.weight[i] * nodes.weight[j] * u * volume / (length * length * length));
    }
}

void split(Points& points, const Nodes& nodes, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
           int splits) {
  const glm::dvec3 right = (b - a) / double(splits), up = (c - a) / double(splits);
  for (int i = 0; i < splits; ++i)
    for (int j = 0; i + j < splits; ++j) {
      const glm::dvec3 corner = a + double(i) * right + double(j) * up;
      add_triangle(points, nodes, corner, corner + right, corner + up);
      if (i + j + 1 < splits) add_triangle(points, nodes, corner + right + up, corner + right, corner + up);
    }
}

}  // namespace

Points icosahedral(int nodes, int splits) {
  const Nodes gauss = gauss_legendre(nodes);
  Points points;
  for (const std::array<int, 3>& face : icosahedron_faces()) {
    const std::array<glm::dvec3, 3> v = {icosahedron()[face[0]].v, icosahedron()[face[1]].v, icosahedron()[face[2]].v};
    const glm::dvec3 middle = (v[0] + v[1] + v[2]) / 3.0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 half = 0.5 * (v[k] + v[(k + 1) % 3]);
      split(points, gauss, middle, v[k], half, splits);
      split(points, gauss, middle, half, v[(k + 1) % 3], splits);
    }
  }
  return points;
}

std::vector<double> values(std::string_view basis, const std::vector<glm::dvec3>& directions, Number number) {
  std::vector<double> xyz;
  for (const glm::dvec3& d : directions) xyz.insert(xyz.end(), {d.x, d.y, d.z});
  return evaluate_basis(basis, xyz, number);
}

Irradiance irradiance(std::string_view basis, const std::vector<glm::dvec3>& coefficients,
                      const std::vector<glm::dvec3>& directions, Number number) {
  const ShaderModule& module = load_module(basis_irradiance_source(find_technique(basis)), number);
  const std::size_t rows = directions.size();
  std::vector<double> inputs(rows * module.input_components);
  for (std::uint32_t k = 0; k < module.input_count; ++k) {  // those that the shader reads
    double* column = inputs.data() + module.inputs[k].first_component * rows;
    if (module.inputs[k].name == std::string_view("direction"))
      for (int c = 0; c < 3; ++c)
        for (const glm::dvec3& d : directions) *column++ = d[c];
    else
      for (const glm::dvec3& coefficient : coefficients)
        for (int c = 0; c < 3; ++c, column += rows) std::fill_n(column, rows, coefficient[c]);
  }
  const std::vector<double> outputs = run_module(module, number, inputs, rows);
  const auto output = [&](std::string_view name) {
    for (std::uint32_t k = 0; k < module.output_count; ++k)
      if (module.outputs[k].name == name) return outputs.data() + module.outputs[k].first_component * rows;
    TWINSHADE_CHECK_EQ(name, "an output of the shader");
    return outputs.data();
  };
  const double *rgb = output("irradiance"), *reads = output("reads");
  Irradiance result;
  for (std::size_t r = 0; r < rows; ++r) {
    result.rgb.emplace_back(rgb[r], rgb[rows + r], rgb[2 * rows + r]);
    result.reads.push_back(int(reads[r]));
  }
  return result;
}

std::vector<double> products(std::string_view a, std::string_view b, const Points& points) {
  const std::vector<double> va = values(a, points.directions), vb = values(b, points.directions);
  const std::size_t rows = points.weights.size(), na = va.size() / rows, nb = vb.size() / rows;
  std::vector<double> result(na * nb);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t i = 0; i < na; ++i)
      for (std::size_t j = 0; j < nb; ++j) result[i * nb + j] += points.weights[r] * va[r * na + i] * vb[r * nb + j];
  return result;
}

double Uniform::operator()(double low, double high) {
  state_ ^= state_ << 13;
  state_ ^= state_ >> 7;
  state_ ^= state_ << 17;
  return low + (high - low) * (double(state_ >> 11) * 0x1p-53);
}

glm::dvec3 Uniform::direction() {
  for (;;) {
    glm::dvec3 v;
    for (int axis = 2; axis >= 0; --axis) v[axis] = (*this)();  // one by one: arguments of a call have no order
    const double square = glm::dot(v, v);
    if (square > 1e-4 && square <= 1) return glm::dvec3(glm::vec3(v / std::sqrt(square)));
  }
}

std::vector<glm::dvec3> random_vectors(int count, std::uint64_t seed) {
  Uniform uniform(seed);
  std::vector<glm::dvec3> vectors;
  for (int i = 0; i < count; ++i) {
    const double x = uniform(), y = uniform(), z = uniform();
    vectors.emplace_back(glm::vec3(x, y, z));
  }
  return vectors;
}

const std::array<Frame, 12>& icosahedron() {
  static const std::array<Frame, 12> frames = [] {
    const double phi = (1 + std::sqrt(5.0)) / 2, size = std::sqrt(1 + phi * phi);
    std::array<Frame, 12> made;
    for (int i = 0; i < 12; ++i) {
      const int kind = i / 4, zero = (kind + 2) % 3;  // 0: (phi, 1, 0), 1: (0, phi, 1), 2: (1, 0, phi)
      glm::dvec3 v(0);
      v[kind] = phi, v[(kind + 1) % 3] = 1;
      bool second = false;  // bit 0: sign of the first coordinate that is not zero
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == zero) continue;
        if (i & (second ? 2 : 1)) v[axis] = -v[axis];
        second = true;
      }
      made[i].v = v / size;
      made[i].e1 = glm::dvec3(zero == 0, zero == 1, zero == 2);
      made[i].e2 = glm::cross(made[i].v, made[i].e1);
    }
    return made;
  }();
  return frames;
}

const std::vector<std::array<int, 3>>& icosahedron_faces() {
  static const std::vector<std::array<int, 3>> faces = [] {
    std::vector<std::array<int, 3>> made;
    const auto near = [](int i, int j) { return glm::dot(icosahedron()[i].v, icosahedron()[j].v) > 0.4; };
    for (int i = 0; i < 12; ++i)
      for (int j = i + 1; j < 12; ++j)
        for (int k = j + 1; k < 12; ++k)
          if (near(i, j) && near(j, k) && near(k, i)) made.push_back({i, j, k});
    return made;
  }();
  return faces;
}

glm::dvec3 barycentric(const std::array<int, 3>& face, const glm::dvec3& n) {
  const glm::dvec3 a = icosahedron()[face[0]].v, b = icosahedron()[face[1]].v, c = icosahedron()[face[2]].v;
  return glm::dvec3(glm::dot(n, glm::cross(b, c)), glm::dot(n, glm::cross(c, a)), glm::dot(n, glm::cross(a, b))) /
         glm::dot(a, glm::cross(b, c));
}

std::string hex(const glm::dvec3& v) {
  char text[128];
  std::snprintf(text, sizeof text, "(%a, %a, %a)", v.x, v.y, v.z);
  return text;
}

std::vector<const TechniqueInfo*> bases(bool linear) {
  std::vector<const TechniqueInfo*> chosen;
  for (const TechniqueInfo& technique : techniques())
    if (technique.is_basis && technique.linear == linear) chosen.push_back(&technique);
  return chosen;
}

}  // namespace twinshade::test

#include "experiments/reference_frame.h"

#include "base/error.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

template <class Vector>
void add_attribute(Bundle& bundle, const char* name, const std::vector<Vector>& values) {
  Attribute out{name, Scalar::f32, std::uint32_t(Vector::length()), {}};
  for (const Vector& value : values)
    for (int c = 0; c < Vector::length(); ++c) out.values.push_back(value[c]);
  bundle.attributes.push_back(std::move(out));
}

ShaderSource probe(const std::string& name, const std::string& value) {
  return resolve_shader("reference_" + name,
                        "#include \"technique/surface_world.glsl\"\n"
                        "in vec3 v_position;\n"
                        "out vec4 color;\n"
                        "void main() {\n"
                        "  load_surface_maps();\n"
                        "  color = vec4(" +
                            value + ", 1.0);\n}\n",
                        "reference_" + name);
}

}  // namespace

void require_world_surfaces(const Scene& scene) {
  if (scene.procedural_coefficients)
    throw UserError(scene.name + ": has no surfaces in the world that light could be traced to");
}

VisiblePoints draw_visible_points(const Scene& scene, const FrameOptions& options, const DrawFunction& draw) {
  require_world_surfaces(scene);
  VisiblePoints out;
  out.bundle = make_bundle(scene, std::span<const LightBake>(), std::vector<LitTechnique>(), options);
  add_attribute(out.bundle, "v_normal", scene.normals);
  add_attribute(out.bundle, "v_tangent", scene.tangents);
  const auto drawn = [&](const char* name, const char* value) { return draw("cpu", out.bundle, probe(name, value)); };
  out.frame = drawn("position", "v_position");
  const Frame& frame = out.frame;
  const Frame normals = drawn("normal", "surface_normal()"), albedo = drawn("albedo", "surface_albedo()");
  const auto at = [](const Frame& from, std::size_t pixel) {
    return glm::vec3(from.color[pixel * 4], from.color[pixel * 4 + 1], from.color[pixel * 4 + 2]);
  };
  for (std::size_t pixel = 0; pixel < frame.coverage.size(); ++pixel) {
    if (!frame.coverage[pixel]) continue;
    out.points.push_back({at(frame, pixel), at(normals, pixel), at(albedo, pixel), frame.primitive_id[pixel]});
    out.pixels.push_back(pixel);
  }
  return out;
}

ReferenceFrame draw_reference(const Scene& scene, const Environment& environment, const FrameOptions& options,
                              const ReferenceOptions& trace, const DrawFunction& draw) {
  VisiblePoints visible = draw_visible_points(scene, options, draw);
  const std::vector<glm::vec3> radiance = reference_radiance(scene, environment, visible.points, trace);
  for (std::size_t i = 0; i < visible.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) visible.frame.color[visible.pixels[i] * 4 + c] = radiance[i][int(c)];
  return {std::move(visible.frame), std::move(visible.bundle)};
}

}  // namespace twinshade

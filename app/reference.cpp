#include "app/reference.h"

#include "base/error.h"
#include "lighting/environment_light.h"
#include "lighting/reference.h"
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

bool wants_reference(const ShadingOptions& options) {
  return options.shader.empty() && options.techniques.size() == 1 && options.techniques.front() == "reference";
}

Frame draw_reference(const SubjectOptions& options, const ShadingOptions& shading, const CpuOptions& cpu,
                     const CommonOptions& common, const Output& output, Subject& subject) {
  const Scene scene = load_scene(options.scene);
  for (const std::string& note : scene.notes) output.note(options.scene + ": " + note);
  if (scene.procedural_coefficients)
    throw UserError(options.scene + ": has no surfaces in the world that technique reference could trace");
  Environment environment = load_light(options);
  if (shading.reference_order > 0)
    environment = environment_of_radiance(environment_radiance(environment, shading.reference_order),
                                          shading.reference_order, 512);

  subject.bundle =
      make_bundle(scene, std::span<const LightBake>(), std::vector<LitTechnique>(), frame_options(options, scene));
  add_attribute(subject.bundle, "v_normal", scene.normals);
  add_attribute(subject.bundle, "v_tangent", scene.tangents);
  subject.hash = bundle_hash(subject.bundle);
  Machines machines(cpu, true);
  const auto draw = [&](const char* name, const char* value) {
    return machines.draw("cpu", subject.bundle, probe(name, value), DrawOptions());
  };
  Frame frame = draw("position", "v_position");
  const Frame normals = draw("normal", "surface_normal()"), albedo = draw("albedo", "surface_albedo()");

  std::vector<ShadedPoint> points;
  std::vector<std::size_t> pixels;
  const auto at = [](const Frame& from, std::size_t pixel) {
    return glm::vec3(from.color[pixel * 4], from.color[pixel * 4 + 1], from.color[pixel * 4 + 2]);
  };
  for (std::size_t pixel = 0; pixel < frame.coverage.size(); ++pixel) {
    if (!frame.coverage[pixel]) continue;
    points.push_back({at(frame, pixel), at(normals, pixel), at(albedo, pixel), frame.primitive_id[pixel]});
    pixels.push_back(pixel);
  }
  ReferenceOptions trace;
  trace.rays = shading.reference_rays;
  trace.seed = common.seed;
  trace.show_progress = !common.quiet;
  const std::vector<glm::vec3> radiance = reference_radiance(scene, environment, points, trace);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) frame.color[pixels[i] * 4 + c] = radiance[i][int(c)];
  return frame;
}

}  // namespace twinshade

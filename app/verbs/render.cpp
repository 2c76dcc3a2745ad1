// render: one frame, as a picture.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "app/machines.h"
#include "app/memory_needed.h"
#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/subject.h"
#include "base/error.h"
#include "experiments/reference_frame.h"
#include "golden/pictures.h"
#include "images/image_file.h"
#include "lighting/environment_light.h"
#include "scenes/model_file.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

// What technique reference has none of: it traces light from the environment to each pixel.
constexpr const char* kNotOfReference[] = {"--light", "--attributes"};

struct RenderVerb {
  CLI::App* command = nullptr;
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  CpuOptions cpu;
  PictureOptions picture;
  std::string backend = "cpu", file;
  AttributeMode attributes = AttributeMode::exact;
  bool host_fma = true;

  int run() const {
    apply(common);
    const Output output(common);
    require_backends({backend});
    require_machine_options(*command, {backend});
    if (backend == "softpipe")
      throw UserError(
          "softpipe draws no picture of its own: it shades what the CPU covered (twinshade compare --on cpu,softpipe)");
    require_one_shading(shading, "render draws one");
    if (!file.empty()) {
      require_picture_ending(file);
      for (const char* option : {"--exposure", "--tonemap"})
        if (lower_case_ending(file) != ".png" && command->get_option(option)->count() > 0)
          throw UserError(std::string(option) + ": PNG pictures alone have it, " + file +
                          " keeps what was computed: leave it out, or name a .png");
      require_writable_file(file);
    }
    output.require_not_read(files_read(subject, shading), file);

    const bool traced = shading.shader.empty() && shading.techniques.front() == kReferenceTechnique;
    for (const char* option : {"--reference-rays", "--reference-order"})
      if (!traced && command->get_option(option)->count() > 0)
        throw UserError(std::string(option) + ": only technique reference has it; add --technique reference");
    if (traced) require_traceable();
    if (traced && cpu.precision != Precision::full)
      throw UserError(
          "--number: technique reference is traced, not shaded, and has no mediump or float16: leave it out");
    Subject ready;
    if (!traced) ready = load_subject(subject, shading, common, output, file);
    const Shading shader = traced ? Shading{kReferenceTechnique, "", "", {}} : load_shadings(shading, ready).front();
    note_precision(output, shader.source, cpu.precision);
    DrawOptions options;
    options.attributes = attributes;
    output.progress("drawing " + shader.technique + " on " + backend);
    const Frame frame =
        traced ? trace(output, ready) : Machines(cpu, host_fma).draw(backend, ready.bundle, shader.source, options);
    const std::string hash = frame_hash(frame);
    if (!file.empty()) {
      PictureOptions noted = picture;
      noted.notes = {
          {"technique", shader.technique}, {"backend", backend}, {"frame_hash", hash}, {"bundle_hash", ready.hash}};
      if (frame.color_scalar != Scalar::f32) require_integers_shown(output);
      write_picture(file, frame, noted);
    }

    output.text(fmt::format("frame  {}\nbundle {}\n", hash, ready.hash));
    Provenance provenance(common);
    provenance.add(ready);
    provenance.add(shader);
    provenance.add(backend, frame);
    Json milliseconds = Json::object();
    for (const auto& [stage, ms] : frame.milliseconds) milliseconds[stage] = ms;
    output.json({{"provenance", provenance.json()},
                 {"technique", shader.technique},
                 {"light", shader.light.empty() ? Json(nullptr) : Json(shader.light)},
                 {"backend", backend},
                 {"attributes", attribute_mode_name(attributes)},
                 {"file", file.empty() ? Json(nullptr) : Json(file)},
                 {"frame", hash},
                 {"bundle", ready.hash},
                 {"width", frame.width},
                 {"height", frame.height},
                 {"distinct_threads", frame.distinct_threads},
                 {"milliseconds", milliseconds}});
    return 0;
  }

 private:
  // A PNG shows integers as they are: no exposure, no tone curve.
  void require_integers_shown(const Output& output) const {
    for (const char* option : {"--exposure", "--tonemap"})
      if (command->get_option(option)->count() > 0)
        throw UserError(std::string(option) +
                        ": the shader's output is of integers, which a PNG shows as they are: "
                        "leave it out");
    if (lower_case_ending(file) == ".png")
      output.note(file + ": integers below 0 are 0, above 255 they are 255; an .exr keeps them");
  }

  void require_traceable() const {
    if (backend != "cpu") throw UserError("technique reference has no shader: the cpu alone draws it");
    for (const char* option : kNotOfReference)
      if (command->get_option(option)->count() > 0)
        throw UserError(std::string(option) + ": technique reference does not read it: leave it out");
    std::error_code code;
    if (std::filesystem::is_regular_file(subject.scene, code) && model_file_ending(subject.scene).empty())
      throw UserError(subject.scene +
                      ": technique reference traces a scene, which a bundle has not: name a built-in scene or a model "
                      "(.gltf, .glb or .obj)");
  }

  Frame trace(const Output& output, Subject& ready) const {
    require_frame_memory(subject.width, subject.height, "cpu");
    require_scene_memory(subject);
    const Scene scene = load_scene(subject.scene, subject.triangles, !subject.camera);
    output.require_not_read(scene.files, file);
    note_scene(output, subject, scene);
    Environment environment = load_light(subject);
    if (!environment.note.empty()) output.note(environment.note);
    if (shading.reference_order > 0)
      environment = environment_of_radiance(environment_radiance(environment, shading.reference_order),
                                            shading.reference_order, 512);
    ReferenceOptions options;
    options.rays = shading.reference_rays;
    options.seed = common.seed;
    options.show_progress = !common.quiet;
    Machines machines(cpu, host_fma);
    const DrawFunction draw = [&](const std::string& machine, const Bundle& bundle, const ShaderSource& source) {
      return machines.draw(machine, bundle, source, DrawOptions());
    };
    ReferenceFrame traced = draw_reference(scene, environment, frame_options(subject, scene), options, draw);
    ready.bundle = std::move(traced.bundle);
    ready.hash = bundle_hash(ready.bundle);
    return std::move(traced.frame);
  }
};

}  // namespace

Verb add_render(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "draw one frame");
  const auto verb = std::make_shared<RenderVerb>();
  verb->command = command;
  add_subject_options(*command, verb->subject);
  add_shading_options(*command, verb->shading, "h4");
  require_one_shader(*command);
  require_second_environment(*command);
  add_reference_options(*command, verb->shading);
  command->add_option("--on", verb->backend, "cpu, egl, osmesa or gpu (default: cpu)")->type_name("BACKEND");
  add_attribute_option(*command, verb->attributes);
  command->add_option("-o,--output", verb->file, "picture to write, by ending: .exr, .hdr or .png")->type_name("F.exr");
  verb->cpu.emulates = true;
  add_cpu_options(*command, verb->cpu);
  add_fma_option(*command, verb->host_fma);
  add_picture_options(*command, verb->picture);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

// render: one frame, as a picture.
#include <fmt/format.h>

#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/reference.h"
#include "app/subject.h"
#include "base/error.h"
#include "golden/pictures.h"

namespace twinshade {
namespace {

struct RenderVerb {
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
    if (backend == "softpipe")
      throw UserError(
          "softpipe draws no picture of its own: it shades what the CPU covered (twinshade compare --on cpu,softpipe)");
    if (wants_all(shading) || (shading.shader.empty() && shading.techniques.size() != 1))
      throw UserError("--technique: render draws one; name one technique");
    if (shading.light == LightSource::all)
      throw UserError("--light all: render draws one; name lightmap, vertex or volume");
    if (!file.empty()) {
      require_picture_ending(file);
      require_writable_file(file);
    }

    const bool traced = wants_reference(shading);
    if (traced && backend != "cpu") throw UserError("technique reference has no shader: the cpu alone draws it");
    Subject ready;
    if (!traced) ready = load_subject(subject, shading, common, output);
    const Shading shader = traced ? Shading{"reference", "", "", {}} : load_shadings(shading, ready).front();
    DrawOptions options;
    options.attributes = attributes;
    output.progress("drawing " + shader.technique + " on " + backend);
    const Frame frame = traced ? draw_reference(subject, shading, cpu, common, output, ready)
                               : Machines(cpu, host_fma).draw(backend, ready.bundle, shader.source, options);
    const std::string hash = frame_hash(frame);
    if (!file.empty()) {
      PictureOptions noted = picture;
      noted.notes = {
          {"technique", shader.technique}, {"backend", backend}, {"frame_hash", hash}, {"bundle_hash", ready.hash}};
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
};

}  // namespace

Verb add_render(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "draw one frame");
  const auto verb = std::make_shared<RenderVerb>();
  add_subject_options(*command, verb->subject);
  add_shading_options(*command, verb->shading, "h4");
  add_reference_options(*command, verb->shading);
  command->add_option("--on", verb->backend, "cpu, egl or osmesa (default: cpu)")->type_name("BACKEND");
  add_attribute_option(*command, verb->attributes);
  command->add_option("-o,--output", verb->file, "picture to write, by ending: .exr, .hdr or .png")->type_name("F.exr");
  add_cpu_options(*command, verb->cpu);
  add_fma_option(*command, verb->host_fma);
  add_picture_options(*command, verb->picture);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

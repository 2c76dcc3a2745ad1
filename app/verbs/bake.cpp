// bake: everything a renderer needs, in one file.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "app/option_rules.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/subject.h"
#include "base/error.h"

namespace twinshade {
namespace {

struct BakeVerb {
  CommonOptions common;
  SubjectOptions subject;
  ShadingOptions shading;
  std::string file;

  int run() const {
    apply(common);
    Output output(common);
    if (file == "-") throw UserError("-o -: names no file; for stdout: -o /dev/stdout");
    require_writable_file(file);
    output.leave_stdout_to(file);
    output.require_not_read(files_read(subject, shading), file);
    const Subject ready = load_subject(subject, shading, common, output, file);
    write_bundle(file, ready.bundle);

    const Bundle& bundle = ready.bundle;
    std::error_code no_file;  // a device or a pipe has no size
    const auto size = std::filesystem::file_size(file, no_file);
    const auto bytes = no_file ? 0 : size;
    output.text(fmt::format("{}: {} triangles, {} vertices, {} textures, {:.1f} MiB\nbundle {}\n", file,
                            bundle.triangle_count(), bundle.vertex_count(), bundle.textures.size(),
                            double(bytes) / (1 << 20), ready.hash));
    Provenance provenance(common);
    provenance.add(ready);
    output.json({{"provenance", provenance.json()},
                 {"file", file},
                 {"bundle", ready.hash},
                 {"bytes", bytes},
                 {"triangles", bundle.triangle_count()},
                 {"vertices", bundle.vertex_count()}});
    return 0;
  }
};

}  // namespace

Verb add_bake(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bake", "light a scene and write all that a renderer needs as one file");
  const auto verb = std::make_shared<BakeVerb>();
  add_subject_options(*command, verb->subject);
  require_second_environment(*command);
  add_technique_option(*command, verb->shading, "all");
  add_light_option(*command, verb->shading);
  command->add_option("-o,--output", verb->file, "bundle file to write")->type_name("BUNDLE")->required();
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

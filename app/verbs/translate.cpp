// translate: the C++ that a shader becomes, to read.
#include "cpu_shaders/translate/translate.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>

#include "app/output.h"
#include "app/provenance.h"
#include "app/report/dialect.h"
#include "app/subject.h"
#include "base/error.h"
#include "base/file.h"
#include "base/names.h"
#include "lighting/registry.h"

namespace twinshade {
namespace {

// A file if there is one of that name or it looks like a path; else a technique, "h4", or its form for another place of
// the coefficients, "h4_vertex" or "sh3_volume".
ShaderSource source_of(const std::string& name, const SourceOptions& options) {
  std::error_code code;
  if (std::filesystem::exists(name, code) || name.find_first_of("./\\") != std::string::npos)
    return load_shader(name, options);
  if (name == kReferenceTechnique) throw UserError(fmt::format("technique {}: {}", name, kReferenceReason));
  std::vector<std::string> names;
  for (const TechniqueInfo& technique : techniques()) {
    const bool lightmap = can_read(technique, CoefficientStorage::lightmap);
    if (name == technique.name)
      return technique_source(technique, lightmap ? CoefficientStorage::lightmap : CoefficientStorage::volume);
    if (name == std::string(technique.name) + "_vertex") return technique_source(technique, CoefficientStorage::vertex);
    if (name == std::string(technique.name) + "_volume") return technique_source(technique, CoefficientStorage::volume);
    names.emplace_back(technique.name);
  }
  throw UserError(unknown_name_message("technique or shader file", name, names));
}

struct TranslateVerb {
  CommonOptions common;
  std::string shader, file;
  SourceOptions source_options;
  Precision precision = Precision::full;

  int run() {
    if (file == "-") file.clear();  // stdout
    const Output output(common);
    if (!file.empty()) require_writable_file(file);
    if (file.empty() && common.json == "-")
      throw UserError("--json -: the C++ goes to stdout; name a file for one of them");
    const ShaderSource source = source_of(shader, source_options);
    output.require_not_read(source.files, file);
    TranslateOptions options;
    options.readable = true;
    ShaderSource narrowed = source;
    narrowed.precision = precision;
    note_precision(output, source, precision);
    const Translation translation = translate(narrowed, options);
    const std::vector<LintFinding> findings = findings_of(source);  // before anything is written: it may refuse, too
    if (file.empty())
      output.text(translation.cpp);
    else
      write_file(file, translation.cpp);
    for (const LintFinding& finding : findings) output.note("outside the exact dialect: " + describe(finding));
    report_json(output, source, translation.reflection, findings);
    return 0;
  }

  void report_json(const Output& output, const ShaderSource& source, const Reflection& reflection,
                   const std::vector<LintFinding>& findings) const {
    const auto names = [](const auto& list) {
      Json json = Json::array();
      for (const auto& entry : list) json.push_back(entry.name);
      return json;
    };
    Provenance provenance(common);
    provenance.add(Shading{shader, "", "", source});
    output.json({{"provenance", provenance.json()},
                 {"shader", shader},
                 {"file", file.empty() ? Json(nullptr) : Json(file)},
                 {"inputs", names(reflection.inputs)},
                 {"outputs", names(reflection.outputs)},
                 {"uniforms", names(reflection.uniforms)},
                 {"resources", names(reflection.resources)},
                 {"discards", reflection.discards},
                 {"writes_depth", reflection.writes_depth},
                 {"uses_derivatives", reflection.uses_derivatives},
                 {"float64", reflection.no_float64_reason.empty() ? Json(true) : Json(reflection.no_float64_reason)},
                 {"outside_exact_dialect", findings_json(findings)}});
  }
};

}  // namespace

Verb add_translate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("translate", "the C++ that a shader becomes, to read");
  const auto verb = std::make_shared<TranslateVerb>();
  command->add_option("shader", verb->shader, "fragment shader file, or a technique")->type_name("SHADER")->required();
  command->add_option("-o,--output", verb->file, "C++ file to write (default, and -: stdout)")->type_name("F.cpp");
  command
      ->add_option_function<std::string>(
          "--number",
          [verb = verb.get()](const std::string& name) {
            const std::optional<Precision> precision = parse_precision(name);
            if (!precision)
              throw UserError("--number " + name +
                              ": must be mediump or float16; of all others the C++ is the same, generic in its number");
            verb->precision = *precision;
          },
          "show what is computed in half")
      ->type_name("mediump|float16");
  add_source_options(*command, verb->source_options);
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade

// The build's translator: one shader becomes one C++ file.
//   twinshade-translate NAME KIND IDENTIFIER OUT.cpp
//     NAME: of lighting/registry.def or lighting/sphere_maps.def. KIND: lightmap, vertex or volume (the technique's
//     fragment shader with that coefficient storage), basis_values, basis_irradiance, map_taps or map_direction (for
//     the host).
//   twinshade-translate FILE.frag [-I FOLDER]... [--name IDENTIFIER] [--readable] -o OUT.cpp
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"
#include "lighting/sphere_maps.h"

using namespace twinshade;

namespace {

constexpr const char* kUsage =
    "usage: twinshade-translate NAME KIND IDENTIFIER OUT.cpp\n"
    "       twinshade-translate FILE.frag [-I FOLDER]... [--name IDENTIFIER] [--readable] -o OUT.cpp";

struct Job {
  ShaderSource source;
  TranslateOptions options;
  std::string output;
};

ShaderSource builtin_source(const std::string& name, const std::string& kind) {
  if (kind == "map_taps") return sphere_map_taps_source(find_sphere_map(name));
  if (kind == "map_direction") return sphere_map_direction_source(find_sphere_map(name));
  const TechniqueInfo& technique = find_technique(name);
  if (kind == "basis_values") return basis_values_source(technique);
  if (kind == "basis_irradiance") return basis_irradiance_source(technique);
  if (kind == "volume") return technique_source(technique, CoefficientStorage::volume);
  if (kind == "lightmap") return technique_source(technique, CoefficientStorage::lightmap);
  if (kind == "vertex") return technique_source(technique, CoefficientStorage::vertex);
  throw UserError("unknown kind " + kind +
                  "; name lightmap, vertex, volume, basis_values, basis_irradiance, map_taps or map_direction");
}

Job job_of(const std::vector<std::string>& arguments) {
  Job job;
  std::vector<std::string> folders, names;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const auto value = [&] {
      if (k + 1 == arguments.size()) throw UserError(arguments[k] + " wants a value\n" + kUsage);
      return arguments[++k];
    };
    if (arguments[k] == "-I")
      folders.push_back(value());
    else if (arguments[k] == "-o")
      job.output = value();
    else if (arguments[k] == "--name")
      job.options.identifier = value();
    else if (arguments[k] == "--readable")
      job.options.readable = true;
    else
      names.push_back(arguments[k]);
  }
  if (names.size() == 4 && job.output.empty()) {
    job.source = builtin_source(names[0], names[1]);
    job.options.identifier = names[2];
    job.output = names[3];
  } else if (names.size() == 1 && !job.output.empty()) {
    job.source = load_shader(names[0], folders);
  } else {
    throw UserError(kUsage);
  }
  return job;
}

// An unchanged file keeps its time, so that a changed shader recompiles only itself.
bool has_content(const std::string& path, const std::string& content) {
  try {
    return read_file(path) == content;
  } catch (const UserError&) {
    return false;
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const Job job = job_of({arguments + 1, arguments + count});
    const std::string cpp = translate(job.source, job.options).cpp;
    if (!has_content(job.output, cpp)) write_file(job.output, cpp);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "twinshade-translate: %s\n", error.what());
    return 2;
  }
  return 0;
}

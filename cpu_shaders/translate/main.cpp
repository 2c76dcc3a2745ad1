// The build's translator: one shader becomes one C++ file.
//   twinshade-translate --list FILE FOLDER
//     FILE has a line NAME KIND IDENTIFIER CODE_OF for each shader, which becomes FOLDER/IDENTIFIER.cpp. NAME: of
//     lighting/registry.def or lighting/sphere_maps.def. KIND: lightmap, vertex or volume (the technique's fragment
//     shader with that coefficient storage), basis_values, basis_irradiance, map_taps or map_direction (for the host).
//     CODE_OF: NAME, or another one of that kind whose GLSL is the same but for the name; its entries then serve both.
//   twinshade-translate FILE.frag [-I FOLDER]... [-D NAME[=VALUE]]... [--name IDENTIFIER] [--readable] -o OUT.cpp
//                       [--header FOLDER --isas ISA,...] [--depfile OUT.d]
//     --header: IDENTIFIER.h and IDENTIFIER_calls.cpp, typed C++ (cpu_shaders/package/cpp_header.h). --depfile: the
//     files that were read, as make and ninja want to know them.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "cpu_shaders/package/cpp_header.h"
#include "cpu_shaders/package/reserved_names.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"
#include "lighting/sphere_maps.h"

using namespace twinshade;

namespace {

constexpr const char* kUsage =
    "usage: twinshade-translate --list FILE FOLDER\n"
    "       twinshade-translate FILE.frag [-I FOLDER]... [-D NAME[=VALUE]]... [--name IDENTIFIER] [--readable] -o "
    "OUT.cpp\n"
    "                           [--header FOLDER --isas ISA,...] [--depfile OUT.d]";

struct Job {
  ShaderSource source;
  TranslateOptions options;
  std::string output;
  std::string header_folder, depfile;
  std::vector<std::string> isas{"baseline"};
};

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts{""};
  for (char c : list) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

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
  std::vector<std::string> names;
  SourceOptions options;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const auto value = [&] {
      if (k + 1 == arguments.size()) throw UserError(arguments[k] + " wants a value\n" + kUsage);
      return arguments[++k];
    };
    if (arguments[k] == "-I")
      options.include_folders.push_back(value());
    else if (arguments[k] == "-D")
      options.defines.push_back(value());
    else if (arguments[k] == "-o")
      job.output = value();
    else if (arguments[k] == "--name")
      job.options.identifier = value();
    else if (arguments[k] == "--readable")
      job.options.readable = true;
    else if (arguments[k] == "--header")
      job.header_folder = value();
    else if (arguments[k] == "--isas")
      job.isas = split(value());
    else if (arguments[k] == "--depfile")
      job.depfile = value();
    else
      names.push_back(arguments[k]);
  }
  if (names.size() != 1 || job.output.empty()) throw UserError(kUsage);
  const std::string& identifier = job.options.identifier;
  if (!identifier.empty() && identifier != identifier_from(identifier))
    throw UserError("--name " + identifier + ": no C++ identifier; " + identifier_from(identifier) + " would be one");
  for (const std::string& folder : options.include_folders) require_include_folder(folder);
  job.source = load_shader(names[0], options);
  return job;
}

// That `name` says the same as `other`, the name aside.
void require_same_code(const ShaderSource& source, const std::string& name, const std::string& other,
                       const std::string& kind) {
  std::string text = source.text;
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + other.size()))
    text.replace(at, name.size(), other);
  if (text != builtin_source(other, kind).text)
    throw UserError("the GLSL of " + name + " (" + kind + ") is not that of " + other +
                    ", whose code should serve both");
}

// The built-in shaders of a list.
std::vector<Job> jobs_of(const std::string& list, const std::string& folder) {
  std::vector<Job> jobs;
  std::istringstream lines(read_file(list));
  for (std::string name, kind, identifier, code_of; lines >> name >> kind >> identifier >> code_of;) {
    Job& job = jobs.emplace_back();
    job.source = builtin_source(name, kind);
    job.options.code_elsewhere = code_of != name;
    if (job.options.code_elsewhere) require_same_code(job.source, name, code_of, kind);
    job.output = (std::filesystem::path(folder) / (identifier + ".cpp")).string();
    job.options.identifier = std::move(identifier);
  }
  return jobs;
}

// An unchanged file keeps its time, so that a changed shader recompiles only itself. Not with a depfile: the build tool
// then compares the times itself.
bool has_content(const std::string& path, const std::string& content) {
  try {
    return read_file(path) == content;
  } catch (const UserError&) {
    return false;
  }
}

// The shader with its header; returns what `translate` does.
Translation write_typed_cpp(const Job& job) {
  const std::string name = job.options.identifier.empty() ? identifier_from(job.source.name) : job.options.identifier;
  if (const std::string refusal = header_name_refusal(name); !refusal.empty())
    throw UserError(job.source.files[0] + ": " + name + " cannot name a header and its namespace: " + refusal +
                    "; give another NAME (--name)");
  TranslateOptions options = job.options;
  options.identifier = package_identifier(name, job.source, job.isas);
  Translation translation = translate(job.source, options);
  const CppHeader typed = cpp_header(name, translation, job.source, job.isas);
  const std::filesystem::path folder(job.header_folder);
  write_file((folder / (name + ".h")).string(), typed.header);
  write_file((folder / (name + "_calls.cpp")).string(), typed.calls);
  return translation;
}

void append_escaped(std::string& text, const std::string& path) {
  for (char c : path) {
    if (c == ' ' || c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
}

std::string depfile_of(const Job& job) {
  std::string text;
  append_escaped(text, job.output);
  text += ':';
  for (const std::string& file : job.source.files) {
    if (!std::filesystem::exists(file)) continue;  // it is in this binary
    text += ' ';
    append_escaped(text, file);
  }
  return text + '\n';
}

void run(const Job& job) {
  const Translation translation = job.header_folder.empty() ? translate(job.source, job.options) : write_typed_cpp(job);
  if (!job.depfile.empty()) write_file(job.depfile, depfile_of(job));
  if (!job.depfile.empty() || !has_content(job.output, translation.cpp)) write_file(job.output, translation.cpp);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (words.size() == 3 && words[0] == "--list") {
      const std::vector<Job> jobs = jobs_of(words[1], words[2]);
      parallel_for(jobs.size(), [&](std::size_t k, int) { run(jobs[k]); });
    } else {
      run(job_of(words));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "twinshade-translate: %s\n", error.what());
    return 2;
  }
  return 0;
}

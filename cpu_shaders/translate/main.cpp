// The build's translator: one built-in shader becomes one C++ file.
//   twinshade-translate NAME KIND IDENTIFIER OUT.cpp
// NAME: of lighting/registry.def. KIND: lightmap or vertex (the technique's fragment shader with that coefficient
// storage), or basis_values (the basis' functions at a direction, for the host).
#include <cstdio>
#include <exception>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/translate/translate.h"
#include "lighting/registry.h"

using namespace twinshade;

namespace {

ShaderSource source_of(const std::string& name, const std::string& kind) {
  const TechniqueInfo& technique = find_technique(name);
  if (kind == "basis_values") return basis_values_source(technique);
  if (kind == "lightmap") return technique_source(technique, CoefficientStorage::lightmap);
  if (kind == "vertex") return technique_source(technique, CoefficientStorage::vertex);
  throw UserError("unknown kind " + kind + "; name lightmap, vertex or basis_values");
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

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: twinshade-translate NAME KIND IDENTIFIER OUT.cpp\n", stderr);
    return 2;
  }
  try {
    TranslateOptions options;
    options.identifier = argv[3];
    const std::string cpp = translate(source_of(argv[1], argv[2]), options).cpp;
    if (!has_content(argv[4], cpp)) write_file(argv[4], cpp);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "twinshade-translate: %s\n", error.what());
    return 2;
  }
  return 0;
}

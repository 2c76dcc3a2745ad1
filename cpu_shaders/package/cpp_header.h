// Typed C++ for a translated shader: a header with structs of its uniforms, inputs and outputs and the calls, and the
// calls' definitions. docs/cpp-package.md shows both from the user's side.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {

struct CppHeader {
  std::string header;  // everything is in a namespace named translation.identifier
  std::string calls;   // includes "<identifier>.h"
};

// source: what was translated; members come in the order of its declarations. isas: names of the instruction sets that
// the translation is compiled for, "baseline" among them.
CppHeader cpp_header(const Translation& translation, const ShaderSource& source, const std::vector<std::string>& isas);

}  // namespace twinshade

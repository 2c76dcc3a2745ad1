// Typed C++ for a translated shader: a header with structs of its uniforms, inputs and outputs and the calls, and the
// calls' definitions. docs/cpp-package.md shows both from the user's side.
#pragma once

#include <string>
#include <vector>

#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {

struct CppHeader {
  std::string header;  // everything is in a namespace `name`
  std::string calls;   // includes "<name>.h"
};

// What a packaged translation is to be made with as TranslateOptions::identifier: `name` and a hash of all that its
// code comes from. Shaders of one name, of two libraries say, can then be linked into one program; where they are the
// same shader, whichever the linker takes will do.
std::string package_identifier(const std::string& name, const ShaderSource& source,
                               const std::vector<std::string>& isas);

// translation: with package_identifier(). source: what was translated; members come in the order of its declarations.
// isas: names of the instruction sets that the translation is compiled for, "baseline" among them. UserError for a
// compute shader: its work groups are not calls with inputs and outputs.
CppHeader cpp_header(const std::string& name, const Translation& translation, const ShaderSource& source,
                     const std::vector<std::string>& isas);

}  // namespace twinshade

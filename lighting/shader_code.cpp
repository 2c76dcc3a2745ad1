#include "lighting/shader_code.h"

#include "cpu_shaders/source/directive_scan.h"

namespace twinshade {

std::string code_of(const std::string& text) {
  std::string code;
  for (const SourceLine& line : scan_lines(text))
    if (line.directive != "line") code += line.code + "\n";
  return code;
}

}  // namespace twinshade

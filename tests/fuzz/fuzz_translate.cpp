// libFuzzer: any bytes as GLSL. Translated, linted, prepared for drivers, or refused with a UserError: nothing else.
#include <string>

#include "base/error.h"
#include "cpu_shaders/lint/lint.h"
#include "cpu_shaders/translate/translate.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace twinshade;
  try {
    const ShaderSource source =
        resolve_shader("fuzz", std::string(reinterpret_cast<const char*>(data), size), "fuzz.frag");
    gl_text(source, "#version 450", "");
    translate(source);
    lint(source);
  } catch (const UserError&) {
  }
  return 0;
}

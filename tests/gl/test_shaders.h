// Shader sources from strings, and the text of what a call throws.
#pragma once

#include <stdexcept>
#include <string>

#include "cpu_shaders/shader_source.h"

namespace twinshade::test {

inline ShaderSource shader(const std::string& text) { return resolve_shader("test", text, "test.frag"); }

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace twinshade::test

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

#include <sstream>

#include "base/error.h"
#include "raster/gl/glsl_tokens.h"

namespace twinshade::gl {
namespace {

struct GlslangProcess {
  GlslangProcess() { glslang::InitializeProcess(); }
  ~GlslangProcess() { glslang::FinalizeProcess(); }
};

// The extension for #line with a file name, which resolve_shader writes, goes right behind the author's #version.
std::string with_line_extension(const ShaderSource& source) {
  const std::string extension = "#extension GL_GOOGLE_cpp_style_line_directive : enable\n";
  if (source.text.compare(0, 8, "#version") != 0) return "#version 450\n" + extension + source.text;
  const std::size_t end = source.text.find('\n');
  if (end == std::string::npos) return source.text + "\n" + extension;
  return source.text.substr(0, end + 1) + extension + source.text.substr(end + 1);
}

std::string first_error(const std::string& log) {
  std::istringstream lines(log);
  const std::string mark = "ERROR: ";
  for (std::string line; std::getline(lines, line);)
    if (line.compare(0, mark.size(), mark) == 0) return line.substr(mark.size());
  return log;
}

}  // namespace

std::string preprocess(const ShaderSource& source) {
  static const GlslangProcess process;
  const std::string text = with_line_extension(source);
  const char* strings[] = {text.c_str()};
  glslang::TShader shader(EShLangFragment);
  shader.setStrings(strings, 1);
  // glslang makes no SPIR-V from ES 300, and its preprocessor refuses to begin: there it goes without.
  const bool spirv = !source.es || source.version >= 310;
  if (spirv) {
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangFragment, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
  }
  glslang::TShader::ForbidIncluder no_includes;
  std::string result;
  const auto messages = spirv ? EShMessages(EShMsgSpvRules | EShMsgDebugInfo) : EShMsgDefault;
  if (!shader.preprocess(GetDefaultResources(), 450, ENoProfile, false, false, messages, &result, no_includes))
    throw UserError(first_error(shader.getInfoLog()));
  return result;
}

}  // namespace twinshade::gl

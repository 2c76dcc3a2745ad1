#include "cpu_shaders/source/glslang_environment.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "cpu_shaders/source/glslang_built_ins.h"
#include "cpu_shaders/source/line_names.h"

namespace twinshade {
namespace {

constexpr int kLatest = 450;

// With the reason or a remedy where glslang gives none.
std::string explained(const std::string& message) {
  for (const char* layout : {"packed", "shared"})
    if (message.find("'" + std::string(layout) + "' : not allowed when") != std::string::npos)
      return message + " (the layout of such a block is the driver's choice: write layout(std140))";
  if (message.find("memory exhausted") != std::string::npos)
    return message + " (glslang's parser: nested too deep, or a chain too long; split it)";
  for (const char* output : {"gl_FragColor", "gl_FragData"})
    if (message.find("'" + std::string(output) + "' : undeclared") != std::string::npos)
      return message + " (of old GLSL: declare an output: out vec4 color;)";
  static const std::regex no_function(R"('(\w+)' : no matching overloaded function found)");
  std::smatch match;
  const bool left_out = std::regex_search(message, match, no_function) && is_left_out(match[1].str());
  return !left_out
             ? message
             : match.prefix().str() + match.str() + " (of extensions none is translated: write it in other terms)";
}

// Below 420, where glslang refuses a backslash that continues a line: joined, and as many lines after it empty.
std::string with_joined_lines(const std::string& text) {
  std::string joined;
  std::size_t from = 0, continued = 0;
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n', from)) {
    const bool continues = end > from && text[end - 1] == '\\';
    joined.append(text, from, end - from - (continues ? 1 : 0));
    from = end + 1;
    if (continues) {
      ++continued;
      continue;
    }
    joined.append(continued + 1, '\n');
    continued = 0;
  }
  return joined.append(text, from, text.npos);
}

}  // namespace

void start_glslang() {
  struct Process {
    Process() { glslang::InitializeProcess(); }
    ~Process() { glslang::FinalizeProcess(); }
  };
  static const Process process;
}

EShMessages set_opengl_environment(glslang::TShader& shader, EShLanguage stage) {
  shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientOpenGL, 100);
  shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
  return static_cast<EShMessages>(EShMsgSpvRules | EShMsgDebugInfo);
}

std::vector<int> glslang_versions(const ShaderSource& source) {
  if (source.es) return {std::max(source.version, 310)};
  if (source.version < kLatest) return {source.version, kLatest};
  return {source.version};
}

std::string glslang_text(const ShaderSource& source, int version) {
  std::string text = source.text;
  if (!source.es && version < 420) text = with_joined_lines(text);
  const bool has_version = text.rfind("#version", 0) == 0;
  const std::size_t end = has_version ? text.find('\n') : 0;
  const std::size_t after = !has_version ? 0 : end == std::string::npos ? text.size() : end + 1;
  return "#version " + std::to_string(version) + (source.es ? " es\n" : "\n") +
         "#extension GL_GOOGLE_cpp_style_line_directive : require\n" + text.substr(after);
}

// Lines of the log read `ERROR: file:line: 'token' : message`.
std::string first_glslang_error(const ShaderSource& source, const char* log) {
  std::istringstream lines(log);
  static const std::regex with_position(R"(^(?:ERROR|WARNING): (.*):(\d+): (.*)$)");
  std::string line, fallback;
  while (std::getline(lines, line)) {
    line.erase(line.find_last_not_of(' ') + 1);  // glslang leaves one where it has no more to say
    if (line.rfind("ERROR: ", 0) != 0) continue;
    std::smatch match;
    if (std::regex_match(line, match, with_position)) {
      // A number is the author's, of a #line as drivers have it.
      std::string file = with_real_names(source.files, match[1]);
      if (file.find_first_not_of("0123456789") == std::string::npos) file = source.files.at(0);
      return file + ":" + match[2].str() + ": " + explained(match[3].str());
    }
    if (fallback.empty()) fallback = source.files.at(0) + ": " + line.substr(7);
  }
  return fallback.empty() ? source.files.at(0) + ": glslang refused the shader: " + log : fallback;
}

}  // namespace twinshade

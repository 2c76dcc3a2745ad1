#include "cpu_shaders/source/glslang_environment.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>

#include "cpu_shaders/source/glslang_built_ins.h"
#include "cpu_shaders/source/line_names.h"

namespace twinshade {
namespace {

constexpr int kLatest = 450;

struct Remedy {
  std::string_view of, remedy;
};

// By what stands in a message.
constexpr Remedy kRemedies[] = {
    {"'packed' : not allowed when", "the layout of such a block is the driver's choice: write layout(std140)"},
    {"'shared' : not allowed when", "the layout of such a block is the driver's choice: write layout(std140)"},
    {"memory exhausted", "glslang's parser: nested too deep, or a chain too long; split it"},
    {"'gl_FragColor' : undeclared", "of old GLSL: declare an output: out vec4 color;"},
    {"'gl_FragData' : undeclared", "of old GLSL: declare an output: out vec4 color;"},
    {"'varying' : ", "of old GLSL: write in"},
    {"'attribute' : ", "an input of vertex shaders in old GLSL: write in"},
    {"only allowed when using GLSL for Vulkan", "write sampler2D, an input or a uniform"},
};

// With the reason or a remedy where glslang gives none.
std::string explained(const std::string& message) {
  const auto with = [&](std::string_view remedy) { return message + " (" + std::string(remedy) + ")"; };
  for (const Remedy& known : kRemedies)
    if (message.find(known.of) != message.npos) return with(known.remedy);
  static const std::regex no_function(R"('(\w+)' : no matching overloaded function found)");
  static const std::regex old_texture("(texture|shadow)(1D|2D|3D|Cube)(\\w*)");
  std::smatch match, old;
  if (!std::regex_search(message, match, no_function)) return message;
  const std::string function = match[1].str();
  if (std::regex_match(function, old, old_texture)) return with("of old GLSL: write texture" + old[3].str());
  return is_left_out(function) ? with("of extensions none is translated: write it in other terms") : message;
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

#include "cpu_shaders/source/glslang_environment.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

// Versions that mean what 450 means and whose tables are read faster, in a third and in half of the time. Three things
// that 400 lacks are extensions without functions, all part of 430. Where 400 still does not accept something, 440 may.
constexpr int kSmallestTable = 400, kSmallTable = 440, kLatest = 450, kHasTheExtensions = 430;
constexpr const char* kExtensionsOfSmallest =
    "#extension GL_ARB_shading_language_420pack : enable\n"
    "#extension GL_ARB_separate_shader_objects : enable\n"
    "#extension GL_ARB_explicit_uniform_location : enable\n";
// What 400 takes for names though they became keywords, or is sure to refuse: compute shaders, storage blocks, arrays
// of arrays, packing of halves.
constexpr const char* kNotOfSmallest[] = {"buffer",    "shared",      "coherent",   "restrict", "readonly",
                                          "writeonly", "atomic_uint", "local_size", "][",       "Half2x16"};
// What core profiles have had no more since 420.
constexpr const char* kGoneSince420[] = {"varying", "attribute", "gl_FragColor", "gl_FragData"};
constexpr const char* kOldTextureFunctions[] = {"texture1D",   "texture2D", "texture3D",
                                                "textureCube", "shadow1D",  "shadow2D"};

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
  const auto mentions = [&](const char* text) { return source.text.find(text) != std::string::npos; };
  const bool can_tell = mentions("__VERSION__") || mentions("GL_");
  std::vector<int> versions;
  if (source.version >= kHasTheExtensions && !can_tell &&
      std::none_of(std::begin(kNotOfSmallest), std::end(kNotOfSmallest), mentions) &&
      std::none_of(std::begin(kOldTextureFunctions), std::end(kOldTextureFunctions), mentions) &&
      std::none_of(std::begin(kGoneSince420), std::end(kGoneSince420),
                   [&](const char* word) { return find_word(source.text, word) != std::string::npos; }))
    versions.push_back(kSmallestTable);
  if (source.version > kSmallTable && !can_tell) versions.push_back(kSmallTable);
  versions.push_back(source.version);
  if (source.version < kLatest) versions.push_back(kLatest);
  return versions;
}

std::string glslang_text(const ShaderSource& source, int version) {
  const std::string& text = source.text;
  const bool has_version = text.rfind("#version", 0) == 0;
  const std::size_t end = has_version ? text.find('\n') : 0;
  const std::size_t after = !has_version ? 0 : end == std::string::npos ? text.size() : end + 1;
  return "#version " + std::to_string(version) + (source.es ? " es\n" : "\n") +
         (!source.es && version < source.version ? kExtensionsOfSmallest : "") +
         "#extension GL_GOOGLE_cpp_style_line_directive : require\n" + text.substr(after);
}

// Lines of the log read `ERROR: file:line: 'token' : message`.
std::string first_glslang_error(const ShaderSource& source, const char* log) {
  std::istringstream lines(log);
  static const std::regex with_position(R"(^(?:ERROR|WARNING): (.*):(\d+): (.*)$)");
  std::string line, fallback;
  while (std::getline(lines, line)) {
    if (line.rfind("ERROR: ", 0) != 0) continue;
    std::smatch match;
    if (std::regex_match(line, match, with_position)) {
      const std::string file = match[1].str() == "0" ? source.files.at(0) : match[1].str();
      return file + ":" + match[2].str() + ": " + match[3].str();
    }
    if (fallback.empty()) fallback = source.files.at(0) + ": " + line.substr(7);
  }
  return fallback.empty() ? source.files.at(0) + ": glslang refused the shader: " + log : fallback;
}

}  // namespace twinshade

#include "cpu_shaders/translate/compile_glsl.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <mutex>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "cpu_shaders/translate/find_recursion.h"
#include "cpu_shaders/translate/glslang_trial.h"
#include "cpu_shaders/translate/limits.h"

namespace twinshade {
namespace {

constexpr const char* kLineExtension = "#extension GL_GOOGLE_cpp_style_line_directive : require\n";

// GLSL ES 300 has no SPIR-V: it is checked as what it says it is, then translated as ES 310. Desktop GLSL is read as
// the version that it says it is (`sample` and `buffer` are names there, not keywords), or as 450 where that version
// lacks something that it uses: `precise`, say, which means the same in all.
std::string with_version(const ShaderSource& source, const std::string& version_line) {
  const std::string& text = source.text;
  const bool has_version = text.rfind("#version", 0) == 0;
  const std::size_t after = has_version ? text.find('\n') + 1 : 0;
  return version_line + kLineExtension + text.substr(after);
}

// The first error of glslang's log as "file:line: message". Its lines read `ERROR: file:line: 'token' : message`.
std::string first_error(const ShaderSource& source, const char* log) {
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

struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

std::vector<std::uint32_t> compile(const ShaderSource& source, const std::string& text, bool opengl_client,
                                   bool make_spirv) {
  const EShLanguage stage = source.stage == ShaderStage::compute ? EShLangCompute : EShLangFragment;
  glslang::TShader shader(stage);
  const char* strings[] = {text.c_str()};
  const char* names[] = {source.files.at(0).c_str()};
  const int lengths[] = {static_cast<int>(text.size())};
  shader.setStringsWithLengthsAndNames(strings, lengths, names, 1);
  shader.setAutoMapLocations(true);
  shader.setAutoMapBindings(true);
  EShMessages messages = EShMsgDefault;
  if (opengl_client) {
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgDebugInfo);
  }
  if (!shader.parse(GetDefaultResources(), 110, false, messages))
    throw UserError(first_error(source, shader.getInfoLog()));
  refuse_recursion(*shader.getIntermediate(), source);
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) throw UserError(first_error(source, program.getInfoLog()));
  if (!make_spirv) return {};
  if (!program.mapIO()) throw UserError(first_error(source, program.getInfoLog()));
  const glslang::TIntermediate* tree = program.getIntermediate(stage);
  // Without a body for main there is a tree, but nothing to run.
  if (tree == nullptr || tree->getNumEntryPoints() == 0)
    throw UserError(source.files.at(0) + ": the shader has no main()");
  glslang::SpvOptions options;
  options.generateDebugInfo = true;
  options.disableOptimizer = true;
  options.stripDebugInfo = false;
  std::vector<unsigned int> words;
  spv::SpvBuildLogger logger;
  glslang::GlslangToSpv(*tree, words, &logger, &options);
  const std::string complaints = logger.getAllMessages();
  if (complaints.find("TBD") != std::string::npos || complaints.find("Missing") != std::string::npos)
    throw UserError(source.files.at(0) +
                    ": glslang cannot express this shader in SPIR-V: " + complaints.substr(0, complaints.find('\n')));
  return words;
}

std::vector<std::uint32_t> compile_any_version(const ShaderSource& source) {
  if (source.es) {
    if (source.version < 300)
      throw UserError(source.files.at(0) + ":1: GLSL ES " + std::to_string(source.version) +
                      " is not supported: write #version 300 es");
    if (source.version == 300) compile(source, with_version(source, "#version 300 es\n"), false, false);
    return compile(source, with_version(source, "#version " + std::to_string(std::max(source.version, 310)) + " es\n"),
                   true, true);
  }
  if (source.version < 330)
    throw UserError(source.files.at(0) + ":1: GLSL " + std::to_string(source.version) +
                    " is not supported: write #version 330 or later");
  const auto as_version = [&](int version) {
    return compile(source, with_version(source, "#version " + std::to_string(version) + "\n"), true, true);
  };
  if (source.version >= 450) return as_version(source.version);
  try {
    return as_version(source.version);
  } catch (const UserError& error) {
    try {
      return as_version(450);
    } catch (const UserError&) {
      throw error;
    }
  }
}

}  // namespace

std::vector<std::uint32_t> compile_glsl(const ShaderSource& source) {
  // The library's first use takes long and its tables are shared.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  static const Process process;
  refuse_large_text(source);
  if (looks_hostile(source)) try_in_child(source, [&] { compile_any_version(source); });
  return compile_any_version(source);
}

}  // namespace twinshade

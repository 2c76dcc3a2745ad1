#include "cpu_shaders/translate/compile_glsl.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <exception>
#include <mutex>

#include "base/error.h"
#include "cpu_shaders/source/glslang_environment.h"
#include "cpu_shaders/source/preprocess.h"
#include "cpu_shaders/translate/find_recursion.h"
#include "cpu_shaders/translate/glslang_trial.h"
#include "cpu_shaders/translate/limits.h"

namespace twinshade {
namespace {

// __VERSION__ is what the author's #version says, whatever the shader is read as.
std::string text_as_version(const ShaderSource& source, int version) {
  if (version == source.version || source.text.find("__VERSION__") == std::string::npos)
    return glslang_text(source, version);
  ShaderSource expanded = source;
  expanded.text = preprocess(source);
  return glslang_text(expanded, version);
}

std::vector<std::uint32_t> compile(const ShaderSource& source, int version, bool make_spirv) {
  const std::string text = text_as_version(source, version);
  const EShLanguage stage = source.stage == ShaderStage::compute ? EShLangCompute : EShLangFragment;
  glslang::TShader shader(stage);
  const char* strings[] = {text.c_str()};
  const char* names[] = {source.files.at(0).c_str()};
  const int lengths[] = {static_cast<int>(text.size())};
  shader.setStringsWithLengthsAndNames(strings, lengths, names, 1);
  shader.setAutoMapLocations(true);
  shader.setAutoMapBindings(true);
  const EShMessages messages = make_spirv ? set_opengl_environment(shader, stage) : EShMsgDefault;
  if (!shader.parse(GetDefaultResources(), 110, false, messages))
    throw UserError(first_glslang_error(source, shader.getInfoLog()));
  refuse_recursion(*shader.getIntermediate(), source);
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) throw UserError(first_glslang_error(source, program.getInfoLog()));
  if (!make_spirv) return {};
  if (!program.mapIO()) throw UserError(first_glslang_error(source, program.getInfoLog()));
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

// GLSL ES 300 has no SPIR-V: it is checked as what it says it is, then translated as ES 310. Desktop GLSL older than
// 450 is read as 450 where its version lacks something that it uses: `precise`, say, which means the same in all (but
// `sample` and `buffer` are names there, not keywords).
std::vector<std::uint32_t> compile_any_version(const ShaderSource& source) {
  if (source.version < (source.es ? 300 : 330))
    throw UserError(source.files.at(0) + ":1: GLSL " + (source.es ? "ES " : "") + std::to_string(source.version) +
                    " is not supported: write #version " + (source.es ? "300 es" : "330 or later"));
  if (source.es && source.version == 300) compile(source, 300, false);
  std::exception_ptr complaint;
  for (const int version : glslang_versions(source)) {
    try {
      return compile(source, version, true);
    } catch (const UserError&) {
      if (!complaint || version == source.version) complaint = std::current_exception();
    }
  }
  std::rethrow_exception(complaint);
}

}  // namespace

std::vector<std::uint32_t> compile_glsl(const ShaderSource& source) {
  // The library's first use takes long and its tables are shared.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  start_glslang();
  refuse_large_text(source);
  if (looks_hostile(source)) try_in_child(source, [&] { compile_any_version(source); });
  return compile_any_version(source);
}

}  // namespace twinshade

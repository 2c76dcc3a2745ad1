#include "cpu_shaders/translate/compile_glsl.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <mutex>
#include <regex>

#include "base/error.h"
#include "cpu_shaders/source/glslang_environment.h"
#include "cpu_shaders/source/glslang_trial.h"
#include "cpu_shaders/source/preprocess.h"
#include "cpu_shaders/translate/constant_initializers.h"
#include "cpu_shaders/translate/extra_semicolons.h"
#include "cpu_shaders/translate/find_recursion.h"
#include "cpu_shaders/translate/free_names.h"
#include "cpu_shaders/translate/limits.h"
#include "cpu_shaders/translate/locate_outputs.h"
#include "cpu_shaders/translate/mark_divisions.h"
#include "cpu_shaders/translate/precise_words.h"
#include "cpu_shaders/translate/source_lines.h"

namespace twinshade {
namespace {

// Whether `precise` is a keyword of the version: elsewhere it is refused, or a name.
bool knows_precise(const ShaderSource& source, int version) {
  return version >= 400 || source.text.find("_gpu_shader5") != std::string::npos;
}

// __VERSION__ is what the author's #version says, whatever the shader is read as.
std::string text_as_version(const ShaderSource& source, int version) {
  if (version == source.version || source.text.find("__VERSION__") == std::string::npos)
    return glslang_text(source, version);
  ShaderSource expanded = source;
  expanded.text = preprocess(source);
  return glslang_text(expanded, version);
}

// glslang's log of linking names the function without a body on its next line, and no place.
std::string link_error(const ShaderSource& source, const std::string& log) {
  static const std::regex without_body(R"(No function definition \(body\) found:\s*(\w+)\()");
  std::smatch match;
  if (log.find("Missing entry point") != log.npos) return source.files.at(0) + ": the shader has no main()";
  if (!std::regex_search(log, match, without_body)) return first_glslang_error(source, log.c_str());
  const std::string name = match[1];
  return SourceLines(source).mention({name}).text() + ": " + name + "() is declared and called, but has no body";
}

std::vector<std::uint32_t> compile(const ShaderSource& source, int version, bool make_spirv) {
  std::string text = text_as_version(source, version);
  if (knows_precise(source, version)) text = without_precise(source, std::move(text));
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
  mark_divisions(*shader.getIntermediate());
  locate_outputs(*shader.getIntermediate());
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) throw UserError(link_error(source, program.getInfoLog()));
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

// Of two readings' complaints, "file:line: message" both, the further one is about what neither accepts: a reading ends
// where it meets what only the other has.
bool is_further(const std::string& complaint, const std::string& other) {
  static const std::regex position(R"(^(.*?):(\d+): )");
  std::smatch a, b;
  return std::regex_search(complaint, a, position) && std::regex_search(other, b, position) && a[1] == b[1] &&
         std::stoll(a[2]) > std::stoll(b[2]);
}

// GLSL ES 300 has no SPIR-V: it is checked as what it says it is, then translated as ES 310. Desktop GLSL older than
// 450 is read as 450 where its version lacks something that it uses: `precise`, say, which means the same in all (but
// `sample` and `buffer` are names there, not keywords).
std::vector<std::uint32_t> compile_any_version(const ShaderSource& source) {
  if (source.es && source.version == 300) {
    compile(source, 300, false);
    return compile(source, 310, true);
  }
  std::string complaint;
  for (const int version : glslang_versions(source)) {
    try {
      return compile(source, version, true);
    } catch (const UserError& error) {
      if (complaint.empty() || is_further(error.what(), complaint)) complaint = error.what();
    }
  }
  throw UserError(complaint);
}

// With constants that glslang does not fold computed, where it refuses them.
std::vector<std::uint32_t> compile_with_constants(const ShaderSource& source) {
  try {
    return compile_any_version(source);
  } catch (const UserError& error) {
    ShaderSource computed = source;
    if (is_about_constant_initializer(error.what())) computed.text = with_computed_constants(source.text);
    if (computed.text == source.text) throw;
    try {
      return compile_any_version(computed);
    } catch (const UserError& other) {  // of the size of an array, say, that is no constant now
      if (is_about_constant_initializer(other.what())) throw;
      throw UserError(error.what());
    }
  }
}

// Without empty declarations, where glslang refuses them.
std::vector<std::uint32_t> compile_without_extra_semicolons(const ShaderSource& source) {
  try {
    return compile_with_constants(source);
  } catch (const UserError& error) {
    if (!is_about_extra_semicolon(error.what())) throw;
  }
  ShaderSource without = source;
  without.text = without_extra_semicolons(preprocess(source));
  return compile_with_constants(without);
}

std::vector<std::uint32_t> compile_with_free_names(const ShaderSource& source) {
  ShaderSource free = source;
  free.text = source.es ? with_free_names_of_es(source) : with_free_functions(source);
  free.text = with_free_members(free);
  try {
    std::vector<std::uint32_t> words = compile_without_extra_semicolons(free);
    drop_endings(words);
    return words;
  } catch (const UserError& error) {
    throw UserError(without_endings(error.what()));
  }
}

}  // namespace

std::vector<std::uint32_t> compile_glsl(const ShaderSource& source) {
  // The library's first use takes long and its tables are shared.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  start_glslang();
  refuse_large_text(source);
  if (looks_hostile(source) ||
      may_lose_itself(knows_precise(source, source.version) ? without_precise(source, source.text) : source.text))
    try_in_child(source, [&] { compile_with_free_names(source); });
  return compile_with_free_names(source);
}

}  // namespace twinshade

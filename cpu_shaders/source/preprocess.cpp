#include "cpu_shaders/source/preprocess.h"

#include <glslang/Public/ResourceLimits.h>

#include <mutex>

#include "base/error.h"
#include "cpu_shaders/source/glslang_environment.h"
#include "cpu_shaders/source/glslang_trial.h"

namespace twinshade {

namespace {

std::mutex mutex;

std::string preprocess_as(const ShaderSource& source, int version) {
  const std::string text = glslang_text(source, version);
  constexpr EShLanguage kStage = EShLangFragment;  // of any version, and all the same to the preprocessor
  glslang::TShader shader(kStage);
  const char* strings[] = {text.c_str()};
  const char* names[] = {source.files.at(0).c_str()};
  const int lengths[] = {static_cast<int>(text.size())};
  shader.setStringsWithLengthsAndNames(strings, lengths, names, 1);
  // glslang makes no SPIR-V from ES 300, and its preprocessor refuses to begin: there it goes without.
  const bool spirv = !source.es || version >= 310;
  const EShMessages messages = spirv ? set_opengl_environment(shader, kStage) : EShMsgDefault;
  glslang::TShader::ForbidIncluder no_includes;
  std::string result;
  if (!shader.preprocess(GetDefaultResources(), version, source.es ? EEsProfile : ENoProfile, false, false, messages,
                         &result, no_includes))
    throw UserError(first_glslang_error(source, shader.getInfoLog()));
  return result;
}

std::string preprocess_locked(const ShaderSource& source) {
  start_glslang();
  return preprocess_as(source, source.version);
}

}  // namespace

std::string preprocess(const ShaderSource& source) {
  const std::lock_guard<std::mutex> lock(mutex);
  return preprocess_locked(source);
}

std::string preprocess_untried(const ShaderSource& source) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (looks_hostile(source)) try_in_child(source, [&] { preprocess_locked(source); });
  return preprocess_locked(source);
}

}  // namespace twinshade

#include "cpu_shaders/translate/translate.h"

#include <cctype>

#include "cpu_shaders/translate/compile_glsl.h"
#include "cpu_shaders/translate/emit_module.h"
#include "cpu_shaders/translate/limits.h"

namespace twinshade {
namespace {

void plant(spirv::Module& module, const std::pair<std::uint32_t, std::uint32_t>& bug) {
  for (spirv::Function& function : module.functions)
    for (spirv::Block& block : function.blocks)
      for (spirv::Instruction& i : block.code)
        if (i.op == bug.first) i.op = static_cast<spv::Op>(bug.second);
}

}  // namespace

std::string identifier_from(const std::string& name) {
  std::string id;
  for (char c : name) id += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (id.empty() || std::isdigit(static_cast<unsigned char>(id[0]))) id.insert(0, "s");
  return id;
}

Translation translate(const ShaderSource& source, const TranslateOptions& options) {
  Translation translation;
  translation.identifier = options.identifier.empty() ? identifier_from(source.name) : options.identifier;
  const SourceLines lines(source);
  spirv::Module module = spirv::parse(compile_glsl(source), lines);
  if (options.planted_bug) plant(module, *options.planted_bug);
  const spirv::Program program = spirv::analyse(std::move(module));
  refuse_large_variables(program, lines);
  spirv::NameTable names;
  spirv::Interface interface = spirv::describe_interface(program, lines, names);
  spirv::emit_module(program, interface, lines, names, source, options, translation);
  return translation;
}

}  // namespace twinshade

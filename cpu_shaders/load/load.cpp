#include "cpu_shaders/load/load.h"

#include <map>
#include <mutex>
#include <tuple>

#include "base/error.h"
#include "cpu_shaders/load/open.h"
#include "cpu_shaders/load/source_index.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

bool has_entry(const ShaderModule& module, Isa isa, Number number) {
  for (std::uint32_t i = 0; i < module.entry_count; ++i)
    if (module.entries[i].isa == isa && module.entries[i].number == number) return true;
  return false;
}

}  // namespace

// Sixteen lanes asked for on a machine with registers of eight mean eight, unless an instruction set was named.
CodeTarget code_target(Number number, std::optional<Isa> isa) {
  if (isa) require_isa(*isa);
  const Isa most = isa.value_or(machine_isa());
  if (!isa && number == Number::lanes16 && most == Isa::avx2) number = Number::lanes8;
  if (number == Number::lanes16 && most == Isa::avx512) return {Isa::avx512, number};
  if (number == Number::lanes8 && most >= Isa::avx2) return {Isa::avx2, number};
  return {Isa::baseline, number};
}

const ShaderModule& load_module_with_lines(const ShaderSource& source, Number number, std::optional<Isa> isa) {
  const CodeTarget target = code_target(number, isa);
  const CompileOptions options{target.isa, 1u << int(target.number), 2, {}, true};
  return open_module(compile_shader(translate(source).cpp, options), kModuleSymbol);
}

const ShaderModule& load_module(const ShaderSource& source, Number number, std::optional<Isa> isa) {
  const auto [build_isa, build_number] = code_target(number, isa);
  if (const ShaderModule* builtin = find_builtin_module(source);
      builtin && has_entry(*builtin, build_isa, build_number))
    return *builtin;

  static std::mutex mutex;
  static std::map<std::tuple<std::string, Isa, Number>, const ShaderModule*> loaded;
  const std::lock_guard lock(mutex);
  const ShaderModule*& module = loaded[{source_hash(source), build_isa, build_number}];
  if (!module) {
    const CompileOptions options{build_isa, 1u << int(build_number), 2, {}};
    const IndexedSource indexed(source, options);
    std::string object = indexed.find();
    if (object.empty()) {
      object = compile_shader(translate(source).cpp, options);
      indexed.remember(object);
    }
    const ShaderModule& opened = open_module(object, kModuleSymbol);
    if (number == Number::float64 && opened.no_float64_reason)
      throw UserError(std::string(opened.no_float64_reason) + ": cannot be evaluated in double");
    module = &opened;
  }
  return *module;
}

}  // namespace twinshade

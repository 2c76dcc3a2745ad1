#include "cpu_shaders/load/load.h"

#include <dlfcn.h>

#include <map>
#include <mutex>
#include <tuple>

#include "base/error.h"
#include "cpu_shaders/runtime/machine.h"
#include "cpu_shaders/translate/translate.h"

namespace twinshade {
namespace {

constexpr const char* kIsaNames[] = {"baseline", "avx2", "avx512"};

// What to build for a number type: the instruction set whose registers hold its lanes, as far as allowed. Sixteen lanes
// asked for on a machine with registers of eight mean eight, unless an instruction set was named.
std::pair<Isa, Number> target_of(Number number, std::optional<Isa> isa) {
  const Isa most = isa.value_or(machine_isa());
  if (!isa && number == Number::lanes16 && most == Isa::avx2) number = Number::lanes8;
  if (number == Number::lanes16 && most == Isa::avx512) return {Isa::avx512, number};
  if (number == Number::lanes8 && most >= Isa::avx2) return {Isa::avx2, number};
  return {Isa::baseline, number};
}

bool has_entry(const ShaderModule& module, Isa isa, Number number) {
  for (std::uint32_t i = 0; i < module.entry_count; ++i)
    if (module.entries[i].isa == isa && module.entries[i].number == number) return true;
  return false;
}

const ShaderModule& open_module(const std::string& path) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw UserError(path + ": compiled shader cannot be loaded: " + dlerror());
  const auto* module = static_cast<const ShaderModule*>(dlsym(library, kModuleSymbol));
  if (!module) throw UserError(path + ": compiled shader has no symbol " + kModuleSymbol + "; remove the file");
  TWINSHADE_CHECK_EQ(module->abi_version, kAbiVersion);
  return *module;
}

}  // namespace

const ShaderModule& load_module(const ShaderSource& source, Number number, std::optional<Isa> isa) {
  const Isa machine = machine_isa();
  if (isa && *isa > machine)
    throw UserError(std::string("this processor has no ") + kIsaNames[int(*isa)] + ": the best it has is " +
                    kIsaNames[int(machine)]);
  const auto [build_isa, build_number] = target_of(number, isa);
  if (const ShaderModule* builtin = find_builtin_module(source); builtin && has_entry(*builtin, build_isa, build_number))
    return *builtin;

  static std::mutex mutex;
  static std::map<std::tuple<std::string, Isa, Number>, const ShaderModule*> loaded;
  const std::lock_guard lock(mutex);
  const ShaderModule*& module = loaded[{source_hash(source), build_isa, build_number}];
  if (!module) {
    const Translation translation = translate(source);
    if (number == Number::float64 && !translation.reflection.no_float64_reason.empty())
      throw UserError(translation.reflection.no_float64_reason + ": cannot be evaluated in double");
    module = &open_module(compile_shader(translation.cpp, build_isa, build_number));
  }
  return *module;
}

}  // namespace twinshade

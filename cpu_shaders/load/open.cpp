#include "cpu_shaders/load/open.h"

#include <dlfcn.h>

#include "base/error.h"

namespace twinshade {

const ShaderModule& open_module(const std::string& path, const std::string& symbol) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw UserError(path + ": compiled shader cannot be loaded: " + dlerror());
  const auto* module = static_cast<const ShaderModule*>(dlsym(library, symbol.c_str()));
  if (!module) throw UserError(path + ": compiled shader has no symbol " + symbol + "; remove the file");
  TWINSHADE_CHECK_EQ(module->abi_version, kAbiVersion);
  return *module;
}

}  // namespace twinshade

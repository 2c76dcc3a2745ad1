#include "cpu_shaders/load/open.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/error.h"

namespace twinshade {
namespace {

// The cache would give it again and again.
[[noreturn]] void refuse_object(const std::string& path, const std::string& reason) {
  std::error_code code;
  const bool removed = std::filesystem::remove(path, code);
  throw UserError(
      path + ": compiled shader " + reason + (removed ? "; it was removed" : "; remove it") +
      "; set CXX to a C++ compiler that works, or TWINSHADE_CACHE to a folder that programs may be loaded from");
}

}  // namespace

const ShaderModule& open_module(const std::string& path, const std::string& symbol) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) refuse_object(path, std::string("cannot be loaded: ") + dlerror());
  const auto* module = static_cast<const ShaderModule*>(dlsym(library, symbol.c_str()));
  if (!module) refuse_object(path, "has no symbol " + symbol);
  TWINSHADE_CHECK_EQ(module->abi_version, kAbiVersion);
  return *module;
}

}  // namespace twinshade

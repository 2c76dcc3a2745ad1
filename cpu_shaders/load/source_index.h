// Which object a shader's source became: one that was compiled before is not even translated again.
#pragma once

#include <string>
#include <string_view>

#include "cpu_shaders/load/load.h"

namespace twinshade {

// SHA-256 over `content` and all that makes an object of it: options, compiler, runtime, the ABI among its headers.
std::string object_key(std::string_view content, const CompileOptions& options);

// By source, options, and the program that translated: another build of this one may translate differently.
class IndexedSource {
 public:
  IndexedSource(const ShaderSource& source, const CompileOptions& options);
  // Path of a whole object; empty where it is not known or has gone.
  std::string find() const;
  // A cache that cannot be written is left as it is.
  void remember(const std::string& object) const;

 private:
  std::string path_;
};

}  // namespace twinshade

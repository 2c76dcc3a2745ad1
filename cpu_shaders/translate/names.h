// Names in generated C++: GLSL's own wherever they are free.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace twinshade::spirv {

class NameTable {
 public:
  NameTable();
  void open() { scopes_.emplace_back(); }
  void close() { scopes_.pop_back(); }
  // `wanted`, or `wanted` with a suffix if a keyword, the runtime or an open scope has it already, or a macro may.
  std::string declare(const std::string& wanted);
  // The same for a name that the translator makes: no macro has it, and it may begin as aliases of uniform types do.
  std::string declare_own(const std::string& wanted);

 private:
  bool taken(const std::string& name) const;
  std::vector<std::set<std::string>> scopes_;
};

}  // namespace twinshade::spirv

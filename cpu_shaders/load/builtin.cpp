// The built-in modules by source hash, with the entries of every instruction set joined.
#include "cpu_shaders/load/builtin.h"

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "cpu_shaders/load/load.h"

namespace twinshade {
namespace {

struct Joined {
  ShaderModule module;
  std::vector<ShaderEntry> entries;
};

std::map<std::string, const ShaderModule*> join_all() {
  static std::deque<Joined> joined;  // addresses stay
  std::map<std::string, const ShaderModule*> by_hash;
  for (const BuiltinModule& builtin : builtin_modules()) {
    Joined& one = joined.emplace_back(Joined{*builtin.module, {}});
    for (const BuiltinEntries& part : builtin.parts)
      one.entries.insert(one.entries.end(), part.entries, part.entries + part.count);
    one.module.entries = one.entries.data();
    one.module.entry_count = std::uint32_t(one.entries.size());
    by_hash.emplace(one.module.source_hash, &one.module);
  }
  return by_hash;
}

}  // namespace

const ShaderModule* find_builtin_module(const ShaderSource& source) {
  static const std::map<std::string, const ShaderModule*> by_hash = join_all();
  const auto found = by_hash.find(source_hash(source));
  return found == by_hash.end() ? nullptr : found->second;
}

}  // namespace twinshade

#include <cstdio>
#include <cstdlib>

#include "cpu_shaders/machine.h"
#include "cpu_shaders/package/call.h"

namespace twinshade::package {

ShadeFunction find_entry(std::initializer_list<EntryList> lists, Number number) {
  for (const EntryList& list : lists)
    for (std::uint32_t i = 0; i < list.count; ++i)
      if (list.entries[i].isa == Isa::baseline && list.entries[i].number == number) return list.entries[i].shade;
  std::fputs("twinshade: a shader was compiled without the number type that its header calls\n", stderr);
  std::abort();
}

ShadeFunction widest_entry(std::initializer_list<EntryList> lists) {
  const Isa machine = machine_isa();
  const ShaderEntry* widest = nullptr;
  for (const EntryList& list : lists)
    for (std::uint32_t i = 0; i < list.count; ++i) {
      const ShaderEntry& entry = list.entries[i];
      const bool lanes =
          entry.number == Number::lanes4 || entry.number == Number::lanes8 || entry.number == Number::lanes16;
      if (lanes && entry.isa <= machine && (!widest || entry.isa > widest->isa)) widest = &entry;
    }
  return widest ? widest->shade : find_entry(lists, Number::scalar);
}

}  // namespace twinshade::package

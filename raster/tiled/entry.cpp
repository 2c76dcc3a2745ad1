#include "raster/tiled/entry.h"

#include <string>

#include "base/error.h"
#include "cpu_shaders/machine.h"

namespace twinshade::tiled {
namespace {

const ShaderEntry* find_entry(const ShaderModule& module, Number number, Isa most) {
  const ShaderEntry* best = nullptr;
  for (std::uint32_t i = 0; i < module.entry_count; ++i) {
    const ShaderEntry& entry = module.entries[i];
    if (entry.number == number && entry.isa <= most && (!best || entry.isa > best->isa)) best = &entry;
  }
  return best;
}

}  // namespace

const char* isa_name(Isa isa) { return kIsaNames[int(isa)]; }

const char* number_name(Number number) {
  static constexpr const char* kNames[] = {"lanes4", "lanes8", "lanes16", "scalar", "float64"};
  return kNames[int(number)];
}

const ShaderEntry& choose_entry(const ShaderModule& module, Number number, std::optional<Isa> isa) {
  const Isa machine = machine_isa();
  if (isa) require_isa(*isa);
  const ShaderEntry* entry = find_entry(module, number, isa.value_or(machine));
  if (!isa && number == Number::lanes16)
    for (const Number fewer : {Number::lanes8, Number::lanes4}) {
      const ShaderEntry* natural = find_entry(module, fewer, machine);
      if (natural && (!entry || natural->isa > entry->isa)) entry = natural;
    }
  if (entry) return *entry;
  std::string reason = std::string("shader \"") + module.name + "\" has no code for " + number_name(number);
  if (isa) reason += std::string(" on ") + isa_name(*isa);
  if (number == Number::float64 && module.no_float64_reason) reason += std::string(": ") + module.no_float64_reason;
  throw UserError(reason);
}

}  // namespace twinshade::tiled

// C++ types and constants for SPIR-V's: F, vec3, uniform_mat4, arr<vec3, 4>, structs.
#pragma once

#include <map>
#include <set>

#include "cpu_shaders/translate/names.h"
#include "cpu_shaders/translate/spirv_module.h"
#include "cpu_shaders/translate/writer.h"

namespace twinshade::spirv {

class TypeNames {
 public:
  // half_constants: constants are rounded to half.
  TypeNames(const Module& module, NameTable& names, bool half_constants);

  // Remembers what was asked for: write_declarations declares just that.
  std::string name(Id type, bool varying);
  const std::string& member(Id structure, std::uint32_t index);
  // A constant as an expression of uniform type.
  std::string constant(Id id);

  void write_declarations(Writer& out) const;

 private:
  void declare_structure(Id type);
  void need_uniform(Id type);
  std::string twin_type(Id id) const;
  void write_structure(Writer& out, Id id) const;

  struct StructureNames {
    std::string varying, uniform, of;  // of: the template that both are made from
  };

  const Module& module_;
  const bool half_constants_;
  std::set<std::string> aliases_;
  std::map<Id, StructureNames> structures_;  // all reserved at the start
  NameTable beside_members_;                 // those same names: a member of a type's name would hide it in its struct
  std::set<Id> declared_;
  std::vector<Id> structure_order_;
  std::set<Id> uniform_structures_;  // those that also occur with uniform members
  std::map<std::pair<Id, std::uint32_t>, std::string> members_, member_types_;
};

// A float literal that reads back as the same bits: short decimals where they are exact, else hexadecimal.
std::string float_literal(std::uint32_t bits);
// The bits of the float that is the nearest half (runtime/half_lanes.h); even where two are as near.
std::uint32_t nearest_half(std::uint32_t bits);

}  // namespace twinshade::spirv

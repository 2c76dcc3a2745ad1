#include "cpu_shaders/translate/emit_types.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/error.h"

namespace twinshade::spirv {
namespace {

std::string scalar_letter(Kind kind) {
  switch (kind) {
    case Kind::integer:
      return "I";
    case Kind::unsigned_integer:
      return "U";
    case Kind::boolean:
      return "B";
    default:
      return "F";
  }
}

std::string vector_prefix(Kind kind) {
  switch (kind) {
    case Kind::integer:
      return "ivec";
    case Kind::unsigned_integer:
      return "uvec";
    case Kind::boolean:
      return "bvec";
    default:
      return "vec";
  }
}

}  // namespace

std::string float_literal(std::uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  if (std::isnan(value)) return "__builtin_nanf(\"\")";
  if (std::isinf(value)) return value < 0 ? "-__builtin_inff()" : "__builtin_inff()";
  char text[64];
  // Halves, tens and the like: decimal digits that are the exact value.
  std::snprintf(text, sizeof text, "%.4f", static_cast<double>(value));
  if (std::strtod(text, nullptr) == static_cast<double>(value) && std::fabs(value) < 100000.0f) {
    std::string decimal = text;
    while (decimal.back() == '0' && decimal[decimal.size() - 2] != '.') decimal.pop_back();
    return decimal + "f";
  }
  std::snprintf(text, sizeof text, "%a", static_cast<double>(value));
  return std::string(text) + "f";
}

std::uint32_t nearest_half(std::uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  if (std::isnan(value)) return bits;
  if (std::fabs(value) >= 65520.0f) {
    value = std::copysign(INFINITY, value);
  } else if (value != 0) {
    // The last place of a half: 2^-10 of its leading one, 2^-24 at least.
    const float place = std::ldexp(1.0f, std::max(std::ilogb(value) - 10, -24));
    value = std::copysign(std::nearbyint(value / place) * place, value);
  }
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

TypeNames::TypeNames(const Module& module, NameTable& names, bool half_constants)
    : module_(module), half_constants_(half_constants) {
  std::set<Id> ids;
  for (const auto& [id, type] : module.types)
    if (type.kind == Kind::structure) ids.insert(id);
  for (Id id : ids) {
    std::string wanted = module.name(id).empty() ? "Struct" : module.name(id);
    if (wanted == "mask" || wanted == "a" || wanted == "b") wanted += '_';  // the parameters of a struct's select
    const std::string name = names.declare(wanted);
    structures_[id] = {name, names.declare_own("uniform_" + name), names.declare_own(name + "_of")};
    const StructureNames& all = structures_.at(id);
    for (const std::string& type : {all.varying, all.uniform, all.of}) beside_members_.declare_own(type);
  }
}

std::string TypeNames::name(Id id, bool varying) {
  const Type& t = module_.type(id);
  std::string base;
  switch (t.kind) {
    case Kind::none:
      return "void";
    case Kind::vector:
      base = vector_prefix(module_.type(t.element).kind) + std::to_string(t.count);
      break;
    case Kind::matrix: {
      const std::uint32_t rows = module_.type(t.element).count;
      base = "mat" + std::to_string(t.count) + (rows == t.count ? "" : "x" + std::to_string(rows));
      break;
    }
    case Kind::array:
      return "arr<" + name(t.element, varying) + ", " + std::to_string(t.count) + ">";
    case Kind::structure:
      declare_structure(id);
      if (!varying) need_uniform(id);
      return varying ? structures_.at(id).varying : structures_.at(id).uniform;
    case Kind::sampler: {
      const Type& image = module_.type(t.element);
      base = image.dimension == spv::DimCube ? "samplerCube" : image.arrayed ? "sampler2DArray" : "sampler2D";
      aliases_.insert(base);
      return base;
    }
    case Kind::pointer:
      return name(t.element, varying);
    default:
      return (varying ? "" : "U") + scalar_letter(t.kind);
  }
  const std::string full = (varying ? "" : "uniform_") + base;
  aliases_.insert(full);
  return full;
}

void TypeNames::declare_structure(Id id) {
  if (!declared_.insert(id).second) return;
  const Type& t = module_.type(id);
  std::vector<std::string> types;  // structures that it holds come first
  for (Id member : t.members) types.push_back(name(member, true));
  beside_members_.open();
  for (std::uint32_t k = 0; k < t.members.size(); ++k) {
    member_types_[{id, k}] = types[k];
    const auto found = module_.member_names.find({id, k});
    members_[{id, k}] =
        beside_members_.declare(found == module_.member_names.end() ? "member" + std::to_string(k) : found->second);
  }
  beside_members_.close();
  structure_order_.push_back(id);
}

const std::string& TypeNames::member(Id structure, std::uint32_t index) {
  declare_structure(structure);
  return members_.at({structure, index});
}

std::string TypeNames::constant(Id id) {
  const Constant& c = module_.constants.at(id);
  const Type& t = module_.type(c.type);
  const std::string type = name(c.type, false);
  switch (t.kind) {
    case Kind::real:
      return "UF(" + float_literal(half_constants_ ? nearest_half(c.bits) : c.bits) + ")";
    case Kind::integer:
      if (c.bits == 0x80000000u) return "UI(-2147483647 - 1)";
      return "UI(" + std::to_string(static_cast<std::int32_t>(c.bits)) + ")";
    case Kind::unsigned_integer:
      return "UU(" + std::to_string(c.bits) + "u)";
    case Kind::boolean:
      return c.bits != 0 ? "UB(true)" : "UB(false)";
    default:
      break;
  }
  if (c.components.empty()) return type + "{}";  // OpConstantNull
  bool same = t.kind == Kind::vector;
  for (Id component : c.components) same &= component == c.components[0];
  if (same) return type + "(" + constant(c.components[0]) + ")";
  std::string list;
  for (Id component : c.components) list += (list.empty() ? "" : ", ") + constant(component);
  if (t.kind == Kind::array) return type + "{{" + list + "}}";
  if (t.kind == Kind::structure) return type + "{" + list + "}";
  return type + "(" + list + ")";
}

void TypeNames::write_declarations(Writer& out) const {
  for (const char* scalar : {"F", "I", "U", "B", "UF", "UI", "UU", "UB"})
    out.line(std::string("using ") + scalar + " = typename N::" + scalar + ";");
  for (const std::string& alias : aliases_) {
    if (alias.rfind("sampler", 0) == 0) {
      out.line("using " + alias + " = typename N::" + alias + ";");
      continue;
    }
    const bool uniform = alias.rfind("uniform_", 0) == 0;
    const std::string base = uniform ? alias.substr(8) : alias;
    const std::size_t digits = base.find_first_of("234");
    const std::string prefix = base.substr(0, digits), size = base.substr(digits);
    const std::string scalar = std::string(uniform ? "U" : "") + (prefix == "ivec"   ? "I"
                                                                  : prefix == "uvec" ? "U"
                                                                  : prefix == "bvec" ? "B"
                                                                                     : "F");
    if (prefix == "mat")
      out.line("using " + alias + " = mat<" + scalar + ", " + size.substr(0, 1) + ", " + size.substr(size.size() - 1) +
               ">;");
    else
      out.line("using " + alias + " = vec<" + scalar + ", " + size + ">;");
  }
  if (!uniform_structures_.empty()) {
    for (const char* twin : {"Varying", "Uniform"}) {
      const std::string prefix = twin[0] == 'U' ? "U" : "";
      out.open(std::string("struct ") + twin + " {");
      for (const char* scalar : {"F", "I", "U", "B"})
        out.line(std::string("using ") + scalar + " = typename N::" + prefix + scalar + ";");
      out.close("};");
    }
  }
  for (Id id : structure_order_) write_structure(out, id);
}

void TypeNames::need_uniform(Id id) {
  const Type& t = module_.type(id);
  if (t.kind == Kind::array) return need_uniform(t.element);
  if (t.kind != Kind::structure || !uniform_structures_.insert(id).second) return;
  for (Id member_type : t.members) need_uniform(member_type);
}

// The type of a member of a structure that occurs as varying and as uniform: K is one of the two.
std::string TypeNames::twin_type(Id id) const {
  const Type& t = module_.type(id);
  switch (t.kind) {
    case Kind::array:
      return "arr<" + twin_type(t.element) + ", " + std::to_string(t.count) + ">";
    case Kind::structure:
      return structures_.at(id).of + "<K>";
    case Kind::matrix:
      return "mat<typename K::F, " + std::to_string(t.count) + ", " + std::to_string(module_.type(t.element).count) +
             ">";
    case Kind::vector:
      return "vec<typename K::" + scalar_letter(module_.type(t.element).kind) + ", " + std::to_string(t.count) + ">";
    default:
      return "typename K::" + scalar_letter(t.kind);
  }
}

void TypeNames::write_structure(Writer& out, Id id) const {
  const Type& t = module_.type(id);
  const bool both = uniform_structures_.count(id) != 0;
  const StructureNames& names = structures_.at(id);
  const std::string& own = both ? names.of : names.varying;
  std::string copies, selects;
  out.line("");
  if (both) out.line("template <class K>");
  out.open("struct " + own + " {");
  for (std::uint32_t k = 0; k < t.members.size(); ++k) {
    const std::string& member = members_.at({id, k});
    out.line((both ? twin_type(t.members[k]) : member_types_.at({id, k})) + " " + member + ";");
    const std::string comma = k == 0 ? "" : ", ";
    copies += comma + member;
    selects += comma + "select(mask, a." + member + ", b." + member + ")";
  }
  if (both) {
    out.line("template <class V>");
    out.line("  requires(!std::same_as<K, V>)");
    out.line("TWINSHADE_INLINE constexpr operator " + own + "<V>() const { return {" + copies + "}; }");
  }
  // The twin of uniform members is selected by a uniform mask: one for all lanes would make its members varying.
  out.open("friend TWINSHADE_INLINE " + own + " select(const " + (both ? "auto" : "B") + "& mask, const " + own +
           "& a, const " + own + "& b) {");
  out.line("return {" + selects + "};");
  out.close("}");
  out.close("};");
  if (both) {
    out.line("using " + names.varying + " = " + own + "<Varying>;");
    out.line("using " + names.uniform + " = " + own + "<Uniform>;");
  }
}

}  // namespace twinshade::spirv

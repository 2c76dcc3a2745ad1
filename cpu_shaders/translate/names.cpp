#include "cpu_shaders/translate/names.h"

#include <algorithm>

#include "cpu_shaders/translate/cpp_keywords.h"

namespace twinshade::spirv {
namespace {

const std::set<std::string>& keywords() {
  static const std::set<std::string> words = {
      "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
      "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
      "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
      "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
      "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
      "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
      "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
      "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
      "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
      "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
      "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
      "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
      "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
      "xor_eq",      "final",     "override",   "std",       "main",     "NULL",         "assert",
      "typeof"};
  return words;
}

// The runtime and the frame of the generated file: what generated code says without a qualifier, and what it calls of
// the class that it inherits, which a function or a variable of the same name would hide.
const std::set<std::string>& reserved() {
  static const std::set<std::string> words = {"F",
                                              "I",
                                              "U",
                                              "B",
                                              "UF",
                                              "UI",
                                              "UU",
                                              "UB",
                                              "N",
                                              "K",
                                              "V",
                                              "Base",
                                              "Shader",
                                              "Varying",
                                              "Uniform",
                                              "twinshade",
                                              "glsl",
                                              "served",
                                              "vec",
                                              "mat",
                                              "arr",
                                              "table",
                                              "vec2",
                                              "vec3",
                                              "vec4",
                                              "ivec2",
                                              "ivec3",
                                              "ivec4",
                                              "uvec2",
                                              "uvec3",
                                              "uvec4",
                                              "bvec2",
                                              "bvec3",
                                              "bvec4",
                                              "mat2",
                                              "mat3",
                                              "mat4",
                                              "sampler2D",
                                              "sampler2DArray",
                                              "samplerCube",
                                              "select",
                                              "assign",
                                              "any",
                                              "all",
                                              "none",
                                              "lookup",
                                              "store_lookup",
                                              "update",
                                              "leave",
                                              "swizzle",
                                              "load",
                                              "store",
                                              "to_float",
                                              "to_int",
                                              "to_uint",
                                              "to_bool",
                                              "float_as_int",
                                              "float_as_uint",
                                              "int_as_float",
                                              "uint_as_float",
                                              "constant",
                                              "input",
                                              "output",
                                              "frag_coord",
                                              "front_facing",
                                              "primitive_id",
                                              "first_",
                                              "data_",
                                              "call_",
                                              "real",
                                              "live",
                                              "frag_depth",
                                              "kept",
                                              "begin",
                                              "finish",
                                              "run",
                                              "texture_2d",
                                              "texture_2d_array",
                                              "texture_cube",
                                              "buffer",
                                              "uniforms",
                                              "data",
                                              "call",
                                              "first",
                                              "memory",
                                              "array_length",
                                              "atomic_add",
                                              "atomic_and",
                                              "atomic_comp_swap",
                                              "atomic_exchange",
                                              "atomic_max",
                                              "atomic_min",
                                              "atomic_or",
                                              "atomic_xor",
                                              "iterate",
                                              "barrier",
                                              "shared",
                                              "num_work_groups",
                                              "work_group_id",
                                              "local_invocation_id",
                                              "local_invocation_index",
                                              "global_invocation_id",
                                              "shader_data",
                                              "shade_call",
                                              "map",
                                              "half_here",
                                              "half_switches",
                                              "in_half",
                                              "in_half_if",
                                              "of_halves",
                                              "to_half",
                                              "to_half_if",
                                              "Lane",
                                              "Vec",
                                              "Mat",
                                              "Arr",
                                              "Lanes",
                                              "Scalar32",
                                              "Scalar64",
                                              "Quad32",
                                              "Quad64",
                                              "Plain",
                                              "Simd",
                                              "Steps",
                                              "SimdMask",
                                              "BufferView",
                                              "TextureView",
                                              "ShaderData",
                                              "ShadeCall",
                                              "ShaderBase",
                                              "ShaderEntry",
                                              "ShaderModule",
                                              "number",
                                              "detail",
                                              "registers",
                                              "bundle",
                                              "portable"};
  return words;
}

// What the headers of C and its compilers define as macros differs; all but these few and ours are in capitals. Seen
// with g++ 12, clang 14 and glibc 2.36.
bool may_be_a_macro(const std::string& name) {
  static const std::set<std::string> in_small_letters = {
      "L_ctermid", "L_cuserid", "L_tmpnam", "P_tmpdir", "alloca",  "be16toh", "be32toh", "be64toh",
      "errno",     "htobe16",   "htobe32",  "htobe64",  "htole16", "htole32", "htole64", "le16toh",
      "le32toh",   "le64toh",   "linux",    "offsetof", "stderr",  "stdin",   "stdout",  "strdupa",
      "strndupa",  "unix",      "va_arg",   "va_copy",  "va_end",  "va_start"};
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  return (name.size() > 1 && std::none_of(name.begin(), name.end(), is_small)) || in_small_letters.count(name) != 0 ||
         name.rfind("TWINSHADE_", 0) == 0;
}

}  // namespace

bool is_cpp_keyword(const std::string& name) { return keywords().count(name) != 0; }

NameTable::NameTable() { open(); }

bool NameTable::taken(const std::string& name) const {
  if (is_cpp_keyword(name) || reserved().count(name)) return true;
  for (const auto& scope : scopes_)
    if (scope.count(name)) return true;
  return false;
}

std::string NameTable::declare(const std::string& wanted) {
  std::string name = wanted.empty() ? "unnamed" : wanted;
  // Two underscores in a row are reserved in C++ as in GLSL, where they only warn.
  for (std::size_t at = name.find("__"); at != std::string::npos; at = name.find("__")) name.erase(at, 1);
  if (name[0] == '_') name.insert(0, "x");
  // Aliases of uniform vectors and matrices begin with uniform_; neither they nor macros end in an underscore.
  const bool may_stand_for_another = name.back() != '_' && (name.rfind("uniform_", 0) == 0 || may_be_a_macro(name));
  return declare_own(may_stand_for_another ? name + '_' : name);
}

std::string NameTable::declare_own(const std::string& wanted) {
  std::string name = wanted;
  if (taken(name)) {
    const std::string base = name.back() == '_' ? name : name + '_';
    name = base;
    for (int k = 2; taken(name); ++k) name = base + std::to_string(k);
  }
  scopes_.back().insert(name);
  return name;
}

}  // namespace twinshade::spirv

#include "app/uniform_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/names.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/bind_table.h"

namespace twinshade {
namespace {

template <class T>
std::optional<T> number_in(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// As a uniform keeps it: integers by bit pattern.
std::optional<float> value_in(const std::string& text, Scalar scalar) {
  if (scalar == Scalar::boolean) {
    if (text != "true" && text != "false" && text != "0" && text != "1") return std::nullopt;
    return std::bit_cast<float>(std::uint32_t(text == "true" || text == "1"));
  }
  if (scalar == Scalar::i32) {
    const auto value = number_in<std::int32_t>(text);
    return value ? std::optional(std::bit_cast<float>(*value)) : std::nullopt;
  }
  if (scalar == Scalar::u32) {
    const auto value = number_in<std::uint32_t>(text);
    return value ? std::optional(std::bit_cast<float>(*value)) : std::nullopt;
  }
  const auto value = number_in<float>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

const ReflectedUniform& find_uniform(const ShaderSource& source, const Reflection& reflection, const std::string& given,
                                     const std::string& name) {
  const std::string file = source.files.empty() ? source.name : source.files[0];
  std::vector<std::string> names;
  for (const ReflectedUniform& uniform : reflection.uniforms) {
    if (uniform.name == name) return uniform;
    names.push_back(uniform.name);
  }
  for (const ReflectedResource& resource : reflection.resources)
    if (resource.name == name) throw UserError("--uniform " + given + ": " + name + " of " + file + " is no number");
  for (const ReflectedBlockMember& member : reflection.block_members)
    if (member.value.name == name || path_by_instance(member) == name)
      throw UserError("--uniform " + given + ": " + name + " of " + file +
                      " is in a block: declare it outside of blocks");
  throw UserError("--uniform " + given + ": " + file + ": " + unknown_name_message("uniform", name, names));
}

}  // namespace

std::vector<Uniform> uniform_values(const ShaderSource& source, const std::vector<std::string>& given) {
  std::vector<Uniform> uniforms;
  if (given.empty()) return uniforms;
  const Reflection reflection = translate(source).reflection;
  for (const std::string& text : given) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0)
      throw UserError("--uniform " + text + ": must be NAME=VALUE, numbers with commas between: tint=1,0.5,0");
    const std::string name = text.substr(0, equals);
    if (std::any_of(uniforms.begin(), uniforms.end(), [&](const Uniform& u) { return u.name == name; }))
      throw UserError("--uniform " + text + ": " + name + " is given twice");
    const ReflectedUniform& wanted = find_uniform(source, reflection, text, name);
    const ValueType type = type_of(wanted);
    Uniform uniform{name, wanted.scalar, wanted.columns, wanted.rows, wanted.array_length, {}};
    for (const std::string& part : split(text.substr(equals + 1))) {
      const std::optional<float> value = value_in(part, wanted.scalar);
      if (!value) throw UserError(fmt::format("--uniform {}: '{}' is no value of a {}", text, part, type_name(type)));
      uniform.values.push_back(*value);
    }
    if (uniform.values.size() != type.components())
      throw UserError(fmt::format("--uniform {}: {} has {} values, not {}", text, type_name(type), type.components(),
                                  uniform.values.size()));
    uniforms.push_back(std::move(uniform));
  }
  return uniforms;
}

}  // namespace twinshade

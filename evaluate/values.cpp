#include "evaluate/values.h"

#include <algorithm>
#include <bit>
#include <charconv>

namespace twinshade {
namespace {

constexpr std::uint32_t kLongestArray = 65536;
constexpr const char* kScalars[] = {"float", "int", "uint", "bool"};
constexpr const char* kPrefixes[] = {"", "i", "u", "b"};

// "3" of "vec3", "4x3" of "mat4x3".
bool is_size(std::string_view text) { return text.size() == 1 && text[0] >= '2' && text[0] <= '4'; }

std::optional<ValueType> find_element_type(std::string_view name) {
  ValueType type;
  for (int s = 0; s < 4; ++s) {
    type.scalar = Scalar(s);
    if (name == kScalars[s]) return type;
    const std::string vector = kPrefixes[s] + std::string("vec");
    if (name.size() == vector.size() + 1 && name.substr(0, vector.size()) == vector &&
        is_size(name.substr(vector.size()))) {
      type.rows = std::uint32_t(name.back() - '0');
      return type;
    }
  }
  if (name.substr(0, 3) != "mat") return std::nullopt;
  const std::string_view size = name.substr(3);
  const bool square = is_size(size);
  if (!square && !(size.size() == 3 && size[1] == 'x' && is_size(size.substr(0, 1)) && is_size(size.substr(2))))
    return std::nullopt;
  type.scalar = Scalar::f32;
  type.columns = std::uint32_t(size.front() - '0');
  type.rows = std::uint32_t(size.back() - '0');
  return type;
}

}  // namespace

std::string type_name(const ValueType& type) {
  std::string name;
  if (type.columns > 1) {
    name = "mat" + std::to_string(type.columns);
    if (type.rows != type.columns) name += "x" + std::to_string(type.rows);
  } else if (type.rows > 1) {
    name = kPrefixes[int(type.scalar)] + std::string("vec") + std::to_string(type.rows);
  } else {
    name = kScalars[int(type.scalar)];
  }
  if (type.array_length != 0) name += "[" + std::to_string(type.array_length) + "]";
  return name;
}

std::optional<ValueType> find_type(std::string_view name) {
  const std::size_t bracket = name.find('[');
  std::optional<ValueType> type = find_element_type(name.substr(0, bracket));
  if (!type || bracket == std::string_view::npos) return type;
  const std::string_view length = name.substr(bracket + 1);
  const auto [end, error] = std::from_chars(length.data(), length.data() + length.size(), type->array_length);
  const bool closed = end == length.data() + length.size() - 1 && length.back() == ']';
  if (error != std::errc() || !closed || type->array_length < 1 || type->array_length > kLongestArray)
    return std::nullopt;
  return type;
}

std::string component_name(const std::string& variable, const ValueType& type, std::uint32_t component) {
  const std::uint32_t column = component / type.rows, row = component % type.rows;
  std::string name = variable;
  if (type.array_length != 0) name += "[" + std::to_string(column / type.columns) + "]";
  if (type.columns > 1) name += "[" + std::to_string(column % type.columns) + "]";
  if (type.rows > 1) name += std::string(".") + "xyzw"[row];
  return name;
}

double value_at(const Values& values, std::size_t row, std::uint32_t component) {
  const std::size_t index = row * values.type.components() + component;
  if (!values.doubles.empty()) return values.doubles[index];
  const std::uint32_t bits = values.bits[index];
  switch (values.type.scalar) {
    case Scalar::f32:
      return double(std::bit_cast<float>(bits));
    case Scalar::i32:
      return double(std::bit_cast<std::int32_t>(bits));
    default:
      return double(bits);
  }
}

const Values* find_values(const std::vector<Values>& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Values& v) { return v.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace twinshade

#include "check/generate_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

#include "base/error.h"
#include "base/names.h"
#include "evaluate/bind_table.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

constexpr double kDefaultFloat = 10;
constexpr double kDefaultInteger = 15;
constexpr std::uint32_t kTexels = 16;
constexpr std::uint64_t kDomain = 0x636865636b;  // "check"

// One value's numbers, drawn in a fixed order.
class Stream {
 public:
  Stream(std::uint64_t seed, std::uint64_t variable, std::uint64_t row) : seed_(seed ^ mix_bits(variable)), row_(row) {}
  std::uint64_t bits() { return random_bits(seed_, kDomain, row_, count_++); }
  double real() { return unit_real(bits()); }
  std::size_t index(std::size_t size) { return std::size_t(bits() % size); }

 private:
  std::uint64_t seed_, row_, count_ = 0;
};

std::uint32_t float_bits(double value) { return std::bit_cast<std::uint32_t>(float(value)); }

std::vector<std::uint32_t> special_floats(const InputRange& range, double low, double high) {
  constexpr double kDenormal = 0x1p-149, kNormal = 0x1p-126;
  std::vector<std::uint32_t> bits;
  if (range.kind == InputRange::Kind::interval) {
    for (const double value : {low, high, 0.0, 1.0, -1.0, 0.5, kDenormal, -kDenormal, kNormal})
      if (value >= low && value <= high) bits.push_back(float_bits(value));
    if (low < 0 && high >= 0) bits.push_back(float_bits(-0.0));
  } else {
    constexpr double kLargest = std::numeric_limits<float>::max();
    for (const double value : {0.0, -0.0, 1.0, -1.0, 0.5, kDenormal, -kDenormal, kNormal, -kNormal, 0x1p24, 1e10, -1e10,
                               1e30, kLargest, -kLargest})
      bits.push_back(float_bits(value));
    if (range.kind == InputRange::Kind::any)
      for (const std::uint32_t value : {0x7f800000u, 0xff800000u, 0x7fc00000u}) bits.push_back(value);
  }
  return bits;
}

class Generator {
 public:
  Generator(const std::vector<InputRange>& ranges, const GenerateOptions& options)
      : ranges_(ranges), options_(options) {}

  Values values(const std::string& name, const ValueType& type, std::size_t variable, std::size_t variables,
                bool uniform) const {
    Values result;
    result.name = name;
    result.type = type;
    InputRange range;
    if (const InputRange* declared = find_range(ranges_, name)) range = *declared;
    check(range, type);
    const std::size_t rows = options_.rows, quarter = rows / 4;
    const std::size_t same = std::max<std::size_t>(4, (rows / options_.uniform_sets + 3) / 4 * 4);  // whole quads
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t drawn = uniform ? row / same : row;
      Stream stream(options_.seed, variable, drawn);
      const bool this_one = drawn % std::max<std::size_t>(variables, 1) == variable;
      const bool special = uniform ? drawn == 1 : row < quarter && this_one;
      const bool mixed = uniform ? drawn == 2 : row >= quarter && row < 2 * quarter;
      append(result, range, stream, special, mixed);
    }
    return result;
  }

  Texture texture(const ReflectedResource& sampler, std::size_t variable) const {
    Texture texture;
    texture.name = sampler.name;
    texture.width = texture.height = kTexels;
    texture.kind = sampler.kind == ResourceKind::sampler_cube       ? TextureKind::cube
                   : sampler.kind == ResourceKind::sampler_2d_array ? TextureKind::two_d_array
                                                                    : TextureKind::two_d;
    texture.layers = texture.kind == TextureKind::cube ? 6 : texture.kind == TextureKind::two_d_array ? 4 : 1;
    texture.wrap = texture.kind == TextureKind::two_d ? Wrap::repeat : Wrap::clamp_to_edge;
    double low = 0, high = 1;
    if (const InputRange* declared = find_range(ranges_, sampler.name)) {
      if (declared->intervals.size() != 1)
        throw UserError(declared->where + sampler.name + " is a sampler: give one LOW..HIGH for all its texels");
      check(*declared, {});
      std::tie(low, high) = declared->intervals[0];
    }
    Stream stream(options_.seed, variable, 0);
    texture.texels.resize(std::size_t{kTexels} * kTexels * texture.layers * 4);
    for (float& texel : texture.texels) texel = float(low + (high - low) * stream.real());
    return texture;
  }

 private:
  static void check(const InputRange& range, const ValueType& type) {
    const auto fail = [&](const std::string& what) { throw UserError(range.where + range.name + what); };
    if (range.intervals.size() > 1 && range.intervals.size() != type.rows)
      fail(" has " + std::to_string(type.rows) + " components, not " + std::to_string(range.intervals.size()));
    const bool real = type.scalar == Scalar::f32;
    if (!real && range.kind != InputRange::Kind::interval && range.kind != InputRange::Kind::list)
      fail(" is no float: give its range as LOW..HIGH or {A, B}");
    if (range.kind == InputRange::Kind::unit && type.rows < 2) fail(" is no vector: it cannot be of unit length");
    for (const double value : range.values) check_value(range, value, type.scalar);
    for (const auto& [low, high] : range.intervals) {
      check_value(range, low, type.scalar);
      check_value(range, high, type.scalar);
      if (type.scalar == Scalar::boolean && low == high)
        fail(" is a bool: give 0..1, or {0} or {1} for one of the two");
    }
  }

  // The ends of an interval, the values of a list.
  static void check_value(const InputRange& range, double value, Scalar scalar) {
    constexpr const char* kHolds[] = {" is a float: give values from -3.40282347e38 to 3.40282347e38, or finite",
                                      " is an int: give whole numbers from -2147483648 to 2147483647",
                                      " is a uint: give whole numbers from 0 to 4294967295",
                                      " is a bool: give 0 and 1 alone"};
    constexpr double kLeast[] = {0, -2147483648.0, 0, 0}, kMost[] = {0, 2147483647.0, 4294967295.0, 1};
    const bool good = scalar == Scalar::f32
                          ? std::isfinite(float(value))
                          : value >= kLeast[int(scalar)] && value <= kMost[int(scalar)] && value == std::floor(value);
    if (good) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    throw UserError(range.where + text + ": " + range.name + kHolds[int(scalar)]);
  }

  static std::uint32_t encoded(double value, Scalar scalar) {
    switch (scalar) {
      case Scalar::f32:
        return float_bits(value);
      case Scalar::i32:
        return std::uint32_t(std::int32_t(std::clamp(std::round(value), -2147483648.0, 2147483647.0)));
      case Scalar::u32:
        return std::uint32_t(std::clamp(std::round(value), 0.0, 4294967295.0));
      case Scalar::boolean:
        return value != 0 ? 1 : 0;
    }
    return 0;
  }

  void append(Values& result, const InputRange& range, Stream& stream, bool special, bool mixed) const {
    const ValueType& type = result.type;
    const std::uint32_t components = type.components();
    if (range.kind == InputRange::Kind::unit) {
      for (std::uint32_t c = 0; c < components; c += type.rows) append_unit(result, type.rows, stream, special);
      return;
    }
    const std::uint64_t choice = stream.bits();
    for (std::uint32_t c = 0; c < components; ++c) {
      const bool is_special = special || (mixed && stream.bits() % 2 == 0);
      result.bits.push_back(
          component(range, type, c % type.rows, stream, is_special, special ? choice : stream.bits()));
    }
  }

  static void append_unit(Values& result, std::uint32_t rows, Stream& stream, bool axis) {
    std::array<double, 4> v{};
    double length = 0;
    if (axis) {
      v[stream.index(rows)] = stream.bits() % 2 == 0 ? 1 : -1;
      length = 1;
    }
    while (length < 0.01 || length > 1) {  // of a ball that is not too small
      length = 0;
      for (std::uint32_t i = 0; i < rows; ++i) {
        v[i] = 2 * stream.real() - 1;
        length += v[i] * v[i];
      }
    }
    for (std::uint32_t i = 0; i < rows; ++i) result.bits.push_back(float_bits(v[i] / std::sqrt(length)));
  }

  static std::uint32_t component(const InputRange& range, const ValueType& type, std::uint32_t row, Stream& stream,
                                 bool special, std::uint64_t choice) {
    if (range.kind == InputRange::Kind::list)
      return encoded(range.values[std::size_t(choice % range.values.size())], type.scalar);
    const bool real = type.scalar == Scalar::f32;
    double low = real ? -kDefaultFloat : 0, high = real ? kDefaultFloat : kDefaultInteger;
    if (!range.intervals.empty()) std::tie(low, high) = range.intervals[range.intervals.size() == 1 ? 0 : row];
    if (type.scalar == Scalar::boolean) return std::uint32_t(choice & 1);
    if (real && special) {
      const std::vector<std::uint32_t> values = special_floats(range, low, high);
      return values[std::size_t(choice % values.size())];
    }
    if (!real)
      return encoded(special ? (choice % 2 == 0 ? low : high) : std::floor(low + (high - low + 1) * stream.real()),
                     type.scalar);
    if (range.kind == InputRange::Kind::interval) return float_bits(low + (high - low) * stream.real());
    auto bits = std::uint32_t(stream.bits() >> 32);
    while (range.kind == InputRange::Kind::finite && !std::isfinite(std::bit_cast<float>(bits)))
      bits = std::uint32_t(stream.bits() >> 32);
    return bits;
  }

  const std::vector<InputRange>& ranges_;
  const GenerateOptions& options_;
};

void require_known(const Reflection& reflection, const std::vector<InputRange>& ranges) {
  std::vector<std::string> names;
  for (const auto& input : reflection.inputs) names.push_back(input.name);
  for (const auto& uniform : reflection.uniforms) names.push_back(uniform.name);
  for (const auto& member : reflection.block_members) names.push_back(member.value.name);
  const auto is_block = [](const ReflectedResource& resource) { return resource.kind == ResourceKind::uniform_block; };
  for (const auto& resource : reflection.resources)
    if (!is_block(resource)) names.push_back(resource.name);
  for (const InputRange& range : ranges) {
    for (const auto& resource : reflection.resources)
      if (resource.name == range.name && is_block(resource))
        throw UserError(range.where + range.name + " is a block: give ranges to its members, by their GLSL path");
    if (std::find(names.begin(), names.end(), range.name) == names.end())
      throw UserError(range.where + unknown_name_message("input", range.name, names));
  }
}

}  // namespace

void use_block_names(const Reflection& reflection, std::vector<InputRange>& ranges) {
  for (const ReflectedBlockMember& member : reflection.block_members)
    for (InputRange& range : ranges)
      if (range.name == path_by_instance(member)) range.name = member.value.name;
}

ValueTable generate_rows(const Reflection& reflection, const std::vector<InputRange>& ranges,
                         const GenerateOptions& options) {
  require_known(reflection, ranges);
  const Generator generator(ranges, options);
  ValueTable table;
  table.rows = options.rows;
  std::size_t variable = 0;
  for (const ReflectedVariable& input : reflection.inputs)
    table.inputs.push_back(generator.values(input.name, type_of(input), variable++, reflection.inputs.size(), false));
  for (const ReflectedUniform& uniform : reflection.uniforms)
    table.uniforms.push_back(generator.values(uniform.name, type_of(uniform), variable++, 1, true));
  for (const ReflectedBlockMember& member : reflection.block_members)
    table.uniforms.push_back(generator.values(member.value.name, type_of(member.value), variable++, 1, true));
  for (const ReflectedResource& resource : reflection.resources) {
    ++variable;
    const bool is_block = resource.kind == ResourceKind::uniform_block || resource.kind == ResourceKind::storage_buffer;
    if (!is_block) table.textures.push_back(generator.texture(resource, variable));
  }
  return table;
}

}  // namespace twinshade

#include "evaluate/bind_table.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

#include "base/error.h"
#include "base/names.h"
#include "cpu_shaders/translate/source_lines.h"

namespace twinshade {
namespace {

std::string file_of(const ShaderSource& shader) { return shader.files.empty() ? shader.name : shader.files[0]; }

class Binder {
 public:
  Binder(const ShaderSource& shader, const Reflection& reflection, const ValueTable& table)
      : shader_(shader), file_(file_of(shader)), reflection_(reflection), table_(table) {}

  std::vector<BoundRows> bind() {
    if (table_.rows < 1 || table_.rows > kMostTableRows)
      fail("a table has 1 to " + std::to_string(kMostTableRows) + " rows, not " + std::to_string(table_.rows));
    check_resources();
    check_inputs();
    check_uniforms();
    std::vector<BoundRows> groups;
    for (std::vector<std::size_t>& rows : rows_by_uniforms()) {
      BoundRows group;
      group.rows = std::move(rows);
      bind_inputs(group);
      bind_resources(group);
      groups.push_back(std::move(group));
    }
    return groups;
  }

 private:
  // What does not fit is put right in the table's file, where it has one.
  [[noreturn]] void fail(const std::string& what) const {
    if (table_.origin.empty()) throw UserError(file_ + ": " + what);
    throw UserError(table_.origin + ": " + what + " (shader: " + file_ + ")");
  }

  // What a table has no values for at all: no correction of it helps.
  void check_resources() const {
    const bool has_buffers =
        std::any_of(table_.buffers.begin(), table_.buffers.end(), [](const Buffer& b) { return b.storage; });
    for (const ReflectedResource& resource : reflection_.resources) {
      if (resource.kind == ResourceKind::uniform_block) continue;
      const bool is_buffer = resource.kind == ResourceKind::storage_buffer;
      if (is_buffer ? has_buffers : !table_.textures.empty()) continue;
      const std::string name = resource.name.substr(0, resource.name.find('['));
      const std::string where = SourceLines(shader_).declaration(name).text() + ": ";
      if (is_buffer)
        throw UserError(where + "storage buffer " + name +
                        ": neither eval's tables nor check's rows have contents for it: hand what is tested its data "
                        "as inputs or uniforms, in a function that both shaders include");
      throw UserError(where + "texture " + name +
                      ": eval's tables have no textures: use check, which makes texels up, or hand what is tested the "
                      "texel as an input, in a function that both shaders include");
    }
  }

  void check_rows(const char* kind, const Values& values, bool one_is_enough) const {
    const std::size_t components = values.type.components();
    const std::size_t rows = values.bits.size() / components;
    if (values.bits.size() % components == 0 && (rows == table_.rows || (one_is_enough && rows == 1))) return;
    fail(std::string(kind) + " " + values.name + " has " + std::to_string(rows) + " rows of " + type_name(values.type) +
         ", but the table has " + std::to_string(table_.rows));
  }

  void check_inputs() const {
    std::vector<std::string> names;
    for (const ReflectedVariable& input : reflection_.inputs) {
      names.push_back(input.name);
      const Values* values = find_values(table_.inputs, input.name);
      if (!values) fail("input " + input.name + " (" + type_name(type_of(input)) + ") has no values in the table");
      if (values->type != type_of(input))
        fail("input " + input.name + " is " + type_name(type_of(input)) + " in the shader, but " +
             type_name(values->type) + " in the table");
    }
    for (const Values& values : table_.inputs) {
      if (std::find(names.begin(), names.end(), values.name) == names.end())
        fail(unknown_name_message("input", values.name, names));
      check_rows("input", values, false);
    }
  }

  // glslang keeps bools of blocks as uints.
  static bool fits(const ValueType& given, ValueType declared, bool in_block) {
    if (in_block && declared.scalar == Scalar::u32 && given.scalar == Scalar::boolean)
      declared.scalar = Scalar::boolean;
    return given == declared;
  }

  // Blocks may also be given whole, as bytes.
  bool given_as_bytes(const ReflectedBlockMember& member) const {
    return std::any_of(table_.buffers.begin(), table_.buffers.end(), [&](const Buffer& b) {
      return !b.storage && b.name == reflection_.resources[member.resource].name;
    });
  }

  // "instance.member" besides OpenGL's own "Block.member".
  const Values* values_of(const ReflectedBlockMember& member) const {
    if (const Values* values = find_values(table_.uniforms, member.value.name)) return values;
    return member.instance.empty() ? nullptr : find_values(table_.uniforms, path_by_instance(member));
  }

  void check_uniform(const ReflectedUniform& uniform, const Values* values, bool in_block) const {
    if (!values) fail("uniform " + uniform.name + " (" + type_name(type_of(uniform)) + ") has no value in the table");
    if (!fits(values->type, type_of(uniform), in_block))
      fail("uniform " + uniform.name + " is " + type_name(type_of(uniform)) + " in the shader, but " +
           type_name(values->type) + " in the table");
  }

  void check_uniforms() const {
    std::vector<std::string> names;
    std::vector<const Values*> known;
    for (const ReflectedUniform& uniform : reflection_.uniforms) {
      names.push_back(uniform.name);
      known.push_back(find_values(table_.uniforms, uniform.name));
      if (known.back() != nullptr || uniform.initial.empty()) check_uniform(uniform, known.back(), false);
    }
    for (const ReflectedBlockMember& member : reflection_.block_members) {
      if (given_as_bytes(member)) continue;
      names.push_back(member.value.name);
      known.push_back(values_of(member));
      check_uniform(member.value, known.back(), true);
    }
    for (const Values& values : table_.uniforms) {
      if (std::find(known.begin(), known.end(), &values) == known.end())
        fail(unknown_name_message("uniform", values.name, names));
      check_rows("uniform", values, true);
    }
  }

  // Rows of the table in groups that have the same uniforms, in order of their first row.
  std::vector<std::vector<std::size_t>> rows_by_uniforms() const {
    std::vector<std::vector<std::size_t>> groups;
    std::map<std::vector<std::uint32_t>, std::size_t> group_of;
    for (std::size_t row = 0; row < table_.rows; ++row) {
      std::vector<std::uint32_t> key;
      for (const Values& values : table_.uniforms) {
        if (values.row_count() == 1) continue;
        const auto first = values.bits.begin() + std::ptrdiff_t(row * values.type.components());
        key.insert(key.end(), first, first + values.type.components());
      }
      const auto [found, is_new] = group_of.emplace(std::move(key), groups.size());
      if (is_new) groups.emplace_back();
      groups[found->second].push_back(row);
    }
    return groups;
  }

  void bind_inputs(BoundRows& group) const {
    for (const ReflectedVariable& input : reflection_.inputs) {
      const Values& values = *find_values(table_.inputs, input.name);
      const std::uint32_t components = values.type.components();
      for (std::uint32_t first = 0; first < components; first += values.type.rows) {
        Attribute leaf;
        leaf.name = component_name(input.name, values.type, first);
        if (values.type.rows > 1) leaf.name.resize(leaf.name.size() - 2);  // ".x"
        leaf.scalar = values.type.scalar;
        leaf.components = values.type.rows;
        leaf.values.resize(group.rows.size() * leaf.components);
        for (std::size_t i = 0; i < group.rows.size(); ++i)
          std::memcpy(&leaf.values[i * leaf.components], &values.bits[group.rows[i] * components + first],
                      leaf.components * 4);
        group.inputs.push_back(std::move(leaf));
      }
    }
  }

  const std::uint32_t* row_of(const Values& values, const BoundRows& group) const {
    return values.bits.data() + (values.row_count() == 1 ? 0 : group.rows[0] * values.type.components());
  }

  void bind_resources(BoundRows& group) const {
    group.resources.textures = table_.textures;
    group.resources.buffers = table_.buffers;
    for (const ReflectedUniform& uniform : reflection_.uniforms) {
      const Values* values = find_values(table_.uniforms, uniform.name);
      Uniform bound;
      // OpenGL's name of an array; both machines know it without the index too.
      bound.name = uniform.name;
      bound.scalar = uniform.scalar;
      bound.columns = uniform.columns, bound.rows = uniform.rows, bound.array_length = uniform.array_length;
      bound.values.resize(type_of(uniform).components());
      const std::uint32_t* given = values != nullptr ? row_of(*values, group) : uniform.initial.data();
      std::memcpy(bound.values.data(), given, bound.values.size() * 4);
      group.resources.uniforms.push_back(std::move(bound));
    }
    for (std::uint32_t r = 0; r < reflection_.resources.size(); ++r) bind_block(r, group);
  }

  void bind_block(std::uint32_t resource, BoundRows& group) const {
    const ReflectedResource& block = reflection_.resources[resource];
    if (block.kind != ResourceKind::uniform_block) return;
    Buffer buffer;
    buffer.name = block.name;
    buffer.bytes.resize((block.minimum_size + 15) / 16 * 16);
    for (const ReflectedBlockMember& member : reflection_.block_members) {
      if (member.resource != resource) continue;
      if (given_as_bytes(member)) return;
      const ReflectedUniform& u = member.value;
      const std::uint32_t* value = row_of(*values_of(member), group);
      for (std::uint32_t element = 0; element < std::max(u.array_length, 1u); ++element)
        for (std::uint32_t column = 0; column < u.columns; ++column)
          for (std::uint32_t row = 0; row < u.rows; ++row, ++value) {
            const std::uint32_t major = member.row_major ? row : column, minor = member.row_major ? column : row;
            std::memcpy(&buffer.bytes[u.offset + element * u.array_stride + major * u.matrix_stride + minor * 4], value,
                        4);
          }
    }
    group.resources.buffers.push_back(std::move(buffer));
  }

  const ShaderSource& shader_;
  const std::string file_;
  const Reflection& reflection_;
  const ValueTable& table_;
};

}  // namespace

ValueType type_of(const ReflectedVariable& v) { return {v.scalar, v.columns, v.rows, v.array_length}; }
ValueType type_of(const ReflectedUniform& u) { return {u.scalar, u.columns, u.rows, u.array_length}; }

std::string path_by_instance(const ReflectedBlockMember& member) {
  return member.instance.empty() ? "" : member.instance + member.value.name.substr(member.value.name.find('.'));
}

std::vector<BoundRows> bind_table(const ShaderSource& shader, const Reflection& reflection, const ValueTable& table) {
  return Binder(shader, reflection, table).bind();
}

}  // namespace twinshade

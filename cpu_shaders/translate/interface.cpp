#include "cpu_shaders/translate/interface.h"

#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/served.h"
#include "cpu_shaders/translate/texture_coordinates.h"

namespace twinshade::spirv {
namespace {

// Uniform blocks up to this size are loaded whole before the first invocation; larger ones are read where they are
// used.
constexpr std::uint32_t kLargestLoadedBlock = 4096;

Scalar scalar_of(Kind kind) {
  switch (kind) {
    case Kind::integer:
      return Scalar::i32;
    case Kind::unsigned_integer:
      return Scalar::u32;
    case Kind::boolean:
      return Scalar::boolean;
    default:
      return Scalar::f32;
  }
}

class Describer {
 public:
  Describer(const Program& program, const SourceLines& lines, NameTable& names)
      : program_(program), module_(program.module), lines_(lines), names_(names), reflection_(result_.reflection) {}

  Interface run() {
    find_mentioned();
    for (Id id : module_.globals) {
      const Variable& v = module_.variables.at(id);
      switch (v.storage) {
        case spv::StorageClassInput:
          input(v);
          break;
        case spv::StorageClassOutput:
          output(v);
          break;
        case spv::StorageClassPrivate:
          if (mentioned_.count(id)) add(v, Role::global, module_.name(id));
          break;
        case spv::StorageClassUniformConstant:
          uniform_constant(v);
          break;
        case spv::StorageClassUniform:
          block(v);
          break;
        case spv::StorageClassWorkgroup:
          shared(v);
          break;
        default:
          refuse(module_.name(id), "storage class of " + module_.name(id), "use in, out, uniform or buffer");
      }
    }
    reflection_.uniform_bytes = (reflection_.uniform_bytes + 15) / 16 * 16;
    for (const auto& [first, second] : samplers_side_by_side(program_)) place_beside(first, second);
    for (const auto& [sampler, at] : texture_coordinates(program_)) note_coordinates(sampler, at);
    for (const auto& [id, info] : program_.functions) {
      reflection_.discards |= info.discards;
      reflection_.has_side_effects |= info.writes_buffers;
      reflection_.uses_derivatives |= info.uses_derivatives;
      reflection_.uses_barrier |= info.has_barrier;
    }
    std::copy_n(module_.local_size, 3, reflection_.local_size);
    if (module_.other_frag_coord)
      refuse("gl_FragCoord", "layout(origin_upper_left) or layout(pixel_center_integer) of gl_FragCoord",
             "compute it from gl_FragCoord");
    if (module_.early_tests && (reflection_.has_side_effects || reflection_.writes_depth || reflection_.discards))
      refuse("early_fragment_tests",
             "layout(early_fragment_tests) in a shader that discards, writes depth or writes to buffers", "remove it");
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const std::string& name, const std::string& what, const std::string& remedy) const {
    throw UserError(lines_.declaration(name).text() + ": " + what + " is not supported: " + remedy);
  }

  void find_mentioned() {
    for (const auto& [id, info] : program_.functions)
      for_each_instruction(info.body.list, [&](const Instruction& i) {
        for (Id operand : value_operands(i)) mentioned_.insert(operand);
      });
  }

  Global& add(const Variable& v, Role role, const std::string& name) {
    Global g;
    g.role = role;
    g.type = v.type;
    g.name = names_.declare(name);
    g.mentioned = mentioned_.count(v.id) != 0;
    return result_.globals[v.id] = g;
  }

  // Fills scalar, columns, rows and array length from a type; false if it is something else.
  template <class Described>
  bool describe(Id type, Described& d) const {
    const Type* t = &module_.type(type);
    if (t->kind == Kind::array) {
      d.array_length = t->count;
      t = &module_.type(t->element);
    }
    if (t->kind == Kind::matrix) {
      d.columns = static_cast<std::uint8_t>(t->count);
      t = &module_.type(t->element);
    }
    if (t->kind == Kind::vector) {
      d.rows = static_cast<std::uint8_t>(t->count);
      t = &module_.type(t->element);
    }
    d.scalar = scalar_of(t->kind);
    return t->kind == Kind::real || t->kind == Kind::integer || t->kind == Kind::unsigned_integer ||
           t->kind == Kind::boolean;
  }

  void input(const Variable& v) {
    const Decorations& d = module_.decorations_of(v.id);
    const std::string name = module_.name(v.id);
    if (d.has(spv::DecorationBuiltIn)) {
      if (!mentioned_.count(v.id)) return;
      Global& g = add(v, Role::builtin, name);
      g.builtin = static_cast<spv::BuiltIn>(d.get(spv::DecorationBuiltIn));
      switch (g.builtin) {
        case spv::BuiltInFragCoord:
          reflection_.uses_frag_coord = true;
          return;
        case spv::BuiltInFrontFacing:
          reflection_.uses_front_facing = true;
          return;
        case spv::BuiltInPrimitiveId:
          reflection_.uses_primitive_id = true;
          return;
        case spv::BuiltInHelperInvocation:
          reflection_.uses_helper_invocation = true;
          return;
        case spv::BuiltInSampleId:
        case spv::BuiltInSamplePosition:
        case spv::BuiltInSampleMask:
        case spv::BuiltInLayer:
        case spv::BuiltInViewportIndex:
        case spv::BuiltInNumWorkgroups:
        case spv::BuiltInWorkgroupId:
        case spv::BuiltInLocalInvocationId:
        case spv::BuiltInGlobalInvocationId:
        case spv::BuiltInLocalInvocationIndex:
          return;
        default:
          refuse(name, "the built-in " + name, "only triangles are drawn, with neither clip distances nor points");
      }
    }
    const std::uint32_t first = reflection_.input_components;
    input_leaves(v.type, name, d, static_cast<std::int32_t>(d.get(spv::DecorationLocation, ~0u)));
    add(v, Role::input, name.empty() ? module_.name(module_.innermost(v.type)) : name).first_component = first;
  }

  // One input for each leaf of blocks, structs and arrays of them, named as the shader names it: "surface.normal",
  // "lights[1].colour", and "normal" in a block without an instance name.
  void input_leaves(Id type, const std::string& path, const Decorations& d, std::int32_t location) {
    const Type& t = module_.type(type);
    if (t.kind == Kind::structure) {
      for (std::uint32_t k = 0; k < t.members.size(); ++k) {
        Decorations member = module_.member(type, k);
        member.values.insert(d.values.begin(), d.values.end());
        input_leaves(t.members[k], (path.empty() ? "" : path + ".") + module_.member_names.at({type, k}), member, -1);
      }
      return;
    }
    ReflectedVariable r;
    if (!describe(type, r)) {  // arrays of structs and of arrays
      for (std::uint32_t k = 0; k < t.count; ++k) input_leaves(t.element, path + "[" + std::to_string(k) + "]", d, -1);
      return;
    }
    r.name = path;
    r.flat = d.has(spv::DecorationFlat);
    r.noperspective = d.has(spv::DecorationNoPerspective);
    r.location = location;
    r.first_component = reflection_.input_components;
    reflection_.input_components += module_.component_count(type);
    reflection_.inputs.push_back(r);
  }

  void output(const Variable& v) {
    const Decorations& d = module_.decorations_of(v.id);
    const std::string name = module_.name(v.id);
    if (d.has(spv::DecorationBuiltIn)) {
      if (!mentioned_.count(v.id)) return;
      if (d.get(spv::DecorationBuiltIn) != spv::BuiltInFragDepth)
        refuse(name, "the built-in output " + name, "write colours and gl_FragDepth only");
      reflection_.writes_depth = true;
      add(v, Role::frag_depth, name);
      return;
    }
    if (name.rfind("gl_", 0) == 0) {  // the driver alone knows what becomes of them
      if (mentioned_.count(v.id))
        refuse(name, "the output " + name + " of old GLSL", "declare an output: out vec4 color;");
      return;
    }
    if (d.get(spv::DecorationIndex) != 0 || d.get(spv::DecorationComponent) != 0)
      refuse(name, "layout(index) or layout(component) of output " + name, "give each output a location of its own");
    ReflectedVariable r;
    r.name = name;
    if (!describe(v.type, r)) refuse(name, "the type of output " + name, "use a scalar, a vector or an array of them");
    r.location = static_cast<std::int32_t>(d.get(spv::DecorationLocation, ~0u));
    r.first_component = reflection_.output_components;
    reflection_.output_components += module_.component_count(v.type);
    reflection_.outputs.push_back(r);
    add(v, Role::output, name).first_component = r.first_component;
  }

  static bool sampler_kind(const Type& image, ResourceKind& kind) {
    if (image.depth || image.multisampled || image.storage_image) return false;
    if (image.dimension == spv::Dim2D) {
      kind = image.arrayed ? ResourceKind::sampler_2d_array : ResourceKind::sampler_2d;
      return true;
    }
    kind = ResourceKind::sampler_cube;
    return image.dimension == spv::DimCube && !image.arrayed;
  }

  void uniform_constant(const Variable& v) {
    const std::string name = module_.name(v.id);
    const Type& element = module_.type(module_.innermost(v.type));
    if (element.kind == Kind::sampler) {
      const Type& image = module_.type(element.element);
      ResourceKind kind;
      if (!sampler_kind(image, kind) || module_.scalar_kind(image.element) != Kind::real)
        refuse(name, "the sampler type of " + name, "use sampler2D, sampler2DArray or samplerCube");
      Global& g = add(v, Role::sampler, name);
      g.slot = reflection_.texture_count;
      for (const std::string& suffix : module_.element_suffixes(v.type)) {
        ReflectedResource r;
        r.name = name + suffix;
        r.kind = kind;
        r.slot = reflection_.texture_count++;
        if (const auto order = layer_orders_.find(v.id); order != layer_orders_.end()) r.layer_order = order->second;
        if (const auto read = layers_read_.find(v.id); read != layers_read_.end()) r.layers_read = read->second;
        reflection_.resources.push_back(r);
      }
      return;
    }
    if (holds_opaque(v.type))
      refuse(name, "an image, or a sampler in a struct (" + name + ")",
             "use sampler2D, sampler2DArray or samplerCube uniforms");
    Global& g = add(v, Role::uniform, name);
    const Layout layout(module_, false);
    g.offset = (reflection_.uniform_bytes + 15) / 16 * 16;
    reflection_.uniform_bytes = g.offset + layout.size(v.type);
    leaves(layout, v.type, name, g.offset, v.initializer);
  }

  // Component k of a constant composite; 0 where that is all zero (OpConstantNull).
  Id part_of(Id constant, std::uint32_t k) const {
    if (constant == 0) return 0;
    const auto& components = module_.constants.at(constant).components;
    return components.empty() ? 0 : components[k];
  }

  void words_of(Id constant, Id type, std::vector<std::uint32_t>& words) const {
    const Type& t = module_.type(type);
    if (t.kind == Kind::array || t.kind == Kind::matrix || t.kind == Kind::vector) {
      for (std::uint32_t k = 0; k < t.count; ++k) words_of(part_of(constant, k), t.element, words);
      return;
    }
    words.push_back(constant == 0 ? 0 : module_.constants.at(constant).bits);
  }

  void place_beside(Id first, Id second) {
    const std::uint32_t slot = result_.globals.at(first).slot, other = result_.globals.at(second).slot;
    for (ReflectedResource& r : reflection_.resources)
      if (r.kind == ResourceKind::sampler_2d_array && r.slot == slot) r.beside = static_cast<std::int32_t>(other);
  }

  void note_coordinates(Id sampler, const TextureCoordinates& at) {
    const auto component = [&](Id input) {
      return static_cast<std::int32_t>(result_.globals.at(input).first_component);
    };
    if (!result_.globals.count(sampler) || !result_.globals.count(at.coordinates)) return;
    if (at.layer != 0 && !result_.globals.count(at.layer)) return;
    for (ReflectedResource& r : reflection_.resources) {
      const bool texture = r.kind == ResourceKind::sampler_2d || r.kind == ResourceKind::sampler_2d_array;
      if (!texture || r.slot != result_.globals.at(sampler).slot) continue;
      r.coordinates = component(at.coordinates);
      if (at.layer != 0) r.layer = component(at.layer);
    }
  }

  bool holds_opaque(Id type) const {
    const Type& t = module_.type(type);
    if (t.kind == Kind::array) return holds_opaque(t.element);
    if (t.kind == Kind::structure)
      return std::any_of(t.members.begin(), t.members.end(), [&](Id m) { return holds_opaque(m); });
    return t.kind == Kind::image || t.kind == Kind::sampler;
  }

  // Uniforms are set by the path of each leaf: "lights[2].colour".
  void leaves(const Layout& layout, Id type, const std::string& path, std::uint32_t offset, Id initial) {
    const Type& t = module_.type(type);
    if (t.kind == Kind::structure) {
      for (std::uint32_t k = 0; k < t.members.size(); ++k)
        leaves(layout, t.members[k], path + "." + module_.member_names.at({type, k}),
               offset + layout.member_offset(type, k), part_of(initial, k));
      return;
    }
    ReflectedUniform u;
    if (!describe(type, u)) {  // arrays of structs and of arrays
      for (std::uint32_t k = 0; k < t.count; ++k)
        leaves(layout, t.element, path + "[" + std::to_string(k) + "]", offset + k * layout.array_stride(type),
               part_of(initial, k));
      return;
    }
    u.name = path;
    u.offset = offset;
    u.array_stride = u.array_length != 0 ? layout.array_stride(type) : 0;
    u.matrix_stride = u.columns > 1 ? 16 : 0;
    if (initial != 0) words_of(initial, type, u.initial);
    reflection_.uniforms.push_back(u);
  }

  // A uniform block, or one of an array of them.
  struct BlockElement {
    std::uint32_t resource;
    std::string instance;  // "b", "b[1]"; may have no name
  };

  void block_leaves(const Layout& layout, Id type, const std::string& path, std::uint32_t offset,
                    const MatrixLayout& matrix, const BlockElement& block) {
    const Type& t = module_.type(type);
    if (t.kind == Kind::structure) {
      for (std::uint32_t k = 0; k < t.members.size(); ++k)
        block_leaves(layout, t.members[k], path + "." + module_.member_names.at({type, k}),
                     offset + layout.member_offset(type, k), layout.member_matrix(type, k), block);
      return;
    }
    ReflectedBlockMember member;
    ReflectedUniform& u = member.value;
    if (!describe(type, u)) {  // arrays of structs and of arrays
      for (std::uint32_t k = 0; k < t.count; ++k)
        block_leaves(layout, t.element, path + "[" + std::to_string(k) + "]", offset + k * layout.array_stride(type),
                     matrix, block);
      return;
    }
    u.name = path;
    u.offset = offset;
    u.array_stride = u.array_length != 0 ? layout.array_stride(type) : 0;
    u.matrix_stride = u.columns > 1 ? matrix.stride : 0;
    member.row_major = u.columns > 1 && matrix.row_major;
    member.resource = block.resource;
    member.instance = block.instance;
    reflection_.block_members.push_back(member);
  }

  void block(const Variable& v) {
    const Id block_type = module_.innermost(v.type);
    const std::string name = module_.name(block_type);
    const bool storage = module_.decorations_of(block_type).has(spv::DecorationBufferBlock);
    const Layout layout(module_, true);
    const std::uint32_t slot = reflection_.buffer_count;
    ReflectedResource r;
    const std::string instance = module_.name(v.id);
    const Type& members = module_.type(block_type);
    for (const std::string& suffix : module_.element_suffixes(v.type)) {
      r.name = name + suffix;
      r.kind = storage ? ResourceKind::storage_buffer : ResourceKind::uniform_block;
      r.slot = reflection_.buffer_count++;
      r.minimum_size = layout.size(block_type);
      r.read_only = !storage || read_only(v, block_type);
      reflection_.resources.push_back(r);
      if (storage) continue;
      const BlockElement element{static_cast<std::uint32_t>(reflection_.resources.size() - 1),
                                 instance.empty() ? "" : instance + suffix};
      const std::string prefix = instance.empty() ? "" : r.name + ".";
      for (std::uint32_t k = 0; k < members.members.size(); ++k)
        block_leaves(layout, members.members[k], prefix + module_.member_names.at({block_type, k}),
                     layout.member_offset(block_type, k), layout.member_matrix(block_type, k), element);
    }
    const bool loaded = block_type == v.type && !storage && r.minimum_size <= kLargestLoadedBlock;
    Global& g = add(v, loaded ? Role::uniform : Role::buffer, instance.empty() ? name : instance);
    g.slot = slot;
    g.in_block = true;
  }

  bool read_only(const Variable& v, Id block_type) const {
    if (module_.decorations_of(v.id).has(spv::DecorationNonWritable)) return true;
    const auto& members = module_.type(block_type).members;
    for (std::uint32_t k = 0; k < members.size(); ++k)
      if (!module_.member(block_type, k).has(spv::DecorationNonWritable)) return false;
    return true;
  }

  // Variables of a work group, one after another, laid out as uniforms are.
  void shared(const Variable& v) {
    Global& g = add(v, Role::shared, module_.name(v.id));
    g.offset = reflection_.shared_bytes;
    reflection_.shared_bytes += (Layout(module_, false).size(v.type) + 15) / 16 * 16;
  }

  const Program& program_;
  const Module& module_;
  const SourceLines& lines_;
  NameTable& names_;
  Interface result_;
  Reflection& reflection_;
  std::set<Id> mentioned_;
  const std::map<Id, LayerOrder> layer_orders_ = layer_orders(program_);
  const std::map<Id, std::uint32_t> layers_read_ = layers_read(program_);
};

}  // namespace

Interface describe_interface(const Program& program, const SourceLines& lines, NameTable& names) {
  return Describer(program, lines, names).run();
}

}  // namespace twinshade::spirv

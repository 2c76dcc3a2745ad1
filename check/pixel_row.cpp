#include "check/pixel_row.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "evaluate/bind_table.h"

namespace twinshade {
namespace {

void require_alone(const Reflection& shader) {
  if (shader.uses_derivatives) throw UserError("the shader takes derivatives, which need the pixels beside it");
  if (shader.uses_frag_coord || shader.uses_front_facing || shader.uses_primitive_id || shader.uses_helper_invocation)
    throw UserError("the shader reads gl_FragCoord or another built-in that tells where in the frame it is");
  if (shader.has_side_effects) throw UserError("the shader stores to buffers");
  for (const ReflectedResource& resource : shader.resources)
    if (resource.kind == ResourceKind::storage_buffer) throw UserError("the shader reads storage buffers");
}

Values input_of(const ReflectedVariable& input, const Frame& frame, std::size_t pixel) {
  Values values{input.name, type_of(input), {}, {}};
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  for (std::uint32_t c = 0; c < values.type.components(); ++c) {
    const std::string name = component_name(input.name, values.type, c);
    const auto found = std::find(frame.attribute_names.begin(), frame.attribute_names.end(), name);
    if (found == frame.attribute_names.end()) throw UserError("the frame has not the input " + name);
    values.bits.push_back(std::bit_cast<std::uint32_t>(
        frame.attributes[std::size_t(found - frame.attribute_names.begin()) * pixels + pixel]));
  }
  return values;
}

Values value_of(const Uniform& uniform) {
  Values values{uniform.name, {uniform.scalar, uniform.columns, uniform.rows, uniform.array_length}, {}, {}};
  for (const float value : uniform.values) values.bits.push_back(std::bit_cast<std::uint32_t>(value));
  return values;
}

}  // namespace

ValueTable row_of_pixel(const Reflection& shader, const Bundle& bundle, const Frame& frame, std::uint32_t x,
                        std::uint32_t y) {
  require_alone(shader);
  ValueTable table;
  table.rows = 1;
  for (const ReflectedVariable& input : shader.inputs)
    table.inputs.push_back(input_of(input, frame, std::size_t(y) * frame.width + x));
  for (const ReflectedUniform& uniform : shader.uniforms)
    if (const Uniform* found = bundle.find_uniform(uniform.name)) table.uniforms.push_back(value_of(*found));
  for (const ReflectedResource& resource : shader.resources) {
    if (const Texture* texture = bundle.find_texture(resource.name)) table.textures.push_back(*texture);
    if (const Buffer* buffer = bundle.find_buffer(resource.name)) table.buffers.push_back(*buffer);
  }
  return table;
}

}  // namespace twinshade

// A table against what a shader declares: checked, and put into the form that both machines take.
#pragma once

#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/values.h"

namespace twinshade {

// Some rows of a table that share their uniforms.
struct BoundRows {
  std::vector<std::size_t> rows;  // of the table
  std::vector<Attribute> inputs;  // by leaf, as the bundle names them: "c[3]", "m[1]"
  Bundle resources;               // uniforms, textures, buffers
};

// UserError, naming the table's origin or else the shader's file, for names that the shader does not have (with the
// nearest), that the table lacks, for types that do not match and row counts that are wrong; naming the line of the
// declaration, for storage buffers and textures where the table has none at all.
std::vector<BoundRows> bind_table(const ShaderSource& shader, const Reflection& reflection, const ValueTable& table);

// "instance.member", besides OpenGL's own "Block.member"; empty where the block has no instance name.
std::string path_by_instance(const ReflectedBlockMember& member);

ValueType type_of(const ReflectedVariable& variable);
ValueType type_of(const ReflectedUniform& uniform);

}  // namespace twinshade

#include "raster/gl/worker/uniform_type.h"

#include <vector>

namespace twinshade::gl {

std::optional<UniformType> uniform_type(GLenum type) {
  switch (type) {
    case GL_FLOAT:
      return UniformType{Scalar::f32, 1, 1};
    case GL_FLOAT_VEC2:
      return UniformType{Scalar::f32, 1, 2};
    case GL_FLOAT_VEC3:
      return UniformType{Scalar::f32, 1, 3};
    case GL_FLOAT_VEC4:
      return UniformType{Scalar::f32, 1, 4};
    case GL_INT:
      return UniformType{Scalar::i32, 1, 1};
    case GL_INT_VEC2:
      return UniformType{Scalar::i32, 1, 2};
    case GL_INT_VEC3:
      return UniformType{Scalar::i32, 1, 3};
    case GL_INT_VEC4:
      return UniformType{Scalar::i32, 1, 4};
    case GL_UNSIGNED_INT:
      return UniformType{Scalar::u32, 1, 1};
    case GL_UNSIGNED_INT_VEC2:
      return UniformType{Scalar::u32, 1, 2};
    case GL_UNSIGNED_INT_VEC3:
      return UniformType{Scalar::u32, 1, 3};
    case GL_UNSIGNED_INT_VEC4:
      return UniformType{Scalar::u32, 1, 4};
    case GL_BOOL:
      return UniformType{Scalar::boolean, 1, 1};
    case GL_BOOL_VEC2:
      return UniformType{Scalar::boolean, 1, 2};
    case GL_BOOL_VEC3:
      return UniformType{Scalar::boolean, 1, 3};
    case GL_BOOL_VEC4:
      return UniformType{Scalar::boolean, 1, 4};
    case GL_FLOAT_MAT2:
      return UniformType{Scalar::f32, 2, 2};
    case GL_FLOAT_MAT2x3:
      return UniformType{Scalar::f32, 2, 3};
    case GL_FLOAT_MAT2x4:
      return UniformType{Scalar::f32, 2, 4};
    case GL_FLOAT_MAT3x2:
      return UniformType{Scalar::f32, 3, 2};
    case GL_FLOAT_MAT3:
      return UniformType{Scalar::f32, 3, 3};
    case GL_FLOAT_MAT3x4:
      return UniformType{Scalar::f32, 3, 4};
    case GL_FLOAT_MAT4x2:
      return UniformType{Scalar::f32, 4, 2};
    case GL_FLOAT_MAT4x3:
      return UniformType{Scalar::f32, 4, 3};
    case GL_FLOAT_MAT4:
      return UniformType{Scalar::f32, 4, 4};
    default:
      return std::nullopt;
  }
}

std::string type_text(Scalar scalar, std::uint32_t columns, std::uint32_t rows) {
  if (columns > 1) return "mat" + std::to_string(columns) + (columns == rows ? "" : "x" + std::to_string(rows));
  static const char* const scalars[] = {"float", "int", "uint", "bool"};
  static const char* const vectors[] = {"vec", "ivec", "uvec", "bvec"};
  const auto kind = std::size_t(scalar);
  return rows == 1 ? scalars[kind] : vectors[kind] + std::to_string(rows);
}

void set_uniform(const GlFunctions& gl, GLint location, const UniformType& type, GLsizei count, const float* values) {
  using SetMatrix = void (*)(GLint, GLsizei, GLboolean, const GLfloat*);
  if (type.columns > 1) {
    const SetMatrix set[3][3] = {{gl.UniformMatrix2fv, gl.UniformMatrix2x3fv, gl.UniformMatrix2x4fv},
                                 {gl.UniformMatrix3x2fv, gl.UniformMatrix3fv, gl.UniformMatrix3x4fv},
                                 {gl.UniformMatrix4x2fv, gl.UniformMatrix4x3fv, gl.UniformMatrix4fv}};
    set[type.columns - 2][type.rows - 2](location, count, GL_FALSE, values);
    return;
  }
  if (type.scalar == Scalar::f32) {
    using Set = void (*)(GLint, GLsizei, const GLfloat*);
    const Set set[4] = {gl.Uniform1fv, gl.Uniform2fv, gl.Uniform3fv, gl.Uniform4fv};
    set[type.rows - 1](location, count, values);
    return;
  }
  // Integers travel as the bit patterns of floats.
  const std::size_t total = std::size_t(count) * type.rows;
  std::vector<GLint> integers(total);
  std::memcpy(integers.data(), values, total * sizeof(GLint));
  if (type.scalar == Scalar::u32) {
    using Set = void (*)(GLint, GLsizei, const GLuint*);
    const Set set[4] = {gl.Uniform1uiv, gl.Uniform2uiv, gl.Uniform3uiv, gl.Uniform4uiv};
    const std::vector<GLuint> unsigned_integers(integers.begin(), integers.end());
    set[type.rows - 1](location, count, unsigned_integers.data());
  } else {
    using Set = void (*)(GLint, GLsizei, const GLint*);
    const Set set[4] = {gl.Uniform1iv, gl.Uniform2iv, gl.Uniform3iv, gl.Uniform4iv};
    set[type.rows - 1](location, count, integers.data());
  }
}

}  // namespace twinshade::gl

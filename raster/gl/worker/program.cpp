#include "raster/gl/worker/program.h"

#include <algorithm>

#include "raster/gl/author_names.h"
#include "raster/gl/worker/failure.h"

namespace twinshade::gl {
namespace {

constexpr std::size_t kMostPrograms = 256;

class Shader {
 public:
  Shader(const GlFunctions& gl, GLenum stage, const std::string& text) : gl_(gl), id_(gl.CreateShader(stage)) {
    const GLchar* strings[] = {text.c_str()};
    gl.ShaderSource(id_, 1, strings, nullptr);
    gl.CompileShader(id_);
  }
  ~Shader() { gl_.DeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  GLuint id() const { return id_; }
  bool compiled() const {
    GLint status = 0;
    gl_.GetShaderiv(id_, GL_COMPILE_STATUS, &status);
    return status != 0;
  }
  std::string log() const {
    GLint length = 0;
    gl_.GetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
    std::string text(std::size_t(length) + 1, '\0');
    gl_.GetShaderInfoLog(id_, length + 1, &length, text.data());
    text.resize(std::size_t(length));
    return text;
  }

 private:
  const GlFunctions& gl_;
  GLuint id_;
};

// "k[0]" to "k"; true if there was something to drop.
bool drop_first_element(std::string& name) {
  if (name.size() < 3 || name.compare(name.size() - 3, 3, "[0]") != 0) return false;
  name.resize(name.size() - 3);
  return true;
}

}  // namespace

Program::Program(const GlFunctions& gl, const ProgramText& text) : gl_(gl) {
  if (text.compute.empty()) {
    const Shader vertex(gl, GL_VERTEX_SHADER, text.vertex);
    if (!vertex.compiled()) throw std::runtime_error("the driver rejects the generated vertex shader: " + vertex.log());
    const Shader fragment(gl, GL_FRAGMENT_SHADER, text.fragment);
    if (!fragment.compiled()) throw Failure(Outcome::glsl_error, fragment.log());
    id_ = gl.CreateProgram();
    gl.AttachShader(id_, vertex.id());
    gl.AttachShader(id_, fragment.id());
    gl.LinkProgram(id_);
  } else {
    const Shader compute(gl, GL_COMPUTE_SHADER, text.compute);
    if (!compute.compiled()) throw Failure(Outcome::glsl_error, compute.log());
    id_ = gl.CreateProgram();
    gl.AttachShader(id_, compute.id());
    gl.LinkProgram(id_);
  }
  GLint linked = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked == 0) {
    GLint length = 0;
    gl.GetProgramiv(id_, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(length) + 1, '\0');
    gl.GetProgramInfoLog(id_, length + 1, &length, log.data());
    log.resize(std::size_t(length));
    gl.DeleteProgram(id_);
    throw Failure(Outcome::glsl_error, log);
  }
  find_uniforms();
  find_blocks();
}

Program::~Program() { gl_.DeleteProgram(id_); }

void Program::find_uniforms() {
  GLint count = 0;
  gl_.GetProgramiv(id_, GL_ACTIVE_UNIFORMS, &count);
  std::string name = name_buffer(GL_ACTIVE_UNIFORM_MAX_LENGTH);
  for (GLint i = 0; i < count; ++i) {
    ActiveUniform uniform{};
    gl_.GetActiveUniform(id_, GLuint(i), GLsizei(name.size()), nullptr, &uniform.size, &uniform.type, name.data());
    uniform.name = author_name(name.c_str());
    uniform.location = gl_.GetUniformLocation(id_, name.c_str());
    uniform.array = drop_first_element(uniform.name);
    if (uniform.location >= 0) uniforms_.push_back(uniform);  // members of blocks have none
  }
}

void Program::find_blocks() {
  GLint count = 0;
  gl_.GetProgramiv(id_, GL_ACTIVE_UNIFORM_BLOCKS, &count);
  std::string name = name_buffer(GL_ACTIVE_UNIFORM_BLOCK_MAX_NAME_LENGTH);
  for (GLuint i = 0; i < GLuint(count); ++i) {
    ActiveBlock block{};
    gl_.GetActiveUniformBlockName(id_, i, GLsizei(name.size()), nullptr, name.data());
    gl_.GetActiveUniformBlockiv(id_, i, GL_UNIFORM_BLOCK_DATA_SIZE, &block.bytes);
    block.name = author_name(name.c_str());
    block.index = i;
    uniform_blocks_.push_back(block);
  }
  gl_.GetProgramInterfaceiv(id_, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
  GLint longest = 0;
  gl_.GetProgramInterfaceiv(id_, GL_SHADER_STORAGE_BLOCK, GL_MAX_NAME_LENGTH, &longest);
  name.assign(std::size_t(std::max(longest, 1)), '\0');
  for (GLuint i = 0; i < GLuint(count); ++i) {
    ActiveBlock block{};
    gl_.GetProgramResourceName(id_, GL_SHADER_STORAGE_BLOCK, i, GLsizei(name.size()), nullptr, name.data());
    const GLenum property = GL_BUFFER_DATA_SIZE;
    gl_.GetProgramResourceiv(id_, GL_SHADER_STORAGE_BLOCK, i, 1, &property, 1, nullptr, &block.bytes);
    block.name = author_name(name.c_str());
    block.index = i;
    storage_blocks_.push_back(block);
  }
}

// Room for the longest name of a kind, with its end: that of a member of nested structs has no limit.
std::string Program::name_buffer(GLenum longest) const {
  GLint length = 0;
  gl_.GetProgramiv(id_, longest, &length);
  return std::string(std::size_t(std::max(length, 1)), '\0');
}

const Program& ProgramCache::get(const ProgramText& text, const std::vector<std::string>& untouched) {
  std::string key = text.vertex + '\0' + text.fragment + '\0' + text.compute;
  for (const std::string& name : untouched) key += '\0' + name;
  if (const auto found = programs_.find(key); found != programs_.end()) return *found->second;
  auto program = std::make_unique<Program>(gl_, text);
  if (programs_.size() >= kMostPrograms) programs_.clear();
  return *(programs_[key] = std::move(program));
}

}  // namespace twinshade::gl

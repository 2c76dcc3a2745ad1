// Which function of shaders/exact/ stands for a built-in one, and the text that brings it in.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cpu_shaders/lint/glsl_type.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade::lint_detail {

// The functions that one rewritten shader needs.
class ExactFunctions {
 public:
  // written_out: / sqrt min max clamp as shaders/exact/written_out.glsl has them, and no other built-in functions.
  explicit ExactFunctions(bool written_out = false) : written_out_(written_out) {}

  static bool is_written_out(std::string_view builtin);

  // Name to call instead of a built-in function; empty where there is none. Argument types: after conversion to float.
  std::string function(std::string_view builtin, const std::vector<GlslType>& arguments);
  // Name to call instead of an operator: "+" gives exact_add; written out, written_add.
  std::string arithmetic(std::string_view op, const GlslType& left, const GlslType& right);
  // x op= y as a call whose first argument is inout, where x may not be written twice. postfix: gives the old value.
  std::string assignment(std::string_view op, const GlslType& target, const GlslType& value, bool postfix);
  // The same of v[i] with v, i and x as arguments, "=" too.
  std::string component_assignment(const std::string& op, const GlslType& vector, bool postfix);
  std::string with_component();                  // v, index, value: v with one component replaced
  std::string diagonal(const GlslType& matrix);  // a matrix of one scalar, and zero
  std::string unseen(const GlslType& type);      // value, zero: the value, unknown to compilers

  bool empty() const { return files_.empty(); }

  // A file of shaders/exact/ that the shader includes itself.
  void include(const std::string& file) { files_.insert(file); }

  // Definitions with #line, to stand before the text of `source`; adds their files to its.
  std::string text(ShaderSource& source) const;

 private:
  std::string written_out(const std::string& name, const std::vector<GlslType>& arguments);
  std::string derivative(const std::string& builtin, const GlslType& type);

  bool written_out_;
  std::set<std::string> files_;
  std::set<std::string> generated_;
  std::set<std::string> generated_matrices_;  // call functions of generated_
};

// The file in messages of what ExactFunctions adds, but for the files of shaders/exact/ themselves.
inline constexpr const char* kExactFunctions = "exact functions";

// "dot" of a file of `source` that is "shaders/exact/dot.glsl" or a copy of it on disk; empty for other files.
std::string exact_file(const ShaderSource& source, const std::string& path);

// "vec3", "mat2x4", "float".
std::string type_text(const GlslType& type);

}  // namespace twinshade::lint_detail

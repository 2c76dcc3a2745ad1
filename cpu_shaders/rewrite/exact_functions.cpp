#include "cpu_shaders/rewrite/exact_functions.h"

#include <algorithm>

namespace twinshade::lint_detail {
namespace {

struct Entry {
  std::string_view builtin, exact, file;
  std::size_t arguments;
  bool componentwise;  // the file has it for scalars only
};

constexpr Entry kFunctions[] = {
    {"dot", "exact_dot", "dot", 2, false},
    {"length", "exact_length", "length", 1, false},
    {"distance", "exact_distance", "refract", 2, false},
    {"normalize", "exact_normalize", "normalize", 1, false},
    {"cross", "exact_cross", "cross", 2, false},
    {"reflect", "exact_reflect", "reflect", 2, false},
    {"refract", "exact_refract", "refract", 3, false},
    {"faceforward", "exact_faceforward", "refract", 3, false},
    {"mix", "exact_mix", "mix", 3, false},
    {"fract", "exact_fract", "fract", 1, false},
    {"mod", "exact_mod", "mod", 2, false},
    {"sqrt", "exact_sqrt", "rounding", 1, false},
    {"min", "exact_min", "rounding", 2, false},
    {"max", "exact_max", "rounding", 2, false},
    {"clamp", "exact_clamp", "rounding", 3, false},
    {"step", "exact_step", "rounding", 2, false},
    {"round", "exact_round", "rounding", 1, true},
    {"roundEven", "exact_round", "rounding", 1, true},
    {"sign", "exact_sign", "rounding", 1, true},
    {"isnan", "exact_isnan", "rounding", 1, true},
    {"isinf", "exact_isinf", "rounding", 1, true},
    {"smoothstep", "exact_smoothstep", "smoothstep", 3, true},
    {"sin", "exact_sin", "sin_cos", 1, true},
    {"cos", "exact_cos", "sin_cos", 1, true},
    {"tan", "exact_tan", "tan", 1, true},
    {"asin", "exact_asin", "acos", 1, true},
    {"acos", "exact_acos", "acos", 1, true},
    {"atan", "exact_atan", "tan", 1, true},
    {"atan", "exact_atan2", "atan2", 2, true},
    {"sinh", "exact_sinh", "exp", 1, true},
    {"cosh", "exact_cosh", "exp", 1, true},
    {"tanh", "exact_tanh", "exp", 1, true},
    {"pow", "exact_pow", "pow", 2, true},
    {"exp", "exact_exp", "exp", 1, true},
    {"log", "exact_log", "log", 1, true},
    {"exp2", "exact_exp2", "exp2", 1, true},
    {"log2", "exact_log2", "log2", 1, true},
    {"matrixCompMult", "exact_matrixCompMult", "matrix_operators", 2, false},
    {"outerProduct", "exact_outerProduct", "matrix_operators", 2, false},
    {"determinant", "exact_determinant", "matrix_operators", 1, false},
    {"inverse", "exact_inverse", "matrix_operators", 1, false},
};

std::string_view operator_name(std::string_view op) {
  switch (op[0]) {
    case '+':
      return "add";
    case '-':
      return "subtract";
    case '*':
      return "multiply";
    default:
      return "divide";
  }
}

// vec3 exact_pow(vec3 a, float b) { return vec3(exact_pow(a.x, b), exact_pow(a.y, b), exact_pow(a.z, b)); }
std::string by_component(const std::string& result, const std::string& name, const std::vector<GlslType>& arguments,
                         int rows) {
  std::string text = result + " " + name + "(";
  for (std::size_t a = 0; a < arguments.size(); ++a)
    text += (a > 0 ? ", " : "") + type_text(arguments[a]) + " " + "abc"[a];
  text += ") { return " + result + "(";
  for (int i = 0; i < rows; ++i) {
    text += (i > 0 ? ", " : "") + name + "(";
    for (std::size_t a = 0; a < arguments.size(); ++a) {
      text += (a > 0 ? ", " : "") + std::string(1, "abc"[a]);
      if (arguments[a].rows > 1) text += std::string(".") + "xyzw"[i];
    }
    text += ")";
  }
  return text + "); }";
}

// mat2 written_divide(mat2 a, float b) { return mat2(written_divide(a[0], b), written_divide(a[1], b)); }
std::string by_column(const GlslType& matrix, const std::string& name, const std::vector<GlslType>& arguments) {
  std::string text = type_text(matrix) + " " + name + "(" + type_text(arguments[0]) + " a, " + type_text(arguments[1]) +
                     " b) { return " + type_text(matrix) + "(";
  for (int i = 0; i < matrix.columns; ++i) {
    const std::string at = "[" + std::to_string(i) + "]";
    text += (i > 0 ? ", " : "") + name + "(a" + (arguments[0].columns > 1 ? at : "") + ", b" +
            (arguments[1].columns > 1 ? at : "") + ")";
  }
  return text + "); }";
}

// What a function does with one argument of type vecN and others scalar (max(v, 0.0), step(0.5, v) ...) is in its file.
int most_rows(const std::vector<GlslType>& arguments) {
  int rows = 1;
  for (const GlslType& argument : arguments) rows = std::max(rows, argument.rows);
  return rows;
}

}  // namespace

std::string exact_file(const ShaderSource& source, const std::string& path) {
  if (source.builtin_files.count(path) == 0) return "";
  const std::size_t folder = path.rfind("exact/"), ending = path.rfind(".glsl");
  if (folder == std::string::npos || ending == std::string::npos || ending + 5 != path.size()) return "";
  if (path.compare(folder, path.npos, "exact/fetch_colors.glsl") == 0) return "";  // what it is depends on its includer
  return path.substr(folder + 6, ending - folder - 6);
}

std::string type_text(const GlslType& type) {
  if (type.base != GlslType::Base::float32 || type.array_dimensions > 0) return "";
  const std::string rows = std::to_string(type.rows), columns = std::to_string(type.columns);
  if (type.columns > 1) return "mat" + columns + (type.columns == type.rows ? "" : "x" + rows);
  return type.rows > 1 ? "vec" + rows : "float";
}

// The function itself is for scalars: vectors and matrices call it for each component.
std::string ExactFunctions::written_out(const std::string& name, const std::vector<GlslType>& arguments) {
  files_.insert("written_out");
  const auto matrix =
      std::find_if(arguments.begin(), arguments.end(), [](const GlslType& argument) { return argument.columns > 1; });
  if (matrix != arguments.end()) {
    std::vector<GlslType> columns = arguments;
    for (GlslType& argument : columns) argument.columns = 1;
    written_out(name, columns);
    generated_matrices_.insert(by_column(*matrix, name, arguments));
  } else if (const int rows = most_rows(arguments); rows > 1) {
    generated_.insert(by_component("vec" + std::to_string(rows), name, arguments, rows));
  }
  return name;
}

bool ExactFunctions::is_written_out(std::string_view builtin) {
  return builtin == "sqrt" || builtin == "min" || builtin == "max" || builtin == "clamp";
}

std::string ExactFunctions::derivative(const std::string& builtin, const GlslType& type) {
  files_.insert("operators");
  const std::string name = "exact_" + builtin, kind = builtin.substr(std::string_view("fwidth").size());
  generated_.insert(type_text(type) + " " + name + "(" + type_text(type) + " a) { return exact_add(abs(dFdx" + kind +
                    "(a)), abs(dFdy" + kind + "(a))); }");
  return name;
}

std::string ExactFunctions::function(std::string_view builtin, const std::vector<GlslType>& arguments) {
  if (written_out_)
    return is_written_out(builtin) ? written_out("written_" + std::string(builtin), arguments) : std::string();
  if (builtin.starts_with("fwidth")) return derivative(std::string(builtin), arguments.at(0));
  if (builtin == "inversesqrt" || builtin == "radians" || builtin == "degrees" || builtin == "fma") {
    files_.insert("operators");
    if (builtin == "inversesqrt") files_.insert("rounding");
    const std::string name = "exact_" + std::string(builtin), type = type_text(arguments.at(0));
    std::string body;
    if (builtin == "inversesqrt") body = "exact_divide(1.0, exact_sqrt(a))";
    if (builtin == "radians") body = "exact_multiply(a, 0.0174532924)";  // pi / 180
    if (builtin == "degrees") body = "exact_multiply(a, 57.2957802)";    // 180 / pi
    if (builtin == "fma") body = "exact_add(exact_multiply(a, b), c)";
    const std::string more = builtin == "fma" ? ", " + type + " b, " + type + " c" : "";
    generated_.insert(type + " " + name + "(" + type + " a" + more + ") { return " + body + "; }");
    return name;
  }
  for (const Entry& entry : kFunctions) {
    if (entry.builtin != builtin || entry.arguments != arguments.size()) continue;
    files_.insert(std::string(entry.file));
    const int rows = most_rows(arguments);
    if (entry.componentwise && rows > 1) {
      const std::string result = builtin == "isnan" || builtin == "isinf" ? "bvec" : "vec";
      generated_.insert(by_component(result + std::to_string(rows), std::string(entry.exact), arguments, rows));
    }
    // a scalar has a direction and a length too
    if (rows == 1 && (builtin == "dot" || builtin == "length" || builtin == "distance" || builtin == "normalize" ||
                      builtin == "reflect" || builtin == "refract" || builtin == "faceforward"))
      return "";
    return std::string(entry.exact);
  }
  return "";
}

std::string ExactFunctions::arithmetic(std::string_view op, const GlslType& left, const GlslType& right) {
  if (written_out_) return written_out("written_" + std::string(operator_name(op)), {left, right});
  files_.insert("operators");
  if (left.columns > 1 || right.columns > 1) files_.insert("matrix_operators");
  return "exact_" + std::string(operator_name(op));
}

std::string ExactFunctions::assignment(std::string_view op, const GlslType& target, const GlslType& value,
                                       bool postfix) {
  const std::string name = arithmetic(op, target, value) + (postfix ? "_behind" : "_to");
  const std::string type = type_text(target);
  (target.columns > 1 ? generated_matrices_ : generated_)
      .insert(type + " " + name + "(inout " + type + " target, " + type_text(value) + " value) { " + type +
              " old = target; target = " + arithmetic(op, target, value) + "(old, value); return " +
              (postfix ? "old" : "target") + "; }");
  return name;
}

std::string ExactFunctions::component_assignment(const std::string& op, const GlslType& vector, bool postfix) {
  const bool computes = op != "=";
  const std::string name =
      with_component() + (computes ? "_" + std::string(operator_name(op)) : "") + (postfix ? "_behind" : "_to");
  std::string body;
  if (computes) {
    const GlslType component = element_type(vector);
    body = "float old = target[i]; value = " + arithmetic(op, component, component) + "(old, value); ";
  }
  generated_.insert("float " + name + "(inout " + type_text(vector) + " target, int i, float value) { " + body +
                    "target = exact_with(target, i, value); return " + (postfix ? "old" : "value") + "; }");
  return name;
}

std::string ExactFunctions::with_component() {
  files_.insert("operators");
  return "exact_with";
}

std::string ExactFunctions::diagonal(const GlslType& matrix) {
  files_.insert("matrix_operators");
  return "exact_diagonal_" + std::to_string(matrix.columns);
}

std::string ExactFunctions::unseen(const GlslType& type) {
  files_.insert(type.columns > 1 ? "matrix_operators" : "operators");
  return "exact_unseen";
}

std::string ExactFunctions::text(ShaderSource& source) const {
  std::string includes;
  for (const std::string& file : files_) includes += "#include \"exact/" + file + ".glsl\"\n";
  const ShaderSource prologue = resolve_shader("exact", includes, kExactFunctions);
  for (const std::string& file : prologue.files)
    if (std::find(source.files.begin(), source.files.end(), file) == source.files.end()) source.files.push_back(file);
  source.builtin_files.insert(prologue.builtin_files.begin(), prologue.builtin_files.end());
  std::string text = prologue.text + "\n";
  for (const std::string& function : generated_) text += function + "\n";
  for (const std::string& function : generated_matrices_) text += function + "\n";
  return text;
}

}  // namespace twinshade::lint_detail

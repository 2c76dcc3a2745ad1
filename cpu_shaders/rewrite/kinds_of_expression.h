// What make_exact tells apart in expressions.
#pragma once

#include <string>

#include "cpu_shaders/lint/expression.h"

namespace twinshade::lint_detail {

inline bool is_comparison(const std::string& op) {
  return op == "<" || op == ">" || op == "<=" || op == ">=" || op == "==" || op == "!=";
}

inline bool is_arithmetic(const std::string& op) { return op == "+" || op == "-" || op == "*" || op == "/"; }

inline bool is_integral(const GlslType& type) { return type.is_integer() || type.base == GlslType::Base::boolean; }

inline bool is_float(const GlslType& type) {
  return type.base == GlslType::Base::float32 && type.array_dimensions == 0;
}

inline GlslType as_float(GlslType type) {
  if (type.is_integer()) type.base = GlslType::Base::float32;
  return type;
}

inline bool is_zero_literal(const Expression& e) {
  return e.kind == Expression::Kind::literal && (e.type.is_integer() || e.type.is_floating()) && e.zeros.all;
}

// A square matrix of one scalar.
inline bool is_diagonal(const Expression& e) {
  return e.kind == Expression::Kind::construct && e.type.is_matrix() && e.type.columns == e.type.rows &&
         e.operands.size() == 1 && e.operands[0]->type.rows == 1 && e.operands[0]->type.columns == 1 && e.text != "{";
}

// A step of arithmetic with floats; what reads a float off the bits of an integer is none.
inline bool is_step(const Expression& e) {
  if (!is_float(e.type)) return false;
  if (e.kind == Expression::Kind::binary) return is_arithmetic(e.text);
  return e.kind == Expression::Kind::builtin && !e.text.starts_with("unpack") && !e.text.ends_with("BitsToFloat");
}

}  // namespace twinshade::lint_detail

#include "cpu_shaders/rewrite/constants.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace twinshade::lint_detail {
namespace {

using Kind = Expression::Kind;

std::set<std::string> names(const Expression& e) {
  std::set<std::string> all;
  if (e.kind == Kind::variable) all.insert(e.text);
  for (const ExpressionPtr& operand : e.operands) all.merge(names(*operand));
  return all;
}

}  // namespace

void NeededConstants::expression(const Expression& e, Role role) {
  if (role == Role::constant) return need(e);
  if (e.kind != Kind::declaration) return;
  if (needs_constant(e)) need(e);
  if (!e.const_token) return;
  std::set<std::string>& together = declared_together_[*e.const_token];
  made_of_[e.text].push_back(names(e));
  made_of_[e.text].push_back(together);
  for (const std::string& other : together) made_of_[other].push_back({e.text});
  if (std::any_of(together.begin(), together.end(), [this](const std::string& name) { return has(name); }))
    need(e.text);
  together.insert(e.text);
}

void NeededConstants::need(const Expression& e) {
  for (const std::string& name : names(e)) need(name);
}

void NeededConstants::need(const std::string& name) {
  if (!names_.insert(name).second) return;
  if (const auto found = made_of_.find(name); found != made_of_.end())
    for (const std::set<std::string>& parts : found->second)
      for (const std::string& part : parts) need(part);
}

void NonzeroConstants::declare(const Expression& declaration) {
  (is_nonzero(*declaration.operands[0]) ? names_ : others_).insert(declaration.text);
}

bool NonzeroConstants::is_nonzero(const Expression& e) const {
  if (e.kind == Kind::index) return e.type.is_floating() && is_nonzero(*e.operands[0]);
  if (!e.constant) return false;
  if (e.type.is_integer() && e.integer) return *e.integer != 0;
  switch (e.kind) {
    case Kind::literal:
      return e.type.is_floating() && std::isnormal(std::strtof(e.text.c_str(), nullptr));
    case Kind::variable:
      return has(e.text);
    case Kind::construct:
      // a matrix of one operand has zeros of its own
      if (e.type.is_integer() || (e.type.is_matrix() && e.operands.size() == 1)) return false;
      break;
    case Kind::unary:
    case Kind::member:
      return !e.operands.empty() && e.type.is_floating() && is_nonzero(*e.operands[0]);
    default:
      return false;
  }
  return std::all_of(e.operands.begin(), e.operands.end(), [&](const ExpressionPtr& o) { return is_nonzero(*o); });
}

}  // namespace twinshade::lint_detail

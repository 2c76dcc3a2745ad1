// Which constants of a shader must stay constants, and which are known not to be zero.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "cpu_shaders/lint/parser.h"

namespace twinshade::lint_detail {

// The constants that must stay constants, by name: those that array sizes, case labels, other constants than floats
// and initial values of uniforms are made of, and those that share a `const` with one of them.
class NeededConstants : public Listener {
 public:
  explicit NeededConstants(const TokenList& list) { Parser(list, *this).run(); }

  void expression(const Expression& e, Role role) override;
  bool has(const std::string& name) const { return names_.count(name) != 0; }

  static bool is_constant(const Expression& e) {
    return e.const_token && !e.operands.empty() && e.operands[0]->constant;
  }
  // Whether a declaration's value is asked to be a constant expression whatever reads it.
  static bool needs_constant(const Expression& e) {
    return e.is_uniform || (is_constant(e) && !e.type.is_floating() && e.type.base != GlslType::Base::structure);
  }

 private:
  void need(const Expression& e);
  void need(const std::string& name);

  std::set<std::string> names_;
  std::map<std::string, std::vector<std::set<std::string>>> made_of_;  // what they need in turn
  std::map<std::size_t, std::set<std::string>> declared_together_;     // by their `const`
};

// Constants none of whose components are zero, as far as that is seen without computing: literals, and what is put
// together of them.
class NonzeroConstants {
 public:
  // A declaration of a constant, in the order of the text. A name that is ever declared for another is not known.
  void declare(const Expression& declaration);
  bool has(const std::string& name) const { return names_.count(name) != 0 && others_.count(name) == 0; }
  bool is_nonzero(const Expression& e) const;

 private:
  std::set<std::string> names_, others_;
};

}  // namespace twinshade::lint_detail

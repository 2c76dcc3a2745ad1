// Shaders translated and compiled, each once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cpu_shaders/load/load.h"
#include "cpu_shaders/load/load_batch.h"
#include "cpu_shaders/translate/translate.h"
#include "evaluate/evaluator.h"

namespace twinshade {

class PreparedShaders {
 public:
  void prepare(std::span<const ShaderSource> shaders, std::span<const EvaluationTarget> targets,
               const Evaluator::Progress& progress);
  // UserError where it cannot be translated.
  const Translation& translation(const ShaderSource& shader);
  struct Code {
    const ShaderModule* module;
    const ShaderEntry* entry;
  };
  // UserError where it cannot be translated or compiled, or has no code for the number type.
  Code code(const ShaderSource& shader, Number number, std::optional<Isa> isa);
  void forget() { shaders_.clear(); }

 private:
  struct Shader {
    Translation translation;
    std::string error;  // instead of a translation
    std::map<Isa, std::vector<BatchModule>> modules;
  };
  Shader& translated(const ShaderSource& shader);
  void compile(const std::vector<Shader*>& shaders, Isa isa, std::uint32_t numbers,
               const Evaluator::Progress& progress);

  std::map<std::string, Shader> shaders_;  // by source_hash
};

}  // namespace twinshade

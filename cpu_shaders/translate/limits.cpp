#include "cpu_shaders/translate/limits.h"

#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/source_lines.h"

namespace twinshade {
namespace {

// Saturates: an array of arrays may have more numbers than a std::uint64_t.
std::uint64_t number_count(const spirv::Module& module, spirv::Id id) {
  constexpr std::uint64_t kMany = std::uint64_t{1} << 31;
  const spirv::Type& t = module.type(id);
  std::uint64_t sum = 0;
  switch (t.kind) {
    case spirv::Kind::vector:
    case spirv::Kind::matrix:
    case spirv::Kind::array:
      sum = t.count * number_count(module, t.element);
      break;
    case spirv::Kind::structure:
      for (const spirv::Id member : t.members) sum += number_count(module, member);
      break;
    default:
      sum = 1;
  }
  return std::min(sum, kMany);
}

}  // namespace

void refuse_large_text(const ShaderSource& source) {
  const std::string& text = source.text;
  if (text.size() > kMostText)
    throw UserError(source.files.at(0) + ": the shader has " + std::to_string(text.size()) +
                    " bytes with its includes: at most " + std::to_string(kMostText) + " are allowed");
  int depth = 0;
  bool line_comment = false, block_comment = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at], next = at + 1 < text.size() ? text[at + 1] : '\0';
    if (c == '\n') line_comment = false;
    if (line_comment || (block_comment && !(c == '*' && next == '/'))) continue;
    if (block_comment) {
      block_comment = false, ++at;
    } else if (c == '/' && (next == '/' || next == '*')) {
      line_comment = next == '/', block_comment = next == '*', ++at;
    } else if (c == '(' || c == '[' || c == '{') {
      if (++depth > kMostNesting) {
        ShaderSource until = source;
        until.text.resize(at + 1);
        throw UserError(SourceLines(until).last().text() + ": brackets are nested more than " +
                        std::to_string(kMostNesting) + " deep");
      }
    } else if (c == ')' || c == ']' || c == '}') {
      --depth;
    }
  }
}

void refuse_large_variables(const spirv::Program& program, const SourceLines& lines) {
  const spirv::Module& module = program.module;
  std::uint64_t sum = 0;
  const auto add = [&](spirv::Id id, const Position& position) {
    const std::uint64_t count = number_count(module, module.variables.at(id).type);
    sum += count;
    if (sum > kMostNumbers)
      throw UserError(position.text() + ": " + (module.name(id).empty() ? "a value" : module.name(id)) + " has " +
                      std::to_string(count) + " numbers, and the variables of a shader at most " +
                      std::to_string(kMostNumbers) + " together: put large tables into a texture or a buffer");
  };
  for (const spirv::Id id : module.globals) {
    const spv::StorageClass storage = module.variables.at(id).storage;
    if (storage == spv::StorageClassPrivate || storage == spv::StorageClassOutput || storage == spv::StorageClassInput)
      add(id, lines.declaration(module.name(id)));
  }
  for (const spirv::Id function : program.callees_first) {
    const spirv::FunctionInfo& info = program.info(function);
    for (const spirv::Id local : info.locals)
      if (!info.constant_tables.count(local)) add(local, module.position(info.function->file, info.function->line));
  }
}

}  // namespace twinshade

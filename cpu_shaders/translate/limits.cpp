#include "cpu_shaders/translate/limits.h"

#include <algorithm>
#include <map>
#include <string>

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

// Of variables, what is worth putting elsewhere than into a variable.
constexpr std::uint64_t kLargeTable = 1024;

struct Largest {
  std::string name;
  Position position;
  std::uint64_t count = 0;

  bool is_less(std::uint64_t other) const { return name.empty() || count < other; }
};

// A variable of a function that takes room in the result.
bool is_kept(const spirv::FunctionInfo& info, spirv::Id local) {
  return info.constant_tables.count(local) == 0 && info.argument_temporaries.count(local) == 0;
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
  std::uint64_t globals = 0;
  Largest variable;
  for (const spirv::Id id : module.globals) {
    const spv::StorageClass storage = module.variables.at(id).storage;
    if (storage != spv::StorageClassPrivate && storage != spv::StorageClassOutput && storage != spv::StorageClassInput)
      continue;
    const std::uint64_t count = number_count(module, module.variables.at(id).type);
    globals += count;
    if (variable.is_less(count)) variable = {module.name(id), lines.declaration(module.name(id)), count};
  }

  // Those of functions that do not call each other take the same place one after another.
  struct Calls {
    std::uint64_t own = 0, all = 0;  // numbers of the function, and with the most that it calls
    const Calls* most = nullptr;     // the call that needs the most
    const spirv::FunctionInfo* info = nullptr;
  };
  std::map<spirv::Id, Calls> functions;
  const Calls* main = nullptr;
  for (const spirv::Id id : program.callees_first) {
    Calls& calls = functions[id];
    calls.info = &program.info(id);
    for (const spirv::Id local : calls.info->locals)
      if (is_kept(*calls.info, local)) calls.own += number_count(module, module.variables.at(local).type);
    for_each_instruction(calls.info->body.list, [&](const spirv::Instruction& i) {
      if (i.op != spv::OpFunctionCall) return;
      const Calls& callee = functions.at(i.operands[0]);
      if (calls.most == nullptr || callee.all > calls.most->all) calls.most = &callee;
    });
    calls.all = calls.own + (calls.most != nullptr ? calls.most->all : 0);
    main = &calls;
  }
  if (globals + main->all <= kMostNumbers) return;

  Largest function;
  for (const Calls* calls = main; calls != nullptr; calls = calls->most) {
    const spirv::FunctionInfo& info = *calls->info;
    const Position position = module.position(info.function->file, info.function->line);
    if (function.is_less(calls->own)) function = {info.function->name, position, calls->own};
    for (const spirv::Id local : info.locals) {
      const std::uint64_t count = number_count(module, module.variables.at(local).type);
      const bool has_name = !module.name(local).empty() && info.parameter_of.count(local) == 0;
      if (is_kept(info, local) && has_name && variable.is_less(count)) variable = {module.name(local), position, count};
    }
  }
  const std::string most = " numbers, and the variables of a shader at most " + std::to_string(kMostNumbers);
  if (variable.count >= kLargeTable)
    throw UserError(variable.position.text() + ": " + variable.name + " has " + std::to_string(variable.count) + most +
                    " together: put large tables into a texture or a buffer");
  if (globals > main->all)
    throw UserError(variable.position.text() + ": the global variables have " + std::to_string(globals) + most +
                    " together: use fewer or smaller ones; " + variable.name + " is the largest");
  throw UserError(function.position.text() + ": the variables of " + function.name + " have " +
                  std::to_string(function.count) + most + ", of functions that call each other (" +
                  std::to_string(globals + main->all) + " here): use fewer or smaller ones");
}

}  // namespace twinshade

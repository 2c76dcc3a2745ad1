#include "tests/fuzz/spirv_interpreter.h"

#include <algorithm>

namespace twinshade::fuzz {

Interpreter::Interpreter(const std::vector<std::uint32_t>& spirv)
    : program_(read_program(spirv)), values_(program_.bound), variables_(program_.bound), pointers_(program_.bound) {}

Invocation Interpreter::run(const std::map<std::string, Words>& values, std::uint64_t most_steps) {
  steps_ = 0;
  most_steps_ = most_steps;
  for (const Instruction& variable : program_.globals) {
    declare(variable);
    if (program_.types[variable.type].storage == spv::StorageClassOutput) continue;
    if (const auto given = values.find(program_.names[variable.result]); given != values.end())
      std::copy_n(given->second.begin(), std::min(given->second.size(), variables_[variable.result].size()),
                  variables_[variable.result].begin());
  }
  Invocation invocation;
  try {
    call(program_.entry, {});
  } catch (const Discarded&) {
    invocation.discarded = true;
  }
  invocation.steps = steps_;
  if (invocation.discarded) return invocation;
  for (const Instruction& variable : program_.globals)
    if (program_.types[variable.type].storage == spv::StorageClassOutput)
      invocation.outputs[program_.names[variable.result]] = variables_[variable.result];
  return invocation;
}

void Interpreter::declare(const Instruction& variable) {
  Words& words = variables_[variable.result];
  if (variable.operands.size() > 1)
    words = value(variable.operands[1]);
  else
    words.assign(program_.types[program_.types[variable.type].parts[0]].words, 0);
  pointers_[variable.result] = {&words, 0};
}

Words Interpreter::call(Id id, const std::vector<std::uint32_t>& arguments) {
  const Function& function = program_.functions.at(id);
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (program_.type_of(arguments[k]).op == spv::OpTypePointer)
      pointers_[function.parameters[k]] = pointers_[arguments[k]];
    else
      values_[function.parameters[k]] = value(arguments[k]);
  }
  Id block = 0, previous = 0;
  for (std::size_t at = 0;;) {
    const Instruction& i = function.code.at(at++);
    if (++steps_ > most_steps_) throw CannotInterpret("too many steps");
    const auto jump = [&](Id label) {
      previous = block;
      at = program_.labels.at(label);
    };
    switch (i.op) {
      case spv::OpLabel:
        block = i.result;
        break;
      case spv::OpSelectionMerge:
      case spv::OpLoopMerge:
      case spv::OpNop:
        break;
      case spv::OpPhi:
        for (std::size_t k = 0; k < i.operands.size(); k += 2)
          if (i.operands[k + 1] == previous) values_[i.result] = value(i.operands[k]);
        break;
      case spv::OpBranch:
        jump(i.operands[0]);
        break;
      case spv::OpBranchConditional:
        jump(value(i.operands[0])[0] != 0 ? i.operands[1] : i.operands[2]);
        break;
      case spv::OpSwitch: {
        Id target = i.operands[1];
        for (std::size_t k = 2; k < i.operands.size(); k += 2)
          if (i.operands[k] == value(i.operands[0])[0]) target = i.operands[k + 1];
        jump(target);
        break;
      }
      case spv::OpFunctionCall:
        values_[i.result] = call(i.operands[0], {i.operands.begin() + 1, i.operands.end()});
        break;
      case spv::OpReturn:
        return {};
      case spv::OpReturnValue:
        return value(i.operands[0]);
      case spv::OpKill:
        throw Discarded();
      default:
        execute(i);
    }
  }
}

void Interpreter::execute(const Instruction& i) {
  if (i.op == spv::OpExtInst) return extended(i);
  if (!memory(i) && !composite(i) && !arithmetic(i))
    throw CannotInterpret("SPIR-V instruction " + std::to_string(i.op));
}

// Where part `index` of a composite starts, and its type. Out of range: the nearest, as the runtime indexes.
std::pair<std::size_t, Id> Interpreter::part(Id type, std::uint32_t index) const {
  const Type& t = program_.types[type];
  if (t.op == spv::OpTypeStruct) {
    std::size_t offset = 0;
    for (std::uint32_t k = 0; k < index; ++k) offset += program_.types[t.parts[k]].words;
    return {offset, t.parts[index]};
  }
  const auto clamped = static_cast<std::uint32_t>(
      std::clamp(static_cast<std::int32_t>(index), 0, static_cast<std::int32_t>(t.count) - 1));
  return {std::size_t{clamped} * program_.types[t.parts[0]].words, t.parts[0]};
}

bool Interpreter::memory(const Instruction& i) {
  switch (i.op) {
    case spv::OpVariable:
      declare(i);
      return true;
    case spv::OpAccessChain: {
      Pointer pointer = pointers_[i.operands[0]];
      Id type = program_.type_of(i.operands[0]).parts[0];
      for (std::size_t k = 1; k < i.operands.size(); ++k) {
        const auto [offset, element] = part(type, value(i.operands[k])[0]);
        pointer.offset += offset;
        type = element;
      }
      pointers_[i.result] = pointer;
      return true;
    }
    case spv::OpLoad: {
      const Pointer& from = pointers_[i.operands[0]];
      const auto first = from.words->begin() + static_cast<std::ptrdiff_t>(from.offset);
      values_[i.result].assign(first, first + program_.types[i.type].words);
      return true;
    }
    case spv::OpStore: {
      const Pointer& to = pointers_[i.operands[0]];
      const Words& stored = value(i.operands[1]);
      std::copy(stored.begin(), stored.end(), to.words->begin() + static_cast<std::ptrdiff_t>(to.offset));
      return true;
    }
    default:
      return false;
  }
}

bool Interpreter::composite(const Instruction& i) {
  Words& result = values_[i.result];
  const auto locate = [&](Id type, std::size_t first_index) {
    std::pair<std::size_t, Id> at{0, type};
    for (std::size_t k = first_index; k < i.operands.size(); ++k) {
      const auto [offset, element] = part(at.second, i.operands[k]);
      at = {at.first + offset, element};
    }
    return at;
  };
  switch (i.op) {
    case spv::OpUndef:
      result.assign(program_.types[i.type].words, 0);
      return true;
    case spv::OpCompositeConstruct: {
      Words all;
      for (const Id id : i.operands) all.insert(all.end(), value(id).begin(), value(id).end());
      result = std::move(all);
      return true;
    }
    case spv::OpCompositeExtract: {
      const auto [offset, type] = locate(program_.value_types[i.operands[0]], 1);
      const auto first = value(i.operands[0]).begin() + static_cast<std::ptrdiff_t>(offset);
      result.assign(first, first + program_.types[type].words);
      return true;
    }
    case spv::OpCompositeInsert: {
      const auto [offset, type] = locate(i.type, 2);
      result = value(i.operands[1]);
      std::copy(value(i.operands[0]).begin(), value(i.operands[0]).end(),
                result.begin() + static_cast<std::ptrdiff_t>(offset));
      return true;
    }
    case spv::OpVectorShuffle: {
      Words all = value(i.operands[0]);
      all.insert(all.end(), value(i.operands[1]).begin(), value(i.operands[1]).end());
      result.clear();
      for (std::size_t k = 2; k < i.operands.size(); ++k)
        result.push_back(i.operands[k] == ~0u ? 0 : all.at(i.operands[k]));
      return true;
    }
    case spv::OpVectorExtractDynamic:
      result = {value(i.operands[0])[part(program_.value_types[i.operands[0]], value(i.operands[1])[0]).first]};
      return true;
    case spv::OpVectorInsertDynamic: {
      Words changed = value(i.operands[0]);
      changed[part(i.type, value(i.operands[2])[0]).first] = value(i.operands[1])[0];
      result = std::move(changed);
      return true;
    }
    case spv::OpTranspose: {
      const Words& m = value(i.operands[0]);
      const std::size_t columns = program_.types[i.type].count, rows = m.size() / columns;
      Words turned;
      for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t r = 0; r < rows; ++r) turned.push_back(m[r * columns + c]);
      result = std::move(turned);
      return true;
    }
    case spv::OpSelect: {
      const Words chosen = value(i.operands[0]);
      Words picked = value(i.operands[1]);
      for (std::size_t k = 0; k < picked.size(); ++k)
        if (chosen[chosen.size() == 1 ? 0 : k] == 0) picked[k] = value(i.operands[2])[k];
      result = std::move(picked);
      return true;
    }
    case spv::OpAny:
    case spv::OpAll: {
      const Words& x = value(i.operands[0]);
      const auto set = std::count(x.begin(), x.end(), 1u);
      result = {i.op == spv::OpAny ? set > 0 : set == static_cast<std::ptrdiff_t>(x.size())};
      return true;
    }
    default:
      return false;
  }
}

// Component by component; bit field offsets and counts, and the scalar of a product, serve all components.
bool Interpreter::arithmetic(const Instruction& i) {
  spv::Op op = i.op;
  if (op == spv::OpVectorTimesScalar || op == spv::OpMatrixTimesScalar) op = spv::OpFMul;
  const std::size_t words = program_.types[i.type].words;
  Words computed(words);
  for (std::size_t k = 0; k < words; ++k) {
    std::uint32_t x[4] = {};
    for (std::size_t n = 0; n < std::min<std::size_t>(i.operands.size(), 4); ++n) {
      const Words& operand = value(i.operands[n]);
      x[n] = operand.at(operand.size() == 1 ? 0 : k);
    }
    if (!scalar_operation(op, x, i.operands.size(), computed[k])) return false;
  }
  values_[i.result] = std::move(computed);
  return true;
}

void Interpreter::extended(const Instruction& i) {
  const std::size_t words = program_.types[i.type].words;
  Words computed(words);
  for (std::size_t k = 0; k < words; ++k) {
    std::uint32_t x[3] = {};
    for (std::size_t n = 2; n < std::min<std::size_t>(i.operands.size(), 5); ++n) x[n - 2] = value(i.operands[n]).at(k);
    if (!extended_scalar(i.operands[1], x, computed[k]))
      throw CannotInterpret("GLSL.std.450 function " + std::to_string(i.operands[1]));
  }
  values_[i.result] = std::move(computed);
}

}  // namespace twinshade::fuzz

#include "tests/fuzz/spirv_program.h"

#include <cstring>
#include <stdexcept>

namespace twinshade::fuzz {
namespace {

// Whether an instruction has a result type and a result, in that order before its operands.
std::pair<bool, bool> type_and_result(spv::Op op) {
  switch (op) {
    case spv::OpLabel:
    case spv::OpString:
    case spv::OpExtInstImport:
      return {false, true};
    case spv::OpStore:
    case spv::OpCopyMemory:
    case spv::OpBranch:
    case spv::OpBranchConditional:
    case spv::OpSwitch:
    case spv::OpReturn:
    case spv::OpReturnValue:
    case spv::OpKill:
    case spv::OpUnreachable:
    case spv::OpSelectionMerge:
    case spv::OpLoopMerge:
    case spv::OpFunctionEnd:
    case spv::OpName:
    case spv::OpMemberName:
    case spv::OpDecorate:
    case spv::OpMemberDecorate:
    case spv::OpLine:
    case spv::OpNoLine:
    case spv::OpNop:
    case spv::OpEntryPoint:
    case spv::OpExecutionMode:
    case spv::OpMemoryModel:
    case spv::OpCapability:
    case spv::OpExtension:
    case spv::OpSource:
    case spv::OpSourceExtension:
    case spv::OpModuleProcessed:
      return {false, false};
    default:
      return op >= spv::OpTypeVoid && op <= spv::OpTypeFunction ? std::pair{false, true} : std::pair{true, true};
  }
}

std::string string_at(const std::vector<std::uint32_t>& operands, std::size_t first) {
  const char* text = reinterpret_cast<const char*>(operands.data() + first);
  return {text, strnlen(text, (operands.size() - first) * 4)};
}

void read_type(Program& program, const Instruction& i) {
  Type type;
  type.op = i.op;
  switch (i.op) {
    case spv::OpTypeInt:
      type.is_signed = i.operands[1] != 0;
      [[fallthrough]];
    case spv::OpTypeFloat:
      if (i.operands[0] != 32) throw std::runtime_error("numbers of other than 32 bits");
      [[fallthrough]];
    case spv::OpTypeBool:
      type.words = 1;
      break;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
    case spv::OpTypeArray:
      type.parts = {i.operands[0]};
      type.count = i.op == spv::OpTypeArray ? program.constants[i.operands[1]].at(0) : i.operands[1];
      type.words = type.count * program.types[i.operands[0]].words;
      break;
    case spv::OpTypeStruct:
      type.parts = i.operands;
      type.count = static_cast<std::uint32_t>(i.operands.size());
      for (const Id member : i.operands) type.words += program.types[member].words;
      break;
    case spv::OpTypePointer:
      type.storage = static_cast<spv::StorageClass>(i.operands[0]);
      type.parts = {i.operands[1]};
      break;
    default:
      break;
  }
  program.types[i.result] = type;
}

void read_constant(Program& program, const Instruction& i) {
  Words& words = program.constants[i.result];
  switch (i.op) {
    case spv::OpConstant:
      words = i.operands;
      break;
    case spv::OpConstantTrue:
      words = {1};
      break;
    case spv::OpConstantComposite:
      for (const Id part : i.operands)
        words.insert(words.end(), program.constants[part].begin(), program.constants[part].end());
      break;
    default:  // false, null, undefined
      words.assign(program.types[i.type].words, 0);
  }
}

}  // namespace

const Type& Program::scalar_of(Id type) const {
  while (!types[type].parts.empty()) type = types[type].parts[0];
  return types[type];
}

Program read_program(const std::vector<std::uint32_t>& words) {
  if (words.size() < 5 || words[0] != spv::MagicNumber) throw std::runtime_error("not SPIR-V");
  Program program;
  program.bound = words[3];
  program.types.resize(program.bound);
  program.constants.resize(program.bound);
  program.value_types.resize(program.bound);
  Function* function = nullptr;
  for (std::size_t at = 5; at < words.size();) {
    const std::size_t length = words[at] >> 16;
    if (length == 0 || at + length > words.size()) throw std::runtime_error("truncated SPIR-V");
    Instruction i;
    i.op = static_cast<spv::Op>(words[at] & 0xffff);
    std::size_t next = at + 1;
    const auto [has_type, has_result] = type_and_result(i.op);
    if (has_type) i.type = words[next++];
    if (has_result) i.result = words[next++];
    i.operands.assign(words.begin() + static_cast<std::ptrdiff_t>(next),
                      words.begin() + static_cast<std::ptrdiff_t>(at + length));
    at += length;
    if (i.result != 0) program.value_types[i.result] = i.type;
    if (i.op == spv::OpEntryPoint) program.entry = i.operands[1];
    if (i.op == spv::OpName) program.names[i.operands[0]] = string_at(i.operands, 1);
    if (i.op >= spv::OpTypeVoid && i.op <= spv::OpTypeFunction) {
      read_type(program, i);
    } else if (i.op >= spv::OpConstantTrue && i.op <= spv::OpConstantNull) {
      read_constant(program, i);
    } else if (i.op == spv::OpUndef && function == nullptr) {
      read_constant(program, i);
    } else if (i.op == spv::OpFunction) {
      function = &program.functions[i.result];
    } else if (i.op == spv::OpFunctionParameter) {
      function->parameters.push_back(i.result);
    } else if (i.op == spv::OpFunctionEnd) {
      function = nullptr;
    } else if (function != nullptr) {
      if (i.op == spv::OpLabel) program.labels[i.result] = function->code.size();
      if (i.op != spv::OpLine && i.op != spv::OpNoLine) function->code.push_back(i);
    } else if (i.op == spv::OpVariable) {
      program.globals.push_back(i);
    }
  }
  return program;
}

}  // namespace twinshade::fuzz

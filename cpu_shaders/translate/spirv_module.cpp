#include "cpu_shaders/translate/spirv_module.h"

#include <glslang/SPIRV/doc.h>
#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace twinshade::spirv {
namespace {

std::string text_at(const std::vector<std::uint32_t>& words, std::size_t first, std::size_t last) {
  std::string text(reinterpret_cast<const char*>(&words[first]), (last - first) * 4);
  return text.substr(0, text.find('\0'));
}

class Parser {
 public:
  Parser(const std::vector<std::uint32_t>& words, const SourceLines& lines) : words_(words), lines_(lines) {}

  Module run() {
    module_.bound = word(3);
    for (std::size_t at = 5; at < words_.size();) {
      const std::size_t length = words_[at] >> 16;
      TWINSHADE_CHECK_LT(0u, length);
      TWINSHADE_CHECK_LE(at + length, words_.size());
      instruction(static_cast<spv::Op>(words_[at] & 0xffffu), at + 1, at + length);
      at += length;
    }
    return std::move(module_);
  }

 private:
  std::uint32_t word(std::size_t at) const { return words_.at(at); }

  void instruction(spv::Op op, std::size_t first, std::size_t last) {
    Module& m = module_;
    switch (op) {
      case spv::OpString:
        m.strings[word(first)] = text_at(words_, first + 1, last);
        return;
      case spv::OpName: {
        m.names[word(first)] = text_at(words_, first + 1, last);
        return;
      }
      case spv::OpExtInstImport:
        extended_sets_[word(first)] = text_at(words_, first + 1, last);
        return;
      case spv::OpMemberName:
        m.member_names[{word(first), word(first + 1)}] = text_at(words_, first + 2, last);
        return;
      case spv::OpDecorate:
        m.decorations[word(first)].values[static_cast<spv::Decoration>(word(first + 1))] =
            first + 2 < last ? word(first + 2) : 0;
        return;
      case spv::OpMemberDecorate:
        m.member_decorations[{word(first), word(first + 1)}].values[static_cast<spv::Decoration>(word(first + 2))] =
            first + 3 < last ? word(first + 3) : 0;
        return;
      case spv::OpEntryPoint:
        m.entry = word(first + 1);
        return;
      case spv::OpExecutionMode:
        if (word(first + 1) == spv::ExecutionModeDepthReplacing) m.depth_replacing = true;
        if (word(first + 1) == spv::ExecutionModeEarlyFragmentTests) m.early_tests = true;
        if (word(first + 1) == spv::ExecutionModeOriginUpperLeft ||
            word(first + 1) == spv::ExecutionModePixelCenterInteger)
          m.other_frag_coord = true;
        for (std::size_t k = 0; word(first + 1) == spv::ExecutionModeLocalSize && k < 3; ++k)
          m.local_size[k] = word(first + 2 + k);
        return;
      case spv::OpLine:
        file_ = word(first);
        line_ = static_cast<int>(word(first + 1));
        return;
      case spv::OpNoLine:
      case spv::OpSource:
      case spv::OpSourceExtension:
      case spv::OpSourceContinued:
      case spv::OpModuleProcessed:
      case spv::OpCapability:
      case spv::OpExtension:
      case spv::OpMemoryModel:
      case spv::OpNop:
        return;
      default:
        break;
    }
    if (type_declaration(op, first, last) || constant(op, first, last)) return;
    function_part(op, first, last);
  }

  bool type_declaration(spv::Op op, std::size_t first, std::size_t last) {
    Type t;
    switch (op) {
      case spv::OpTypeVoid:
      case spv::OpTypeFunction:
        break;
      case spv::OpTypeBool:
        t.kind = Kind::boolean;
        break;
      case spv::OpTypeInt:
        if (word(first + 1) != 32)
          throw UserError(lines_.mention({"int64_t", "uint64_t", "int16_t", "uint16_t", "int8_t", "uint8_t"}).text() +
                          ": integers of other than 32 bits are not supported: write int or uint");
        t.kind = word(first + 2) != 0 ? Kind::integer : Kind::unsigned_integer;
        break;
      case spv::OpTypeFloat:
        if (word(first + 1) != 32) {
          // Types have no position of their own.
          const Position where = lines_.mention(
              {"double", "dvec2", "dvec3", "dvec4", "dmat2", "dmat3", "dmat4", "float16_t", "float64_t"});
          throw UserError(where.text() +
                          ": floating-point types other than float are not supported: write float (the float64 "
                          "build evaluates the same shader in double)");
        }
        t.kind = Kind::real;
        break;
      case spv::OpTypeVector:
        t.kind = Kind::vector;
        t.element = word(first + 1);
        t.count = word(first + 2);
        break;
      case spv::OpTypeMatrix:
        t.kind = Kind::matrix;
        t.element = word(first + 1);
        t.count = word(first + 2);
        break;
      case spv::OpTypeArray:
        t.kind = Kind::array;
        t.element = word(first + 1);
        t.count = module_.constants.at(word(first + 2)).bits;
        break;
      case spv::OpTypeRuntimeArray:
        t.kind = Kind::runtime_array;
        t.element = word(first + 1);
        break;
      case spv::OpTypeStruct:
        t.kind = Kind::structure;
        for (std::size_t i = first + 1; i < last; ++i) t.members.push_back(word(i));
        break;
      case spv::OpTypePointer:
        t.kind = Kind::pointer;
        t.storage = static_cast<spv::StorageClass>(word(first + 1));
        t.element = word(first + 2);
        break;
      case spv::OpTypeImage:
        t.kind = Kind::image;
        t.element = word(first + 1);
        t.dimension = static_cast<spv::Dim>(word(first + 2));
        t.depth = word(first + 3) == 1;
        t.arrayed = word(first + 4) != 0;
        t.multisampled = word(first + 5) != 0;
        t.storage_image = word(first + 6) == 2;
        break;
      case spv::OpTypeSampledImage:
        t.kind = Kind::sampler;
        t.element = word(first + 1);
        break;
      default:
        return false;
    }
    module_.types[word(first)] = t;
    return true;
  }

  bool constant(spv::Op op, std::size_t first, std::size_t last) {
    Constant c;
    switch (op) {
      case spv::OpConstantTrue:
        c.bits = 1;
        break;
      case spv::OpConstantFalse:
        break;
      case spv::OpConstant:
        c.bits = word(first + 2);
        break;
      case spv::OpConstantComposite:
        for (std::size_t i = first + 2; i < last; ++i) c.components.push_back(word(i));
        break;
      case spv::OpConstantNull:
        break;  // zero of its type: no components
      case spv::OpSpecConstant:
      case spv::OpSpecConstantTrue:
      case spv::OpSpecConstantFalse:
      case spv::OpSpecConstantComposite:
      case spv::OpSpecConstantOp:
        throw UserError(lines_.mention({"constant_id"}).text() +
                        ": specialisation constants (constant_id) are not supported: write a const");
      default:
        return false;
    }
    c.type = word(first);
    module_.constants[word(first + 1)] = c;
    module_.value_types[word(first + 1)] = c.type;
    return true;
  }

  void function_part(spv::Op op, std::size_t first, std::size_t last) {
    switch (op) {
      case spv::OpFunction: {
        Function f;
        f.result_type = word(first);
        f.id = word(first + 1);
        const std::string mangled = module_.name(f.id);
        f.name = mangled.substr(0, mangled.find('('));
        f.file = file_;
        f.line = line_;
        module_.functions.push_back(f);
        in_function_ = true;
        return;
      }
      case spv::OpFunctionParameter:
        module_.functions.back().parameters.push_back({word(first + 1), word(first)});
        module_.value_types[word(first + 1)] = word(first);
        return;
      case spv::OpFunctionEnd:
        in_function_ = false;
        return;
      case spv::OpLabel:
        module_.functions.back().blocks.emplace_back();
        module_.functions.back().blocks.back().label = word(first);
        return;
      case spv::OpVariable: {
        Variable v;
        v.id = word(first + 1);
        v.type = module_.type(word(first)).element;
        v.storage = static_cast<spv::StorageClass>(word(first + 2));
        v.initializer = first + 3 < last ? word(first + 3) : 0;
        module_.variables[v.id] = v;
        module_.value_types[v.id] = word(first);
        if (!in_function_) module_.globals.push_back(v.id);
        return;
      }
      default:
        break;
    }
    if (!in_function_)
      throw UserError(here() + "SPIR-V instruction " + op_name(op) + " is not supported outside functions");
    Block& block = module_.functions.back().blocks.back();
    if (op == spv::OpSelectionMerge) {
      block.selection_merge = word(first);
      return;
    }
    if (op == spv::OpLoopMerge) {
      block.loop_merge = word(first);
      block.loop_continue = word(first + 1);
      return;
    }
    Instruction i;
    i.op = op;
    i.file = file_;
    i.line = line_;
    bool has_result = false, has_type = false;
    spv::HasResultAndType(op, &has_result, &has_type);
    std::size_t at = first;
    if (has_type) i.type = word(at++);
    if (has_result) i.result = word(at++);
    i.operands.assign(words_.begin() + static_cast<std::ptrdiff_t>(at),
                      words_.begin() + static_cast<std::ptrdiff_t>(last));
    if (i.result != 0) module_.value_types[i.result] = i.type;
    // Whoever looks at an extended instruction looks at its number alone.
    if (op == spv::OpExtInst && extended_sets_[i.operands.at(0)] != "GLSL.std.450")
      throw UserError(here() + "built-in functions of " + extended_sets_[i.operands[0]] +
                      " are not supported: of extensions none is translated, write it in other terms");
    switch (op) {
      case spv::OpPhi:
        block.phis.push_back(i);
        return;
      case spv::OpBranch:
      case spv::OpBranchConditional:
      case spv::OpSwitch:
      case spv::OpReturn:
      case spv::OpReturnValue:
      case spv::OpKill:
      case spv::OpUnreachable:
        block.terminator = i;
        return;
      default:
        block.code.push_back(i);
    }
  }

  std::string here() const { return line_ == 0 ? std::string() : module_.position(file_, line_).text() + ": "; }

  const std::vector<std::uint32_t>& words_;
  const SourceLines& lines_;
  Module module_;
  std::unordered_map<Id, std::string> extended_sets_;  // names of what is imported
  std::uint32_t file_ = 0;
  int line_ = 0;
  bool in_function_ = false;
};

}  // namespace

Module parse(const std::vector<std::uint32_t>& words, const SourceLines& lines) { return Parser(words, lines).run(); }

const Function* Module::function(Id id) const {
  for (const Function& f : functions)
    if (f.id == id) return &f;
  return nullptr;
}

std::string Module::name(Id id) const {
  const auto found = names.find(id);
  return found == names.end() ? std::string() : found->second;
}

Position Module::position(std::uint32_t file, int line) const {
  const auto found = strings.find(file);
  return {found == strings.end() ? std::string("shader") : found->second, line};
}

const Decorations& Module::decorations_of(Id id) const {
  static const Decorations none;
  const auto found = decorations.find(id);
  return found == decorations.end() ? none : found->second;
}

const Decorations& Module::member(Id structure, std::uint32_t index) const {
  static const Decorations none;
  const auto found = member_decorations.find({structure, index});
  return found == member_decorations.end() ? none : found->second;
}

std::vector<std::string> Module::element_suffixes(Id id) const {
  const Type& t = type(id);
  if (t.kind != Kind::array) return {""};
  std::vector<std::string> all;
  for (std::uint32_t k = 0; k < t.count; ++k)
    for (const std::string& rest : element_suffixes(t.element)) all.push_back("[" + std::to_string(k) + "]" + rest);
  return all;
}

std::uint32_t Module::component_count(Id id) const {
  const Type& t = type(id);
  switch (t.kind) {
    case Kind::vector:
    case Kind::matrix:
    case Kind::array:
      return t.count * component_count(t.element);
    case Kind::structure: {
      std::uint32_t sum = 0;
      for (Id member_type : t.members) sum += component_count(member_type);
      return sum;
    }
    default:
      return 1;
  }
}

Kind Module::scalar_kind(Id id) const {
  const Type& t = type(id);
  return t.kind == Kind::vector || t.kind == Kind::matrix || t.kind == Kind::array ? scalar_kind(t.element) : t.kind;
}

std::string op_name(spv::Op op) {
  // glslang's names lack the "Op", but for some of extensions.
  const std::string name = spv::OpcodeString(op);
  return name.rfind("Op", 0) == 0 ? name : "Op" + name;
}

std::vector<Id> value_operands(const Instruction& i) {
  const auto& o = i.operands;
  switch (i.op) {
    case spv::OpCompositeExtract:
      return {o[0]};
    case spv::OpCompositeInsert:
    case spv::OpVectorShuffle:
      return {o[0], o[1]};
    case spv::OpExtInst:
      return {o.begin() + 2, o.end()};
    case spv::OpFunctionCall:
      return {o.begin() + 1, o.end()};
    case spv::OpStore:
      return {o[0], o[1]};
    case spv::OpLoad:
    case spv::OpArrayLength:
      return {o[0]};
    case spv::OpImageSampleImplicitLod:
    case spv::OpImageSampleExplicitLod:
    case spv::OpImageSampleProjImplicitLod:
    case spv::OpImageSampleProjExplicitLod:
    case spv::OpImageFetch: {
      std::vector<Id> ids = {o[0], o[1]};
      if (o.size() > 3) ids.insert(ids.end(), o.begin() + 3, o.end());
      return ids;
    }
    case spv::OpImageGather: {
      std::vector<Id> ids = {o[0], o[1], o[2]};
      if (o.size() > 4) ids.insert(ids.end(), o.begin() + 4, o.end());
      return ids;
    }
    case spv::OpBranchConditional:
    case spv::OpSwitch:
    case spv::OpReturnValue:
      return {o[0]};
    case spv::OpBranch:
    case spv::OpReturn:
    case spv::OpKill:
    case spv::OpUnreachable:
    case spv::OpPhi:
      return {};
    default:
      return o;
  }
}

}  // namespace twinshade::spirv

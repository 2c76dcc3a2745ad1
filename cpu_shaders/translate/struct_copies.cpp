// A struct that a block holds is another type in SPIR-V than the same struct elsewhere: it has a layout, and uints for
// bools. glslang 12 writes the conversion out where one is assigned to the other, but not where ?: chooses between the
// two, and it compares a bool with the uint. What is missing is put in here, member by member.
#include "base/error.h"
#include "cpu_shaders/translate/function_info.h"

namespace twinshade::spirv {
namespace {

class StructCopies {
 public:
  StructCopies(Module& module, Function& function) : module_(module), function_(function) {}

  void run() {
    for (Block& block : function_.blocks) {
      std::vector<Instruction> before;
      before.swap(block.code);
      for (Instruction& i : before) {
        complete(block.code, i);
        block.code.push_back(std::move(i));
      }
      if (block.terminator.op == spv::OpReturnValue) convert(block.code, block.terminator, 0, function_.result_type);
    }
  }

 private:
  void complete(std::vector<Instruction>& code, Instruction& i) {
    switch (i.op) {
      case spv::OpStore:
        return convert(code, i, 1, module_.type_of(i.operands[0]).element);
      case spv::OpCompositeConstruct: {
        const Type& type = module_.type(i.type);
        if (type.kind != Kind::structure && type.kind != Kind::array) return;
        for (std::size_t k = 0; k < i.operands.size(); ++k)
          convert(code, i, k, type.kind == Kind::array ? type.element : type.members.at(k));
        return;
      }
      case spv::OpCompositeExtract:
        if (module_.types.count(i.type) == 0) refuse(i);
        return;
      case spv::OpIEqual:
      case spv::OpINotEqual:
        if (!is_bool(i.operands[0]) && !is_bool(i.operands[1])) return;
        i.op = i.op == spv::OpIEqual ? spv::OpLogicalEqual : spv::OpLogicalNotEqual;
        [[fallthrough]];
      case spv::OpLogicalEqual:
      case spv::OpLogicalNotEqual:
        for (Id& operand : i.operands)
          if (!is_bool(operand)) operand = as_bool(code, i, operand, i.type);
        return;
      default:
        return;
    }
  }

  bool is_bool(Id value) const { return module_.scalar_kind(module_.value_types.at(value)) == Kind::boolean; }

  // glslang takes components of a scalar.
  [[noreturn]] void refuse(const Instruction& i) const {
    throw UserError(module_.position(i).text() +
                    ": a struct of a block that has bools is not supported as a part of another value: assign it to a "
                    "variable first");
  }

  // Structs, and arrays of them, that are two types of one.
  bool differ(Id a, Id b) const {
    if (a == b) return false;
    const Type &x = module_.type(a), &y = module_.type(b);
    if (x.kind == Kind::array && y.kind == Kind::array) return x.count == y.count && differ(x.element, y.element);
    return x.kind == Kind::structure && y.kind == Kind::structure && x.members.size() == y.members.size();
  }

  void convert(std::vector<Instruction>& code, Instruction& i, std::size_t operand, Id type) {
    const Id from = module_.value_types.at(i.operands[operand]);
    if (differ(from, type)) i.operands[operand] = converted(code, i, i.operands[operand], from, type);
  }

  Id converted(std::vector<Instruction>& code, const Instruction& at, Id value, Id from, Id to) {
    if (from == to) return value;
    const Type &source = module_.type(from), &target = module_.type(to);
    if (module_.scalar_kind(from) == Kind::unsigned_integer && module_.scalar_kind(to) == Kind::boolean &&
        source.kind != Kind::array)
      return as_bool(code, at, value, to);
    if (source.kind != Kind::structure && source.kind != Kind::array) return value;
    std::vector<Id> parts;
    const std::uint32_t count =
        source.kind == Kind::array ? source.count : static_cast<std::uint32_t>(source.members.size());
    for (std::uint32_t k = 0; k < count; ++k) {
      const Id part_from = source.kind == Kind::array ? source.element : source.members[k];
      const Id part_to = target.kind == Kind::array ? target.element : target.members[k];
      const Id part = add(code, at, spv::OpCompositeExtract, part_from, {value, k});
      parts.push_back(converted(code, at, part, part_from, part_to));
    }
    return add(code, at, spv::OpCompositeConstruct, to, std::move(parts));
  }

  Id as_bool(std::vector<Instruction>& code, const Instruction& at, Id value, Id type) {
    return add(code, at, spv::OpINotEqual, type, {value, zero(module_.value_types.at(value))});
  }

  Id zero(Id type) {
    Constant constant;
    constant.type = type;
    if (const Type& t = module_.type(type); t.kind == Kind::vector)
      constant.components.assign(t.count, zero(t.element));
    const Id id = module_.new_id();
    module_.value_types[id] = type;
    module_.constants[id] = std::move(constant);
    return id;
  }

  Id add(std::vector<Instruction>& code, const Instruction& at, spv::Op op, Id type, std::vector<Id> operands) {
    Instruction i;
    i.op = op;
    i.type = type;
    i.result = module_.new_id();
    i.operands = std::move(operands);
    i.file = at.file;
    i.line = at.line;
    module_.value_types[i.result] = type;
    code.push_back(std::move(i));
    return code.back().result;
  }

  Module& module_;
  Function& function_;
};

}  // namespace

void complete_struct_copies(Module& module, Function& function) { StructCopies(module, function).run(); }

}  // namespace twinshade::spirv

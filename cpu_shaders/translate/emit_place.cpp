// Memory: variables, parameters, inputs, uniforms and buffers, through access chains.
#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/emit_function.h"

namespace twinshade::spirv {
namespace {

// Arrays and structs out of buffers are put together leaf by leaf.
constexpr std::uint32_t kMostLeavesLoaded = 256;

}  // namespace

std::string FunctionEmitter::declare(Id variable, const std::string& wanted) {
  return variables_[variable] = names_.declare(wanted);
}

std::string FunctionEmitter::variable_name(Id variable) {
  const auto found = variables_.find(variable);
  if (found == variables_.end())
    throw UserError(module_.position(info_.function->file, info_.function->line).text() + ": variable " +
                    module_.name(variable) + " of " + info_.function->name +
                    " is used before it is declared: this is a fault of the translator");
  return found->second;
}

bool FunctionEmitter::holds_structure(Id type) const {
  const Type& t = module_.type(type);
  return t.kind == Kind::structure || (t.kind == Kind::array && holds_structure(t.element));
}

std::string FunctionEmitter::step_text(const std::string& base, const Step& s) {
  const Type& container = module_.type(s.container);
  switch (s.kind) {
    case Step::Kind::varying_index:
      // Structs are selected one from another: they must be varying first.
      if (container.kind == Kind::array && holds_structure(container.element))
        return "lookup(" + types_.name(s.container, true) + "(" + base + "), " + s.text + ")";
      return "lookup(" + base + ", " + s.text + ")";
    case Step::Kind::uniform_index:
      return base + "[" + s.text + "]";
    default:
      break;
  }
  if (container.kind == Kind::structure) return base + "." + types_.member(s.container, s.index);
  if (container.kind == Kind::vector) return base + "." + "xyzw"[s.index];
  return base + "[" + std::to_string(s.index) + "]";
}

bool FunctionEmitter::is_block_array(Id type) const {
  if (module_.type(type).kind != Kind::array) return false;
  const Decorations& d = module_.decorations_of(module_.innermost(type));
  return d.has(spv::DecorationBlock) || d.has(spv::DecorationBufferBlock);
}

// Built-in inputs. There is one sample, at the pixel centre, one layer and one viewport.
std::string FunctionEmitter::builtin_text(const Global& g) {
  const std::uint32_t* size = module_.local_size;
  const std::string local_size =
      "<" + std::to_string(size[0]) + ", " + std::to_string(size[1]) + ", " + std::to_string(size[2]) + ">()";
  switch (g.builtin) {
    case spv::BuiltInFragCoord:
      return "frag_coord()";
    case spv::BuiltInFrontFacing:
      return "front_facing()";
    case spv::BuiltInPrimitiveId:
      return "primitive_id()";
    case spv::BuiltInHelperInvocation:
      return "!live()";
    case spv::BuiltInSamplePosition:
      return types_.name(g.type, true) + "(F(0.5f))";
    case spv::BuiltInSampleMask:
      return types_.name(g.type, true) + "{{I(1)}}";
    case spv::BuiltInNumWorkgroups:
      return "this->num_work_groups()";
    case spv::BuiltInWorkgroupId:
      return "this->work_group_id()";
    case spv::BuiltInLocalInvocationIndex:
      return "this->local_invocation_index()";
    case spv::BuiltInLocalInvocationId:
      return "this->template local_invocation_id" + local_size;
    case spv::BuiltInGlobalInvocationId:
      return "this->template global_invocation_id" + local_size;
    default:  // gl_SampleID, gl_Layer, gl_ViewportIndex
      return "I(0)";
  }
}

FunctionEmitter::Place FunctionEmitter::place(Id pointer) {
  std::vector<const Instruction*> chains;
  Id at = pointer;
  for (;;) {
    const auto found = info_.definitions.find(at);
    if (found == info_.definitions.end() || !found->second->is_chain()) break;
    chains.push_back(found->second);
    at = found->second->operands[0];
  }
  Place p;
  p.root = at;
  p.base.precedence = 1;
  p.type = module_.type_of(at).element;
  for (auto chain = chains.rbegin(); chain != chains.rend(); ++chain) {
    for (std::size_t k = 1; k < (*chain)->operands.size(); ++k) {
      const Id index = (*chain)->operands[k];
      const Type& t = module_.type(p.type);
      Step s;
      s.container = p.type;
      s.index_value = index;
      if (module_.is_constant(index)) {
        s.kind = t.kind == Kind::structure ? Step::Kind::member : Step::Kind::constant;
        s.index = module_.constants.at(index).bits;
        if (t.count != 0 && s.index >= t.count) s.index = t.count - 1;
        s.text = std::to_string(s.index);
      } else {
        if (at_.is_varying(index) && module_.scalar_kind(t.element) == Kind::sampler)
          refuse(**chain, "indexing samplers by a value that differs between invocations",
                 "use a sampler2DArray, or a switch");
        if (at_.is_varying(index) && is_block_array(p.type))
          refuse(**chain, "indexing blocks by a value that differs between invocations",
                 "use one block with an array in it, or a switch");
        s.kind = at_.is_varying(index) ? Step::Kind::varying_index : Step::Kind::uniform_index;
        const Expression e = value(index);
        s.text = e.text;
        p.base.reads.insert(e.reads.begin(), e.reads.end());
      }
      p.type = t.kind == Kind::structure ? t.members[s.index] : t.element;
      p.steps.push_back(s);
    }
  }

  const auto global = shared_.interface.globals.find(at);
  if (global == shared_.interface.globals.end()) {
    const auto table = shared_.tables.find({info_.function->id, at});
    if (table != shared_.tables.end()) {
      p.base.text = table->second;
      return p;
    }
    p.base.text = variable_name(at);
    p.base.reads.insert(at);
    return p;
  }
  const Global& g = global->second;
  switch (g.role) {
    case Role::input:
      // An element of an input array is loaded by itself.
      if (!p.steps.empty() && module_.type(g.type).kind == Kind::array && !holds_structure(g.type) &&
          p.steps[0].kind != Step::Kind::varying_index) {
        const bool constant = p.steps[0].kind == Step::Kind::constant;
        p.base.text = g.name + "(" + (constant ? "UI(" + p.steps[0].text + ")" : p.steps[0].text) + ")";
        p.steps.erase(p.steps.begin());
      } else {
        p.base.text = g.name + "()";
      }
      break;
    case Role::builtin:
      p.base.text = builtin_text(g);
      if (g.builtin == spv::BuiltInHelperInvocation) p.base.precedence = 3;
      break;
    case Role::output:
    case Role::frag_depth:
    case Role::global:
      p.base.text = g.name;
      p.base.reads.insert(at);
      break;
    case Role::buffer:
    case Role::shared:
      p.buffer = &g;
      p.base.text = g.name;
      while (!p.steps.empty() && is_block_array(p.steps[0].container)) {  // one view each
        p.base.text += "[" + p.steps[0].text + "]";
        p.steps.erase(p.steps.begin());
      }
      break;
    case Role::uniform:
    case Role::sampler:
      p.base.text = g.name;
      break;
  }
  return p;
}

Expression FunctionEmitter::load(const Place& p) {
  Expression e = p.base;
  if (p.buffer != nullptr) {
    Offset at = offset_of(p);
    if (module_.component_count(p.type) > kMostLeavesLoaded)
      throw UserError(module_.position(info_.function->file, info_.function->line).text() + ": in " +
                      info_.function->name + ": copying the whole of " + p.buffer->name +
                      " is not supported: read its elements one by one");
    const Kind kind = module_.type(p.type).kind;
    const bool several = kind == Kind::matrix || kind == Kind::array || kind == Kind::structure;
    if (several) name_dynamic(at);
    e.text = load_memory(p.base.text, at, p.type, 0, at.matrix, at.varying);
    e.precedence = 1;
    e.reads.insert(kBuffers);
    return e;
  }
  for (const Step& s : p.steps) {
    if (e.precedence > 1) e.text = "(" + e.text + ")";
    e.precedence = 1;
    e.text = step_text(e.text, s);
  }
  return e;
}

// --- stores

void FunctionEmitter::store(const Instruction& i) {
  const Id root = root_of(info_, i.operands[0]);
  if (info_.argument_temporaries.count(root)) {
    argument_values_[root] = i.operands[1];
    return;
  }
  if (info_.constant_tables.count(root)) return;
  const bool declaring = regions_.declaring_stores.count(&i) != 0;
  if (declaring) {
    const Expression v = value(i.operands[1]);
    settle_effects();
    position(i.file, i.line);
    const Id type = module_.variables.at(root).type;
    const std::string name = declare(root, local_name(root));
    const std::string text = types_.name(type, at_.is_varying(root)) + " " + name + " = " + to_store(i, v.text);
    for (const auto& [loop_statement, init] : regions_.loop_init) {
      if (init != &i) continue;
      for_init_ = text;
      return;
    }
    out_.line((regions_.constant.count(root) ? constant(type) : "") + text + ";");
    return;
  }
  const Place p = place(i.operands[0]);
  const Expression v = value(i.operands[1]);
  before_write(p.buffer != nullptr ? kBuffers : p.root);
  position(i.file, i.line);
  store_to(i, p, to_store(i, v.text));
}

void FunctionEmitter::store_to(const Instruction& i, const Place& p, const std::string& stored) {
  if (p.buffer != nullptr) {
    Offset at = offset_of(p);
    std::string whole = stored;
    // Columns of row-major matrices are apart in memory.
    const bool one_piece = module_.type(p.type).kind == Kind::vector && !at.matrix.row_major;
    if (module_.component_count(p.type) > 1 && !one_piece) {
      // Taken apart below: evaluated once.
      whole = names_.declare("t" + std::to_string(++temporary_count_));
      out_.line("auto " + whole + " = " + stored + ";");
      name_dynamic(at);  // the first piece may change what an index is read from
    }
    store_memory(p.base.text, at, p.type, 0, at.matrix, whole);
    return;
  }
  const bool partial = at_.partial.count(&i) != 0;
  const auto varying =
      std::find_if(p.steps.begin(), p.steps.end(), [](const Step& s) { return s.kind == Step::Kind::varying_index; });
  if (varying == p.steps.end()) {
    std::string target = p.base.text;
    for (const Step& s : p.steps) target = step_text(target, s);
    out_.line(partial ? "assign(" + mask() + ", " + target + ", " + stored + ");" : target + " = " + stored + ";");
    return;
  }
  std::string whole = stored;
  if (varying + 1 != p.steps.end()) {
    whole = names_.declare("t" + std::to_string(++temporary_count_));
    out_.line(constant(p.type) + types_.name(p.type, true) + " " + whole + " = " + stored + ";");
  }
  out_.line(nested_store(p.base.text, p, 0, mask_or_all(), partial, whole, 0));
}

// One store through the steps from `first` on; a varying index before the last one becomes an update of each element it
// means.
std::string FunctionEmitter::nested_store(const std::string& base, const Place& p, std::size_t first,
                                          const std::string& mask_text, bool masked, const std::string& stored,
                                          int depth) {
  std::string target = base;
  for (std::size_t k = first; k < p.steps.size(); ++k) {
    const Step& s = p.steps[k];
    if (s.kind != Step::Kind::varying_index) {
      target = step_text(target, s);
      continue;
    }
    if (k + 1 == p.steps.size())
      return "store_lookup(" + mask_text + ", " + target + ", " + s.text + ", " + stored + ");";
    const std::string number = depth == 0 ? "" : std::to_string(depth);
    names_.open();
    const std::string here = names_.declare("here" + number), element = names_.declare("element" + number);
    const std::string inner = nested_store(element, p, k + 1, here, true, stored, depth + 1);
    names_.close();
    return "update(" + mask_text + ", " + target + ", " + s.text + ", [&](const auto& " + here + ", auto& " + element +
           ") { " + inner + " });";
  }
  return masked ? "assign(" + mask_text + ", " + target + ", " + stored + ");" : target + " = " + stored + ";";
}

// --- buffers

std::string FunctionEmitter::Offset::text(std::uint32_t more) const {
  const std::uint32_t sum = constant + more;
  if (dynamic.empty()) return "UI(" + std::to_string(sum) + ")";
  return sum == 0 ? dynamic : dynamic + " + UI(" + std::to_string(sum) + ")";
}

FunctionEmitter::Offset FunctionEmitter::offset_of(const Place& p) {
  const Layout layout(module_, p.buffer->role != Role::shared);
  Offset at(layout);
  at.type = p.type;
  for (const Step& s : p.steps) {
    const Type& container = module_.type(s.container);
    std::uint32_t stride = 0;
    switch (container.kind) {
      case Kind::structure:
        at.constant += layout.member_offset(s.container, s.index);
        at.matrix = layout.member_matrix(s.container, s.index);
        continue;
      case Kind::matrix:
        stride = at.matrix.row_major ? 4 : at.matrix.stride;
        break;
      case Kind::vector:
        stride = at.matrix.row_major ? at.matrix.stride : 4;
        break;
      default:
        stride = layout.array_stride(s.container);
    }
    if (s.kind == Step::Kind::constant) {
      at.constant += stride * s.index;
      continue;
    }
    const bool is_unsigned = module_.type_of(s.index_value).kind == Kind::unsigned_integer;
    const std::string index = is_unsigned                             ? "to_int(" + s.text + ")"
                              : s.text.find(' ') == std::string::npos ? s.text
                                                                      : "(" + s.text + ")";
    at.dynamic += (at.dynamic.empty() ? "" : " + ") + index + " * UI(" + std::to_string(stride) + ")";
    at.varying |= s.kind == Step::Kind::varying_index;
  }
  // Row-major concerns matrices and their columns only; what was reached may be neither.
  return at;
}

// Before several pieces are read or written there.
void FunctionEmitter::name_dynamic(Offset& at) {
  if (at.dynamic.empty()) return;
  const std::string name = names_.declare("t" + std::to_string(++temporary_count_));
  out_.line("const " + std::string(at.varying ? "I " : "UI ") + name + " = " + at.dynamic + ";");
  at.dynamic = name;
}

std::string FunctionEmitter::load_memory(const std::string& buffer, const Offset& at, Id id, std::uint32_t more,
                                         const MatrixLayout& matrix, bool varying) {
  const Type& t = module_.type(id);
  const std::string type = types_.name(id, varying);
  const Layout& layout = at.layout;
  std::string parts;
  const auto add = [&](const std::string& part) { parts += (parts.empty() ? "" : ", ") + part; };
  switch (t.kind) {
    case Kind::matrix:
      for (std::uint32_t c = 0; c < t.count; ++c)
        add(load_memory(buffer, at, t.element, more + c * (matrix.row_major ? 4 : matrix.stride), matrix, varying));
      return type + "(" + parts + ")";
    case Kind::array:
      for (std::uint32_t k = 0; k < t.count; ++k)
        add(load_memory(buffer, at, t.element, more + k * layout.array_stride(id), matrix, varying));
      return type + "{{" + parts + "}}";
    case Kind::structure:
      for (std::uint32_t k = 0; k < t.members.size(); ++k)
        add(load_memory(buffer, at, t.members[k], more + layout.member_offset(id, k), layout.member_matrix(id, k),
                        varying));
      return type + "{" + parts + "}";
    case Kind::vector:
      if (matrix.row_major) {
        for (std::uint32_t k = 0; k < t.count; ++k)
          add("load<" + types_.name(t.element, varying) + ">(" + buffer + ", " + at.text(more + k * matrix.stride) +
              ")");
        return type + "(" + parts + ")";
      }
      [[fallthrough]];
    default:
      return "load<" + type + ">(" + buffer + ", " + at.text(more) + ")";
  }
}

void FunctionEmitter::store_memory(const std::string& buffer, const Offset& at, Id id, std::uint32_t more,
                                   const MatrixLayout& matrix, const std::string& stored) {
  const Type& t = module_.type(id);
  const Layout& layout = at.layout;
  switch (t.kind) {
    case Kind::matrix:
      for (std::uint32_t c = 0; c < t.count; ++c)
        store_memory(buffer, at, t.element, more + c * (matrix.row_major ? 4 : matrix.stride), matrix,
                     stored + "[" + std::to_string(c) + "]");
      return;
    case Kind::array:
      for (std::uint32_t k = 0; k < t.count; ++k)
        store_memory(buffer, at, t.element, more + k * layout.array_stride(id), matrix,
                     stored + "[" + std::to_string(k) + "]");
      return;
    case Kind::structure:
      for (std::uint32_t k = 0; k < t.members.size(); ++k)
        store_memory(buffer, at, t.members[k], more + layout.member_offset(id, k), layout.member_matrix(id, k),
                     stored + "." + types_.member(id, k));
      return;
    case Kind::vector:
      if (matrix.row_major) {
        for (std::uint32_t k = 0; k < t.count; ++k)
          store_memory(buffer, at, t.element, more + k * matrix.stride, {}, stored + "[" + std::to_string(k) + "]");
        return;
      }
      [[fallthrough]];
    default:
      out_.line("store(" + narrowed("kept", 1) + ", " + buffer + ", " + at.text(more) + ", " + stored + ");");
  }
}

// --- atomics

void FunctionEmitter::atomic(const Instruction& i) {
  const char* function = nullptr;
  switch (i.op) {
    case spv::OpAtomicIAdd:
      function = "atomic_add";
      break;
    case spv::OpAtomicSMin:
    case spv::OpAtomicUMin:
      function = "atomic_min";
      break;
    case spv::OpAtomicSMax:
    case spv::OpAtomicUMax:
      function = "atomic_max";
      break;
    case spv::OpAtomicAnd:
      function = "atomic_and";
      break;
    case spv::OpAtomicOr:
      function = "atomic_or";
      break;
    case spv::OpAtomicXor:
      function = "atomic_xor";
      break;
    case spv::OpAtomicExchange:
      function = "atomic_exchange";
      break;
    case spv::OpAtomicCompareExchange:
      function = "atomic_comp_swap";
      break;
    default:
      refuse(i, "SPIR-V instruction " + op_name(i.op), "use atomicAdd, Min, Max, And, Or, Xor, Exchange or CompSwap");
  }
  const Place p = place(i.operands[0]);
  if (p.buffer == nullptr) refuse(i, "an atomic operation outside a buffer block", "use a buffer block");
  // Operands: pointer, scope, semantics [, semantics], value [, comparator].
  const bool compares = i.op == spv::OpAtomicCompareExchange;
  const Expression operand = value(i.operands[compares ? 4 : 3]);
  std::string arguments = narrowed("kept", 1) + ", " + p.base.text + ", " + offset_of(p).text();
  if (compares) arguments += ", " + value(i.operands[5]).text;
  before_write(kBuffers);
  Expression e;
  e.reads = {kEffects};
  e.text = std::string(function) + "(" + arguments + ", " + operand.text + ")";
  e.precedence = 1;
  define(i, e);
}

}  // namespace twinshade::spirv

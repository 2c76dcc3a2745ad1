// Values: expression trees, one C++ statement for each GLSL statement. A value that is used once is written where it is
// used, unless something that it reads is written in between.
#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/emit_function.h"
#include "cpu_shaders/translate/extended_instructions.h"

namespace twinshade::spirv {

void FunctionEmitter::refuse(const Instruction& i, const std::string& what, const std::string& remedy) const {
  throw UserError(module_.position(i).text() + ": " + what + " is not supported: " + remedy);
}

void FunctionEmitter::no_float64(const Instruction& i, const std::string& what) {
  if (runs_in_double_ && shared_.no_float64_reason.empty())
    shared_.no_float64_reason = module_.position(i).text() + ": " + what;
}

Expression FunctionEmitter::value(Id id) {
  const auto pending = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& p) { return p.id == id; });
  if (pending != pending_.end()) {
    Expression e = std::move(pending->expression);
    pending_.erase(pending);
    return e;
  }
  const auto known = values_.find(id);
  if (known != values_.end()) return known->second;
  if (module_.is_constant(id)) {
    Expression e;
    e.text = types_.constant(id);
    e.precedence = 1;
    return e;
  }
  const auto argument = argument_values_.find(id);
  if (argument != argument_values_.end()) return value(argument->second);
  throw UserError(module_.position(info_.function->file, info_.function->line).text() + ": " + info_.function->name +
                  " uses a value that it does not compute: this is a fault of the translator");
}

std::string FunctionEmitter::text(Id id, int most) {
  Expression e = value(id);
  return e.precedence > most ? "(" + e.text + ")" : e.text;
}

namespace {
// Compilers walk expressions recursively, and give up within long ones.
bool is_unwieldy(const std::string& text) {
  constexpr std::size_t kShort = 400, kLongest = 800;
  constexpr int kDeepest = 100;
  if (text.size() < kShort) return false;
  int depth = 0, deepest = 0;
  for (const char c : text) {
    if (c == '(') deepest = std::max(deepest, ++depth);
    if (c == ')') --depth;
  }
  return text.size() > kLongest || deepest > kDeepest;
}
}  // namespace

void FunctionEmitter::define(const Instruction& i, Expression e) {
  if (rounds_result(i)) {
    e.text = rounded(i, e.text);
    e.precedence = 1;
  }
  const auto found = info_.uses.find(i.result);
  const int uses = found == info_.uses.end() ? 0 : found->second;
  if (uses == 0) {
    if (e.reads.count(kEffects)) {
      position(i.file, i.line);
      out_.line(e.text + ";");
    }
    return;
  }
  // Names, constants and inputs may be written again and again.
  const bool trivial =
      e.reads.empty() && e.precedence <= 1 && e.text.find(' ') == std::string::npos && e.text.size() < 32;
  if (uses > 1 && trivial) {
    values_[i.result] = std::move(e);
    return;
  }
  Pending pending{i.result, std::move(e)};
  if (uses > 1 || is_unwieldy(pending.expression.text)) {
    position(i.file, i.line);
    materialise(pending);
  } else {
    pending_.push_back(std::move(pending));
  }
}

void FunctionEmitter::materialise(Pending& pending) {
  const std::string name = names_.declare("t" + std::to_string(++temporary_count_));
  out_.line(constant(module_.value_types.at(pending.id)) + type_of(pending.id) + " " + name + " = " +
            pending.expression.text + ";");
  Expression e;
  e.text = name;
  e.precedence = 1;
  values_[pending.id] = e;
}

void FunctionEmitter::flush() {
  std::vector<Pending> all;
  all.swap(pending_);
  for (Pending& p : all) materialise(p);
}

void FunctionEmitter::before_write(Id root) {
  std::vector<Pending> all;
  all.swap(pending_);
  for (Pending& p : all) {
    const auto& reads = p.expression.reads;
    if (reads.count(root) || reads.count(kEffects)) {
      materialise(p);
    } else {
      pending_.push_back(std::move(p));
    }
  }
}

void FunctionEmitter::settle_effects() { before_write(kEffects); }

namespace {
bool is_shift(spv::Op op) {
  return op == spv::OpShiftLeftLogical || op == spv::OpShiftRightLogical || op == spv::OpShiftRightArithmetic;
}
}  // namespace

// SPIR-V lets int and uint meet in one instruction; our types do not. The kind that both operands must have.
Kind FunctionEmitter::signedness(const Instruction& i) const {
  const Kind result = module_.scalar_kind(i.type);
  return result == Kind::boolean ? module_.scalar_kind(module_.value_types.at(i.operands[0])) : result;
}

Expression FunctionEmitter::operand_as(Id id, Kind wanted) {
  const Kind kind = module_.scalar_kind(module_.value_types.at(id));
  Expression e = value(id);
  if (kind == wanted || (kind != Kind::integer && kind != Kind::unsigned_integer)) return e;
  e.text = (wanted == Kind::integer ? "to_int(" : "to_uint(") + e.text + ")";
  e.precedence = 1;
  return e;
}

Expression FunctionEmitter::binary(const Instruction& i, const char* op, int precedence) {
  const Expression left = operand_as(i.operands[0], signedness(i)),
                   right = is_shift(i.op) ? value(i.operands[1]) : operand_as(i.operands[1], signedness(i));
  // Where compilers ask for parentheses, readers want them too.
  const bool plain = precedence == 5 || precedence == 6;
  const auto wrap = [&](const Expression& x, bool is_right) {
    const bool needs = plain ? x.precedence > precedence || (is_right && x.precedence == precedence)
                             : x.precedence > (precedence < 9 || (precedence > 10 && precedence < 14) ? 3 : 6);
    return needs ? "(" + x.text + ")" : x.text;
  };
  Expression e;
  e.text = wrap(left, false) + " " + op + " " + wrap(right, true);
  e.precedence = precedence;
  e.reads = left.reads;
  e.reads.insert(right.reads.begin(), right.reads.end());
  return e;
}

Expression FunctionEmitter::call_text(const Instruction&, const std::string& function,
                                      const std::vector<Id>& arguments) {
  Expression e;
  e.precedence = 1;
  e.text = function + "(";
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const Expression a = value(arguments[k]);
    e.text += (k == 0 ? "" : ", ") + a.text;
    e.reads.insert(a.reads.begin(), a.reads.end());
  }
  e.text += ")";
  return e;
}

Expression FunctionEmitter::extended(const Instruction& i) {
  const std::uint32_t number = i.operands[1];
  const ExtendedInstruction* known = extended_instruction(number);
  if (known == nullptr || known->function == nullptr)
    refuse(i,
           known == nullptr ? "the built-in function with GLSL.std.450 number " + std::to_string(number)
                            : std::string("the built-in function ") + known->glsl,
           known == nullptr ? "write it out" : known->remedy);
  if (known->bits) no_float64(i, known->glsl);
  const std::string function = std::string("glsl::") + known->function;
  const std::vector<Id> arguments(i.operands.begin() + 2, i.operands.end());
  return is_narrow(i) && !rounds_result(i) ? in_half(i, function, arguments) : call_text(i, function, arguments);
}

// Functions that give two values: a struct in SPIR-V, two names here.
bool FunctionEmitter::pair(const Instruction& i) {
  const char* function = i.op == spv::OpIAddCarry                        ? "glsl::uaddCarry"
                         : i.op == spv::OpISubBorrow                     ? "glsl::usubBorrow"
                         : i.op == spv::OpUMulExtended                   ? "glsl::umulExtended"
                         : i.op == spv::OpSMulExtended                   ? "glsl::imulExtended"
                         : i.op == spv::OpExtInst && i.operands[1] == 52 ? "glsl::frexp"
                                                                         : nullptr;
  if (function == nullptr) return false;
  settle_effects();
  Expression call = call_text(i, function, {i.operands.begin() + (i.op == spv::OpExtInst ? 2 : 0), i.operands.end()});
  call.text.pop_back();
  position(i.file, i.line);
  auto& names = pairs_[i.result];
  for (std::string& name : names) name = names_.declare("t" + std::to_string(++temporary_count_));
  const auto type = [&](std::size_t k) {
    return types_.name(module_.type(i.type).members[k], at_.is_varying(i.result)) + " ";
  };
  out_.line(type(1) + names[1] + ";");
  if (i.op == spv::OpUMulExtended || i.op == spv::OpSMulExtended) {  // low, high; in GLSL the other way round
    out_.line(type(0) + names[0] + ";");
    out_.line(call.text + ", " + names[1] + ", " + names[0] + ");");
  } else {
    out_.line("const " + type(0) + names[0] + " = " + call.text + ", " + names[1] + ");");
  }
  return true;
}

// Constructors. A vector taken apart and put together in order is passed whole.
Expression FunctionEmitter::composite(const Instruction& i) {
  const Type& type = module_.type(i.type);
  Expression e;
  e.precedence = 1;
  e.text = types_.name(i.type, at_.is_varying(i.result));
  const char* open = type.kind == Kind::array ? "{{" : type.kind == Kind::structure ? "{" : "(";
  const char* close = type.kind == Kind::array ? "}}" : type.kind == Kind::structure ? "}" : ")";
  e.text += open;
  const auto add = [&](const Expression& part, bool first) {
    e.text += (first ? "" : ", ") + part.text;
    e.reads.insert(part.reads.begin(), part.reads.end());
  };
  const bool same = type.kind == Kind::vector && i.operands.size() == type.count &&
                    std::all_of(i.operands.begin(), i.operands.end(), [&](Id id) { return id == i.operands[0]; });
  const std::size_t count = same ? 1 : i.operands.size();
  for (std::size_t k = 0; k < count; ++k) add(value(i.operands[k]), k == 0);
  e.text += close;
  return e;
}

Expression FunctionEmitter::extract(const Instruction& i) {
  if (const auto found = pairs_.find(i.operands[0]); found != pairs_.end())
    return Expression{found->second[i.operands[1]], 1, {}};
  Id constant = i.operands[0];
  for (std::size_t k = 1; k < i.operands.size() && module_.is_constant(constant); ++k) {
    const auto& components = module_.constants.at(constant).components;
    constant = i.operands[k] < components.size() ? components[i.operands[k]] : 0;
  }
  if (module_.is_constant(constant)) return value(constant);
  Expression e = value(i.operands[0]);
  if (e.precedence > 1) e.text = "(" + e.text + ")";
  e.precedence = 1;
  Id type = module_.value_types.at(i.operands[0]);
  for (std::size_t k = 1; k < i.operands.size(); ++k) {
    Step s;
    s.kind = Step::Kind::constant;
    s.container = type;
    s.index = i.operands[k];
    s.text = std::to_string(s.index);
    e.text = step_text(e.text, s);
    const Type& t = module_.type(type);
    type = t.kind == Kind::structure ? t.members[s.index] : t.element;
  }
  return e;
}

Expression FunctionEmitter::select(const Instruction& i) {
  const Expression c = value(i.operands[0]);
  const Expression a = value(i.operands[1]), b = value(i.operands[2]);
  Expression e;
  e.reads = c.reads;
  e.reads.insert(a.reads.begin(), a.reads.end());
  e.reads.insert(b.reads.begin(), b.reads.end());
  e.precedence = 1;
  const bool varying = at_.is_varying(i.result);
  const Kind kind = module_.type(i.type).kind;
  std::string left = a.text, right = b.text;
  const bool a_varies = at_.is_varying(i.operands[1]), b_varies = at_.is_varying(i.operands[2]);
  // Aggregates of structs must be of one type; two uniform sides under a varying condition must become varying.
  // So must arrays, which may be tables.
  if (kind == Kind::array || (varying && ((!a_varies && !b_varies) || kind == Kind::structure))) {
    const std::string type = types_.name(i.type, varying);
    if (!a_varies) left = type + "(" + left + ")";
    if (!b_varies && (kind == Kind::structure || kind == Kind::array)) right = type + "(" + right + ")";
  }
  e.text = "select(" + c.text + ", " + left + ", " + right + ")";
  return e;
}

Id FunctionEmitter::passed(Id argument) const {
  const auto found = direct_.variable.find(argument);
  return found == direct_.variable.end() ? argument : found->second;
}

void FunctionEmitter::call(const Instruction& i) {
  settle_effects();
  const Instance& callee = *at_.callees.at(&i);
  const FunctionInfo& info = *callee.info;
  std::vector<std::string> arguments;
  Expression e;
  if (callee.needs_mask) arguments.push_back(mask_or_all());
  for (std::size_t k = 0; k + 1 < i.operands.size(); ++k) {
    const Id id = i.operands[k + 1];
    const bool is_value = module_.type_of(id).kind != Kind::pointer || info_.argument_temporaries.count(id);
    Expression a = is_value ? value(id) : load(place(passed(id)));
    // What is not copied for the callee may be what it writes.
    const bool written = std::any_of(a.reads.begin(), a.reads.end(),
                                     [&](Id variable) { return info.globals_written.count(variable) != 0; });
    if (written && info.passed_uncopied(module_, k)) {
      const Parameter& p = info.function->parameters[k];
      const std::string name = names_.declare("t" + std::to_string(++temporary_count_));
      position(i.file, i.line);
      const Id type = info.parameter_type(module_, k);
      out_.line(constant(type) + types_.name(type, callee.is_varying(p.id)) + " " + name + " = " + a.text + ";");
      a = Expression{name, 1, {}};
    }
    e.reads.insert(a.reads.begin(), a.reads.end());
    arguments.push_back(a.text);
  }
  e.precedence = 1;
  e.text = callee.name + "(";
  for (std::size_t k = 0; k < arguments.size(); ++k) e.text += (k == 0 ? "" : ", ") + arguments[k];
  e.text += ")";
  e.reads.insert(info.globals_read.begin(), info.globals_read.end());
  if (info.reads_buffers) e.reads.insert(kBuffers);
  if (info.pure() && module_.type(i.type).kind != Kind::none) {
    define(i, std::move(e));
    return;
  }
  // Everything that it writes changes now: what reads it comes first, and the call is a statement.
  for (Id g : info.globals_written) before_write(g);
  if (info.writes_buffers) before_write(kBuffers);
  for (std::size_t k = 0; k + 1 < i.operands.size(); ++k)
    if (info.is_reference(k)) before_write(root_of(info_, passed(i.operands[k + 1])));
  e.reads.insert(kEffects);
  define(i, std::move(e));
}

void FunctionEmitter::instruction(const Instruction& i) {
  if (arithmetic(i) || texture(i) || pair(i)) return;
  switch (i.op) {
    case spv::OpVariable:
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
      return;
    case spv::OpLoad:
      if (module_.type(i.type).kind == Kind::sampler || module_.type(i.type).kind == Kind::image) {
        values_[i.result] = load(place(i.operands[0]));
        return;
      }
      {
        const Place p = place(i.operands[0]);
        const bool immutable = p.base.reads.empty() && p.buffer == nullptr;
        if (!immutable) settle_effects();
        return define(i, load(p));
      }
    case spv::OpStore:
      return store(i);
    case spv::OpFunctionCall:
      return call(i);
    case spv::OpExtInst:
      if (i.operands[1] == 35) {  // modf(x, whole) is whole = trunc(x), x - whole, as in Mesa
        settle_effects();
        const Id x = i.operands[2];
        Pending whole{x, value(x)};
        position(i.file, i.line);
        materialise(whole);
        const Place p = place(i.operands[3]);
        before_write(p.buffer != nullptr ? kBuffers : p.root);
        const std::string name = values_.at(x).text;
        store_to(i, p, "glsl::trunc(" + name + ")");
        Expression e;
        e.text = name + " - glsl::trunc(" + name + ")";
        e.precedence = 6;
        return define(i, e);
      }
      if (i.operands[1] == 76 || i.operands[1] == 77)  // interpolateAtCentroid, interpolateAtSample: one sample
        return define(i, load(place(i.operands[2])));
      return define(i, extended(i));
    case spv::OpCompositeConstruct:
      return define(i, composite(i));
    case spv::OpCompositeExtract:
      return define(i, extract(i));
    case spv::OpCompositeInsert: {
      position(i.file, i.line);
      const std::string name = names_.declare("t" + std::to_string(++temporary_count_));
      out_.line(type_of(i.result) + " " + name + " = " + value(i.operands[1]).text + ";");
      Step s;
      s.kind = Step::Kind::constant;
      std::string target = name;
      Id type = i.type;
      for (std::size_t k = 2; k < i.operands.size(); ++k) {
        s.container = type;
        s.index = i.operands[k];
        s.text = std::to_string(s.index);
        target = step_text(target, s);
        const Type& t = module_.type(type);
        type = t.kind == Kind::structure ? t.members[s.index] : t.element;
      }
      out_.line(target + " = " + value(i.operands[0]).text + ";");
      Expression e;
      e.text = name;
      e.precedence = 1;
      values_[i.result] = e;
      return;
    }
    case spv::OpVectorExtractDynamic: {
      Expression v = value(i.operands[0]);
      const Expression index = value(i.operands[1]);
      v.reads.insert(index.reads.begin(), index.reads.end());
      if (at_.is_varying(i.operands[1]))
        v.text = "lookup(" + v.text + ", " + index.text + ")";
      else
        v.text = (v.precedence > 1 ? "(" + v.text + ")" : v.text) + "[" + index.text + "]";
      v.precedence = 1;
      return define(i, v);
    }
    case spv::OpVectorShuffle:
      return define(i, [&] {
        const std::uint32_t size = module_.type_of(i.operands[0]).count;
        const bool same = i.operands[0] == i.operands[1];
        const auto all_picks = [&](auto condition) {
          return std::all_of(i.operands.begin() + 2, i.operands.end(), condition);
        };
        Expression e;
        e.precedence = 1;
        const Expression a = value(i.operands[0]);
        e.reads = a.reads;
        // Of one vector, or of both joined.
        const bool one_vector = same || all_picks([&](std::uint32_t k) { return k < size; });
        const bool other_vector = !same && all_picks([&](std::uint32_t k) { return k >= size; });
        std::string picks;
        for (std::size_t k = 2; k < i.operands.size(); ++k)
          picks += (k == 2 ? "" : ", ") +
                   std::to_string((same || other_vector) && i.operands[k] >= size ? i.operands[k] - size : i.operands[k]);
        if (one_vector) {
          e.text = "swizzle<" + picks + ">(" + a.text + ")";
          return e;
        }
        const Expression b = value(i.operands[1]);
        if (other_vector) {  // v.yxz = b
          e.reads = b.reads;
          e.text = "swizzle<" + picks + ">(" + b.text + ")";
          return e;
        }
        e.reads.insert(b.reads.begin(), b.reads.end());
        const std::string joined = "vec<" + std::string(at_.is_varying(i.result) ? "" : "U") +
                                   types_.name(module_.type(i.type).element, true) + ", " +
                                   std::to_string(size + module_.type_of(i.operands[1]).count) + ">";
        e.text = "swizzle<" + picks + ">(" + joined + "(" + a.text + ", " + b.text + "))";
        return e;
      }());
    case spv::OpSelect:
      return define(i, select(i));
    case spv::OpCopyObject:
      return define(i, value(i.operands[0]));
    case spv::OpUndef:
      return define(i, Expression{type_of(i.result) + "{}", 1, {}});
    case spv::OpArrayLength: {
      const Place p = place(i.operands[0]);
      const std::uint32_t member = i.operands[1];
      const Layout layout(module_, true);
      const Id array = module_.type(p.type).members[member];
      Expression e;
      e.precedence = 1;
      e.text = "array_length(" + p.base.text + ", " + std::to_string(layout.member_offset(p.type, member)) + ", " +
               std::to_string(layout.array_stride(array)) + ")";
      return define(i, e);
    }
    case spv::OpMemoryBarrier:
      return;  // lanes run in step
    case spv::OpControlBarrier:
      before_write(kBuffers);
      position(i.file, i.line);
      out_.line("this->barrier();");
      return;
    default:
      if (i.op >= spv::OpAtomicLoad && i.op <= spv::OpAtomicXor) return atomic(i);
      refuse(i, "SPIR-V instruction " + op_name(i.op), "write it in other terms");
  }
}

}  // namespace twinshade::spirv

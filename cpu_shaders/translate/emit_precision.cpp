// What is computed in half (ShaderSource::precision): glslang decorates results whose operands are all mediump or lowp
// with RelaxedPrecision. Values lie in lanes of float whatever they are; those of 16 bits hold halves.
#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/emit_function.h"
#include "cpu_shaders/translate/served.h"

namespace twinshade::spirv {
namespace {

// Samplers and structs are no numbers, though their members may be.
bool is_made_of_reals(const Module& module, Id type) { return module.scalar_kind(type) == Kind::real; }

// The value at hand, moved or converted: it is rounded. All else that is narrow is an operation in half, but for
// components of what is half already.
bool moves_or_converts(const Module& module, const Instruction& i) {
  switch (i.op) {
    case spv::OpLoad:
    case spv::OpFunctionCall:
    case spv::OpSelect:
    case spv::OpCompositeConstruct:
    case spv::OpConvertSToF:
    case spv::OpConvertUToF:
    case spv::OpImageSampleImplicitLod:  // filtered in the precision of the texture, as texture units do
    case spv::OpImageSampleExplicitLod:
    case spv::OpImageSampleProjImplicitLod:
    case spv::OpImageSampleProjExplicitLod:
    case spv::OpImageGather:
    case spv::OpImageFetch:
      return true;
    case spv::OpCompositeExtract:
      return module.type_of(i.operands[0]).kind == Kind::structure;
    case spv::OpExtInst:  // modf, ldexp, interpolateAtCentroid, interpolateAtSample
      return i.operands[1] == 35 || i.operands[1] == 53 || i.operands[1] == 76 || i.operands[1] == 77;
    default:
      return false;
  }
}

// Whether the text is one call, which begins with `function`: "f(", "f(x, ".
bool is_call_of(const std::string& function, const std::string& text) {
  if (text.rfind(function, 0) != 0) return false;
  int depth = 0;
  for (std::size_t k = text.find('('); k < text.size(); ++k) {
    depth += text[k] == '(' ? 1 : text[k] == ')' ? -1 : 0;
    if (depth == 0) return k + 1 == text.size();
  }
  return false;
}

}  // namespace

std::string rounded_to_half(const std::string& text) {
  return is_call_of("to_half(", text) || is_call_of("in_half(", text) || is_call_of("of_halves(", text)
             ? text
             : "to_half(" + text + ")";
}

// By line what the runtime serves, and functions that it alone calls, are as in full: what calls it rounds its result.
bool FunctionEmitter::everything_may_be_half() const {
  return shared_.precision == Precision::half ||
         (shared_.precision == Precision::by_line && runs_in_double_ && !is_served(module_, *info_.function));
}

// Functions, variables and results alike.
bool FunctionEmitter::is_relaxed(Id id) const {
  if (shared_.precision != Precision::mediump) return everything_may_be_half();
  if (module_.decorations_of(id).has(spv::DecorationRelaxedPrecision)) return true;
  const auto found = info_.definitions.find(id);
  return found != info_.definitions.end() && found->second->op == spv::OpLoad &&
         is_relaxed_place(found->second->operands[0]);
}

// glslang leaves loads of components and members undecorated: what they are in says it.
bool FunctionEmitter::is_relaxed_place(Id pointer) const {
  if (shared_.precision != Precision::mediump) return everything_may_be_half();
  for (Id at = pointer;;) {
    if (module_.decorations_of(at).has(spv::DecorationRelaxedPrecision)) return true;
    const auto found = info_.definitions.find(at);
    if (found == info_.definitions.end() || !found->second->is_chain()) return false;
    const Instruction& chain = *found->second;
    Id type = module_.type_of(chain.operands[0]).element;
    for (std::size_t k = 1; k < chain.operands.size(); ++k) {
      const Type& t = module_.type(type);
      if (t.kind != Kind::structure) {
        type = t.element;
        continue;
      }
      const std::uint32_t member = module_.constants.at(chain.operands[k]).bits;
      if (module_.member(type, member).has(spv::DecorationRelaxedPrecision)) return true;
      type = t.members[member];
    }
    at = chain.operands[0];
  }
}

bool FunctionEmitter::is_narrow(const Instruction& i) const {
  if (shared_.precision == Precision::by_line && i.op == spv::OpBitcast) return false;
  return shared_.precision != Precision::full && i.type != 0 && is_made_of_reals(module_, i.type) &&
         is_relaxed(i.result);
}

// Comparisons have no precision of their own: they are narrow where every operand is, constants aside.
bool FunctionEmitter::compares_halves(const Instruction& i) const {
  if (shared_.precision == Precision::full || !is_real(i.operands[0])) return false;
  const auto narrow_or_constant = [&](Id id) { return module_.is_constant(id) || is_relaxed(id); };
  return std::all_of(i.operands.begin(), i.operands.end(), narrow_or_constant) &&
         !std::all_of(i.operands.begin(), i.operands.end(), [&](Id id) { return module_.is_constant(id); });
}

std::string FunctionEmitter::half_switch(const Instruction& i) {
  const Position at = module_.position(i);
  const auto found = std::find_if(shared_.switched.begin(), shared_.switched.end(),
                                  [&](const Position& p) { return p.file == at.file && p.line == at.line; });
  const std::size_t index = std::size_t(found - shared_.switched.begin());
  if (found == shared_.switched.end()) shared_.switched.push_back(at);
  return "half_here(" + shared_.half_lines + ", " + std::to_string(index) + ")";
}

// Where everything is half operands are halves; a mediump operation may have constants.
std::string FunctionEmitter::half_call(const Instruction& i) {
  if (shared_.precision == Precision::by_line) return "in_half_if(" + half_switch(i) + ", ";
  return shared_.precision == Precision::half ? "of_halves(" : "in_half(";
}

std::string FunctionEmitter::rounded(const Instruction& i, const std::string& text) {
  if (shared_.precision != Precision::by_line) return rounded_to_half(text);
  const std::string of_line = "half_if(" + half_switch(i) + ", ";
  return is_call_of("in_" + of_line, text) || is_call_of("to_" + of_line, text) ? text : "to_" + of_line + text + ")";
}

// function: its name in the runtime.
Expression FunctionEmitter::in_half(const Instruction& i, const std::string& function,
                                    const std::vector<Id>& arguments) {
  Expression e = call_text(i, "", arguments);
  e.text =
      half_call(i) + "[](const auto&... x) TWINSHADE_LAMBDA { return " + function + "(x...); }, " + e.text.substr(1);
  return e;
}

Expression FunctionEmitter::in_half_operator(const Instruction& i, const char* op) {
  Expression e = call_text(i, "", i.operands);
  e.text = half_call(i) + "[](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x " + std::string(op) +
           " y; }, " + e.text.substr(1);
  return e;
}

bool FunctionEmitter::rounds_result(const Instruction& i) const {
  return moves_or_converts(module_, i) && is_narrow(i);
}

// What a store writes: narrow variables, outputs above all, hold halves. Where everything is half every value is.
std::string FunctionEmitter::to_store(const Instruction& i, const std::string& value) {
  const Id pointer = i.operands[0];
  const bool every_value_is_known = shared_.precision == Precision::full || shared_.precision == Precision::half;
  if (every_value_is_known || !is_made_of_reals(module_, module_.type_of(pointer).element) ||
      !is_relaxed_place(pointer))
    return value;
  return rounded(i, value);
}

// Transcendentals of shaders/exact/ are made of bit casts, which halves would break: they are computed in more digits
// and their results rounded, as those of the language are.
bool FunctionEmitter::is_served_in_full() const {
  return (shared_.precision == Precision::mediump || shared_.precision == Precision::half) &&
         is_served_in_double(module_, *info_.function) && is_relaxed(info_.function->id);
}

void FunctionEmitter::refuse_bits(const Instruction& i, const std::string& what) const {
  if (shared_.precision == Precision::half && runs_in_double_)
    throw UserError(module_.position(i).text() + ": " + what +
                    ": cannot be evaluated in half: it is of a float's bits; leave it out, or declare what is mediump");
}

}  // namespace twinshade::spirv

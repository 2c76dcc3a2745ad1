#include "cpu_shaders/translate/instances.h"

#include <algorithm>

#include "base/error.h"
#include "cpu_shaders/translate/limits.h"

namespace twinshade::spirv {
namespace {

enum class Part { then_arm, else_arm, body, continuing, in_case };

struct Frame {
  const Statement* construct;
  Part part;
  std::size_t case_index;
};

// interpolateAtCentroid, interpolateAtSample
bool is_interpolation(std::uint32_t extended) { return extended == 76 || extended == 77; }

class Analysis {
 public:
  explicit Analysis(const Program& program) : program_(program), module_(program.module) {}

  // Everything starts out uniform and only ever becomes varying, so repeating until nothing changes ends.
  Instances run() {
    std::set<Id> globals;
    for (;;) {
      result_ = Instances{};
      result_.varying_globals = globals;
      sizes_.clear();
      copied_ = 0;
      result_.main = &instance(module_.entry, {}, true);
      if (result_.varying_globals == globals) break;
      globals = result_.varying_globals;
    }
    std::set<const Instance*> seen;
    order(*result_.main, seen);
    return std::move(result_);
  }

 private:
  void order(Instance& at, std::set<const Instance*>& seen) {
    if (!seen.insert(&at).second) return;
    for_each_instruction(at.info->body.list, [&](const Instruction& i) {
      if (i.op == spv::OpFunctionCall) order(*at.callees.at(&i), seen);
    });
    result_.callees_first.push_back(&at);
  }

  Instance& instance(Id function, const std::vector<bool>& varying_in, bool whole) {
    auto& slot = result_.all[{function, varying_in, whole}];
    if (slot) return *slot;
    count_copy(program_.info(function));
    auto fresh = std::make_unique<Instance>();
    fresh->info = &program_.info(function);
    fresh->varying_in = varying_in;
    fresh->whole = whole;
    Walker(*this, *fresh).run();
    slot = std::move(fresh);
    return *slot;
  }

  // Functions with many parameters can have more patterns than a compiler takes.
  void count_copy(const FunctionInfo& info) {
    std::size_t& size = sizes_[info.function->id];
    if (size != 0 && (copied_ += size) > kMostCopied)
      throw UserError(module_.position(info.function->file, info.function->line).text() + ": " + info.function->name +
                      "() and others are called with too many patterns of arguments of which some are the same for all "
                      "invocations: their copies have more than " +
                      std::to_string(kMostCopied) + " instructions; pass fewer arguments");
    if (size != 0) return;
    size = 1;
    for_each_instruction(info.body.list, [&](const Instruction&) { ++size; });
  }

  class Walker {
   public:
    Walker(Analysis& analysis, Instance& at)
        : analysis_(analysis), module_(analysis.module_), info_(*at.info), at_(at) {}

    void run() {
      const auto& parameters = info_.function->parameters;
      for (std::size_t k = 0; k < parameters.size(); ++k)
        if (at_.varying_in[k]) at_.varying.insert(parameters[k].id);
      do {
        changed_ = false;
        at_.partial.clear();
        at_.callees.clear();
        at_.needs_mask = false;
        list(info_.body.list);
      } while (changed_);
      for (const Parameter& p : parameters) at_.varying_out.push_back(at_.is_varying(p.id));
      if (!at_.masked.empty()) at_.needs_mask = true;
      if (at_.whole) at_.needs_mask = false;
    }

   private:
    void mark(Id id) { changed_ |= at_.varying.insert(id).second; }
    template <class Set, class Key>
    void mark(Set& set, Key key) {
      changed_ |= set.insert(key).second;
    }
    void mark_masked(const Statement& s) { mark(at_.masked, s.id); }

    bool varying(Id id) const { return at_.is_varying(id); }

    // Whether some lanes may be waiting somewhere inside `target` (null: the function) while the current ones run.
    bool masked_within(const Statement* target) const {
      for (std::size_t k = frames_.size(); k-- > 0 && frames_[k].construct != target;)
        if (at_.is_masked(*frames_[k].construct)) return true;
      return false;
    }

    void list(const List& statements) {
      for (const auto& s : statements) statement(*s);
    }
    void part(const Statement& s, Part p, const List& statements, std::size_t case_index = 0) {
      frames_.push_back({&s, p, case_index});
      list(statements);
      frames_.pop_back();
    }

    void statement(const Statement& s) {
      switch (s.shape) {
        case Shape::code:
          for (const Instruction& i : s.code) instruction(i);
          break;
        case Shape::choice:
          if (varying(s.condition)) mark_masked(s);
          part(s, Part::then_arm, s.then_list);
          part(s, Part::else_arm, s.else_list);
          break;
        case Shape::loop:
          skipped_.erase(s.id);
          part(s, Part::body, s.body);
          part(s, Part::continuing, s.continuing);
          if (s.back_condition != 0 && varying(s.back_condition)) {
            mark_masked(s);
            mark(at_.waits_at_end, s.id);
          }
          break;
        case Shape::cases:
          if (varying(s.condition)) mark_masked(s);
          for (std::size_t k = 0; k < s.cases.size(); ++k) part(s, Part::in_case, s.cases[k].body, k);
          break;
        case Shape::leave_loop:
          // A break that the running lanes agree on leaves those behind that have skipped to the next iteration.
          if (masked_within(s.target) || skipped_.count(s.target->id)) {
            mark(at_.divergent, s.id);
            mark(at_.waits_at_end, s.target->id);
            mark_masked(*s.target);
          }
          break;
        case Shape::next_iteration:
          if (masked_within(s.target)) {
            mark(at_.divergent, s.id);
            mark(at_.waits_at_next, s.target->id);
            skipped_.insert(s.target->id);
            mark_masked(*s.target);
          }
          break;
        case Shape::leave_cases:
          if (masked_within(s.target)) {
            mark(at_.divergent, s.id);
            mark_masked(*s.target);
          }
          break;
        case Shape::give_back:
          give_back(s);
          break;
        case Shape::discard:
          at_.needs_mask = true;
          break;
        case Shape::unreachable:
          break;
      }
    }

    void give_back(const Statement& s) {
      if (masked_within(nullptr)) {
        mark(at_.divergent, s.id);
        if (!at_.divergent_return) changed_ = at_.divergent_return = true;
        // The lanes that returned must not keep an enclosing loop going.
        for (const Frame& f : frames_)
          if (f.construct->shape == Shape::loop) mark_masked(*f.construct);
      }
      if (s.value != 0 && (varying(s.value) || at_.divergent_return) && !at_.result_varying)
        changed_ = at_.result_varying = true;
    }

    // Whether lanes outside the current mask may still read `variable` before they write it.
    bool live_elsewhere(Id variable) const {
      for (const Frame& f : frames_) {
        const Statement& s = *f.construct;
        if (!at_.is_masked(s)) continue;
        switch (f.part) {
          case Part::then_arm:
            if (s.live_else.count(variable)) return true;
            break;
          case Part::else_arm:
            if (s.live_after.count(variable)) return true;
            break;
          case Part::body:
            if (at_.waits_at_next.count(s.id) && s.live_continuing.count(variable)) return true;
            [[fallthrough]];
          case Part::continuing:
            if (at_.waits_at_end.count(s.id) && s.live_after.count(variable)) return true;
            break;
          case Part::in_case:
            if (s.live_after.count(variable)) return true;
            for (std::size_t k = f.case_index + 1; k < s.live_cases.size(); ++k)
              if (s.live_cases[k].count(variable)) return true;
            break;
        }
      }
      // What returned lanes give back through an out parameter.
      for (std::size_t k = 0; at_.divergent_return && k < info_.function->parameters.size(); ++k)
        if (info_.function->parameters[k].id == variable && info_.is_reference(k)) return true;
      return false;
    }

    bool varying_index(const Instruction& chain) const {
      return std::any_of(chain.operands.begin() + 1, chain.operands.end(), [&](Id id) { return varying(id); });
    }

    // Any varying index on the way from the root to `pointer`.
    bool varying_path(Id pointer) const {
      for (;;) {
        const auto found = info_.definitions.find(pointer);
        if (found == info_.definitions.end() || !found->second->is_chain()) return false;
        if (varying_index(*found->second)) return true;
        pointer = found->second->operands[0];
      }
    }

    bool load_varies(Id pointer) const {
      if (varying_path(pointer)) return true;
      const Id root = root_of(info_, pointer);
      const auto v = module_.variables.find(root);
      if (v == module_.variables.end()) return varying(root);  // a parameter
      switch (v->second.storage) {
        case spv::StorageClassFunction:
          return varying(root) && !info_.constant_tables.count(root);
        case spv::StorageClassPrivate:
          return analysis_.result_.varying_globals.count(root) != 0;
        case spv::StorageClassUniformConstant:
        case spv::StorageClassUniform:
          return false;
        case spv::StorageClassInput: {  // what a work group shares
          const std::uint32_t built_in = module_.decorations_of(root).get(spv::DecorationBuiltIn, spv::BuiltInMax);
          return built_in != spv::BuiltInWorkgroupId && built_in != spv::BuiltInNumWorkgroups;
        }
        default:
          return true;
      }
    }

    void store(const Instruction& i, Id pointer, bool value_varies) {
      const Id root = root_of(info_, pointer);
      const auto v = module_.variables.find(root);
      const spv::StorageClass storage = v == module_.variables.end() ? spv::StorageClassFunction : v->second.storage;
      const bool varies = value_varies || varying_path(pointer);
      if (storage == spv::StorageClassUniform || storage == spv::StorageClassWorkgroup) {
        at_.needs_mask = true;
      } else if (storage == spv::StorageClassFunction) {
        const bool partial = live_elsewhere(root);
        if (partial) at_.partial.insert(&i);
        if (partial || varies) mark(root);
      } else {
        const bool partial = !at_.whole || masked_within(nullptr) || at_.divergent_return;
        if (partial) at_.partial.insert(&i);
        at_.needs_mask = true;
        if (storage == spv::StorageClassPrivate && (partial || varies))
          changed_ |= analysis_.result_.varying_globals.insert(root).second;
      }
    }

    void call(const Instruction& i) {
      const FunctionInfo& callee_info = analysis_.program_.info(i.operands[0]);
      std::vector<bool> varying_in;
      for (std::size_t k = 1; k < i.operands.size(); ++k) varying_in.push_back(varying(i.operands[k]));
      const bool whole = at_.whole && !masked_within(nullptr) && !at_.divergent_return;
      Instance& callee = analysis_.instance(i.operands[0], varying_in, whole || !callee_info.mask_matters);
      at_.callees[&i] = &callee;
      if (callee.needs_mask) at_.needs_mask = true;
      if (callee.result_varying) mark(i.result);
      for (std::size_t k = 0; k + 1 < i.operands.size(); ++k)
        if (callee_info.written_parameters.count(k)) store(i, i.operands[k + 1], callee.varying_out[k]);
    }

    void instruction(const Instruction& i) {
      bool varies = false;
      switch (i.op) {
        case spv::OpStore:
          store(i, i.operands[0], varying(i.operands[1]));
          return;
        case spv::OpFunctionCall:
          call(i);
          return;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
        case spv::OpVariable:
          return;
        case spv::OpLoad:
          varies = load_varies(i.operands[0]);
          break;
        case spv::OpArrayLength:
        case spv::OpImageQuerySize:
        case spv::OpImageQuerySizeLod:
        case spv::OpImageQueryLevels:
          break;
        case spv::OpImageSampleImplicitLod:
        case spv::OpImageSampleExplicitLod:
        case spv::OpImageSampleProjImplicitLod:
        case spv::OpImageSampleProjExplicitLod:
        case spv::OpImageGather:
        case spv::OpImageFetch:
          varies = true;
          break;
        case spv::OpExtInst:
          if (i.operands[1] == 35) {  // modf
            varies = varying(i.operands[2]);
            store(i, i.operands[3], varies);
            break;
          }
          if (is_interpolation(i.operands[1])) {
            varies = load_varies(i.operands[2]);
            break;
          }
          [[fallthrough]];
        default:
          if (i.op >= spv::OpAtomicLoad && i.op <= spv::OpAtomicXor) {
            at_.needs_mask = true;
            varies = true;
            break;
          }
          for (Id id : value_operands(i)) varies |= varying(id);
      }
      if (varies && i.result != 0) mark(i.result);
    }

    Analysis& analysis_;
    const Module& module_;
    const FunctionInfo& info_;
    Instance& at_;
    bool changed_ = false;
    std::set<int> skipped_;  // loops of which, so far in this iteration, some lanes have skipped the rest
    std::vector<Frame> frames_;
  };

  const Program& program_;
  const Module& module_;
  Instances result_;
  std::map<Id, std::size_t> sizes_;  // instructions of the functions that have an instance
  std::size_t copied_ = 0;           // instructions of all instances but each function's first
};

}  // namespace

Instances analyse_uniformity(const Program& program) { return Analysis(program).run(); }

}  // namespace twinshade::spirv

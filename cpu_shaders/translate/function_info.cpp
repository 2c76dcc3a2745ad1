#include "cpu_shaders/translate/function_info.h"

#include <algorithm>

#include "base/error.h"

namespace twinshade::spirv {
namespace {

bool is_local(const Module& module, Id variable) {
  const auto found = module.variables.find(variable);
  return found != module.variables.end() && found->second.storage == spv::StorageClassFunction;
}

bool is_memory(spv::StorageClass c) { return c == spv::StorageClassUniform || c == spv::StorageClassWorkgroup; }

bool is_atomic(spv::Op op) { return op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor; }

class Gatherer {
 public:
  Gatherer(Program& program, FunctionInfo& info) : program_(program), module_(program.module), info_(info) {}

  void run() {
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      if (i.result != 0) info_.definitions[i.result] = &i;
    });
    for_each_statement(info_.body.list, [&](const Statement& s) {
      for (Id id : {s.condition, s.back_condition, s.value})
        if (id != 0) ++info_.uses[id];
      for (const Instruction& i : s.code) instruction(i);
      if (s.shape == Shape::discard) info_.discards = true;
      if (s.shape != Shape::code && s.shape != Shape::give_back) info_.mask_matters = true;
    });
    count_chains();
    constant_tables();
    if (!info_.globals_written.empty() || info_.writes_buffers) info_.mask_matters = true;
  }

 private:
  // A pointer is written out wherever it is used (x[i]++ loads and stores through one), and its indices with it.
  void count_chains() {
    std::vector<const Instruction*> chains;
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      if (i.is_chain()) chains.push_back(&i);
    });
    std::for_each(chains.rbegin(), chains.rend(), [&](const Instruction* chain) {
      const int more = info_.uses[chain->result] - 1;
      if (more > 0)
        for (Id id : chain->operands) info_.uses[id] += more;
    });
  }

  void note(Id root) {
    if (is_local(module_, root) && std::find(info_.locals.begin(), info_.locals.end(), root) == info_.locals.end())
      info_.locals.push_back(root);
  }

  void read(Id pointer) {
    const Id root = root_of(info_, pointer);
    note(root);
    const auto v = module_.variables.find(root);
    if (v == module_.variables.end()) return;
    if (v->second.storage == spv::StorageClassPrivate || v->second.storage == spv::StorageClassOutput)
      info_.globals_read.insert(root);
    if (is_memory(v->second.storage)) info_.reads_buffers = true;
  }

  void write(Id pointer) {
    const Id root = root_of(info_, pointer);
    note(root);
    for (std::size_t k = 0; k < info_.function->parameters.size(); ++k)
      if (info_.function->parameters[k].id == root) info_.written_parameters.insert(k);
    const auto v = module_.variables.find(root);
    if (v == module_.variables.end()) return;
    if (v->second.storage == spv::StorageClassPrivate || v->second.storage == spv::StorageClassOutput)
      info_.globals_written.insert(root);
    if (is_memory(v->second.storage)) info_.writes_buffers = true;
  }

  void instruction(const Instruction& i) {
    const std::vector<Id> operands = value_operands(i);
    // A scalar repeated over a vector is one use of it; so is a vector taken apart in order.
    if (i.op == spv::OpCompositeConstruct &&
        std::all_of(operands.begin(), operands.end(), [&](Id id) { return id == operands[0]; }))
      ++info_.uses[operands[0]];
    else if (i.op == spv::OpVectorShuffle && i.operands[0] == i.operands[1])
      ++info_.uses[operands[0]];
    else
      for (Id id : operands) ++info_.uses[id];
    switch (i.op) {
      case spv::OpLoad:
      case spv::OpArrayLength:
        read(i.operands[0]);
        break;
      case spv::OpStore:
        write(i.operands[0]);
        break;
      case spv::OpExtInst:
        if (i.operands[1] == 35) write(i.operands[3]);  // modf
        break;
      case spv::OpDPdx:
      case spv::OpDPdy:
      case spv::OpFwidth:
      case spv::OpDPdxFine:
      case spv::OpDPdyFine:
      case spv::OpFwidthFine:
      case spv::OpDPdxCoarse:
      case spv::OpDPdyCoarse:
      case spv::OpFwidthCoarse:
        info_.uses_derivatives = true;
        break;
      case spv::OpControlBarrier:
        info_.has_barrier = info_.reads_buffers = info_.writes_buffers = true;
        break;
      case spv::OpFunctionCall:
        call(i);
        break;
      default:
        if (is_atomic(i.op)) {
          read(i.operands[0]);
          if (i.op != spv::OpAtomicLoad) write(i.operands[0]);
        }
    }
  }

  void call(const Instruction& i) {
    const FunctionInfo& callee = program_.info(i.operands[0]);
    info_.globals_read.insert(callee.globals_read.begin(), callee.globals_read.end());
    info_.globals_written.insert(callee.globals_written.begin(), callee.globals_written.end());
    info_.mask_matters |= callee.mask_matters;
    info_.discards |= callee.discards;
    info_.writes_buffers |= callee.writes_buffers;
    info_.reads_buffers |= callee.reads_buffers;
    info_.uses_derivatives |= callee.uses_derivatives;
    info_.has_barrier |= callee.has_barrier;
    for (std::size_t k = 0; k + 1 < i.operands.size(); ++k) {
      const Id argument = i.operands[k + 1];
      if (module_.type_of(argument).kind != Kind::pointer) continue;
      read(argument);
      if (callee.written_parameters.count(k)) write(argument);
    }
  }

  // Finds the local variables that may be read without their store: elsewhere than later in its list of statements.
  void find_early_reads(const List& list, std::set<Id>& stored, std::set<Id>& early) const {
    std::vector<Id> stored_here;
    for (const auto& s : list) {
      for (const Instruction& i : s->code) {
        for (Id id : value_operands(i))
          if (is_local(module_, id) && i.op != spv::OpStore && !stored.count(id)) early.insert(id);
        if (i.op == spv::OpStore && stored.insert(i.operands[0]).second) stored_here.push_back(i.operands[0]);
      }
      for (const List* inner : {&s->then_list, &s->else_list, &s->body, &s->continuing})
        find_early_reads(*inner, stored, early);
      for (const Case& c : s->cases) find_early_reads(c.body, stored, early);
    }
    for (Id id : stored_here) stored.erase(id);
  }

  // Variables that are stored whole, once, with a constant, and else only read through loads, later.
  void constant_tables() {
    std::map<Id, int> stores, other;
    std::map<Id, Id> constant;
    for_each_instruction(info_.body.list, [&](const Instruction& i) {
      if (i.op == spv::OpStore) {
        const Id root = root_of(info_, i.operands[0]);
        ++stores[root];
        if (i.operands[0] == root && module_.is_constant(i.operands[1])) constant[root] = i.operands[1];
      } else if (i.op != spv::OpLoad && !i.is_chain()) {
        for (Id id : value_operands(i))
          if (module_.value_types.count(id) && module_.type_of(id).kind == Kind::pointer) ++other[root_of(info_, id)];
      }
    });
    std::set<Id> stored, early;
    find_early_reads(info_.body.list, stored, early);
    for (Id v : info_.locals) {
      const Kind kind = module_.type(module_.variables.at(v).type).kind;
      if (stores[v] == 1 && other[v] == 0 && constant.count(v) && !early.count(v) && kind == Kind::array)
        info_.constant_tables[v] = constant[v];
    }
  }

  Program& program_;
  const Module& module_;
  FunctionInfo& info_;
};

// Which call arguments the callers read again, and which are mere temporaries.
void relate_calls(Program& program, FunctionInfo& info) {
  const Module& m = program.module;
  struct Mentions {
    int stores = 0, loads = 0, calls = 0, other = 0;
  };
  std::map<Id, Mentions> mentions;
  for_each_instruction(info.body.list, [&](const Instruction& i) {
    for (Id id : value_operands(i)) {
      if (!is_local(m, id)) continue;
      Mentions& n = mentions[id];
      if (i.op == spv::OpStore && i.operands[0] == id)
        ++n.stores;
      else if (i.op == spv::OpLoad)
        ++n.loads;
      else if (i.op == spv::OpFunctionCall)
        ++n.calls;
      else
        ++n.other;
    }
  });
  for_each_instruction(info.body.list, [&](const Instruction& i) {
    if (i.op != spv::OpFunctionCall) return;
    FunctionInfo& callee = program.functions.at(i.operands[0]);
    for (std::size_t k = 0; k + 1 < i.operands.size(); ++k) {
      const Id argument = i.operands[k + 1];
      if (m.type_of(argument).kind != Kind::pointer) continue;
      info.parameter_of[argument] = m.name(callee.function->parameters[k].id);
      const auto found = mentions.find(argument);
      const bool temporary = found != mentions.end() && m.name(argument) == "param" && found->second.stores == 1 &&
                             found->second.loads == 0 && found->second.calls == 1 && found->second.other == 0;
      if (temporary)
        info.argument_temporaries.insert(argument);
      else
        callee.returned_parameters.insert(k);
    }
  });
}

void callees_first(const Program& program, Id function, std::vector<Id>& order) {
  if (std::find(order.begin(), order.end(), function) != order.end()) return;
  for (const Block& b : program.module.function(function)->blocks)
    for (const Instruction& i : b.code)
      if (i.op == spv::OpFunctionCall) callees_first(program, i.operands[0], order);
  order.push_back(function);
}

}  // namespace

bool FunctionInfo::pure() const {
  if (!globals_written.empty() || discards || writes_buffers) return false;
  for (std::size_t k : written_parameters)
    if (returned_parameters.count(k)) return false;
  return true;
}

Id FunctionInfo::parameter_type(const Module& module, std::size_t parameter) const {
  const Id type = function->parameters[parameter].type;
  return module.type(type).kind == Kind::pointer ? module.type(type).element : type;
}

bool FunctionInfo::passed_uncopied(const Module& module, std::size_t parameter) const {
  const Kind kind = module.type(parameter_type(module, parameter)).kind;
  return (kind == Kind::array || kind == Kind::structure) && !written_parameters.count(parameter);
}

Id root_of(const FunctionInfo& info, Id pointer) {
  for (;;) {
    const auto found = info.definitions.find(pointer);
    if (found == info.definitions.end() || !found->second->is_chain()) return pointer;
    pointer = found->second->operands[0];
  }
}

Program analyse(Module module) {
  Program program;
  program.module = std::move(module);
  callees_first(program, program.module.entry, program.callees_first);
  for (Id id : program.callees_first) {
    FunctionInfo& info = program.functions[id];
    for (Function& f : program.module.functions)
      if (f.id == id) info.function = &f;
    complete_struct_copies(program.module, *info.function);
    simplify(program.module, *info.function);
    info.body = structure(program.module, *info.function);
    fold_conditionals(program.module, info.body);
    Gatherer(program, info).run();
    find_endless_loops(program, info);
  }
  for (Id id : program.callees_first) relate_calls(program, program.functions.at(id));
  for (Id id : program.callees_first) compute_liveness(program, program.functions.at(id));
  return program;
}

}  // namespace twinshade::spirv

#include "cpu_shaders/translate/find_recursion.h"

#include <glslang/MachineIndependent/localintermediate.h>

#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace twinshade {
namespace {

struct Call {
  std::string callee;  // mangled: "f(i1;"
  std::string where;   // file:line
};
using CallGraph = std::map<std::string, std::vector<Call>>;

class CallFinder : public glslang::TIntermTraverser {
 public:
  explicit CallFinder(const ShaderSource& source) : TIntermTraverser(true, false, true), source_(source) {}

  bool visitAggregate(glslang::TVisit visit, glslang::TIntermAggregate* node) override {
    const std::string name(node->getName().c_str());
    // Behind a function's end, global variables may be given values by calls.
    if (node->getOp() == glslang::EOpFunction) caller_ = visit == glslang::EvPreVisit ? name : "";
    if (visit == glslang::EvPreVisit && node->getOp() == glslang::EOpFunctionCall && node->isUserDefined())
      calls[caller_].push_back({name, where(node->getLoc())});
    return true;
  }

  CallGraph calls;

 private:
  std::string where(const glslang::TSourceLoc& at) const {
    const char* file = at.getFilename();
    return (file != nullptr ? std::string(file) : source_.files.at(0)) + ":" + std::to_string(at.line);
  }

  const ShaderSource& source_;
  std::string caller_;
};

std::string plain(const std::string& mangled) { return mangled.substr(0, mangled.find('(')); }

// Depth first; `path` holds the calls from the first function to the current one.
class CycleFinder {
 public:
  explicit CycleFinder(const CallGraph& calls) : calls_(calls) {}

  void from(const std::string& function) {
    State& state = states_[function];
    if (state != State::unseen) return;
    state = State::open;
    if (const auto found = calls_.find(function); found != calls_.end())
      for (const Call& call : found->second) {
        path_.push_back(call);
        if (states_[call.callee] == State::open) refuse(call.callee);
        from(call.callee);
        path_.pop_back();
      }
    states_[function] = State::done;
  }

 private:
  enum class State { unseen, open, done };

  [[noreturn]] void refuse(const std::string& function) const {
    std::size_t first = path_.size() - 1;  // the calls after `function` was entered
    while (first > 0 && path_[first - 1].callee != function) --first;
    std::string chain = plain(function);
    for (std::size_t k = first; k < path_.size(); ++k)
      chain += " -> " + plain(path_[k].callee) + " (" + path_[k].where + ")";
    throw UserError(path_[first].where + ": " + plain(function) +
                    " calls itself, and GLSL has no recursion: write a loop; the calls are " + chain);
  }

  const CallGraph& calls_;
  std::map<std::string, State> states_;
  std::vector<Call> path_;
};

}  // namespace

void refuse_recursion(const glslang::TIntermediate& tree, const ShaderSource& source) {
  CallFinder finder(source);
  if (tree.getTreeRoot() == nullptr) return;
  tree.getTreeRoot()->traverse(&finder);
  CycleFinder cycles(finder.calls);
  for (const auto& [function, calls] : finder.calls) cycles.from(function);
}

}  // namespace twinshade

#include "cpu_shaders/translate/locate_outputs.h"

#include <glslang/MachineIndependent/localintermediate.h>

#include <map>
#include <vector>

#include "cpu_shaders/source/output_locations.h"

namespace twinshade {
namespace {

class Locator : public glslang::TIntermTraverser {
 public:
  explicit Locator(const glslang::TIntermAggregate& declared) {
    OutputLocations locations;
    std::vector<const glslang::TIntermSymbol*> without;
    for (TIntermNode* node : declared.getSequence()) {
      const glslang::TIntermSymbol* symbol = node->getAsSymbolNode();
      if (symbol == nullptr || symbol->getQualifier().storage != glslang::EvqVaryingOut) continue;
      if (symbol->getQualifier().hasLocation())
        locations.take(int(symbol->getQualifier().layoutLocation), count(*symbol));
      else
        without.push_back(symbol);
    }
    for (const glslang::TIntermSymbol* symbol : without)
      located_[symbol->getId()] = locations.take_lowest(count(*symbol));
  }
  void visitSymbol(glslang::TIntermSymbol* symbol) override {
    if (const auto found = located_.find(symbol->getId()); found != located_.end())
      symbol->getWritableType().getQualifier().layoutLocation = unsigned(found->second);
  }

 private:
  static int count(const glslang::TIntermSymbol& symbol) {
    return glslang::TIntermediate::computeTypeLocationSize(symbol.getType(), EShLangFragment);
  }

  std::map<long long, int> located_;  // by glslang's numbers of symbols
};

}  // namespace

void locate_outputs(const glslang::TIntermediate& tree) {
  if (tree.getTreeRoot() == nullptr) return;
  Locator locator(*tree.findLinkerObjects());
  tree.getTreeRoot()->traverse(&locator);
}

}  // namespace twinshade

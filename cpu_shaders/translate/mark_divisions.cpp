#include "cpu_shaders/translate/mark_divisions.h"

#include <glslang/MachineIndependent/localintermediate.h>

namespace twinshade {
namespace {

class Marker : public glslang::TIntermTraverser {
 public:
  bool visitBinary(glslang::TVisit, glslang::TIntermBinary* node) override {
    if (node->getOp() == glslang::EOpDiv) node->getWritableType().getQualifier().setNoContraction();
    return true;
  }
};

}  // namespace

void mark_divisions(const glslang::TIntermediate& tree) {
  Marker marker;
  if (tree.getTreeRoot() != nullptr) tree.getTreeRoot()->traverse(&marker);
}

}  // namespace twinshade

#include "app/own_resources.h"

#include <algorithm>

#include "base/error.h"

namespace twinshade {
namespace {

template <class T>
void add_own(std::vector<T>& there, std::vector<T> own, const char* option) {
  for (T& one : own) {
    const bool taken = std::any_of(there.begin(), there.end(), [&](const T& other) { return other.name == one.name; });
    if (taken) throw UserError(std::string(option) + one.name + ": the scene has it: leave it out");
    there.push_back(std::move(one));
  }
}

}  // namespace

void add_own_resources(Bundle& bundle, OwnResources own) {
  add_own(bundle.uniforms, std::move(own.uniforms), "--uniform ");
  add_own(bundle.textures, std::move(own.textures), "--texture ");
}

}  // namespace twinshade

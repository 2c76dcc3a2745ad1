#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "images/image_codec.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

// Beside the program, where it is installed, and where it was built.
std::vector<fs::path> places() {
  std::vector<fs::path> all;
  std::error_code code;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", code); !code) {
    all.push_back(program.parent_path() / TWINSHADE_CODEC_NAME);
    all.push_back(program.parent_path().parent_path() / TWINSHADE_CODEC_FOLDER / TWINSHADE_CODEC_NAME);
  }
  all.emplace_back(TWINSHADE_CODEC_BUILT);
  return all;
}

const ImageCodec& load() {
  std::string looked;
  for (const fs::path& place : places()) {
    std::error_code code;
    if (!fs::exists(place, code)) {
      looked += (looked.empty() ? "" : ", ") + place.string();
      continue;
    }
    void* module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) throw UserError(std::string("image files cannot be read or written: ") + dlerror());
    const void* symbol = dlsym(module, kImageCodecSymbol);
    if (!symbol) throw UserError(place.string() + ": not the module for image files that belongs to this program");
    return *static_cast<const ImageCodec*>(symbol);
  }
  throw UserError("image files cannot be read or written: no module at " + looked + "; build or install it there");
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

}  // namespace twinshade

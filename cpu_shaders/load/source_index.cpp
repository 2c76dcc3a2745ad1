#include "cpu_shaders/load/source_index.h"

#include <filesystem>

#include "base/cache.h"
#include "base/error.h"
#include "base/file.h"

namespace twinshade {
namespace {
namespace fs = std::filesystem;

const std::string& program_identity() {
  static const std::string identity = [] {
    std::error_code code;
    const fs::path program = fs::canonical("/proc/self/exe", code);
    return std::to_string(fs::file_size(program, code)) + " " +
           std::to_string(fs::last_write_time(program, code).time_since_epoch().count());
  }();
  return identity;
}

}  // namespace

IndexedSource::IndexedSource(const ShaderSource& source, const CompileOptions& options)
    : path_(cache_folder() + "/shader-" +
            object_key(program_identity() + "\n" + source.name + "\n" + source_hash(source), options) + ".object") {}

std::string IndexedSource::find() const {
  std::error_code code;
  if (!fs::is_regular_file(path_, code)) return "";
  const fs::path object = fs::path(path_).parent_path() / read_file(path_);
  if (object.extension() != ".so" || !is_sealed(object.string())) return "";
  touch_cached(path_);
  touch_cached(object.string());
  return object.string();
}

void IndexedSource::remember(const std::string& object) const {
  try {
    write_cached(path_, fs::path(object).filename().string());
  } catch (const UserError&) {
  }
}

}  // namespace twinshade

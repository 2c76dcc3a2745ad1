#include "app/provenance.h"

#include <fstream>

#include "base/parallel.h"
#include "golden/content_hashes.h"

namespace twinshade {
namespace {

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0 || line.rfind("CPU part", 0) == 0)
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

constexpr const char* kCompiler =
#if defined(__clang__)
    "clang " __clang_version__;
#else
    "gcc " __VERSION__;
#endif

}  // namespace

Provenance::Provenance(const CommonOptions& options) {
  json_["twinshade"] = TWINSHADE_VERSION;
  json_["processor"] = processor_name();
  json_["compiler"] = kCompiler;
  json_["flags"] = TWINSHADE_FLAGS;
  json_["threads"] = thread_count();
  json_["seed"] = options.seed;
}

void Provenance::add(const Subject& subject) {
  json_["bundle"] = subject.hash;
  Json notes = Json::object();
  for (const auto& [key, value] : subject.bundle.notes) notes[key] = value;
  json_["bundle_notes"] = notes;
  json_["size"] = {subject.bundle.width, subject.bundle.height};
}

void Provenance::add(const Shading& shading) { add_shader(shading.label(), content_hash(shading.source)); }

void Provenance::add_shader(const std::string& name, const std::string& hash) { json_["shaders"][name] = hash; }

void Provenance::add(const std::string& backend, const std::vector<std::pair<std::string, std::string>>& said) {
  Json& entry = json_["backends"][backend];
  if (!entry.is_null()) return;
  entry = Json::object();
  for (const auto& [key, value] : said)
    if (key != "shader") entry[key] = value;  // one of many: they have their own place
}

}  // namespace twinshade

// Where a result comes from, as JSON: what one needs to make it again.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/output.h"
#include "app/subject.h"
#include "raster/renderer.h"

namespace twinshade {

class Provenance {
 public:
  explicit Provenance(const CommonOptions& options);
  void add(const Subject& subject);
  void add(const Shading& shading);
  void add_shader(const std::string& name, const std::string& hash);
  // GL_RENDERER, instruction set ...: what the backend says about itself. The first frame of a backend counts.
  void add(const std::string& backend, const Frame& frame) { add(backend, frame.provenance); }
  void add(const std::string& backend, const std::vector<std::pair<std::string, std::string>>& said);
  Json json() const { return json_; }

 private:
  Json json_;
};

}  // namespace twinshade

// Words of GLSL that were names before a version made them keywords.
#pragma once

namespace twinshade {

struct KeywordVersion {
  const char* name;
  int version, es_version;  // that made it one
};

inline constexpr KeywordVersion kNewKeywords[] = {
    {"sample", 400, 0},   {"patch", 400, 0},    {"subroutine", 400, 0}, {"precise", 400, 320}, {"coherent", 420, 0},
    {"restrict", 420, 0}, {"readonly", 420, 0}, {"writeonly", 420, 0},  {"buffer", 430, 310},  {"shared", 430, 310},
};

}  // namespace twinshade

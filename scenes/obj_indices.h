// Whether the vertices, texture coordinates and normals that faces of a Wavefront OBJ file name are there (Advanced
// Visualizer manual, appendix B1: indices from 1, or from -1 backwards). assimp draws a face without texture
// coordinates or normals where an index of them is out of range, and names no line for vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace twinshade {

class ObjIndices {
 public:
  // A statement of ObjLines, in the file's order. UserError naming `path` and the line: an index of 0, one from the end
  // that is before the first, or what is no index.
  void read(std::string_view statement, const std::string& path, std::size_t line);
  // At the end, since faces may stand before their vertices. UserError: an index beyond the last.
  void check(const std::string& path) const;

 private:
  void read_corner(std::string_view corner, const std::string& path, std::size_t line);

  static constexpr std::size_t kKinds = 3;  // v, vt, vn
  struct Largest {
    std::int64_t index = 0;
    std::size_t line = 0;
  };
  std::array<std::int64_t, kKinds> counts_{};
  std::array<Largest, kKinds> largest_;
};

}  // namespace twinshade

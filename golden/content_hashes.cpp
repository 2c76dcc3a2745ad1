#include "golden/content_hashes.h"

#include <algorithm>

#include "base/hash.h"
#include "cpu_shaders/source/line_names.h"

namespace twinshade {
namespace {

// `#line N "path"` with the path's place among the files in its stead; other lines as they are.
std::string without_path(const std::string& line, const std::vector<std::string>& files) {
  if (line.rfind("#line ", 0) != 0 || line.back() != '"') return line;
  const std::size_t begin = line.find('"') + 1;
  const std::string name = line.substr(begin, line.size() - 1 - begin);
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const auto& file) { return line_name(file) == name; });
  return found == files.end() ? line : line.substr(0, begin - 1) + std::to_string(found - files.begin());
}

}  // namespace

std::string content_hash(Bundle bundle) {
  bundle.notes.clear();
  return bundle_hash(bundle);
}

std::string content_hash(const ShaderSource& source) {
  ShaderSource placed = source;
  placed.text.clear();
  for (std::size_t begin = 0; begin < source.text.size();) {
    const std::size_t end = std::min(source.text.find('\n', begin), source.text.size());
    placed.text += without_path(source.text.substr(begin, end - begin), source.files) + '\n';
    begin = end + 1;
  }
  return source_hash(placed);
}

}  // namespace twinshade

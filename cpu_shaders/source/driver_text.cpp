// What OpenGL drivers need instead: files by number, and their logs back by name.
#include <cctype>
#include <regex>
#include <sstream>

#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/source/line_names.h"

namespace twinshade {
namespace {

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

// `#line 12 "a.glsl"` to `#line 12 1`.
std::string numbered(const ShaderSource& source, const std::string& line) {
  const std::size_t open = line.find('"'), close = line.rfind('"');
  if (!starts_with(line, "#line ") || open == std::string::npos || close == open) return line;
  const std::string path = line.substr(open + 1, close - open - 1);
  for (std::size_t k = 0; k < source.files.size(); ++k)
    if (line_name(source.files[k]) == path) return line.substr(0, open) + std::to_string(k);
  return line.substr(0, open) + "0";
}

}  // namespace

std::string gl_text(const ShaderSource& source, const std::string& version_line, const std::string& extra_lines) {
  std::string head = version_line, body;
  if (head.empty() || head.back() != '\n') head += '\n';
  std::istringstream lines(source.text);
  bool in_head = true, pending_line_directive = false;
  std::string line, pending;
  const auto end_head = [&] {
    if (!in_head) return;
    in_head = false;
    head += extra_lines;
    if (!extra_lines.empty() && extra_lines.back() != '\n') head += '\n';
  };
  while (std::getline(lines, line)) {
    if (in_head && starts_with(line, "#version")) continue;
    // A #line belongs to the head if an #extension follows it.
    if (in_head && starts_with(line, "#line") && !pending_line_directive) {
      pending = numbered(source, line) + '\n';
      pending_line_directive = true;
      continue;
    }
    if (in_head && starts_with(line, "#extension")) {
      head += pending + line + '\n';
      pending_line_directive = false;
      continue;
    }
    end_head();
    if (pending_line_directive) body += pending;
    pending_line_directive = false;
    body += numbered(source, line) + '\n';
  }
  end_head();
  return head + body;
}

std::string map_driver_log(const ShaderSource& source, const std::string& log) {
  static const std::regex position(R"(^(\s*)(?:(\d+):(\d+)(?:\((\d+)\))?|(\d+)\((\d+)\)))");
  std::istringstream lines(log);
  std::string mapped, line;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_search(line, match, position)) {
      const std::string& file_text = match[2].matched ? match[2].str() : match[5].str();
      const std::string& line_text = match[3].matched ? match[3].str() : match[6].str();
      const std::size_t file = file_text.size() < 6 ? std::stoul(file_text) : source.files.size();
      if (file < source.files.size()) {
        const std::string where = match[1].str() + source.files[file] + ":" + line_text;
        line = where + match.suffix().str();
      }
    }
    mapped += line + '\n';
  }
  if (!mapped.empty() && (log.empty() || log.back() != '\n')) mapped.pop_back();
  return mapped;
}

}  // namespace twinshade

#include "app/profile/code_lines.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/error.h"
#include "cpu_shaders/load/run_program.h"
#include "cpu_shaders/source/line_names.h"

namespace twinshade {
namespace {

// A few hundred letters for each line that was inlined: less than what run_program keeps.
constexpr std::size_t kAddressesAtOnce = 200;

Dl_info object_of(std::uintptr_t address) {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<void*>(address), &info) == 0) info = {};
  return info;
}

std::string find_addr2line() {
  for (const char* folder : {"/usr/bin/", "/usr/local/bin/", "/bin/"}) {
    std::error_code code;
    const std::string path = std::string(folder) + "addr2line";
    if (std::filesystem::exists(path, code)) return path;
  }
  throw UserError("addr2line: not found in /usr/bin; install binutils, which has it");
}

// "/somewhere/a.frag:12 (discriminator 2)". The compiler puts its folder in front of relative names.
bool is_line_of(const std::string& text, const std::string& file, GlslLine& found) {
  const std::size_t colon = text.find_last_of(':');
  if (colon == text.npos) return false;
  const std::string path = text.substr(0, colon), name = line_name(file);
  if (path != name && !path.ends_with("/" + name)) return false;
  int line = 0;
  std::from_chars(text.data() + colon + 1, text.data() + text.size(), line);
  found = {file, line};
  return line > 0;
}

}  // namespace

bool is_within(std::uintptr_t address, ShadeFunction entry) {
  return object_of(address).dli_fbase == object_of(reinterpret_cast<std::uintptr_t>(entry)).dli_fbase;
}

std::map<std::uintptr_t, GlslLine> glsl_lines(const std::vector<std::uintptr_t>& addresses, ShadeFunction entry,
                                              const std::vector<std::string>& files) {
  const Dl_info object = object_of(reinterpret_cast<std::uintptr_t>(entry));
  const auto base = reinterpret_cast<std::uintptr_t>(object.dli_fbase);
  const std::set<std::uintptr_t> distinct(addresses.begin(), addresses.end());
  const std::vector<std::uintptr_t> list(distinct.begin(), distinct.end());
  const std::string addr2line = find_addr2line();
  std::map<std::uintptr_t, GlslLine> lines;
  for (std::size_t first = 0; first < list.size(); first += kAddressesAtOnce) {
    std::vector<std::string> words{addr2line, "-a", "-i", "-e", object.dli_fname};
    const std::size_t last = std::min(list.size(), first + kAddressesAtOnce);
    for (std::size_t i = first; i < last; ++i) words.push_back(fmt::format("{:#x}", list[i] - base));
    const ProgramResult result = run_program(words, std::chrono::seconds(60));
    if (result.status != 0) throw UserError(addr2line + ": failed: " + result.output.substr(0, 200));
    // Each address, then the lines inlined to it, the innermost first.
    std::istringstream text(result.output);
    std::size_t at = first;
    bool begun = false;
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("0x")) {
        at += begun;
        begun = true;
      } else if (begun && at < last && !lines.contains(list[at])) {
        GlslLine found;
        std::size_t longest = 0;  // "a.frag" is the end of "b/a.frag", too
        for (const std::string& file : files)
          if (file.size() > longest && is_line_of(line, file, found)) {
            lines[list[at]] = found;
            longest = file.size();
          }
      }
    }
  }
  return lines;
}

}  // namespace twinshade

// Wavefront, MTL material format (Advanced Visualizer manual, appendix B, "Options for texture map statements").
#include "scenes/mtl_textures.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

namespace twinshade {
namespace {

constexpr const char* kBlanks = " \t\r";
constexpr std::array kDrawn = {"map_kd", "map_bump", "bump", "map_kn", "norm"};

struct Option {
  const char* name;
  std::array<const char*, 3> usual;  // its arguments where they change nothing; fewer where it has fewer
  bool seen = true;                  // whether other arguments change the picture
};

constexpr std::array kOptions = {Option{"-s", {"1", "1", "1"}},
                                 Option{"-o", {"0", "0", "0"}},
                                 Option{"-t", {"0", "0", "0"}},
                                 Option{"-mm", {"0", "1", nullptr}},
                                 Option{"-bm", {"1", nullptr, nullptr}},
                                 Option{"-clamp", {"off", nullptr, nullptr}},
                                 Option{"-cc", {"off", nullptr, nullptr}},
                                 Option{"-imfchan", {"", nullptr, nullptr}},
                                 Option{"-blendu", {"on", nullptr, nullptr}, false},
                                 Option{"-blendv", {"on", nullptr, nullptr}, false},
                                 Option{"-boost", {"0", nullptr, nullptr}, false},
                                 Option{"-texres", {"", nullptr, nullptr}, false},
                                 Option{"-type", {"", nullptr, nullptr}, false}};

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return text;
}

bool is_number(const std::string& word, double& value) {
  char* end = nullptr;
  value = std::strtod(word.c_str(), &end);
  return !word.empty() && *end == 0;
}

// Takes the first word off the text, and the blanks after it.
std::string take_word(std::string& text) {
  const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
  const std::string word = text.substr(0, end);
  text.erase(0, std::min(text.find_first_not_of(kBlanks, end), text.size()));
  return word;
}

// Takes an option's arguments off the text. -s, -o and -t may have fewer than three: the name is no number, and
// something is left for it.
void take_arguments(std::string& text, const Option& option, std::set<std::string>& ignored) {
  for (const char* usual : option.usual) {
    if (!usual) break;
    std::string rest = text;
    const std::string word = take_word(rest);
    double value = 0, usual_value = 0;
    const bool number = is_number(word, value);
    if (rest.empty() || (option.usual[2] && !number)) break;
    text = rest;
    const bool same = number && is_number(usual, usual_value) ? value == usual_value : lower_case(word) == usual;
    if (option.seen && !same) ignored.insert(option.name);
  }
}

}  // namespace

std::string with_plain_textures(const std::string& library, std::set<std::string>& ignored) {
  std::istringstream lines(library);
  std::string text;
  for (std::string line; std::getline(lines, line); text += '\n') {
    std::string rest = line.substr(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::string keyword = take_word(rest);
    if (std::find(kDrawn.begin(), kDrawn.end(), lower_case(keyword)) == kDrawn.end()) {
      text += line;
      continue;
    }
    for (bool more = true; more;) {
      std::string after = rest;
      const std::string word = lower_case(take_word(after));
      const auto option =
          std::find_if(kOptions.begin(), kOptions.end(), [&](const Option& o) { return word == o.name; });
      more = option != kOptions.end() && !after.empty();
      if (!more) break;
      rest = after;
      take_arguments(rest, *option, ignored);
    }
    rest.erase(rest.find_last_not_of(kBlanks) + 1);
    text += rest.empty() ? line : keyword + ' ' + rest;
  }
  return text;
}

}  // namespace twinshade

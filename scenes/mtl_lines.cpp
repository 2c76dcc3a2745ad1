// Wavefront, MTL material format (Advanced Visualizer manual, appendix B: "Material color and illumination statements",
// "Options for texture map statements").
#include "scenes/mtl_lines.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "scenes/obj_lines.h"

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

// A texture's name behind its options.
std::string texture_name(std::string rest, std::set<std::string>& ignored) {
  for (bool more = true; more;) {
    std::string after = rest;
    const std::string word = lower_case(take_word(after));
    const auto option = std::find_if(kOptions.begin(), kOptions.end(), [&](const Option& o) { return word == o.name; });
    more = option != kOptions.end() && !after.empty();
    if (!more) break;
    rest = after;
    take_arguments(rest, *option, ignored);
  }
  rest.erase(rest.find_last_not_of(kBlanks) + 1);
  return rest;
}

// What materials have besides what is drawn of them; empty: nothing that would be seen.
std::string undrawn(const std::string& keyword, const std::string& rest) {
  std::string words = rest;
  double value = 0;
  const bool number = is_number(take_word(words), value);
  if ((keyword == "d" && number && value < 1) || (keyword == "tr" && number && value > 0))
    return "transparent materials are drawn opaque";
  if (keyword == "map_d") return "cut-out materials are drawn opaque";
  if ((keyword == "pm" && number && value > 0) || keyword == "map_pm")
    return "metals (Pm) are drawn as matt surfaces of their Kd";
  if ((keyword == "ke" && number && value > 0) || keyword == "map_ke")
    return "light that materials give (Ke) is ignored";
  return "";
}

// The lines of `newmtl` whose materials have a picture of colours and no colour beside it.
std::set<std::size_t> colourless(const std::string& library) {
  std::set<std::size_t> lines_found;
  std::size_t material = 0;
  bool has_picture = false, has_colour = false;
  const auto end = [&] {
    if (has_picture && !has_colour) lines_found.insert(material);
  };
  for (ObjLines lines(library); lines.next();) {
    std::string rest(lines.statement());
    const std::string keyword = lower_case(take_word(rest));
    has_picture |= keyword == "map_kd";
    has_colour |= keyword == "kd";
    if (keyword != "newmtl") continue;
    end();
    material = std::size_t(lines.number());
    has_picture = has_colour = false;
  }
  end();
  return lines_found;
}

}  // namespace

std::string plain_materials(const std::string& library, const std::string& path, std::set<std::string>& notes) {
  const std::set<std::size_t> without_colour = colourless(library);
  std::set<std::string> ignored;
  std::string text;
  bool in_material = false;  // assimp crashes at pictures before the first one
  for (ObjLines lines(library); lines.next(); text += '\n') {
    std::string rest(lines.statement());
    const std::string keyword = take_word(rest), lower = lower_case(keyword);
    std::string words = rest;
    const std::string first = lower_case(take_word(words));
    if (lower == "newmtl") {
      text += "newmtl " + rest;
      in_material = true;
      // assimp's colour, where there is none, is grey and would darken the picture.
      if (without_colour.count(std::size_t(lines.number())) != 0) text += "\nKd 1 1 1";
    } else if (lower == "kd" && (first == "xyz" || first == "spectral")) {
      notes.insert("colours as " + first + " are ignored: their materials are plain");
    } else if (lower == "kd") {
      add_colour(text, rest, path, lines.number());
    } else if (std::find(kDrawn.begin(), kDrawn.end(), lower) != kDrawn.end()) {
      const std::string name = texture_name(rest, ignored);
      if (name.empty())
        notes.insert("line " + std::to_string(lines.number()) + ": " + keyword + " names no file");
      else if (in_material)
        text += keyword + ' ' + name;
    } else if (const std::string note = undrawn(lower, rest); !note.empty()) {
      notes.insert(note);
    }
  }
  for (const std::string& option : ignored) notes.insert("the option " + option + " of its textures is ignored");
  return text;
}

}  // namespace twinshade

#include "cpu_shaders/source/macro_expansion.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <vector>

#include "cpu_shaders/source/directive_scan.h"
#include "cpu_shaders/source/find_word.h"

namespace twinshade {
namespace {

struct Definition {
  std::vector<std::string> parameters;
  bool takes_arguments = false;
  std::string body;
};

struct Size {
  double tokens = 1;  // of the expansion, arguments aside
  double copies = 1;  // of an argument
};

// NAME body, or NAME(a, b) body.
std::pair<std::string, Definition> read_definition(const std::string& arguments) {
  std::size_t at = 0;
  while (at < arguments.size() && is_word_character(arguments[at])) ++at;
  const std::string name = arguments.substr(0, at);
  Definition definition;
  if (at < arguments.size() && arguments[at] == '(') {
    definition.takes_arguments = true;
    std::string word;
    for (++at; at < arguments.size(); ++at) {
      if (is_word_character(arguments[at])) {
        word += arguments[at];
        continue;
      }
      if (!word.empty()) definition.parameters.push_back(std::move(word));
      word.clear();
      if (arguments[at] == ')') break;
    }
  }
  definition.body = arguments.substr(std::min(at + (definition.takes_arguments ? 1 : 0), arguments.size()));
  return {name, definition};
}

class Estimate {
 public:
  explicit Estimate(std::multimap<std::string, Definition> definitions) : definitions_(std::move(definitions)) {}

  bool unclear() const { return unclear_; }

  // What the macros of `text` become; the other tokens do not count, unless `within` says that the text is a macro's.
  Size of(std::string_view text, const Definition* within) {
    Size size{0, 0};
    double copies = 1;            // that the macros make whose parentheses are open
    std::vector<double> outside;  // the same outside each open parenthesis
    double next = 1;              // of the macro just read, if a parenthesis follows
    for (std::size_t at = 0; at < text.size();) {
      const char c = text[at];
      if (std::isspace(static_cast<unsigned char>(c)) != 0) {
        ++at;
        continue;
      }
      if (!is_word_character(c)) {
        if (c == '(') {
          outside.push_back(copies);
          copies *= next;
        } else if (c == ')' && !outside.empty()) {
          copies = outside.back();
          outside.pop_back();
        }
        next = 1;
        if (within != nullptr) size.tokens += copies;
        ++at;
        continue;
      }
      std::size_t end = at;
      while (end < text.size() && is_word_character(text[end])) ++end;
      const std::string word(text.substr(at, end - at));
      at = end;
      next = 1;
      const bool is_parameter = within != nullptr && std::find(within->parameters.begin(), within->parameters.end(),
                                                               word) != within->parameters.end();
      if (is_parameter) {
        size.copies += copies;
      } else if (definitions_.count(word) != 0) {
        const Size macro = of_macro(word);
        size.tokens += macro.tokens * copies;
        next = std::max(macro.copies, 1.0);
        const std::size_t behind = std::min(text.find_first_not_of(" \t\r\n\v\f", at), text.size());
        unclear_ = unclear_ || (takes_arguments(word) && text.substr(behind, 1) != "(");
      } else if (within != nullptr || copies > 1) {
        size.tokens += copies;
      }
    }
    return size;
  }

 private:
  bool takes_arguments(const std::string& name) const {
    const auto [first, last] = definitions_.equal_range(name);
    return std::any_of(first, last, [](const auto& entry) { return entry.second.takes_arguments; });
  }

  Size of_macro(const std::string& name) {
    if (const auto found = sizes_.find(name); found != sizes_.end()) return found->second;
    if (!open_.insert(name).second) {
      unclear_ = true;
      return {};
    }
    Size largest;
    for (auto [definition, end] = definitions_.equal_range(name); definition != end; ++definition) {
      const Size size = of(definition->second.body, &definition->second);
      largest.tokens = std::max(largest.tokens, size.tokens);
      largest.copies = std::max(largest.copies, size.copies);
    }
    open_.erase(name);
    return sizes_[name] = largest;
  }

  std::multimap<std::string, Definition> definitions_;
  std::map<std::string, Size> sizes_;
  std::set<std::string> open_;  // whose size is being told
  bool unclear_ = false;
};

}  // namespace

MacroUse estimate_macros(std::string_view text) {
  constexpr std::size_t kMost = 100;  // each may stand within the next: so deep goes the search
  MacroUse use;
  std::multimap<std::string, Definition> definitions;
  std::string code, conditions;
  for (const SourceLine& line : scan_lines(text)) {
    if (line.directive.empty()) code += line.code + "\n";
    if (line.directive == "if" || line.directive == "elif" || line.directive == "line")
      conditions += line.arguments + "\n";
    if (line.directive != "define") continue;
    use.unclear = use.unclear || line.arguments.find("##") != std::string::npos || ++use.macros > kMost;
    if (use.macros <= kMost) definitions.insert(read_definition(line.arguments));
  }
  if (definitions.empty()) return use;
  Estimate estimate(std::move(definitions));
  use.tokens = estimate.of(code, nullptr).tokens;
  use.unclear = use.unclear || estimate.unclear();
  use.tokens += estimate.of(conditions, nullptr).tokens;  // where a name may stand without arguments: defined(NAME)
  return use;
}

}  // namespace twinshade

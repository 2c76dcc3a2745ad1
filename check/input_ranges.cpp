#include "check/input_ranges.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "cpu_shaders/source/directive_scan.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/source/preprocess.h"

namespace twinshade {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// Decimal, or a hex float as C writes it.
double number(const std::string& text, const std::string& where) {
  const bool negative = text.rfind('-', 0) == 0, has_sign = negative || text.rfind('+', 0) == 0;
  std::string_view digits = std::string_view(text).substr(has_sign ? 1 : 0);
  const bool hex = digits.substr(0, 2) == "0x";
  if (hex) digits.remove_prefix(2);
  const bool second_sign = digits.substr(0, 1) == "-";  // from_chars would take it
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value,
                                            hex ? std::chars_format::hex : std::chars_format::general);
  if (second_sign || error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    throw UserError(where + "\"" + text + "\" is no finite number");
  return negative ? -value : value;
}

std::pair<double, double> interval(const std::string& word, const std::string& where) {
  const std::size_t dots = word.find("..");
  if (word.find("...") != std::string::npos) throw UserError(where + word + ": two dots stand between the ends");
  const double low = number(word.substr(0, dots), where), high = number(word.substr(dots + 2), where);
  if (low > high) throw UserError(where + word + ": the lower end comes first");
  return {low, high};
}

std::optional<InputRange::Kind> kind_of(const std::string& word) {
  if (word == "unit") return InputRange::Kind::unit;
  if (word == "finite") return InputRange::Kind::finite;
  if (word == "any") return InputRange::Kind::any;
  return std::nullopt;
}

// That stands first, behind blanks; none where something else does, or more digits than an int has.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  const auto [_, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

// What stands behind a range is for people, or one that was mistyped.
void require_end(const std::vector<std::string>& words, std::size_t end, const std::string& where) {
  if (end == words.size()) return;
  const bool word = std::isalpha(static_cast<unsigned char>(words[end][0])) != 0 && !kind_of(words[end]);
  if (!word || words[end].find("..") != std::string::npos)
    throw UserError(where + "\"" + words[end] + "\" is too much behind the range: # or // begins a comment");
}

// NAME 0..1 | NAME -1..1 0..2 0..2 | NAME {0, 1, 2} | NAME unit|finite|any
InputRange range_of(const std::string& line, const std::string& where) {
  const std::string text = line.substr(0, line.find("//"));  // what follows is for people
  const std::vector<std::string> words = words_of(text);
  if (words.size() < 2)
    throw UserError(where + "an input range is NAME LOW..HIGH, NAME {A, B}, or NAME unit|finite|any");
  InputRange range;
  range.name = words[0];
  range.where = where;
  if (words[1][0] == '{') {
    const std::size_t open = text.find('{'), close = text.rfind('}');
    if (close == std::string::npos) throw UserError(where + "the list of values lacks its }");
    std::string list = text.substr(open + 1, close - open - 1);
    if (list.find('{') != std::string::npos) throw UserError(where + "one list serves all components: NAME {A, B}");
    for (char& c : list)
      if (c == ',') c = ' ';
    range.kind = InputRange::Kind::list;
    for (const std::string& word : words_of(list)) range.values.push_back(number(word, where));
    if (range.values.empty()) throw UserError(where + "the list of values is empty");
    require_end(words_of(text.substr(close + 1)), 0, where);
    return range;
  }
  if (const std::optional<InputRange::Kind> kind = kind_of(words[1])) {
    range.kind = *kind;
    require_end(words, 2, where);
    return range;
  }
  std::size_t end = 1;
  for (; end < words.size() && words[end].find("..") != std::string::npos; ++end)
    range.intervals.push_back(interval(words[end], where));
  if (range.intervals.empty())
    throw UserError(where + "\"" + words[1] + "\" is no range: LOW..HIGH, {A, B}, unit, finite or any");
  require_end(words, end, where);
  return range;
}

// Which of two lines for one input is meant, nobody can tell.
void add(std::vector<InputRange>& ranges, InputRange range, const std::string& instead) {
  if (const InputRange* first = find_range(ranges, range.name)) {
    const std::string place = first->where.substr(0, first->where.size() - 2);
    throw UserError(range.where + "a second range for " + range.name + ", after " + place + ": keep one" + instead);
  }
  ranges.push_back(std::move(range));
}

struct InputComment {
  std::string text, file;
  int line = 0;
};
using InputComments = std::map<std::size_t, InputComment>;  // by their line in the resolved text, counted from 0

bool has_conditionals(const std::string& text) {
  const std::vector<SourceLine> lines = scan_lines(text);
  return std::any_of(lines.begin(), lines.end(),
                     [](const SourceLine& line) { return line.directive.rfind("if", 0) == 0; });
}

// Leaves out those that an #if leaves out. Comments are gone when conditionals are decided, pragmas are not: each line
// gets one behind it.
void keep_those_in_force(const ShaderSource& source, InputComments& comments) {
  if (comments.empty() || !has_conditionals(source.text)) return;
  const std::string mark = "#pragma twinshade_input_";
  ShaderSource marked = source;
  marked.text.clear();
  std::istringstream in(source.text);
  std::size_t at = 0;
  for (std::string line; std::getline(in, line); ++at) {
    marked.text += line + "\n";
    if (const auto found = comments.find(at); found != comments.end())
      marked.text += mark + std::to_string(at) + "\n#line " + std::to_string(found->second.line + 1) + " \"" +
                     line_name(found->second.file) + "\"\n";
  }
  std::string preprocessed;
  try {
    preprocessed = preprocess_untried(marked);
  } catch (const UserError&) {
    preprocess_untried(source);  // its own errors are told
    return;                      // a comment among a macro's arguments, where no pragma may stand
  }
  InputComments in_force;
  std::istringstream left(preprocessed);
  for (std::string line; std::getline(left, line);)
    if (line.rfind(mark, 0) == 0)
      if (const std::optional<int> comment = whole_number(std::string_view(line).substr(mark.size())))
        in_force.insert(comments.extract(std::size_t(*comment)));
  comments = std::move(in_force);
}

// Where a // comment begins, if one does; not within a block comment, which may go on from the line before.
std::size_t line_comment(const std::string& line, bool& in_block) {
  for (std::size_t at = 0; at + 1 < line.size(); ++at) {
    const std::string_view two = std::string_view(line).substr(at, 2);
    if (!in_block && two == "//") return at;
    if (two != (in_block ? "*/" : "/*")) continue;
    in_block = !in_block;
    ++at;
  }
  return std::string::npos;
}

}  // namespace

std::vector<InputRange> declared_ranges(const ShaderSource& source) {
  InputComments comments;
  std::istringstream lines(source.text);
  std::string file = source.files.empty() ? source.name : source.files[0];
  int number_of_line = 0;
  std::size_t at = 0;
  bool in_block = false;
  for (std::string line; std::getline(lines, line); ++at) {
    ++number_of_line;
    if (!in_block && line.rfind("#line ", 0) == 0) {
      // That an author's own is none is glslang's to say.
      number_of_line = whole_number(std::string_view(line).substr(6)).value_or(number_of_line + 1) - 1;
      const std::size_t open = line.find('"'), close = line.rfind('"');
      if (close != open) file = with_real_names(source.files, line.substr(open + 1, close - open - 1));
      continue;
    }
    const std::size_t comment = line_comment(line, in_block);
    const std::size_t tag = comment == std::string::npos ? comment : line.find("@input", comment);
    if (tag == std::string::npos || line.find_first_not_of("/ \t", comment) != tag) continue;
    if (const std::size_t end = std::min(line.find_first_of(" \t\r", tag), line.size()); end != tag + 6) {
      if (line.find("..", end) == std::string::npos && line.find('{', end) == std::string::npos) continue;  // prose
      throw UserError(file + ":" + std::to_string(number_of_line) + ": unknown comment " + line.substr(tag, end - tag) +
                      ": a range is declared by @input NAME");
    }
    comments[at] = {line.substr(tag + 6), file, number_of_line};
  }
  keep_those_in_force(source, comments);
  std::vector<InputRange> ranges;
  for (const auto& [_, comment] : comments)
    add(ranges, range_of(comment.text, comment.file + ":" + std::to_string(comment.line) + ": "),
        "; a side file goes before comments");
  return ranges;
}

std::vector<InputRange> ranges_in_file(const std::string& path) {
  std::vector<InputRange> ranges;
  std::istringstream lines(read_file(path, kMostTextBytes));
  int number_of_line = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number_of_line;
    line = line.substr(0, line.find('#'));
    if (words_of(line).empty()) continue;
    add(ranges, range_of(line, path + ":" + std::to_string(number_of_line) + ": "), "");
  }
  return ranges;
}

std::vector<InputRange> all_ranges(const ShaderSource& source, const std::string& path, std::string side_file) {
  std::vector<InputRange> ranges = declared_ranges(source);
  std::error_code code;
  if (side_file.empty() && std::filesystem::exists(path + ".inputs", code)) side_file = path + ".inputs";
  if (!side_file.empty())
    for (InputRange& range : ranges_in_file(side_file)) ranges.push_back(std::move(range));
  return ranges;
}

const InputRange* find_range(const std::vector<InputRange>& ranges, const std::string& name) {
  for (auto range = ranges.rbegin(); range != ranges.rend(); ++range)
    if (range->name == name) return &*range;
  return nullptr;
}

}  // namespace twinshade

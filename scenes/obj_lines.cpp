#include "scenes/obj_lines.h"

#include <algorithm>
#include <iterator>

#include "base/error.h"

namespace twinshade {
namespace {

constexpr std::string_view kBetweenWords = " \t\r";
constexpr std::size_t kMostShown = 40;  // characters of a word in a message

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Whether the line ends within a comment: a # that begins a word. A backslash means nothing there.
bool ends_in_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1))
    if (at == 0 || is_blank(line[at - 1])) return true;
  return false;
}

// What a keyword's numbers may be.
struct Numbers {
  std::string_view keyword;
  bool (*right)(std::size_t count);
  const char* wanted;
};

constexpr Numbers kNumbers[] = {
    {"v", [](std::size_t count) { return count == 3 || count == 4 || count == 6; },
     "3 numbers (x y z), 4 (x y z w) or 6 (x y z r g b)"},
    {"vt", [](std::size_t count) { return count >= 1 && count <= 3; }, "1 to 3 numbers (u v w)"},
    {"vn", [](std::size_t count) { return count == 3; }, "3 numbers (x y z)"}};

// Statements of names that assimp reads. It knows statements by their first letters: foo 1 2 3 would be a face.
constexpr std::string_view kNaming[] = {"usemtl", "g", "o"};

constexpr Numbers kColour = {"Kd", [](std::size_t count) { return count == 1 || count == 3; },
                             "3 numbers (r g b), or 1 for all of them"};

// nan and inf, and what begins with them: that a value is not finite is said where it is used.
bool is_not_finite(std::string_view text) {
  const auto begins = [&](std::string_view word) {
    return text.size() >= word.size() &&
           std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) { return a == (b | 0x20); });
  };
  return begins("nan") || begins("inf");
}

// Length of the number that the text begins with; 0: it begins with none. As assimp, which takes a comma for a point.
std::size_t number_length(std::string_view text) {
  std::size_t at = 0;
  const auto is = [&](char a, char b) { return at < text.size() && (text[at] == a || text[at] == b); };
  const auto digits = [&] {
    const std::size_t first = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - first;
  };
  if (is('+', '-')) ++at;
  if (is_not_finite(text.substr(at))) return std::min(text.find_first_of(kBetweenWords), text.size());
  std::size_t count = digits();
  if (is('.', ',')) {
    ++at;
    count += digits();
  }
  if (count == 0) return 0;
  if (is('e', 'E')) {
    ++at;
    if (is('+', '-')) ++at;
    if (digits() == 0) return 0;
  }
  return at;
}

// Returns how many there were.
std::size_t add_numbers(std::string& text, std::string_view statement, const Numbers& numbers, const std::string& path,
                        std::size_t line) {
  const auto refuse = [&](const std::string& what) {
    throw UserError(path + ":" + std::to_string(line) + ": " + what + ": write " + std::string(numbers.keyword) +
                    " with " + numbers.wanted);
  };
  text += numbers.keyword;
  std::size_t count = 0;
  for (std::size_t at = 0;;) {
    while (at < statement.size() && is_blank(statement[at])) ++at;
    if (at == statement.size() || statement[at] == '#') break;
    const std::string_view rest = statement.substr(at);
    const std::size_t length = number_length(rest);
    const bool comment = length > 0 && length < rest.size() && rest[length] == '#' && rest[length - 1] != '.';
    if (length == 0 || (length < rest.size() && !is_blank(rest[length]) && !comment))  // 1.#IND is no number
      refuse("'" + shown_word(rest) + "' is not a number");
    text += rest.front() == '.' || rest.front() == ',' ? " 0" : " ";
    text += rest.substr(0, length);
    at += length;
    ++count;
  }
  if (!numbers.right(count))
    refuse(std::string(numbers.keyword) + " has " + std::to_string(count) + (count == 1 ? " number" : " numbers"));
  return count;
}

}  // namespace

std::string shown_word(std::string_view word) {
  std::string text(word.substr(0, std::min({word.find_first_of(kBetweenWords), word.size(), kMostShown})));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

std::string_view ObjLines::take_line() {
  const std::size_t end = std::min(text_.find('\n'), text_.size());
  const std::string_view line = without_blanks(text_.substr(0, end));
  text_.remove_prefix(std::min(end + 1, text_.size()));
  ++lines_;
  return line;
}

bool ObjLines::next() {
  if (text_.empty()) return false;
  number_ = lines_ + 1;
  statement_ = take_line();
  if (statement_.ends_with('\\') && !ends_in_comment(statement_)) {
    joined_.clear();
    std::string_view part = statement_;
    while (part.ends_with('\\') && !ends_in_comment(part)) {
      joined_.append(part.substr(0, part.size() - 1)) += ' ';
      part = text_.empty() ? std::string_view() : take_line();
    }
    joined_ += part;
    statement_ = without_blanks(joined_);
  }
  if (statement_.starts_with('#')) statement_ = {};
  return true;
}

void add_statement(std::string& text, std::string_view statement, const std::string& path, std::size_t number) {
  const std::string_view keyword =
      statement.substr(0, std::min(statement.find_first_of(kBetweenWords), statement.size()));
  for (const Numbers& numbers : kNumbers) {
    if (keyword != numbers.keyword) continue;
    const std::size_t count = add_numbers(text, statement.substr(keyword.size()), numbers, path, number);
    if (keyword == "vt" && count == 1) text += " 0";
    return;
  }
  const bool has_indices = keyword == "f" || keyword == "l" || keyword == "p";
  if (has_indices)
    text += statement.substr(0, statement.find('#'));
  else if (std::find(std::begin(kNaming), std::end(kNaming), keyword) != std::end(kNaming))
    text += statement;
}

std::string undrawn_statement(std::string_view statement) {
  const std::string_view keyword =
      statement.substr(0, std::min(statement.find_first_of(kBetweenWords), statement.size()));
  if (keyword == "l" || keyword == "p") return "points and lines are not drawn";
  if (keyword == "curv" || keyword == "curv2" || keyword == "surf") return "curves and curved surfaces are not drawn";
  if (keyword != "v") return "";
  std::size_t words = 0;
  for (std::size_t at = 0; at < statement.size() && statement[at] != '#'; ++at)
    words += !is_blank(statement[at]) && (at == 0 || is_blank(statement[at - 1]));
  return words == 7 ? "vertex colours are ignored" : "";
}

void add_colour(std::string& text, std::string_view numbers, const std::string& path, std::size_t line) {
  std::string added;
  if (add_numbers(added, numbers, kColour, path, line) == 1) {
    const std::string value = added.substr(kColour.keyword.size());
    added += value + value;
  }
  text += added;
}

}  // namespace twinshade

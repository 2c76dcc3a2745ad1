#include "base/utf8.h"

#include <doctest/doctest.h>

using namespace twinshade;

TEST_CASE("what is no character of a document is replaced, all else is kept") {
  for (const char* text : {"", "plain\ttext\n", "caf\xc3\xa9", "\xe2\x86\x92", "\xf0\x9f\x98\x80"})
    CHECK(with_characters_alone(text) == text);
  const std::string other = "\xef\xbf\xbd";
  CHECK(with_characters_alone("caf\xe9!") == "caf" + other + "!");
  CHECK(with_characters_alone("\x01") == other);
  CHECK(with_characters_alone("\xc0\xaf") == other + other);              // too long
  CHECK(with_characters_alone("\xed\xa0\x80") == other + other + other);  // a surrogate
  CHECK(with_characters_alone("\xe2\x86") == other + other);              // cut
}

TEST_CASE("what would steer a terminal is replaced in a line, names of files are kept") {
  const std::string other = "\xef\xbf\xbd";
  CHECK(one_line("two\r\nlines\tand a tab \n") == "two  lines and a tab");
  CHECK(one_line("\x1b[2J\x07") == other + "[2J" + other);
  CHECK(one_line("\x7f") == other);
  CHECK(one_line("\xc2\x9b"
                 "31m") == other + "31m");  // the one-character form of ESC [
  CHECK(one_line("caf\xc3\xa9 caf\xe9 \xc2\xa0\xc2") == "caf\xc3\xa9 caf\xe9 \xc2\xa0\xc2");
  CHECK(one_line("\n").empty());
}

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
